/** The case in the header: a line of what matters, and a table of the rest. */
import { valueTable } from './details.js';
import { figure, fill, foreign, make, moment } from './text.js';

const PURPOSE = { cfd: 'flow simulation (cfd)', rp: 'printed model (rp)', planning: 'planning', simulation: 'simulation' };
const KNOWN = ['surface', 'contours', 'slices', 'image slices', 'neighbours'];
const purposeOf = ({ purpose }) => PURPOSE[purpose] ?? purpose;
const row = (name, value, unit = '') => ({ name, value, unit, automatic: false });

function resolution({ source }) {
  if (!source.spacing) return 'not known: the source is a surface';
  const size = source.size ? `, ${source.size.map((n) => figure(n)).join(' × ')} voxels` : '';
  return `${source.spacing.map((x) => figure(x, 3)).join(' × ')} mm${size}`;
}

/** What the page holds and, as important, what it does not. */
function holds(manifest) {
  const has = manifest.holds.map((name) => (KNOWN.includes(name) ? name : `“${name}”`));
  const images = manifest.edits.some((edit) => edit.slices.length);
  return `${has.join(', ') || 'nothing stated'}; ${images ? 'grey values of the slices shown' : 'no voxels of the image'}`;
}

/** Rows of names and values about the case. */
export const caseRows = (manifest) => [
  row('Case', manifest.project.name), row('Purpose', purposeOf(manifest.project)),
  row('Variant', manifest.project.variant || 'trunk'), row('Source', `${manifest.project.source.file} (${manifest.project.source.kind || 'unknown kind'})`),
  row('Source resolution', resolution(manifest.project)), row('Units', manifest.project.units), row('Edited by', editors(manifest)),
  row('Written', `${moment(manifest.written)} by vesselbench ${manifest.program}`), row('This page holds', holds(manifest)),
  row('Head of the record', manifest.chainHead || 'none'), ...manifest.report];

const editors = (manifest) => [...new Set(manifest.edits.map((edit) => edit.author).filter(Boolean))].join(', ') || 'unknown';

/** Fills the header. */
export function showCase(manifest) {
  const { project } = manifest;
  document.title = 'Review';
  fill(document.getElementById('case-name'), foreign(project.name || 'Unnamed case', { limit: 90 }));
  fill(document.getElementById('case-facts'), foreign(purposeOf(project), { limit: 60 }), ' · source ', foreign(resolution(project), { limit: 80 }),
    ' · lengths in ', foreign(project.units, { limit: 12 }), ' · vesselbench ', foreign(manifest.program, { limit: 20 }), ` · written ${moment(manifest.written).slice(0, 30)}`);
  fill(document.getElementById('case-table'), valueTable(caseRows(manifest), 'The case'), make('p', { class: 'quiet' }, 'This page uses no network. Verdicts stay on this computer until you save and send them.'));
}
