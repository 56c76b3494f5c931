/** Keeps the verdicts in the browser between sessions. A page opened from a file may be denied that; the caller says so. */

const keyOf = (manifest) => `vesselbench-verdicts ${manifest.project.id} ${manifest.chainHead}`;

/** @returns {boolean} whether the browser keeps drafts at all */
export function draftsAllowed() {
  try {
    localStorage.setItem('vesselbench-test', '1');
    localStorage.removeItem('vesselbench-test');
    return true;
  } catch {
    return false;
  }
}

/** @returns {boolean} whether the draft was kept */
export function keepDraft(verdicts) {
  try {
    localStorage.setItem(keyOf(verdicts.manifest), JSON.stringify({ unsaved: verdicts.unsaved, file: verdicts.toFile() }));
    return true;
  } catch {
    return false;
  }
}

/** Takes over the draft of this project and chain head, if there is one. @returns {object | null} the report of `load` */
export function restoreDraft(verdicts) {
  try {
    const draft = JSON.parse(localStorage.getItem(keyOf(verdicts.manifest)));
    if (!draft) return null;
    const report = verdicts.load(JSON.stringify(draft.file));
    verdicts.unsaved = Number.isSafeInteger(draft.unsaved) ? draft.unsaved : 0;
    return report;
  } catch {
    return null;
  }
}
