/** What an edit's picture needs, made ready once: surfaces, their difference, the deviation, where to look from. */
import { boxOf, onlyIn } from './surface.js';

const KEPT = 6;            // prepared edits
const WHOLE = 0.6;         // a changed box of more than this share of the model is shown as the whole model
const CONTEXT = 0.4;       // of the model's size that the first picture of an edit shows at least
const FRONT = [0.25, -1, 0.25];

const minus = (a, b) => a.map((x, k) => x - b[k]);
const length = (a) => Math.hypot(...a);
const half = (box) => length(minus(box.slice(3), box.slice(0, 3))) / 2;
const middle = (box) => box.slice(0, 3).map((x, k) => (x + box[k + 3]) / 2);

/** The normal at the vertex nearest to a place. */
function normalAt(surface, place) {
  let best = Infinity, at = 0;
  for (let i = 0; i < surface.points.length; i += 3) {
    const d = (surface.points[i] - place[0]) ** 2 + (surface.points[i + 1] - place[1]) ** 2 + (surface.points[i + 2] - place[2]) ** 2;
    if (d < best) { best = d; at = i; }
  }
  return [...surface.normals.subarray(at, at + 3)];
}

/** A viewer's direction a little beside a normal: straight from above, relief cannot be seen. */
function oblique(normal) {
  const side = Math.abs(normal[2]) < 0.9 ? [-normal[1], normal[0], 0] : [1, 0, 0];
  const l = length(side) || 1;
  return normal.map((x, k) => x + 0.5 * side[k] / l + (k === 2 ? 0.2 : 0));
}

/** The ball that shows what changed, and where to look at it from. @returns {{centre, radius, from}} [mm] */
export function framing(edit, { before, after }, place = edit.place, radius = edit.radius) {
  const surface = after ?? before;
  const whole = boxOf(surface.points);
  const changed = edit.changedBox && half(edit.changedBox) < WHOLE * half(whole) ? edit.changedBox : null;
  if (!place && !changed) return { centre: middle(whole), radius: half(whole), from: FRONT };
  const target = place ?? middle(changed);
  const size = Math.max(3 * (radius ?? 0), changed ? 1.25 * half(changed) : 0, 0.06 * half(whole));
  const normal = edit.outward ?? normalAt(surface, target);
  return { centre: changed && place ? middle(changed) : target, radius: Math.min(size, half(whole)), from: oblique(normal) };
}

/** The same with enough of the model around it to see where it is. */
export function withContext(frame, { before, after }) {
  return { ...frame, radius: Math.max(frame.radius, CONTEXT * half(boxOf((after ?? before).points))) };
}

export class Preparer {
  constructor(pool, manifest) {
    Object.assign(this, { pool, manifest, kept: new Map() });
  }

  /** @returns {Promise<{before, after, difference, problem: string}>} problem: what could not be read beside the surfaces */
  prepare(edit) {
    const known = this.kept.get(edit.id);
    const making = known ?? this.make(edit);
    this.kept.delete(edit.id);
    this.kept.set(edit.id, making);
    if (!known) making.catch(() => this.kept.delete(edit.id));
    if (this.kept.size > KEPT) this.kept.delete(this.kept.keys().next().value);
    return making;
  }

  async make(edit) {
    const [before, after] = await Promise.all([this.pool.surface(edit.before), this.pool.surface(edit.after)]);
    const none = new Uint32Array(0);
    const both = before && after;
    const difference = { added: both ? onlyIn(after, before, this.manifest.triangles) : none, removed: both ? onlyIn(before, after, this.manifest.triangles) : none,
                         deviation: null, range: edit.deviation ?? { min: 0, max: 0 } };
    let problem = '';
    if (edit.deviation && after)
      difference.deviation = await this.pool.deviation(edit.deviation, after).catch((error) => { problem = error.message; return null; });
    // Where all triangles are new, marking them would only paint the whole model.
    if (after && difference.added.length > 0.6 * after.index.length) { difference.added = none; difference.removed = none; }
    return { before, after, difference, problem };
  }
}
