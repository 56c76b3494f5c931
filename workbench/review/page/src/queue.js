/** The list at the left: what to look at first, or all edits by step. Walked by keys, one entry is current. */
import { fill, foreign, make } from './text.js';

const KINDS = { deviation: 'Large change', warning: 'Warning', stale: 'No longer applies', choice: 'Decided by hand', decision: 'Decided by program', finding: 'Finding' };
const VERDICT = { accept: 'accepted', reject: 'rejected', unsure: 'unsure', none: 'open' };
const SIGN = { accept: '✓', reject: '✗', unsure: '?', none: '○' };

/** A verdict as sign and word: never as colour alone. */
export const verdictBadge = (verdict) =>
  make('span', { class: `badge verdict-${verdict}` }, make('span', { 'aria-hidden': 'true' }, `${SIGN[verdict] ?? '○'} `), VERDICT[verdict] ?? 'open');

/** The state of an edit, if it is not the usual one. */
export const statusBadge = (status) =>
  (status === 'applied' ? null : make('span', { class: 'badge status' }, status === 'stale' ? 'no longer applies' : status === 'pending' ? 'not run again yet' : foreign(status, { limit: 30 })));

export class ListPanel {
  /**
   * @param {{list: HTMLElement, queueTab: HTMLElement, editsTab: HTMLElement}} elements
   * @param {(entry: {edit, item}) => void} onselect
   */
  constructor(elements, manifest, verdicts, onselect) {
    Object.assign(this, { ...elements, manifest, verdicts, onselect, at: 0 });
    const byId = new Map(manifest.edits.map((edit) => [edit.id, edit]));
    const queue = manifest.queue.map((item) => ({ item, edit: byId.get(item.edit) })).filter(({ edit }) => edit);
    this.folded = queue.filter(({ item }) => item.folded);
    this.entries = {
      queue: queue.filter(({ item }) => !item.folded),
      edits: manifest.edits.map((edit) => ({ item: null, edit })),
    };
    this.kind = this.entries.queue.length ? 'queue' : 'edits';
    elements.queueTab.addEventListener('click', () => this.change('queue'));
    elements.editsTab.addEventListener('click', () => this.change('edits'));
    verdicts.addEventListener('change', () => this.mark());
    this.build();
  }

  get current() { return this.entries[this.kind][this.at]; }

  /** Switches between queue and edits; stays at the same edit where it can. */
  change(kind) {
    if (kind === this.kind) return;
    const edit = this.current?.edit;
    this.kind = kind;
    this.at = Math.max(0, this.entries[kind].findIndex((entry) => entry.edit === edit));
    this.build();
    if (this.current && this.current.edit !== edit) this.onselect(this.current);
  }

  build() {
    this.queueTab.textContent = `To look at (${this.entries.queue.length})`;
    this.editsTab.textContent = `All edits (${this.entries.edits.length})`;
    this.queueTab.setAttribute('aria-pressed', String(this.kind === 'queue'));
    this.editsTab.setAttribute('aria-pressed', String(this.kind === 'edits'));
    this.buttons = this.entries[this.kind].map((entry, i) => this.button(entry, i));
    fill(this.list, ...this.rows());
    if (!this.buttons.length) fill(this.list, make('li', { class: 'empty' }, 'Nothing here.'));
    if (this.kind === 'queue' && this.folded.length) this.list.append(make('li', {}, this.unfolding()));
    this.mark();
  }

  /** The line under which findings are folded that are more likely wrong than right. */
  unfolding() {
    return make('button', { type: 'button', class: 'more', id: 'unfold', onclick: () => this.unfold() }, `${this.folded.length} more below 50 %`);
  }

  unfold() {
    const first = this.entries.queue.length;
    for (const entry of this.folded.splice(0)) {
      entry.item.folded = false;
      this.entries.queue.push(entry);
    }
    this.build();
    this.select(first, true);
  }

  /** List items; edits have their step's title before the first of a step. */
  rows() {
    let step = null;
    return this.entries[this.kind].flatMap(({ edit }, i) => {
      const item = make('li', {}, this.buttons[i]);
      if (this.kind === 'queue' || edit.stepTitle === step) return [item];
      step = edit.stepTitle;
      return [make('li', { class: 'step' }, foreign(step, { limit: 40 })), item];
    });
  }

  button({ edit, item }, i) {
    const picture = make('img', { alt: '', width: 56, height: 56 });
    if (edit.thumbnail) picture.src = edit.thumbnail;
    const top = item ? make('span', { class: `kind kind-${item.kind}` }, KINDS[item.kind] ?? foreign(item.kind, { limit: 30, brief: true })) : null;
    const title = make('span', { class: 'title' }, foreign(item ? item.title : edit.title, { limit: 90, brief: true }));
    const below = make('span', { class: 'below' }, foreign(item ? edit.title : edit.author, { limit: 70, brief: true }));
    const state = make('span', { class: 'state' });
    const words = make('span', { class: 'words' }, top, title, below, state);
    return make('button', { type: 'button', class: 'entry', onclick: () => this.select(i) }, edit.thumbnail ? picture : make('span', { class: 'no-picture' }), words);
  }

  /** Brings the current entry and the verdicts up to date. */
  mark() {
    this.buttons.forEach((button, i) => {
      const { edit } = this.entries[this.kind][i];
      button.toggleAttribute('aria-current', false);
      if (i === this.at) button.setAttribute('aria-current', 'true');
      fill(button.querySelector('.state'), verdictBadge(this.verdicts.of(edit.id).verdict), statusBadge(edit.status));
    });
  }

  select(i, focus = false) {
    if (!this.entries[this.kind][i]) return;
    this.at = i;
    this.mark();
    const button = this.buttons[i];
    button.scrollIntoView({ block: 'nearest', inline: 'nearest' });
    if (focus || this.list.contains(document.activeElement)) button.focus({ preventScroll: true });
    this.onselect(this.current);
  }

  /** Goes on by `by` entries. @returns {boolean} false at an end of the list */
  step(by) {
    const next = this.at + by;
    if (next < 0 || next >= this.buttons.length) return false;
    this.select(next);
    return true;
  }

  /** Edits next to the current one, most likely next first. */
  neighbours() {
    return [this.at + 1, this.at - 1, this.at + 2].map((i) => this.entries[this.kind][i]?.edit).filter(Boolean);
  }
}
