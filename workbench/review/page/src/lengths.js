/** Distances: the smallest one between two structures, and those measured by two clicks. */
import { fill, foreign, make, plain, words } from './text.js';

export class Lengths {
  /**
   * @param {{gaps, first, second, gap, list, clear, tool}} elements
   * @param manifest @param {{say, changed, look}} page changed: marks are to be drawn again; look: (centre, radius) goes there
   */
  constructor(elements, manifest, page) {
    Object.assign(this, { ...elements, manifest, page, measured: [], start: null, armed: false, chosen: null });
    this.gaps.hidden = manifest.gaps.length === 0;
    const options = () => [make('option', { value: -1 }, 'none'), ...manifest.structures.map(({ name }, i) => make('option', { value: i }, plain(words(name), 60)))];
    for (const select of [this.first, this.second]) {
      select.append(...options());
      select.addEventListener('change', () => this.choose());
    }
    this.clear.addEventListener('click', () => this.remove());
    this.tool.addEventListener('click', () => this.arm());
    this.refresh();
  }

  /** Shows the smallest distance of the two chosen structures. */
  choose() {
    const pair = [this.first, this.second].map((select) => Number(select.value));
    this.chosen = this.manifest.gaps.find(({ between }) => between.includes(pair[0]) && between.includes(pair[1]) && pair[0] !== pair[1]) ?? null;
    const names = pair.map((i) => foreign(words(this.manifest.structures[i]?.name ?? ''), { limit: 40, brief: true }));
    if (this.chosen) {
      const text = this.chosen.mm > 0 ? `${this.chosen.mm.toFixed(2)} mm` : '0 mm: they touch or cross';
      const reach = Math.max(4 * this.chosen.mm, 5);
      const centre = this.chosen.from.map((x, k) => (x + this.chosen.to[k]) / 2);
      fill(this.gap, make('strong', {}, text), ' between ', names[0], ' and ', names[1], ' ',
           make('button', { type: 'button', class: 'small', onclick: () => this.page.look(centre, reach) }, 'Show the place'));
    } else fill(this.gap, pair.includes(-1) ? 'Choose two structures.' : 'Choose two different structures.');
    this.page.changed();
  }

  /** Readies the tool, or ends it. */
  arm() {
    if (this.armed) return this.disarm();
    this.armed = true;
    this.start = null;
    this.page.say('Distance: click the start and the end on the model, or turn them under the cross and press Enter. Escape ends.');
    return this.refresh();
  }

  disarm() { this.armed = false; this.start = null; this.refresh(); }

  /** Takes a place of the model as start or end. @param {number[] | null} place [mm] */
  place(place) {
    if (!place) return this.page.say('There is no model at this point.');
    if (!this.start) { this.start = place; this.page.say('Start set. Now the end.'); return this.page.changed(); }
    const mm = Math.hypot(...place.map((x, k) => x - this.start[k]));
    this.measured.push({ from: this.start, to: place, mm });
    this.page.say(`Distance ${mm.toFixed(2)} mm.`);
    return this.disarm();
  }

  remove() { this.measured = []; this.page.say('The measured distances are removed.'); this.refresh(); }

  refresh() {
    this.tool.setAttribute('aria-pressed', String(this.armed));
    this.clear.hidden = this.measured.length === 0;
    fill(this.list, ...this.measured.map(({ mm }, i) => make('li', {}, `${i + 1}: ${mm.toFixed(2)} mm`)));
    this.page.changed();
  }

  /** All that are to be drawn. */
  lines() { return [...this.measured, ...(this.chosen ? [this.chosen] : [])]; }
}
