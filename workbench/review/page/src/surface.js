/** Surfaces as flat arrays: triangles ordered by patch, own vertices, normals, and what differs between two of them. */

/** Triangle ids of a state ordered by patch (stable), and the ranges of the patches. */
function orderByPatch(state, patches) {
  const size = new Uint32Array(patches);
  state.patch.forEach((patch, run) => { size[patch] += state.count[run]; });
  const groups = [];
  const next = new Uint32Array(patches);
  let start = 0;
  for (let patch = 0; patch < patches; ++patch) {
    next[patch] = start;
    if (size[patch]) groups.push({ patch, start, count: size[patch] });
    start += size[patch];
  }
  const triangles = new Uint32Array(state.total);
  for (let run = 0; run < state.first.length; ++run) {
    let at = next[state.patch[run]];
    for (let i = 0; i < state.count[run]; ++i) triangles[at++] = state.first[run] + i;
    next[state.patch[run]] = at;
  }
  return { triangles, groups };
}

/** Gives the vertices that `triangles` use new numbers in ascending order of their ids. */
function compact(triangles, corners, positions) {
  const local = new Int32Array(positions.length / 3).fill(-1);
  for (const triangle of triangles) for (let c = 0; c < 3; ++c) local[corners[3 * triangle + c]] = 0;
  let used = 0;
  for (let id = 0; id < local.length; ++id) if (local[id] === 0) local[id] = used++;
  const points = new Float32Array(3 * used);
  for (let id = 0; id < local.length; ++id)
    if (local[id] >= 0) points.set(positions.subarray(3 * id, 3 * id + 3), 3 * local[id]);
  const index = new Uint32Array(3 * triangles.length);
  for (let i = 0; i < index.length; ++i) index[i] = local[corners[3 * triangles[(i / 3) | 0] + (i % 3)]];
  return { points, index };
}

/** Adds twice the area vectors of triangles [from, to) to their corners, only where `wanted` says so. */
function addNormals(points, index, from, to, normals, wanted) {
  for (let i = 3 * from; i < 3 * to; i += 3) {
    const a = 3 * index[i], b = 3 * index[i + 1], c = 3 * index[i + 2];
    const ux = points[b] - points[a], uy = points[b + 1] - points[a + 1], uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a], vy = points[c + 1] - points[a + 1], vz = points[c + 2] - points[a + 2];
    const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const corner of [a, b, c]) {
      if (!wanted(corner / 3)) continue;
      for (let k = 0; k < 3; ++k) normals[corner + k] += n[k];
    }
  }
}

/** Vertex normals, area weighted. At a rim the wall alone decides, so that a flat cap leaves no dark ring on it. */
function normalsOf(points, index, groups, patches) {
  const normals = new Float32Array(points.length);
  const wall = new Uint8Array(points.length / 3);
  const isWall = (group) => patches[group.patch].kind === 'wall';
  for (const group of groups.filter(isWall)) {
    for (let i = 3 * group.start; i < 3 * (group.start + group.count); ++i) wall[index[i]] = 1;
    addNormals(points, index, group.start, group.start + group.count, normals, () => true);
  }
  for (const group of groups.filter((one) => !isWall(one)))
    addNormals(points, index, group.start, group.start + group.count, normals, (vertex) => !wall[vertex]);
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let k = 0; k < 3; ++k) normals[i + k] /= length;
  }
  return normals;
}

/** Lower and upper corner of points n x 3. */
export function boxOf(points) {
  const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; ++i) {
    const axis = i % 3;
    if (points[i] < box[axis]) box[axis] = points[i];
    if (points[i] > box[axis + 3]) box[axis + 3] = points[i];
  }
  return box;
}

/**
 * The surface of a state.
 * @param {{first, count, patch, total}} state decoded runs
 * @param {{name: string, kind: string}[]} patches
 * @param {Uint32Array} corners of all triangles, global vertex ids
 * @param {Float32Array} positions of all vertices [mm]
 * @returns {{points, index, normals, triangles, groups, patches, box}} `triangles` are global ids in the order of `index`
 */
export function makeSurface(state, patches, corners, positions) {
  const { triangles, groups } = orderByPatch(state, patches.length);
  const { points, index } = compact(triangles, corners, positions);
  return { points, index, triangles, groups, patches, normals: normalsOf(points, index, groups, patches), box: boxOf(points) };
}

/**
 * Corners of the triangles of `surface` that `other` lacks. States share unchanged triangles by id, so this is exact.
 * @returns {Uint32Array} rows of `surface.index`
 */
export function onlyIn(surface, other, allTriangles) {
  const shared = new Uint8Array(allTriangles);
  for (const triangle of other.triangles) shared[triangle] = 1;
  const own = [];
  surface.triangles.forEach((triangle, i) => {
    if (!shared[triangle]) own.push(surface.index[3 * i], surface.index[3 * i + 1], surface.index[3 * i + 2]);
  });
  return Uint32Array.from(own);
}
