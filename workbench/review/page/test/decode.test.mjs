import assert from 'node:assert/strict';
import { deflateSync } from 'node:zlib';
import { test } from 'node:test';
import { bytesOfBase64, DataError, decodeChunk, decodeDeviation, decodeState, dequantise, inflate } from '../src/decode.js';
import { cutSurface, ORTHOGONAL } from '../src/contours.js';
import { readManifest } from '../src/manifest.js';
import { Pool } from '../src/pool.js';
import { onlyIn } from '../src/surface.js';
import { encodeChunk, encodeState, Packer } from './sample/encode.mjs';
import { makeSample } from './sample/sample.mjs';
import { random, surfaceNets } from './sample/vessel.mjs';

const BOX = [-2, -2, -2, 2, 2, 2];
const sphere = () => surfaceNets((p) => Math.hypot(...p) - 1.5, BOX.map((x) => 1.1 * x), 0.2);

function poolOf(packer, extra = {}) {
  const manifest = readManifest(JSON.stringify({ format: 'vesselbench-review', version: 1, project: { id: 'p' }, pool: { box: packer.box },
    chunks: packer.chunks, states: packer.states, edits: [], ...extra }));
  return new Pool(manifest, (name) => packer.blobs[name] ?? null);
}

test('a chunk comes back as it was packed, at the limits of its numbers too', () => {
  const rng = random(3);
  const points = [[0, 65535, 1], [65535, 0, 2], ...Array.from({ length: 500 }, () => [0, 1, 2].map(() => Math.floor(rng() * 65536)))];
  const triangles = [[0, 501, 2], [501, 0, 1], ...Array.from({ length: 700 }, () => [0, 1, 2].map(() => Math.floor(rng() * 502)))];
  const decoded = decodeChunk(new Uint8Array(encodeChunk(points, triangles)), points.length, triangles.length, points.length);
  assert.deepEqual([...decoded.points], points.flat());
  assert.deepEqual([...decoded.corners], triangles.flat());
});

test('runs of a state keep triangles and patches', () => {
  const { bytes, runs } = encodeState([4, 5, 6, 9, 1, 2], [0, 0, 1, 1, 0, 0]);
  const state = decodeState(new Uint8Array(bytes), runs, 10, 2);
  assert.deepEqual([[...state.first], [...state.count], [...state.patch], state.total], [[1, 4, 6, 9], [2, 2, 1, 1], [0, 0, 1, 1], 6]);
});

test('wrong data is refused, not drawn', async () => {
  assert.throws(() => decodeChunk(new Uint8Array(17), 1, 1, 1), DataError);
  assert.throws(() => decodeChunk(new Uint8Array(encodeChunk([[0, 0, 0]], [[0, 0, 7]])), 1, 1, 1), /vertex that does not exist/);
  const { bytes, runs } = encodeState([8, 9], [0, 0]);
  assert.throws(() => decodeState(new Uint8Array(bytes), runs, 9, 1), /triangle that does not exist/);
  assert.throws(() => decodeState(new Uint8Array(bytes), runs, 10, 0), /patch that does not exist/);
  assert.throws(() => bytesOfBase64('§§'), DataError);
  await assert.rejects(inflate(new Uint8Array([1, 2, 3, 4]), 4), /cannot be decompressed/);
  await assert.rejects(inflate(new Uint8Array(deflateSync(Buffer.alloc(1000))), 999), /more than the 999 bytes/);
  await assert.rejects(inflate(new Uint8Array(deflateSync(Buffer.alloc(10))), 11), DataError);
});

test('positions and deviations keep their millimetres', () => {
  const out = new Float32Array(6);
  dequantise(Uint16Array.from([0, 65535, 32768, 65535, 0, 0]), [-1, 0, 10, 1, 4, 20], out);
  assert.ok(Math.abs(out[1] - 4) < 1e-6 && Math.abs(out[2] - 15) < 1e-3 && out[0] === -1);
  assert.ok(Math.abs(decodeDeviation(Uint8Array.from([255, 255, 0, 128]), 0, 2)[1] - 1) < 1e-4);
  const [least, none] = decodeDeviation(Uint8Array.from([0, 0, 0, 128]), -2, 2);
  assert.equal(least, -2);
  assert.ok(Math.abs(none) < 1e-4);
});

test('states share what did not change, and differ in what did', async () => {
  const packer = new Packer(BOX);
  const first = sphere();
  const second = { ...first, points: first.points.map((p) => (p[2] > 1.2 ? [p[0], p[1], p[2] + 0.2] : p)) };
  packer.add(first);
  packer.add(second);
  const pool = poolOf(packer);
  const [before, after] = [await pool.surface(0), await pool.surface(1)];
  assert.equal(before.triangles.length, first.triangles.length);
  assert.ok(packer.chunks[1].triangles < first.triangles.length / 4);
  const [added, removed] = [onlyIn(after, before, pool.manifest.triangles), onlyIn(before, after, pool.manifest.triangles)];
  assert.equal(added.length, removed.length);
  assert.equal(added.length / 3, packer.chunks[1].triangles);
  for (const corner of removed) assert.ok(before.points[3 * corner + 2] > 0.7);
});

test('normals of a sphere point outwards', async () => {
  const packer = new Packer(BOX);
  packer.add(sphere());
  const { points, normals } = await poolOf(packer).surface(0);
  for (let i = 0; i < points.length; i += 3) assert.ok(points[i] * normals[i] + points[i + 1] * normals[i + 1] + points[i + 2] * normals[i + 2] > 1.3);
});

test('a plane cuts a sphere in one closed circle of the right radius', async () => {
  const packer = new Packer(BOX);
  packer.add(sphere());
  const surface = await poolOf(packer).surface(0);
  for (const plane of ORTHOGONAL) {
    const lines = cutSurface(surface, { ...plane, origin: [0.5, 0.5, 0.5] });
    assert.equal(lines.length, 1);
    const [line] = lines;
    assert.deepEqual([...line.slice(0, 2)], [...line.slice(-2)]);
    const [cu, cv] = [plane.u, plane.v].map((axis) => -0.5 * (axis[0] + axis[1] + axis[2]));
    for (let i = 0; i < line.length; i += 2) assert.ok(Math.abs(Math.hypot(line[i] - cu, line[i + 1] - cv) - Math.SQRT2) < 0.04);
  }
});

test('missing and damaged parts are named', async () => {
  const packer = new Packer(BOX);
  packer.add(sphere());
  delete packer.blobs['chunk-0'];
  await assert.rejects(poolOf(packer).surface(0), /“chunk-0” is missing/);
  packer.blobs['chunk-0'] = 'AAAA';
  await assert.rejects(poolOf(packer).surface(0), /“chunk-0” is damaged/);
});

test('a state that does not name a chunk it needs is refused', async () => {
  const packer = new Packer(BOX);
  const first = sphere();
  packer.add(first);
  packer.add({ ...first, points: first.points.map((p) => (p[2] > 1.2 ? [p[0], p[1], p[2] + 0.2] : p)) });
  packer.states[1].chunks = [1];
  await assert.rejects(poolOf(packer).surface(1), /does not name/);
});

test('the sample is the same for the same seed and holds twelve edits', () => {
  const [a, b] = [0, 1].map(() => makeSample({ h: 0.7, pictures: false }));
  assert.deepEqual(a.blobs, b.blobs);
  assert.equal(a.manifest.edits.length, 12);
});

test('foreign manifests are refused in words', () => {
  assert.throws(() => readManifest('{'), /damaged or incomplete/);
  assert.throws(() => readManifest('{"format": "x"}'), /holds no review/);
  assert.throws(() => readManifest('{"format": "vesselbench-review", "version": 2}'), /version 2/);
  const odd = readManifest(JSON.stringify({ format: 'vesselbench-review', version: 1, edits: [{ id: 7, place: [1, 'x', 2], before: 3, thumbnail: 'https://x/y.png', warnings: [null] }] }));
  assert.deepEqual([odd.edits[0].id, odd.edits[0].place, odd.edits[0].before, odd.edits[0].thumbnail], [7, null, null, '']);
});
