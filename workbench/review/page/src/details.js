/** What is known of an edit, in words: figures, warnings, arguments, decisions, earlier verdicts. */
import { css, patchColours } from './colours.js';
import { statusBadge, verdictBadge } from './queue.js';
import { fill, foreign, inWords, make, moment, words } from './text.js';

const section = (title, ...content) => (content.filter(Boolean).length ? make('section', {}, make('h3', {}, title), ...content) : null);

/** A table of names and values; values that the program chose say so. */
export function valueTable(rows, caption) {
  if (!rows.length) return null;
  const line = (row) => make('tr', {}, make('th', { scope: 'row' }, foreign(words(row.name), { limit: 60 })),
    make('td', {}, foreign(inWords(row), { limit: 120 }), row.automatic ? make('span', { class: 'auto' }, ' chosen by the program') : null));
  return make('table', {}, make('caption', { class: 'hidden' }, caption), make('tbody', {}, ...rows.map(line)));
}

function patchList(surface) {
  if (!surface) return null;
  const colours = patchColours(surface.patches);
  const used = [...new Set(surface.groups.map(({ patch }) => patch))];
  return make('ul', { class: 'patches' }, ...used.map((patch) => {
    const swatch = make('span', { class: 'swatch', 'aria-hidden': 'true' });
    swatch.style.background = css(colours[patch]);
    const { name, kind } = surface.patches[patch];
    return make('li', {}, swatch, foreign(name, { limit: 60 }), kind && kind !== name ? make('span', { class: 'quiet' }, ` (${kind.slice(0, 20)})`) : null);
  }));
}

function warningList(edit, look) {
  if (!edit.warnings.length) return null;
  return make('ul', { class: 'warnings' }, ...edit.warnings.map(({ text, place }) => make('li', {}, foreign(text),
    place && look ? make('button', { type: 'button', class: 'small', onclick: () => look(place) }, 'Show the place') : null)));
}

function earlier(edit) {
  if (!edit.verdicts.length) return null;
  return make('ul', { class: 'earlier' }, ...edit.verdicts.map((one) => make('li', {}, verdictBadge(one.verdict), ' ',
    foreign(one.reviewer, { limit: 60 }), ', ', foreign(moment(one.time), { limit: 30 }),
    one.outdated ? make('strong', {}, ` — for revision ${String(one.revision).slice(0, 12)}, the edit has changed since`) : null,
    one.comment ? make('p', {}, foreign(one.comment)) : null)));
}

/** No text twice: warnings are listed further down, and a reason may begin with its title. */
function reason({ kind, title, why }) {
  if (kind === 'warning') return ['A warning, listed below.'];
  return why.includes(title) ? [foreign(why)] : [make('strong', {}, foreign(title, { limit: 120 })), ' ', foreign(why)];
}

const why = (items) => (items.length ? make('ul', { class: 'why' }, ...items.map((item) => make('li', {}, ...reason(item)))) : null);

/** Title and facts of an edit. */
export function heading(edit, level = 'h2') {
  return make('div', { class: 'edit-head' },
    make(level, {}, foreign(edit.title, { limit: 160 })),
    make('p', { class: 'quiet' }, foreign(edit.stepTitle, { limit: 40 }), ' · ', foreign(edit.operation, { limit: 40 }), ' · by ', foreign(edit.author || 'unknown', { limit: 60 }), ' · ',
      foreign(moment(edit.time), { limit: 30 }), ` · revision ${String(edit.revision).slice(0, 12)} `, statusBadge(edit.status)));
}

/** The parts below the verdict, as elements. @param {Function | null} look goes to a place; null on paper */
export function facts(edit, manifest, surface, look) {
  return [
    section('Why it is in the queue', why(manifest.queue.filter((item) => item.edit === edit.id && !item.folded))),
    section('Warnings', warningList(edit, look)),
    section('Figures', valueTable(edit.figures, 'Figures of the edit')),
    section('Arguments', valueTable(edit.arguments, 'Arguments of the edit')),
    section('Decided by the program', valueTable(edit.decided, 'What the program decided')),
    section('Note of the author', edit.note ? make('p', {}, foreign(edit.note)) : null),
    section('Patches of the model', patchList(surface)),
    section('Earlier verdicts', earlier(edit)),
  ].filter(Boolean);
}

/** Fills the panel of facts. */
export const showFacts = (element, ...rest) => fill(element, ...facts(...rest));
