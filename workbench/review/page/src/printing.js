/** The paper form: the case, the overall verdict and every edit with figures, arguments and verdict, as a document. */
import { facts, heading, valueTable } from './details.js';
import { verdictBadge } from './queue.js';
import { fill, foreign, make, moment } from './text.js';
import { caseRows } from './case_facts.js';

function verdictOf(entry) {
  return make('div', { class: 'paper-verdict' }, make('p', {}, make('strong', {}, 'Verdict: '), verdictBadge(entry.verdict)),
    entry.comment ? make('p', {}, foreign(entry.comment, { limit: 5000 })) : null,
    ...entry.pins.map((pin, i) => make('p', {}, `Pin ${i + 1} at (${pin.place.join(', ')}) mm. `, foreign(pin.text))),
    ...entry.distances.map((one, i) => make('p', {}, `Distance ${i + 1}: ${one.mm.toFixed(2)} mm. `, foreign(one.text))));
}

/** Fills the document that is printed. */
export function writePaper(element, manifest, verdicts) {
  const { reviewer, overall } = verdicts;
  const edits = manifest.edits.map((edit) => make('section', { class: 'paper-edit' }, heading(edit),
    edit.thumbnail ? make('img', { src: edit.thumbnail, alt: '', width: 112, height: 112 }) : null,
    verdictOf(verdicts.of(edit.id)), ...facts(edit, manifest, null, null)));
  fill(element, make('h1', {}, foreign(manifest.project.name, { limit: 160 })), valueTable(caseRows(manifest), 'The case'),
    make('h2', {}, 'Overall'), make('p', {}, verdictBadge(overall.verdict), ' ', foreign(overall.comment, { limit: 5000 })),
    make('p', {}, 'Reviewer: ', foreign(reviewer.name || 'not named', { limit: 100 }), reviewer.role ? ', ' : '', foreign(reviewer.role, { limit: 100 }),
      `; printed ${moment(new Date().toISOString())}`), ...edits);
}
