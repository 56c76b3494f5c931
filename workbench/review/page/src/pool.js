/** The page's geometry, decoded when it is needed: chunks once, the surfaces of the last states kept. */
import { bytesOfBase64, chunkSize, DataError, decodeChunk, decodeDeviation, decodeState, dequantise, inflate, stateSize } from './decode.js';
import { makeSurface } from './surface.js';

const KEPT_SURFACES = 10;  // the edit on the screen, its neighbours in the queue and the way back: about 6 MB each

/** Text of a data element of the page; null if it is missing. */
export function blobText(name) {
  const element = document.getElementById(`blob-${name}`);
  return element && element.localName === 'script' && element.type === 'application/octet-stream' ? element.textContent : null;
}

export class Pool {
  /**
   * @param manifest as `readManifest` returns it
   * @param {(name: string) => string | null} read base64 text of a blob
   */
  constructor(manifest, read = blobText) {
    this.manifest = manifest;
    this.read = read;
    this.positions = new Float32Array(3 * manifest.vertices);
    this.corners = new Uint32Array(3 * manifest.triangles);
    this.ready = new Uint8Array(manifest.vertices);  // vertices whose chunk is loaded
    this.readyTriangles = new Uint8Array(manifest.triangles);
    this.chunks = new Map();
    this.surfaces = new Map();
  }

  /** Inflated bytes of a blob. @throws {DataError} that names what is missing or damaged */
  async bytes(name, size) {
    const text = this.read(name);
    if (text === null) throw new DataError(`The part “${name}” is missing in this file.`);
    return this.named(name, async () => inflate(bytesOfBase64(text), size));
  }

  async named(name, work) {
    try {
      return await work();
    } catch (error) {
      if (error instanceof DataError) throw new DataError(`The part “${name}” ${error.message}.`);
      throw error;
    }
  }

  /** Decodes a chunk into the shared arrays, once. */
  chunk(number) {
    if (!this.chunks.has(number)) {
      const loading = this.loadChunk(number);
      this.chunks.set(number, loading);
      loading.catch(() => {});
    }
    return this.chunks.get(number);
  }

  async loadChunk(number) {
    const chunk = this.manifest.chunks[number];
    if (!chunk) throw new DataError(`Part ${number} of the geometry is missing in this file.`);
    const bytes = await this.bytes(chunk.blob, chunkSize(chunk.vertices, chunk.triangles));
    await this.named(chunk.blob, async () => {
      const { points, corners } = decodeChunk(bytes, chunk.vertices, chunk.triangles, chunk.firstVertex + chunk.vertices);
      dequantise(points, this.manifest.box, this.positions, 3 * chunk.firstVertex);
      this.corners.set(corners, 3 * chunk.firstTriangle);
      this.ready.fill(1, chunk.firstVertex, chunk.firstVertex + chunk.vertices);
      this.readyTriangles.fill(1, chunk.firstTriangle, chunk.firstTriangle + chunk.triangles);
    });
  }

  /** @param {number | null} number @returns {Promise<object | null>} the surface of a state, from the cache if it was there lately */
  surface(number) {
    if (number === null) return Promise.resolve(null);
    const known = this.surfaces.get(number);
    const loading = known ?? this.loadSurface(number);
    this.surfaces.delete(number);  // the last one asked for is at the end
    this.surfaces.set(number, loading);
    if (!known) loading.catch(() => {});
    if (this.surfaces.size > KEPT_SURFACES) this.surfaces.delete(this.surfaces.keys().next().value);
    return loading;
  }

  async loadSurface(number) {
    const state = this.manifest.states[number];
    await Promise.all(state.chunks.map((chunk) => this.chunk(chunk)));
    const bytes = await this.bytes(state.blob, stateSize(state.runs));
    const runs = await this.named(state.blob, async () =>
      this.complete(decodeState(bytes, state.runs, this.manifest.triangles, state.patches.length)));
    return makeSurface(runs, state.patches, this.corners, this.positions);
  }

  /** Refuses a state that uses triangles or vertices of a chunk it does not name: it would be drawn wrong. */
  complete(runs) {
    const loaded = (triangle) => this.readyTriangles[triangle] && [0, 1, 2].every((c) => this.ready[this.corners[3 * triangle + c]]);
    for (let run = 0; run < runs.first.length; ++run)
      for (let i = 0; i < runs.count[run]; ++i)
        if (!loaded(runs.first[run] + i)) throw new DataError('uses geometry that it does not name');
    return runs;
  }

  /** Deviations [mm] of the vertices of an edit's surface after it, in their order. */
  async deviation(deviation, surface) {
    const bytes = await this.bytes(deviation.blob, 2 * (surface.points.length / 3));
    return decodeDeviation(bytes, deviation.min ?? 0, deviation.max);
  }

  /** Grey values of an image slice, row after row. */
  slice(slice) {
    return this.bytes(slice.blob, slice.width * slice.height);
  }
}
