// A vessel with an aneurysm as a seeded implicit function, meshed by surface nets; positions in mm.

/** Repeatable random numbers in [0, 1): a 32-bit generator of Weyl steps and mixing. */
export function random(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x9e3779b9) >>> 0;
    let x = state;
    x = Math.imul(x ^ (x >>> 16), 0x85ebca6b);
    x = Math.imul(x ^ (x >>> 13), 0xc2b2ae35);
    return ((x ^ (x >>> 16)) >>> 0) / 4294967296;
  };
}

const length = (p) => Math.hypot(...p);
export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const plus = (a, b, t = 1) => [a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]];
export const unit = (a) => { const l = length(a) || 1; return [a[0] / l, a[1] / l, a[2] / l]; };
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Distance to a tube of round cones along a line of [x, y, z, radius]. */
function tube(line) {
  return (p) => {
    let best = Infinity;
    for (let i = 0; i + 1 < line.length; ++i) {
      const [a, b] = [line[i], line[i + 1]];
      const d = minus(b, a);
      const t = Math.min(1, Math.max(0, dot(minus(p, a), d) / dot(d, d)));
      best = Math.min(best, length(minus(p, plus(a, d, t))) - (a[3] + t * (b[3] - a[3])));
    }
    return best;
  };
}
const ball = (c, r) => (p) => length(minus(p, c)) - r;
const joined = (parts, blend) => (p) => -blend * Math.log(parts.reduce((sum, f) => sum + Math.exp(-f(p) / blend), 0));

function curve(at, steps = 24) {
  return Array.from({ length: steps + 1 }, (_, i) => at(i / steps));
}

/** Parent vessel with two outlets, an aneurysm at the bend, a narrowing and a spurious twig. */
export const PARTS = {
  parent: curve((t) => [4 * Math.sin(3 * t), 3.2 * Math.sin(2.2 * t + 0.4), 26 * t - 13, 1.9 - 0.5 * t - 0.55 * Math.exp(-(((t - 0.3) / 0.06) ** 2))]),
  branch: curve((t) => [3.6 + 7.5 * t, 2.4 + 2.5 * Math.sin(2 * t), 0.5 + 8 * t, 1.15 - 0.25 * t], 12),
  twig: curve((t) => [2.2 - 4.5 * t, 3.1 + 1.6 * t, -4.2 - 1.5 * t, 0.55 - 0.1 * t], 8),
  dome: [[4.6, 6.4, 2.6], 3.1],
};

/** Distance function of the vessel [mm], negative inside. */
export const vessel = joined([tube(PARTS.parent), tube(PARTS.branch), tube(PARTS.twig), ball(...PARTS.dome)], 0.22);

/** Surface nets: one vertex in each cell that the zero set of `f` passes, at the mean of the edges' cuts. */
export function surfaceNets(f, box, h, jitter = () => 0) {
  const n = [0, 1, 2].map((k) => Math.ceil((box[k + 3] - box[k]) / h) + 1);
  const at = (i, j, k) => (k * n[1] + j) * n[0] + i;
  const values = new Float32Array(n[0] * n[1] * n[2]);
  for (let k = 0; k < n[2]; ++k) for (let j = 0; j < n[1]; ++j) for (let i = 0; i < n[0]; ++i)
    values[at(i, j, k)] = f([box[0] + i * h, box[1] + j * h, box[2] + k * h]) + jitter();
  const cell = new Int32Array(values.length).fill(-1);
  const points = [], triangles = [];
  const vertexOf = (i, j, k) => {
    let sum = [0, 0, 0], cuts = 0;
    for (let axis = 0; axis < 3; ++axis) for (let e = 0; e < 4; ++e) {
      const a = [i, j, k];
      a[(axis + 1) % 3] += e & 1;
      a[(axis + 2) % 3] += e >> 1;
      const b = [...a];
      b[axis] += 1;
      const [va, vb] = [values[at(...a)], values[at(...b)]];
      if (va < 0 === vb < 0) continue;
      a[axis] += va / (va - vb);
      sum = plus(sum, a);
      ++cuts;
    }
    return cuts ? [0, 1, 2].map((x) => box[x] + (sum[x] / cuts) * h) : null;
  };
  for (let k = 0; k + 1 < n[2]; ++k) for (let j = 0; j + 1 < n[1]; ++j) for (let i = 0; i + 1 < n[0]; ++i) {
    const p = vertexOf(i, j, k);
    if (p) { cell[at(i, j, k)] = points.length; points.push(p); }
  }
  for (let k = 1; k + 1 < n[2]; ++k) for (let j = 1; j + 1 < n[1]; ++j) for (let i = 1; i + 1 < n[0]; ++i)
    for (let axis = 0; axis < 3; ++axis) {
      const b = [i, j, k];
      b[axis] += 1;
      const inside = values[at(i, j, k)] < 0;
      if (inside === values[at(...b)] < 0) continue;
      const step = (du, dv) => { const c = [i, j, k]; c[(axis + 1) % 3] -= du; c[(axis + 2) % 3] -= dv; return cell[at(...c)]; };
      const q = [step(0, 0), step(1, 0), step(1, 1), step(0, 1)];
      if (!inside) q.reverse();
      triangles.push([q[0], q[1], q[2]], [q[0], q[2], q[3]]);
    }
  return { points, triangles, patch: triangles.map(() => 0), patches: [{ name: 'wall', kind: 'wall' }] };
}
