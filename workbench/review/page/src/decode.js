/**
 * Bytes of the page's blobs to typed arrays. Pure functions without a document, so that Node tests them.
 * Every length is checked against the manifest: a cut or foreign blob gives a DataError, never a wrong picture.
 */

/** Data of the page that cannot be used; the message is shown to the reader. */
export class DataError extends Error {}

/** @param {string} text base64 @returns {Uint8Array} */
export function bytesOfBase64(text) {
  let binary;
  try {
    binary = atob(text.trim());
  } catch {
    throw new DataError('is not base64 text');
  }
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/**
 * Inflates zlib data of a known size; stops as soon as there is more, so that a small blob cannot fill the memory.
 * @param {Uint8Array} bytes deflated
 * @param {number} size bytes expected
 * @returns {Promise<Uint8Array>}
 */
export async function inflate(bytes, size) {
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate')).getReader();
  const out = new Uint8Array(size);
  let at = 0;
  for (;;) {
    const part = await reader.read().catch(() => { throw new DataError('is damaged: it cannot be decompressed'); });
    if (part.done) break;
    if (at + part.value.length > size) {
      reader.cancel().catch(() => {});
      throw new DataError(`is damaged: more than the ${size} bytes expected`);
    }
    out.set(part.value, at);
    at += part.value.length;
  }
  if (at !== size) throw new DataError(`is damaged: ${at} of ${size} bytes`);
  return out;
}

/** Joins `width` byte planes of `count` differences each and sums them up, modulo 2^(8 width). */
function plane(bytes, offset, count, width, out, outOffset, stride) {
  let value = 0;
  for (let i = 0; i < count; ++i) {
    let step = 0;
    for (let k = width - 1; k >= 0; --k) step = (step << 8) | bytes[offset + k * count + i];
    value = width === 2 ? (value + step) & 0xffff : (value + step) >>> 0;
    out[outOffset + i * stride] = value;
  }
  return offset + width * count;
}

/** Bytes of a chunk with `vertices` and `triangles`. */
export const chunkSize = (vertices, triangles) => 6 * vertices + 12 * triangles;

/**
 * A chunk's vertices and triangles.
 * @param {Uint8Array} bytes inflated
 * @param {number} known vertices of all chunks up to and with this one; corners are ids below it
 * @returns {{points: Uint16Array, corners: Uint32Array}} quantised positions, n x 3; global vertex ids, m x 3
 */
export function decodeChunk(bytes, vertices, triangles, known) {
  if (bytes.length !== chunkSize(vertices, triangles)) throw new DataError('has a wrong length');
  const points = new Uint16Array(3 * vertices);
  const corners = new Uint32Array(3 * triangles);
  let at = 0;
  for (let axis = 0; axis < 3; ++axis) at = plane(bytes, at, vertices, 2, points, axis, 3);
  for (let corner = 0; corner < 3; ++corner) at = plane(bytes, at, triangles, 4, corners, corner, 3);
  for (const id of corners) if (id >= known) throw new DataError('names a vertex that does not exist');
  return { points, corners };
}

/** Bytes of a state with `runs`. */
export const stateSize = (runs) => 9 * runs;

/**
 * A state's runs of triangles.
 * @param {Uint8Array} bytes inflated
 * @param {number} triangles in all chunks
 * @param {number} patches number of patches; a run's patch is below it
 * @returns {{first: Uint32Array, count: Uint32Array, patch: Uint8Array, total: number}}
 */
export function decodeState(bytes, runs, triangles, patches) {
  if (bytes.length !== stateSize(runs)) throw new DataError('has a wrong length');
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const first = new Uint32Array(runs);
  const count = new Uint32Array(runs);
  const patch = bytes.slice(8 * runs);
  let total = 0;
  for (let i = 0; i < runs; ++i) {
    first[i] = view.getUint32(8 * i, true);
    count[i] = view.getUint32(8 * i + 4, true);
    total += count[i];
    if (first[i] + count[i] > triangles || total > triangles) throw new DataError('names a triangle that does not exist');
    if (patch[i] >= patches) throw new DataError('names a patch that does not exist');
  }
  return { first, count, patch, total };
}

/**
 * Deviations of the vertices that a state uses, in the order of their ids.
 * @param {Uint8Array} bytes inflated
 * @param {number} min deviation of the value 0 [mm]
 * @param {number} max deviation of the value 65535 [mm]
 * @returns {Float32Array} [mm]
 */
export function decodeDeviation(bytes, min, max) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const out = new Float32Array(bytes.length >> 1);
  for (let i = 0; i < out.length; ++i) out[i] = min + (view.getUint16(2 * i, true) / 65535) * (max - min);
  return out;
}

/**
 * Positions in millimetres.
 * @param {Uint16Array} points n x 3
 * @param {number[]} box lower and upper corner [mm]
 * @param {Float32Array} out the positions are written from `offset` on
 */
export function dequantise(points, box, out, offset = 0) {
  const scale = [0, 1, 2].map((axis) => (box[axis + 3] - box[axis]) / 65535);
  for (let i = 0; i < points.length; ++i) out[offset + i] = box[i % 3] + points[i] * scale[i % 3];
}
