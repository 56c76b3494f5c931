/** The manifest of a page that shows a model: read, checked and filled up. */
import { count, list, number, numbers, object, readGeometry, readRaw, readSlices, text } from './manifest.js';

const NONE = 0.001;  // shares below it mean that a vertex has no value; the others follow on it

const colour = (value) => (Array.isArray(value) && value.length === 3 && value.every((x) => Number.isInteger(x) && x >= 0 && x <= 255) ? value : null);

/** The measure that colours the model; null: none. */
function readColour(raw) {
  const ramp = list(raw.colours).map(colour).filter(Boolean);
  const least = number(raw.least), most = number(raw.most);
  if (ramp.length < 2 || least === null || most === null || !(most > least)) return null;
  const values = list(raw.values).map(object).map((one) => ({ state: count(one.state), blob: text(one.blob), max: number(one.max) ?? 0 }));
  return { name: text(raw.name), label: text(raw.label) || text(raw.name), unit: text(raw.unit), least, most, ramp, values };
}

/** A vertex's share of the range, or null for none. @param {number} stored as the page holds it */
export const shareOf = (stored) => (stored < NONE / 2 ? null : (stored - NONE) / (1 - NONE));

const readGap = (gap, structures) => {
  const [a, b] = list(gap.between).map(count);
  const read = { between: [a, b], from: numbers(gap.from, 3), to: numbers(gap.to, 3), mm: number(gap.mm) };
  return a < structures && b < structures && a !== b && read.from && read.to && read.mm !== null ? read : null;
};

/** @param {string} json @throws {DataError} if it is no manifest of this version */
export function readViewer(json) {
  const raw = readRaw(json, 'vesselbench-viewer', 'This page holds no model.');
  const geometry = readGeometry(raw);
  const structures = list(raw.structures).map(object)
    .map((one) => ({ name: text(one.name), kind: text(one.kind), state: count(one.state) })).filter((one) => one.state < geometry.states.length);
  const source = object(raw.source);
  return {
    program: text(raw.program), written: text(raw.written), title: text(raw.title), text: text(raw.text), purpose: text(raw.purpose), provenance: text(raw.provenance),
    holds: list(raw.holds).map(text), ...geometry, structures, colour: readColour(object(raw.colour)),
    gaps: list(raw.distances).map(object).map((gap) => readGap(gap, structures.length)).filter(Boolean),
    patient: source.patient === true, slices: readSlices(raw.slices), slicesPlace: numbers(raw.slices_place, 3),
  };
}
