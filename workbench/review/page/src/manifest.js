/** The manifest: read, checked and filled up, so that the rest of the page meets numbers, texts and lists only. */
import { DataError } from './decode.js';

export const text = (value) => (typeof value === 'string' ? value : value === undefined || value === null ? '' : String(value));
export const list = (value) => (Array.isArray(value) ? value : []);
export const object = (value) => (value && typeof value === 'object' && !Array.isArray(value) ? value : {});
export const number = (value) => (typeof value === 'number' && Number.isFinite(value) ? value : null);
export const count = (value) => (Number.isSafeInteger(value) && value >= 0 ? value : 0);
export const numbers = (value, length) =>
  (Array.isArray(value) && value.length === length && value.every(Number.isFinite) ? value : null);

/** An image inside the page, or nothing: an address of the network is never followed. */
const picture = (value) => (/^data:image\/(png|jpeg|webp);base64,[A-Za-z0-9+/=]+$/.test(value) ? value : '');

const MAX_ELEMENTS = 200e6;  // vertices or triangles; beyond it no browser could hold the arrays

function readChunks(chunks) {
  let vertices = 0;
  let triangles = 0;
  const read = list(chunks).map((chunk) => {
    const own = { blob: text(chunk.blob), vertices: count(chunk.vertices), triangles: count(chunk.triangles),
                  firstVertex: vertices, firstTriangle: triangles };
    vertices += own.vertices;
    triangles += own.triangles;
    return own;
  });
  if (vertices > MAX_ELEMENTS || triangles > MAX_ELEMENTS) throw new DataError('The page states an impossible size.');
  return { chunks: read, vertices, triangles };
}

const readState = (state) => ({
  blob: text(state.blob), runs: count(state.runs), chunks: list(state.chunks).map(count),
  patches: list(state.patches).map((patch) => ({ name: text(object(patch).name), kind: text(object(patch).kind) })),
});

/** The geometry of all states, as `Pool` takes it. */
export function readGeometry(raw) {
  const states = list(raw.states).map(object).map(readState);
  return { box: numbers(object(raw.pool).box, 6) ?? [0, 0, 0, 1, 1, 1], ...readChunks(raw.chunks), states };
}

const readSlice = (slice) => ({
  blob: text(slice.blob), width: count(slice.width), height: count(slice.height), spacing: numbers(slice.spacing, 2),
  origin: numbers(slice.origin, 3), u: numbers(slice.u, 3), v: numbers(slice.v, 3),
});
const usable = (slice) => slice.spacing && slice.origin && slice.u && slice.v && slice.width > 0 && slice.height > 0;
/** Image slices that can be drawn. */
export const readSlices = (slices) => list(slices).map(object).map(readSlice).filter(usable);

const readValue = (row) => ({ name: text(object(row).name), value: object(row).value, unit: text(object(row).unit),
                              automatic: object(row).automatic === true });

function readDeviation(deviation) {
  const max = number(object(deviation).max_mm);
  return max === null ? null : { blob: text(deviation.blob), min: number(deviation.min_mm) ?? 0, max, measure: text(deviation.measure) };
}

function readEdit(edit, states) {
  const state = (value) => (Number.isInteger(value) && value >= 0 && value < states ? value : null);
  return {
    id: count(edit.id), revision: edit.revision, hash: text(edit.hash), step: text(edit.step),
    stepTitle: text(edit.step_title) || text(edit.step), operation: text(edit.operation),
    title: text(edit.title) || text(edit.operation), author: text(edit.author), time: text(edit.time),
    status: text(edit.status) || 'applied', note: text(edit.note),
    arguments: list(edit.arguments).map(readValue), decided: list(edit.decided).map(readValue),
    figures: list(edit.figures).map(readValue),
    warnings: list(edit.warnings).map((warning) => ({ text: text(object(warning).text), place: numbers(object(warning).place, 3) })),
    place: numbers(edit.place, 3), outward: numbers(edit.outward, 3), radius: number(edit.radius),
    before: state(edit.before), after: state(edit.after), thumbnail: picture(text(edit.thumbnail)),
    deviation: readDeviation(edit.deviation), changedBox: numbers(edit.changed_box, 6),
    slices: readSlices(edit.slices),
    verdicts: list(edit.verdicts).map(object).map((verdict) => ({
      reviewer: text(verdict.reviewer), time: text(verdict.time), verdict: text(verdict.verdict),
      comment: text(verdict.comment), revision: verdict.revision, outdated: verdict.outdated === true })),
  };
}

const readQueued = (item) => ({ kind: text(item.kind), edit: count(item.edit), title: text(item.title), why: text(item.why),
                                place: numbers(item.place, 3), radius: number(item.radius), folded: item.folded === true });

function readProject(project) {
  const source = object(project.source);
  return { id: text(project.id), name: text(project.name), purpose: text(project.purpose), units: text(project.units) || 'mm',
           variant: text(project.variant), source: { file: text(source.file), kind: text(source.kind),
           spacing: numbers(source.spacing, 3), size: numbers(source.size, 3) } };
}

/**
 * The JSON text of a page's manifest.
 * @param {string} json @param {string} format that it must have, in version 1 @param {string} missing said of another one
 * @throws {DataError}
 */
export function readRaw(json, format, missing) {
  let raw;
  try {
    raw = object(JSON.parse(json));
  } catch {
    throw new DataError('The data of this page cannot be read: the file is damaged or incomplete.');
  }
  if (raw.format !== format) throw new DataError(missing);
  if (raw.version !== 1) throw new DataError(`This page was written in version ${text(raw.version)} of its format; it reads version 1.`);
  return raw;
}

/**
 * Reads the manifest's text.
 * @param {string} json
 * @throws {DataError} if it is no manifest of this version
 */
export function readManifest(json) {
  const raw = readRaw(json, 'vesselbench-review', 'This page holds no review.');
  const geometry = readGeometry(raw);
  const states = geometry.states.length;
  return {
    program: text(raw.program), written: text(raw.written), chainHead: text(raw.chain_head),
    project: readProject(object(raw.project)), holds: list(raw.holds).map(text), ...geometry,
    neighbours: list(raw.neighbours).map(object).map((one) => ({ name: text(one.name), state: count(one.state) }))
      .filter((one) => one.state < states),
    edits: list(raw.edits).map(object).map((edit) => readEdit(edit, states)),
    queue: list(raw.queue).map(object).map(readQueued), report: list(raw.report).map(readValue),
  };
}
