/** The cut of a surface with a plane, as polylines in the plane's own coordinates. */

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Signed distances to the plane [mm]; what lies in it counts as above it, so that no cut passes through a corner. */
function heights(points, origin, normal) {
  const out = new Float32Array(points.length / 3);
  const offset = dot(origin, normal);
  for (let i = 0; i < out.length; ++i) {
    const h = points[3 * i] * normal[0] + points[3 * i + 1] * normal[1] + points[3 * i + 2] * normal[2] - offset;
    out[i] = h === 0 ? 1e-9 : h;
  }
  return out;
}

/** Joins segments, given by the mesh edges they end on, into chains of edges. */
function chains(segments) {
  const at = new Map();
  segments.forEach((segment, i) => segment.forEach((edge) => {
    if (at.has(edge)) at.get(edge).push(i); else at.set(edge, [i]);
  }));
  const used = new Uint8Array(segments.length);
  const follow = (edge) => {
    const chain = [edge];
    for (;;) {
      const next = at.get(edge).find((i) => !used[i]);
      if (next === undefined) return chain;
      used[next] = 1;
      edge = segments[next][0] === edge ? segments[next][1] : segments[next][0];
      chain.push(edge);
    }
  };
  const found = [];
  const collect = (edge) => { const chain = follow(edge); if (chain.length > 1) found.push(chain); };
  for (const [edge, ends] of at) if (ends.length === 1) collect(edge);  // open ends first, then the closed loops
  for (const [edge] of at) collect(edge);
  return found;
}

/**
 * Cuts a surface with the plane through `origin` that the unit vectors `u` and `v` span.
 * @param {{points: Float32Array, index: Uint32Array}} surface [mm]
 * @returns {Float32Array[]} polylines: pairs of coordinates along u and v relative to `origin` [mm]; closed ones repeat the first
 */
export function cutSurface(surface, { origin, u, v }) {
  const { points, index } = surface;
  const h = heights(points, origin, cross(u, v));
  const count = points.length / 3;
  const place = new Map();
  const edgePoint = (a, b) => {
    const key = Math.min(a, b) * count + Math.max(a, b);
    if (!place.has(key)) {
      const t = h[a] / (h[a] - h[b]);
      const p = [0, 1, 2].map((k) => points[3 * a + k] + t * (points[3 * b + k] - points[3 * a + k]) - origin[k]);
      place.set(key, [dot(p, u), dot(p, v)]);
    }
    return key;
  };
  const segments = [];
  for (let i = 0; i < index.length; i += 3) {
    const a = index[i], b = index[i + 1], c = index[i + 2];
    const up = (h[a] > 0) + (h[b] > 0) + (h[c] > 0);
    if (up === 0 || up === 3) continue;
    const alone = up === 1 ? [a, b, c].find((x) => h[x] > 0) : [a, b, c].find((x) => h[x] < 0);
    const others = [a, b, c].filter((x) => x !== alone);
    if (others.length === 2) segments.push([edgePoint(alone, others[0]), edgePoint(alone, others[1])]);
  }
  return chains(segments).map((chain) => Float32Array.from(chain.flatMap((edge) => place.get(edge))));
}

/**
 * The three orthogonal planes through a place, as radiology shows them: rows run along u, columns along v (downwards).
 * The letters hold for coordinates that grow to the left, to the back and to the head (LPS).
 */
export const ORTHOGONAL = [
  { name: 'Axial', axis: 2, u: [1, 0, 0], v: [0, 1, 0], letters: ['R', 'L', 'A', 'P'] },
  { name: 'Coronal', axis: 1, u: [1, 0, 0], v: [0, 0, -1], letters: ['R', 'L', 'S', 'I'] },
  { name: 'Sagittal', axis: 0, u: [0, 1, 0], v: [0, 0, -1], letters: ['A', 'P', 'S', 'I'] },
];
