/**
 * A reviewer's verdicts: the values, their rules, and the file they are saved in. Knows nothing of the page.
 * An entry is bound to its edit by id, revision and content hash; all texts are the reviewer's own.
 */

export const VERDICTS = ['accept', 'reject', 'unsure', 'none'];
const MAX_FILE = 8 * 1024 * 1024;  // characters of a verdict file that is read
const MAX_TEXT = 20000;            // characters of a comment
const MAX_MARKS = 500;             // pins or distances of an edit

const blank = () => ({ verdict: 'none', comment: '', time: '', pins: [], distances: [] });
const isEmpty = (entry) => entry.verdict === 'none' && !entry.comment && !entry.pins.length && !entry.distances.length;
const length = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
const rounded = (x, digits) => Number(x.toFixed(digits));
const place = (p) => p.map((x) => rounded(x, 4));

/** A file that is no verdict file of this project; the message is shown to the reader. */
export class VerdictError extends Error {}

export class Verdicts extends EventTarget {
  /**
   * @param manifest as `readManifest` returns it
   * @param {() => Date} now
   */
  constructor(manifest, now = () => new Date()) {
    super();
    Object.assign(this, { manifest, now, reviewer: { name: '', role: '' }, overall: { verdict: 'none', comment: '' },
                          entries: new Map(), unsaved: 0 });
  }

  /** The entry of an edit; a blank one if there is none yet. */
  of(id) { return this.entries.get(id) ?? blank(); }

  change(id, values) {
    this.entries.set(id, { ...this.of(id), ...values, time: this.now().toISOString() });
    this.changed();
  }

  changed() {
    ++this.unsaved;
    this.dispatchEvent(new Event('change'));
  }

  /**
   * Sets a verdict; the same one again withdraws it.
   * @returns {boolean} false if it was refused: a rejection needs a comment, its reason
   */
  decide(id, verdict) {
    const entry = this.of(id);
    if (verdict === 'reject' && !entry.comment.trim()) return false;
    this.change(id, { verdict: entry.verdict === verdict ? 'none' : verdict });
    return true;
  }

  /** Sets a comment. @returns {boolean} false if a rejection lost its reason by it and was withdrawn */
  comment(id, text) {
    const entry = this.of(id);
    const comment = text.slice(0, MAX_TEXT);
    if (comment === entry.comment) return true;
    const kept = entry.verdict !== 'reject' || comment.trim() !== '';
    this.change(id, { comment, verdict: kept ? entry.verdict : 'none' });
    return kept;
  }

  addPin(id, at, text = '') { this.change(id, { pins: [...this.of(id).pins, { place: place(at), text }] }); }

  addDistance(id, from, to, text = '') {
    const distance = { from: place(from), to: place(to), mm: rounded(length(from, to), 3), text };
    this.change(id, { distances: [...this.of(id).distances, distance] });
  }

  /** @param {'pins' | 'distances'} kind */
  describe(id, kind, index, text) {
    this.change(id, { [kind]: this.of(id)[kind].map((mark, i) => (i === index ? { ...mark, text: text.slice(0, MAX_TEXT) } : mark)) });
  }

  remove(id, kind, index) { this.change(id, { [kind]: this.of(id)[kind].filter((_, i) => i !== index) }); }

  /** @returns {boolean} false if refused: an overall rejection needs a comment */
  decideOverall(verdict, comment) {
    if (verdict === 'reject' && !comment.trim()) return false;
    this.overall = { verdict, comment: comment.slice(0, MAX_TEXT) };
    this.changed();
    return true;
  }

  setReviewer(name, role) {
    this.reviewer = { name: name.trim().slice(0, 200), role: role.trim().slice(0, 200) };
    this.changed();
  }

  saved() {
    this.unsaved = 0;
    this.dispatchEvent(new Event('change'));
  }

  /** Numbers of edits by verdict. */
  counts() {
    const counts = { accept: 0, reject: 0, unsure: 0, none: 0 };
    for (const edit of this.manifest.edits) ++counts[this.of(edit.id).verdict];
    return counts;
  }

  /** The value of verdicts.json. An overall verdict holds for the edits that it lists: then all are, else those something is said about. */
  toFile() {
    const { manifest } = this;
    const written = this.now().toISOString();
    const listed = ({ id }) => this.overall.verdict !== 'none' || !isEmpty(this.of(id));
    const edits = manifest.edits.filter(listed).map((edit) => {
      const { verdict, comment, time, pins, distances } = this.of(edit.id);
      return { edit: edit.id, revision: edit.revision, hash: edit.hash, verdict, comment, time: time || written, pins, distances };
    });
    return { format: 'vesselbench-verdicts', version: 1, program: manifest.program,
             project: { id: manifest.project.id, name: manifest.project.name }, chain_head: manifest.chainHead,
             reviewer: this.reviewer, written, overall: this.overall, edits };
  }

  /**
   * Takes over a saved file or draft. Entries for another revision of an edit are left out, as is an overall verdict on other
   * edits than this page's: saved again, it would hold for edits that it was not given on. Its comment is kept.
   * @returns {{taken: number, outdated: string[], missing: number, overallOutdated: boolean}} outdated: titles of edits that have changed since
   * @throws {VerdictError} if it is not a verdict file, or another project's
   */
  load(text) {
    const file = readVerdicts(text);
    if (file.project.id !== this.manifest.project.id)
      throw new VerdictError(`This file belongs to another project: ${file.project.name || file.project.id}.`);
    const report = { taken: 0, outdated: [], missing: 0, overallOutdated: file.overall.verdict !== 'none' && !this.listsAll(file.edits) };
    for (const { edit: id, revision, hash, ...entry } of file.edits.filter((one) => !isEmpty(one))) {
      const edit = this.manifest.edits.find((one) => one.id === id);
      if (!edit) ++report.missing;
      else if (edit.revision !== revision || edit.hash !== hash) report.outdated.push(edit.title);
      else { this.entries.set(id, entry); ++report.taken; }
    }
    this.reviewer = file.reviewer;
    this.overall = report.overallOutdated ? { ...file.overall, verdict: 'none' } : file.overall;
    this.dispatchEvent(new Event('change'));
    return report;
  }

  /** Whether a file's entries are on all edits of the page as the page shows them. */
  listsAll(entries) {
    const seen = new Map(entries.map((entry) => [entry.edit, entry]));
    return this.manifest.edits.every(({ id, revision, hash }) => seen.get(id)?.revision === revision && seen.get(id).hash === hash);
  }
}

function check(condition, what) {
  if (!condition) throw new VerdictError(`This is not a file of verdicts: ${what}.`);
}

const isText = (value, limit = MAX_TEXT) => typeof value === 'string' && value.length <= limit;
const isPlace = (value) => Array.isArray(value) && value.length === 3 && value.every(Number.isFinite);
const isObject = (value) => value !== null && typeof value === 'object' && !Array.isArray(value);

function readMarks(marks, fields, what) {
  check(Array.isArray(marks) && marks.length <= MAX_MARKS, `too many ${what}`);
  return marks.map((mark) => {
    check(isObject(mark) && fields.every((field) => isPlace(mark[field])) && isText(mark.text), `a wrong entry in ${what}`);
    const own = Object.fromEntries(fields.map((field) => [field, mark[field]]));
    return what === 'pins' ? { ...own, text: mark.text } : { ...own, mm: rounded(length(mark.from, mark.to), 3), text: mark.text };
  });
}

function readEntry(entry) {
  check(isObject(entry) && Number.isSafeInteger(entry.edit) && isText(entry.hash, 200), 'an entry without its edit');
  check(VERDICTS.includes(entry.verdict) && isText(entry.comment) && isText(entry.time, 40), 'an entry without its verdict');
  check(entry.verdict !== 'reject' || entry.comment.trim(), 'a rejection without a reason');
  return { edit: entry.edit, revision: entry.revision, hash: entry.hash, verdict: entry.verdict, comment: entry.comment, time: entry.time,
           pins: readMarks(entry.pins, ['place'], 'pins'), distances: readMarks(entry.distances, ['from', 'to'], 'distances') };
}

/** Reads verdicts.json as hostile text: size, form and every field are checked, unknown fields dropped. */
export function readVerdicts(text) {
  check(text.length <= MAX_FILE, 'it is too large');
  let raw;
  try {
    raw = JSON.parse(text);
  } catch {
    check(false, 'it is not JSON');
  }
  check(isObject(raw) && raw.format === 'vesselbench-verdicts' && raw.version === 1, 'another format or version');
  check(isObject(raw.project) && isText(raw.project.id), 'it names no project');
  check(isObject(raw.reviewer) && isText(raw.reviewer.name) && isText(raw.reviewer.role), 'it names no reviewer');
  check(isObject(raw.overall) && VERDICTS.includes(raw.overall.verdict) && isText(raw.overall.comment), 'it has no overall verdict');
  check(Array.isArray(raw.edits) && raw.edits.length <= 10000, 'it has no list of edits');
  return { project: { id: raw.project.id, name: isText(raw.project.name) ? raw.project.name : '' },
           reviewer: { name: raw.reviewer.name, role: raw.reviewer.role },
           overall: { verdict: raw.overall.verdict, comment: raw.overall.comment }, edits: raw.edits.map(readEntry) };
}
