/** The form of one edit's verdict: buttons, comment, pins, distances. Rules live in verdicts.js. */
import { figure, fill, make } from './text.js';

const BUTTONS = [['accept', 'Accept', 'a'], ['reject', 'Reject', 'r'], ['unsure', 'Unsure', 'u']];
const SAID = { accept: 'Accepted.', reject: 'Rejected.', unsure: 'Marked as unsure.' };

export class VerdictPanel {
  /**
   * @param {HTMLElement} element
   * @param {(text: string) => void} say announces what happened
   * @param {() => void} onverdict called after each verdict
   */
  constructor(element, verdicts, say, onverdict) {
    Object.assign(this, { element, verdicts, say, onverdict, edit: null, wanted: null });
    this.buttons = BUTTONS.map(([verdict, text, key]) => make('button', { type: 'button', class: `verdict ${verdict}`, 'aria-keyshortcuts': key, 'aria-pressed': 'false',
      onclick: () => this.decide(verdict) }, text, make('kbd', { 'aria-hidden': 'true' }, key)));
    this.comment = make('textarea', { id: 'comment', rows: 3, maxlength: 20000, 'aria-describedby': 'comment-hint', oninput: () => this.typed(), onchange: () => this.commit(),
      onkeydown: (event) => { if (event.key === 'Enter' && (event.ctrlKey || event.metaKey)) { this.leave(); this.commit(); } } });
    this.title = make('h3', { tabindex: -1 }, 'Your verdict');
    this.hint = make('p', { id: 'comment-hint', class: 'quiet' });
    this.marks = make('div', { class: 'marks' });
    fill(element, this.title, make('div', { class: 'verdict-buttons', role: 'group', 'aria-label': 'Verdict on this edit' }, ...this.buttons),
         make('label', { for: 'comment' }, 'Comment (required for a rejection)'), this.comment, this.hint, this.marks);
    verdicts.addEventListener('change', () => this.refresh());
  }

  show(edit) {
    if (this.edit) this.commit();
    this.edit = edit;
    this.wanted = null;
    this.comment.value = this.verdicts.of(edit.id).comment;
    this.refresh();
    this.showMarks();
  }

  /** @param {boolean} [byKey] a key gives a verdict and never withdraws one: it may be meant for a field */
  decide(verdict, byKey = false) {
    if (!this.edit) return;
    const { id } = this.edit;
    if (byKey && this.verdicts.of(id).verdict === verdict) { this.say(`${SAID[verdict]} Its button withdraws it.`); return; }
    if (this.comment.value !== this.verdicts.of(id).comment) this.verdicts.comment(id, this.comment.value);
    if (!this.verdicts.decide(id, verdict)) {
      this.wanted = 'reject';
      this.comment.focus();
      this.refresh();
      this.say('A rejection needs a reason. Write it, then press Control and Enter.');
      return;
    }
    this.wanted = null;
    this.refresh();
    this.say(this.verdicts.of(id).verdict === 'none' ? 'Verdict withdrawn.' : SAID[verdict]);
    this.onverdict();
  }

  /** Takes over what was typed; completes a rejection that waited for its reason. */
  commit() {
    const { id } = this.edit;
    if (!this.verdicts.comment(id, this.comment.value)) this.say('The rejection is withdrawn: it has no reason any more.');
    if (this.wanted === 'reject' && this.comment.value.trim()) {
      this.wanted = null;
      if (this.verdicts.of(id).verdict !== 'reject') this.decide('reject');
    }
  }

  typed() { if (this.wanted) this.refresh(); }

  /** To no button: a second Enter gives no verdict. */
  leave() { this.title.focus(); }

  /** Asks for the remark on the mark that was placed last. */
  describe(kind) { this.marks.querySelector(`#${kind}-${this.verdicts.of(this.edit.id)[kind].length - 1}`)?.focus(); }

  refresh() {
    if (!this.edit) return;
    const entry = this.verdicts.of(this.edit.id);
    this.buttons.forEach((button, i) => button.setAttribute('aria-pressed', String(entry.verdict === BUTTONS[i][0])));
    const missing = this.wanted === 'reject' && !this.comment.value.trim();
    this.comment.toggleAttribute('aria-invalid', false);
    if (missing) this.comment.setAttribute('aria-invalid', 'true');
    this.hint.className = missing ? 'problem' : 'quiet';
    this.hint.textContent = this.wanted === 'reject' ? 'A rejection needs a reason. Write it; Control+Enter rejects.' : 'Control+Enter keeps the comment and leaves the field.';
    const count = entry.pins.length + entry.distances.length;
    if (this.shown !== this.edit || count !== this.shownMarks) this.showMarks();
  }

  showMarks() {
    const entry = this.verdicts.of(this.edit.id);
    this.shown = this.edit;
    this.shownMarks = entry.pins.length + entry.distances.length;
    const place = (p) => `(${p.map((x) => figure(x, 4)).join(', ')}) mm`;
    const rows = [...entry.pins.map((pin, i) => this.row('pins', i, `Pin ${i + 1} at ${place(pin.place)}`, pin.text)),
                  ...entry.distances.map((one, i) => this.row('distances', i, `Distance ${i + 1}: ${one.mm.toFixed(2)} mm`, one.text))];
    fill(this.marks, rows.length ? make('ul', {}, ...rows) : null);
  }

  row(kind, index, title, text) {
    const id = `${kind}-${index}`;
    const input = make('input', { id, type: 'text', maxlength: 2000, placeholder: 'Remark', onchange: () => this.verdicts.describe(this.edit.id, kind, index, input.value),
      onkeydown: (event) => { if (event.key === 'Enter') { this.verdicts.describe(this.edit.id, kind, index, input.value); this.leave(); } } });
    input.value = text;
    const remove = make('button', { type: 'button', class: 'small', 'aria-label': `Remove ${title}`, onclick: () => { this.verdicts.remove(this.edit.id, kind, index); this.leave(); } }, 'Remove');
    return make('li', {}, make('label', { for: id }, title), make('div', { class: 'line' }, input, remove));
  }
}
