// A vessel with three openings beside two other structures, as the page that shows a model holds them.
import { clip } from './edits.mjs';
import { Packer } from './encode.mjs';
import { dot, minus, PARTS, random, surfaceNets, unit, vessel } from './vessel.mjs';

const BOX = [-16, -9, -17, 15, 16, 18];
const onParent = (t) => PARTS.parent[Math.round(t * 24)].slice(0, 3);
const ball = (centre, radius) => (p) => Math.hypot(...minus(p, centre)) - radius;

function cutVessel(h) {
  const [inlet, outlet1, outlet2] = [onParent(0.08), onParent(0.92), PARTS.branch[11].slice(0, 3)];
  let mesh = surfaceNets(vessel, BOX, h);
  mesh = clip(mesh, inlet, unit([-0.3, -0.25, -1]), 5, { name: 'inlet', kind: 'inlet' });
  mesh = clip(mesh, outlet1, unit([-0.4, -0.2, 1]), 5, { name: 'outlet_1', kind: 'outlet' });
  return clip(mesh, outlet2, unit([0.6, 0, 0.75]), 4, { name: 'outlet_2', kind: 'outlet' });
}

/** The nearest corners of two meshes. */
function gapOf(a, b) {
  let best = { mm: Infinity };
  for (const p of a.points) for (const q of b.points) {
    const d = minus(p, q);
    const mm = Math.sqrt(dot(d, d));
    if (mm < best.mm) best = { from: p, to: q, mm };
  }
  return best;
}

const RAMP = [[59, 10, 84], [49, 104, 142], [53, 183, 121], [253, 231, 37]];

function colourOf(packer, mesh, added) {
  const height = mesh.points.map((p) => p[2]);
  const most = height.reduce((a, b) => Math.max(a, b)), least = height.reduce((a, b) => Math.min(a, b));
  const shares = height.map((z) => 0.001 + 0.999 * ((z - least) / (most - least)));
  const values = packer.deviation('deviation-0', shares, added.vertices, 1);
  return { name: 'height', label: 'Height', unit: 'mm', least, most, colours: RAMP, values: [{ state: added.state, blob: values.blob, max: 1 }] };
}

function slicesOf(packer, place) {
  const size = 120, spacing = 0.28, rng = random(3);
  return [[[1, 0, 0], [0, 1, 0], 'z'], [[1, 0, 0], [0, 0, -1], 'y'], [[0, 1, 0], [0, 0, -1], 'x']].map(([u, v, name]) => {
    const origin = place.map((x, k) => x - (size / 2) * spacing * (u[k] + v[k]));
    const bytes = Buffer.alloc(size * size);
    for (let j = 0; j < size; ++j) for (let i = 0; i < size; ++i) {
      const d = vessel(origin.map((x, k) => x + spacing * (i * u[k] + j * v[k])));
      bytes[j * size + i] = Math.max(0, Math.min(255, 62 + 150 / (1 + Math.exp(d / 0.22)) + 26 * (rng() - 0.5)));
    }
    return { blob: packer.put(`slice-model-${name}`, bytes), width: size, height: size, spacing: [spacing, spacing], origin, u, v };
  });
}

/** The middle of the picture from the front shows the parent artery. @param {{h?: number, colour?: boolean, slices?: boolean}} options h: cell size [mm] @returns {{manifest: object, blobs: object}} */
export function makeViewerSample({ h = 0.6, colour = false, slices = false } = {}) {
  const packer = new Packer(BOX);
  const meshes = [cutVessel(h), surfaceNets(ball([-3, 9, 2], 3), BOX, 2 * h), surfaceNets(ball([10, -3, -6], 3.5), BOX, 2 * h)];
  const added = meshes.map((mesh) => packer.add(mesh));
  const structures = [['vessel', 'vessel'], ['tumour', 'neighbour'], ['optic_nerve', 'neighbour']].map(([name, kind], i) => ({ name, kind, state: added[i].state }));
  const distances = [[0, 1], [0, 2], [1, 2]].map((between) => ({ between, ...gapOf(meshes[between[0]], meshes[between[1]]) }));
  const place = [3.2, 3.1, 0.4];
  const manifest = {
    format: 'vesselbench-viewer', version: 1, program: '0.2.0', written: '2026-03-03T08:00:00Z', title: 'Case 7, middle cerebral artery',
    text: 'An aneurysm at the bend; how far is the tumour from the parent artery?', purpose: 'flow simulation (cfd)', provenance: 'project carotid, cfd, accepted by A. Kern, model 1a2b3c4d5e6f', units: 'mm', source: { patient: true },
    holds: ['surface', 'neighbours', ...(colour ? ['vertex measure'] : []), ...(slices ? ['image slices'] : [])],
    structures, distances, ...(colour ? { colour: colourOf(packer, meshes[0], added[0]) } : {}),
    ...(slices ? { slices: slicesOf(packer, place), slices_place: place } : {}),
    pool: { box: packer.box, bits: 16 }, chunks: packer.chunks, states: packer.states,
  };
  return { manifest, blobs: packer.blobs };
}
