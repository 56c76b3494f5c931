// A whole review of a plausible case: 12 edits on a meshed vessel, queue, verdicts; the same for the same seed.
import { createHash } from 'node:crypto';
import { clip, distances, fillHoles, inflate, puncture, smooth, subdivide } from './edits.mjs';
import { Packer } from './encode.mjs';
import { thumbnail } from './picture.mjs';
import { PARTS, random, surfaceNets, unit, vessel } from './vessel.mjs';

const BOX = [-9, -5, -17, 15, 12, 18];
const onParent = (t) => PARTS.parent[Math.round(t * 24)].slice(0, 3);
const value = (name, v, unitName = '', automatic = false) => ({ name, value: v, unit: unitName, automatic });
const warning = (text, place) => ({ text, place });

/** The edits: what the operator did, in order. `run` makes the mesh after from the mesh before. */
function script(rng, h, refined) {
  const near = (p) => p.map((x) => Math.round(x * 10) / 10);
  const dome = PARTS.dome[0], neck = [6.2, 4.6, 2.2], narrow = onParent(0.29), twig = [1.9, 3.3, -4.4], hole = [3.4, 9.2, 3.1];
  const [inlet, outlet1, outlet2] = [onParent(0.08), onParent(0.92), PARTS.branch[11].slice(0, 3)];
  return [
    { step: 'source', title: 'Extract the surface at 215 HU', operation: 'extract-surface', place: null,
      run: () => puncture(refined(surfaceNets(vessel, BOX, h, () => (rng() - 0.5) * 0.11)), hole, 0.9),
      arguments: [value('threshold', 215, 'HU', true), value('smooth_image', true)],
      figures: [value('triangles', null), value('volume', 612.4, 'mm³')],
      warnings: [warning('The threshold lies within 3 % of the point where the dome touches the branch.', dome)] },
    { step: 'source', title: 'Fill the hole in the dome', operation: 'fill-hole', place: hole, radius: 1.2, run: fillHoles,
      arguments: [value('max_size', 3, 'mm')], figures: [value('holes filled', 1), value('area added', 2.31, 'mm²')], warnings: [] },
    { step: 'branches', title: 'Remove a twig at the parent artery', operation: 'remove-branch', place: twig, radius: 1.6,
      run: (m) => clip(m, [1.35, 3.4, -4.5], unit([-4.5, 1.6, 0]), 2.9, null, [-0.8, 4.1, -5.1]),
      arguments: [value('tip', near([-2.1, 4.6, -5.6]), 'mm'), value('length', 4.1, 'mm', true)],
      figures: [value('volume removed', 3.8, 'mm³'), value('stump radius', 0.53, 'mm')],
      warnings: [warning('The removed branch carried an estimated 2.1 % of the flow.', twig)] },
    { step: 'local-repair', title: 'Smooth a step of the scan at the neck', operation: 'brush-smooth', place: neck, radius: 1.5,
      run: (m) => smooth(m, 6, (p) => (Math.hypot(p[0] - neck[0], p[1] - neck[1], p[2] - neck[2]) < 2 ? 0.9 : 0)),
      arguments: [value('radius', 2, 'mm'), value('strength', 0.9, '')], figures: [value('largest move', 0.11, 'mm')], warnings: [] },
    { step: 'local-repair', title: 'Inflate the dome at its tip', operation: 'brush-inflate', place: [4.2, 8.9, 4.3], radius: 1.8,
      run: (m) => inflate(m, [4.2, 8.9, 4.3], 2.3, 0.85), note: 'Looked flat in the slices, see contour.',
      arguments: [value('height', 0.85, 'mm'), value('radius', 2.3, 'mm')],
      figures: [value('largest move', 0.85, 'mm'), value('local radius', 3.1, 'mm'), value('volume change', 5.9, 'mm³')],
      warnings: [warning('The surface moved by 27 % of the local radius.', [4.2, 8.9, 4.3])] },
    { step: 'local-repair', title: 'Widen the narrowing before the bend', operation: 'correct-narrowing', place: narrow, radius: 1.4,
      run: (m) => inflate(m, narrow, 3, 0.5), arguments: [value('target_radius', 1.75, 'mm', true), value('blend', 2, 'mm')],
      figures: [value('stenosis before', 31, '%'), value('stenosis after', 4, '%')],
      warnings: [warning('The narrowing is seen in the image, too: it may be real.', narrow)] },
    { step: 'openings', title: 'Clip the inlet', operation: 'clip-opening', place: inlet, radius: 1.8,
      run: (m) => clip(m, inlet, unit([-0.3, -0.25, -1]), 5, { name: 'inlet', kind: 'inlet' }),
      arguments: [value('name', 'inlet', '', true), value('turn', [0, 4.5], 'deg')],
      decided: [value('plane_normal', [-0.28, -0.23, -0.93], '', true), value('role', 'inlet', '', true)],
      figures: [value('diameter', 3.61, 'mm'), value('share of flow', 100, '%')], warnings: [] },
    { step: 'openings', title: 'Clip outlet 1', operation: 'clip-opening', place: outlet1, radius: 1.4,
      run: (m) => clip(m, outlet1, unit([-0.4, -0.2, 1]), 5, { name: 'outlet_1', kind: 'outlet' }),
      arguments: [value('name', 'outlet_1', '', true)], decided: [value('role', 'outlet', '', true)],
      figures: [value('diameter', 2.83, 'mm'), value('share of flow', 64, '%')], warnings: [] },
    { step: 'openings', title: 'Clip outlet 2', operation: 'clip-opening', place: outlet2, radius: 1,
      run: (m) => clip(m, outlet2, unit([0.6, 0, 0.75]), 4, { name: 'outlet_2', kind: 'outlet' }),
      arguments: [value('name', 'outlet_2', '', true)], decided: [value('role', 'outlet', '', true)],
      figures: [value('diameter', 1.87, 'mm'), value('share of flow', 36, '%')], warnings: [] },
    { step: 'smoothing', title: 'Smooth the wall, caps kept', operation: 'smooth', place: null,
      run: (m) => smooth(m, 5, () => 0.8), arguments: [value('filter', 'taubin'), value('iterations', 5), value('context', true)],
      figures: [value('largest move', 0.21, 'mm'), value('volume change', -0.06, '%')], warnings: [] },
    { step: 'remeshing', title: 'Remesh to an edge length of 0.12 mm', operation: 'remesh', place: null,
      run: (m) => smooth(denser(m), 1, () => 0.3), reference: denser,
      arguments: [value('edge_length', 0.12, 'mm', true), value('keep_caps', true)],
      figures: [value('worst angle', 21.4, 'deg'), value('largest distance', 0.03, 'mm')], warnings: [] },
    { step: 'product', title: 'Extrude the outlets by 5 diameters', operation: 'extrude-opening', place: outlet1, radius: 1.4, run: null,
      status: 'stale', arguments: [value('length', 5, 'diameters')], figures: [],
      warnings: [warning('This edit no longer applies: outlet_2 was clipped after it.', null)] },
  ];
}

/** Four triangles of one, unless the page would become larger than it ought to be. */
const denser = (mesh) => (mesh.triangles.length < 50000 ? subdivide(mesh) : mesh);

const STEPS = { source: 'Source', branches: 'Branches', 'local-repair': 'Local repair', openings: 'Openings',
                smoothing: 'Smoothing', remeshing: 'Remeshing', product: 'Product' };

function changedBox(before, after) {
  if (!before) return null;
  const key = (p) => p.map((x) => x.toFixed(4)).join();
  const [old, now] = [before, after].map((mesh) => new Set(mesh.points.map(key)));
  const moved = after.points.filter((p) => !old.has(key(p))).concat(before.points.filter((p) => !now.has(key(p))));
  if (!moved.length) return null;
  return [0, 1, 2].map((k) => moved.reduce((low, p) => Math.min(low, p[k]), Infinity))
    .concat([0, 1, 2].map((k) => moved.reduce((high, p) => Math.max(high, p[k]), -Infinity)));
}

function pictureOf(before, after, place, radius) {
  const key = (mesh, t) => t.map((c) => mesh.points[c].map((x) => x.toFixed(4)).join()).join(' ');
  const old = new Set(before ? before.triangles.map((t) => key(before, t)) : []);
  const all = before !== null && !place;
  return thumbnail(after, place ?? [3, 2, 0.5], place ? 3.2 * radius : 17, (i) => before && !all && !old.has(key(after, after.triangles[i])));
}

/** Grey values of the plane through `place` spanned by x and z, as a scan would show them. */
function grey(packer, name, place, rng) {
  const size = 96, spacing = 0.2;
  const bytes = Buffer.alloc(size * size);
  const origin = [place[0] - (size / 2) * spacing, place[1], place[2] + (size / 2) * spacing];
  for (let j = 0; j < size; ++j) for (let i = 0; i < size; ++i) {
    const d = vessel([origin[0] + i * spacing, place[1], origin[2] - j * spacing]);
    bytes[j * size + i] = Math.max(0, Math.min(255, 62 + 150 / (1 + Math.exp(d / 0.22)) + 26 * (rng() - 0.5)));
  }
  return { blob: packer.put(name, bytes), width: size, height: size, spacing: [spacing, spacing], origin, u: [1, 0, 0], v: [0, 0, -1], window: [-50, 450] };
}

const QUEUE = [
  [4, 'deviation', 'Largest change beside the local radius', 'The surface moved 0.85 mm where the vessel has a radius of 3.1 mm (27 %).'],
  [11, 'stale', 'An edit that no longer applies', 'outlet_2 was clipped after it; the model has no extensions.'],
  [5, 'warning', 'A narrowing was widened that may be real', 'The image shows it, too; the stenosis fell from 31 % to 4 %.'],
  [0, 'decision', 'Threshold chosen by the program', '215 HU lies within 3 % of the value at which dome and branch join.'],
  [6, 'decision', 'Inlet chosen by the program', 'The odds of this end being the inlet are 3 to 1.'],
  [2, 'deviation', 'A branch was removed', 'It carried an estimated 2.1 % of the flow.'],
  [1, 'finding', 'Hole in the dome', 'The patch is flat where the dome is round.'],
  [9, 'deviation', 'Smoothing of the whole wall', 'The largest move is 0.21 mm.'],
];

/**
 * @param {{seed?: number, h?: number, slices?: boolean, pictures?: boolean, refine?: boolean}} options h: cell size of the first mesh [mm]; refine: split its triangles in four
 * @returns {{manifest: object, blobs: object}} the page's data, base64 blobs by name
 */
export function makeSample({ seed = 7, h = 0.42, slices = false, pictures = true, refine = false } = {}) {
  const rng = random(seed);
  const packer = new Packer(BOX);
  let mesh = null, last = null;
  const edits = script(rng, h, refine ? subdivide : (mesh) => mesh).map((edit, k) => {
    const before = mesh;
    const own = { before: last, after: null, deviation: null, changed_box: null, thumbnail: '' };
    if (edit.run) {
      mesh = edit.run(before);
      const added = packer.add(mesh);
      last = own.after = added.state;
      own.changed_box = changedBox(before, mesh);
      if (before) {
        const values = distances(mesh, edit.reference ? edit.reference(before) : before, 1);
        own.deviation = packer.deviation(`deviation-${k}`, values, added.vertices, values.reduce((a, b) => Math.max(a, b), 1e-6));
      }
      if (pictures) own.thumbnail = pictureOf(before, mesh, edit.place, edit.radius);
    } else own.before = last;
    return finished(edit, k, own, mesh, slices && edit.place ? [grey(packer, `slice-${k}`, edit.place, rng)] : []);
  });
  return { manifest: manifestOf(packer, edits, slices), blobs: packer.blobs };
}

function finished(edit, k, own, mesh, slices) {
  const { run, reference, step, ...rest } = edit;
  const figures = edit.figures.map((f) => (f.name === 'triangles' ? { ...f, value: mesh.triangles.length } : f));
  return { id: k + 1, revision: k === 5 ? 2 : 1, hash: createHash('sha256').update(`${k} ${edit.title}`).digest('hex'), step,
           step_title: STEPS[step], author: k < 9 ? 'M. Operator' : 'S. Second', time: `2026-03-0${1 + (k > 5)}T1${k % 10}:2${k % 6}:00Z`,
           status: 'applied', note: '', decided: [], slices, ...rest, ...own, figures,
           verdicts: k === 5 ? [{ reviewer: 'Dr A. Former', time: '2026-03-01T18:00:00Z', verdict: 'reject', comment: 'This is a real stenosis.', revision: 1, outdated: true }] : [] };
}

function manifestOf(packer, edits, slices) {
  return {
    format: 'vesselbench-review', version: 1, program: '0.2.0', written: '2026-03-03T08:00:00Z', chain_head: createHash('sha256').update('head').digest('hex'),
    project: { id: 'p-7f3a', name: 'Case 7, middle cerebral artery', purpose: 'cfd', units: 'mm', variant: 'cfd',
               source: { file: 'case7.nrrd', kind: 'image', spacing: [0.35, 0.35, 0.4], size: [256, 256, 180] } },
    holds: ['surface', 'contours', ...(slices ? ['image slices'] : [])],
    pool: { box: packer.box, bits: 16 }, chunks: packer.chunks, states: packer.states, neighbours: [], edits,
    queue: QUEUE.map(([k, kind, title, why], i) => ({ kind, edit: k + 1, title, why, score: 1 - i / 10, place: edits[k].place, radius: edits[k].radius })),
    report: [value('wall area', 402.7, 'mm²'), value('volume', 601.9, 'mm³'), value('openings', 3)],
  };
}
