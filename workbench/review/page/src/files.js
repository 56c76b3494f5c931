/** Verdicts out to a file and back in. */
import { askReviewer } from './dialogs.js';
import { make, plain } from './text.js';
import { VerdictError } from './verdicts.js';

const asFileName = (text) => plain(text, 40).normalize('NFKD').replace(/[^A-Za-z0-9]+/g, '-').replace(/^-+|-+$/g, '').toLowerCase();

/** Hands verdicts.json to the browser as a download. */
export async function saveVerdicts(verdicts, say) {
  if (!(await askReviewer(verdicts))) { say('Not saved: a verdict needs a name.'); return; }
  const text = `${JSON.stringify(verdicts.toFile(), null, 1)}\n`;
  const address = URL.createObjectURL(new Blob([text], { type: 'application/json' }));
  const name = ['verdicts', asFileName(verdicts.manifest.project.name), asFileName(verdicts.reviewer.name)].filter(Boolean).join('-');
  const link = make('a', { href: address, download: `${name}.json` });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
  verdicts.saved();
  say(`Saved as ${name}.json. Send this file back to the operator.`);
}

/** @param {Function} notice shows a message that stays @param {Function} done called after a file was taken over */
export function bindFiles(button, input, verdicts, notice, done) {
  button.addEventListener('click', () => input.click());
  input.addEventListener('change', async () => {
    const [file] = input.files;
    input.value = '';
    if (!file) return;
    try {
      if (file.size > 3 * 8 * 1024 * 1024) throw new VerdictError('This is not a file of verdicts: it is too large.');
      const report = verdicts.load(await file.text());
      const old = report.outdated.length ? ` ${report.outdated.length} left out, because the edits have changed since: ${report.outdated.map((title) => plain(title, 50)).join('; ')}.` : '';
      const missing = report.missing ? ` ${report.missing} for edits that this page does not hold.` : '';
      const overall = report.overallOutdated ? ' The overall verdict is left out, because it was not given on all edits as this page shows them.' : '';
      notice(`Verdicts on ${report.taken} edits taken over.${old}${missing}${overall}`);
      done();
    } catch (error) {
      notice(error instanceof VerdictError ? error.message : 'The file cannot be read.');
    }
  });
}
