// The writer's half of the contract: packs states that share vertices and triangles into chunks, states and blobs.
import { deflateSync } from 'node:zlib';

/** Bytes of `values` as byte planes of differences, `width` bytes each. */
export function differences(values, width) {
  const out = Buffer.alloc(width * values.length);
  let last = 0;
  values.forEach((value, i) => {
    const step = (value - last) >>> 0;
    for (let k = 0; k < width; ++k) out[k * values.length + i] = (step >>> (8 * k)) & 255;
    last = value;
  });
  return out;
}

/** @param {number[][]} points quantised, n x 3 @param {number[][]} triangles global ids, m x 3 */
export const encodeChunk = (points, triangles) => Buffer.concat([
  ...[0, 1, 2].map((axis) => differences(points.map((p) => p[axis]), 2)),
  ...[0, 1, 2].map((corner) => differences(triangles.map((t) => t[corner]), 4))]);

/** @param {number[]} ids of triangles @param {number[]} patches one a triangle */
export function encodeState(ids, patches) {
  const order = ids.map((id, i) => [id, patches[i]]).sort((a, b) => a[0] - b[0]);
  const runs = [];
  for (const [id, patch] of order) {
    const last = runs.at(-1);
    if (last && last[2] === patch && last[0] + last[1] === id) ++last[1]; else runs.push([id, 1, patch]);
  }
  const bytes = Buffer.alloc(9 * runs.length);
  runs.forEach(([first, count, patch], i) => {
    bytes.writeUInt32LE(first, 8 * i);
    bytes.writeUInt32LE(count, 8 * i + 4);
    bytes[8 * runs.length + i] = patch;
  });
  return { bytes, runs: runs.length };
}

const deflated = (bytes) => deflateSync(bytes, { level: 6 }).toString('base64');

export class Packer {
  /** @param {number[]} box of all positions [mm] */
  constructor(box) {
    Object.assign(this, { box, blobs: {}, chunks: [], states: [], pointIds: new Map(), triangleIds: new Map(),
                          owner: [], home: [] });
  }

  put(name, bytes) { this.blobs[name] = deflated(bytes); return name; }

  quantise(point) {
    return point.map((x, k) => Math.round(((x - this.box[k]) / (this.box[k + 3] - this.box[k])) * 65535));
  }

  /**
   * Adds a state and a chunk with what it brings that no earlier one had.
   * @param {{points: number[][], triangles: number[][], patch: number[], patches: object[]}} mesh
   * @returns {{state: number, vertices: number[]}} its number and the global id of each of the mesh's vertices
   */
  add(mesh) {
    const points = [], triangles = [], ids = [], patch = [];
    const fresh = (map, key, value, list) => {
      if (!map.has(key)) { map.set(key, map.size); list.push(value); }
      return map.get(key);
    };
    const vertices = mesh.points.map((p) => {
      const q = this.quantise(p);
      return fresh(this.pointIds, (q[0] * 65536 + q[1]) * 65536 + q[2], q, points);
    });
    mesh.triangles.forEach((corners, i) => {
      const t = corners.map((c) => vertices[c]);
      if (t[0] === t[1] || t[1] === t[2] || t[2] === t[0]) return;
      ids.push(fresh(this.triangleIds, t.join(), t, triangles));
      patch.push(mesh.patch[i]);
    });
    this.addChunk(points, triangles);
    const encoded = encodeState(ids, patch);
    const number = this.states.length;
    // A chunk's triangles may have corners of earlier chunks: those are needed, too.
    const chunks = [...new Set([...ids.map((id) => this.owner[id]), ...vertices.map((id) => this.home[id])])].sort((a, b) => a - b);
    this.states.push({ blob: this.put(`state-${number}`, encoded.bytes), runs: encoded.runs, chunks, patches: mesh.patches });
    return { state: number, vertices };
  }

  addChunk(points, triangles) {
    if (!points.length && !triangles.length) return;
    const number = this.chunks.length;
    for (let i = 0; i < triangles.length; ++i) this.owner.push(number);
    for (let i = 0; i < points.length; ++i) this.home.push(number);
    this.chunks.push({ blob: this.put(`chunk-${number}`, encodeChunk(points, triangles)), vertices: points.length, triangles: triangles.length });
  }

  /** @param {number[]} values one for each of the mesh's vertices [mm] @param {number[]} vertices their global ids */
  deviation(name, values, vertices, max) {
    const byId = new Map();
    vertices.forEach((id, i) => byId.set(id, values[i]));
    const sorted = [...byId].sort((a, b) => a[0] - b[0]);
    const bytes = Buffer.alloc(2 * sorted.length);
    sorted.forEach(([, value], i) => bytes.writeUInt16LE(Math.round((value / max) * 65535), 2 * i));
    return { blob: this.put(name, bytes), min_mm: 0, max_mm: max, measure: 'distance from the surface before the edit' };
  }
}

const escaped = { '<': '\\u003c', '>': '\\u003e', '&': '\\u0026', '\u2028': '\\u2028', '\u2029': '\\u2029' };

/** Puts manifest and blobs into the template at its marker, as the program does. */
export function fillPage(template, manifest, blobs) {
  const json = JSON.stringify(manifest).replace(/[<>&\u2028\u2029]/g, (c) => escaped[c]);
  const data = [`<script type="application/json" id="case">${json}</script>`,
    ...Object.entries(blobs).map(([name, text]) => `<script type="application/octet-stream" id="blob-${name}">${text}</script>`)];
  return template.split('<!-- vesselbench data -->').join(data.join('\n'));
}
