// Edits of the sample: plain, local operations on {points, triangles, patch, patches} that return a new mesh.
import { dot, minus, plus, unit } from './vessel.mjs';

const distance = (a, b) => Math.hypot(...minus(a, b));
const smoothStep = (x) => (x <= 0 ? 0 : x >= 1 ? 1 : x * x * (3 - 2 * x));
/** 1 at the centre, 0 from the radius on. */
const falloff = (p, centre, radius) => smoothStep(1 - distance(p, centre) / radius);

/** Vertex normals, area weighted. */
export function normals(mesh) {
  const sum = mesh.points.map(() => [0, 0, 0]);
  for (const [a, b, c] of mesh.triangles) {
    const u = minus(mesh.points[b], mesh.points[a]), v = minus(mesh.points[c], mesh.points[a]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    for (const corner of [a, b, c]) sum[corner] = plus(sum[corner], n);
  }
  return sum.map(unit);
}

/** Moves vertices along their normals: by `height` [mm] at the centre, by nothing from the radius on. */
export function inflate(mesh, centre, radius, height) {
  const n = normals(mesh);
  return { ...mesh, points: mesh.points.map((p, i) => plus(p, n[i], height * falloff(p, centre, radius))) };
}

/** Laplacian smoothing with `weight(p)` in [0, 1]; vertices of caps stay. */
export function smooth(mesh, iterations, weight) {
  const ring = mesh.points.map(() => new Set());
  mesh.triangles.forEach((t) => t.forEach((a, i) => ring[a].add(t[(i + 1) % 3]).add(t[(i + 2) % 3])));
  const fixed = new Set(mesh.triangles.filter((_, i) => mesh.patches[mesh.patch[i]].kind !== 'wall').flat());
  const factor = mesh.points.map((p, i) => (fixed.has(i) ? 0 : weight(p)));
  let points = mesh.points;
  for (let k = 0; k < 2 * iterations; ++k) {
    const step = k % 2 ? -0.53 : 0.5;  // shrinking and inflating in turn keeps the volume
    points = points.map((p, i) => {
      if (!factor[i]) return p;
      let mean = [0, 0, 0];
      for (const j of ring[i]) mean = plus(mean, points[j], 1 / ring[i].size);
      return plus(p, minus(mean, p), step * factor[i]);
    });
  }
  return { ...mesh, points };
}

/** Edges that only one triangle has, as a map from start to end. */
function rim(triangles) {
  const edges = new Set(triangles.flatMap(([a, b, c]) => [`${a},${b}`, `${b},${c}`, `${c},${a}`]));
  const next = new Map();
  for (const edge of edges) {
    const [a, b] = edge.split(',').map(Number);
    if (!edges.has(`${b},${a}`)) next.set(a, b);
  }
  return next;
}

/** The mesh without points that no triangle uses. */
function compacted(mesh) {
  const number = new Map();
  const triangles = mesh.triangles.map((t) => t.map((c) => {
    if (!number.has(c)) number.set(c, number.size);
    return number.get(c);
  }));
  return { ...mesh, triangles, points: [...number.keys()].map((c) => mesh.points[c]) };
}

/** Removes the triangles for which `gone` holds; closes the rims with fans of a new patch (or of the wall). */
function cutAway(mesh, gone, place, patch) {
  const kept = mesh.triangles.map((t, i) => i).filter((i) => !gone(mesh.triangles[i]));
  const triangles = kept.map((i) => mesh.triangles[i]);
  const labels = kept.map((i) => mesh.patch[i]);
  const patches = patch ? [...mesh.patches, patch] : mesh.patches;
  const next = rim(triangles);
  const points = mesh.points.slice();
  while (next.size) {
    const loop = [next.keys().next().value];
    while (next.has(loop.at(-1))) { const to = next.get(loop.at(-1)); next.delete(loop.at(-1)); loop.push(to); }
    loop.pop();
    for (const i of loop) points[i] = place(points[i]);
    const centre = points.length;
    points.push(loop.reduce((sum, i) => plus(sum, points[i], 1 / loop.length), [0, 0, 0]));
    loop.forEach((a, i) => {
      triangles.push([loop[(i + 1) % loop.length], a, centre]);
      labels.push(patch ? patches.length - 1 : 0);
    });
  }
  return compacted({ points, triangles, patch: labels, patches });
}

/** Cuts off what lies beyond a plane and within `reach` [mm] of `around`, and caps it flat. */
export function clip(mesh, origin, normal, reach, patch, around = origin) {
  const beyond = (i) => dot(minus(mesh.points[i], origin), normal) > 0 && distance(mesh.points[i], around) < reach;
  const onPlane = (p) => plus(p, normal, -dot(minus(p, origin), normal));
  return cutAway(mesh, (t) => t.some(beyond), onPlane, patch);
}

/** Opens a hole of a radius [mm], as a damaged source has it. */
export function puncture(mesh, centre, radius) {
  const kept = mesh.triangles.map((_, i) => i).filter((i) => !mesh.triangles[i].every((c) => distance(mesh.points[c], centre) < radius));
  return compacted({ ...mesh, triangles: kept.map((i) => mesh.triangles[i]), patch: kept.map((i) => mesh.patch[i]) });
}

/** Closes all holes with fans of the wall. */
export const fillHoles = (mesh) => cutAway(mesh, () => false, (p) => p, null);

/** Splits each triangle in four; new vertices lie on the edges' middles. */
export function subdivide(mesh) {
  const points = mesh.points.slice();
  const middle = new Map();
  const between = (a, b) => {
    const key = Math.min(a, b) * 1e7 + Math.max(a, b);
    if (!middle.has(key)) {
      middle.set(key, points.length);
      points.push(plus(points[a], minus(points[b], points[a]), 0.5));
    }
    return middle.get(key);
  };
  const triangles = [], patch = [];
  mesh.triangles.forEach(([a, b, c], i) => {
    const [d, e, f] = [between(a, b), between(b, c), between(c, a)];
    triangles.push([a, d, f], [d, b, e], [f, e, c], [d, e, f]);
    patch.push(...Array(4).fill(mesh.patch[i]));
  });
  return { ...mesh, points, triangles, patch };
}

/** Distance of each vertex from the nearest vertex of another mesh [mm], by a grid of cells. */
export function distances(mesh, other, limit) {
  const cell = limit / 2;
  const keyOf = (p) => p.map((x) => Math.floor(x / cell)).join();
  const grid = new Map();
  for (const p of other.points) { const k = keyOf(p); if (grid.has(k)) grid.get(k).push(p); else grid.set(k, [p]); }
  return mesh.points.map((p) => {
    const base = p.map((x) => Math.floor(x / cell));
    let best = limit;
    for (let reach = 0; reach <= 2 && best > (reach - 1) * cell; ++reach)
      for (let i = -reach; i <= reach; ++i) for (let j = -reach; j <= reach; ++j) for (let k = -reach; k <= reach; ++k) {
        if (Math.max(Math.abs(i), Math.abs(j), Math.abs(k)) !== reach) continue;
        for (const q of grid.get([base[0] + i, base[1] + j, base[2] + k].join()) ?? []) best = Math.min(best, distance(p, q));
      }
    return best;
  });
}
