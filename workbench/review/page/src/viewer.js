/** Starts the page that shows a model: structures, clipping, distances, views. */
import { neighbourColour, patchColours, rampColour, rampGradient, rampStops } from './colours.js';
import { ClipPanel } from './clip_panel.js';
import { DataError } from './decode.js';
import { showHelp } from './dialogs.js';
import { bindClicks } from './drawing.js';
import { bindKeys } from './keyboard.js';
import { Lengths } from './lengths.js';
import { notice, say } from './messages.js';
import { ModelStage } from './model_stage.js';
import { Marks, openingsOf } from './pins.js';
import { Pool } from './pool.js';
import { drawScaleBar } from './scale_bar.js';
import { Slices } from './slices.js';
import { listStructures } from './structures.js';
import { boxOf } from './surface.js';
import { fill, foreign, make, moment, plain, tickTexts, words } from './text.js';
import { bindTheme } from './theme.js';
import { readViewer, shareOf } from './viewer_manifest.js';
import { makeViewerCommands, VIEWS } from './viewer_commands.js';

const byId = (id) => document.getElementById(id);
const UNKNOWN = [140, 140, 140];  // of a vertex without a value
const ROOM = 1.1;  // of a view, for names beside the model
const KNOWN = ['surface', 'neighbours', 'vertex measure', 'image slices'];

function manifestOfPage() {
  const element = byId('case');
  if (!element) throw new DataError('This page holds no model yet: it is the empty template.');
  return readViewer(element.textContent);
}

function showCase(manifest) {
  const holds = manifest.holds.map((name) => (KNOWN.includes(name) ? name : `“${plain(name)}”`)).join(', ');
  fill(byId('case-name'), foreign(manifest.title || 'Vessel model', { limit: 90 }));
  byId('case-provenance').hidden = !manifest.provenance;
  fill(byId('case-provenance'), foreign(manifest.provenance, { limit: 200, brief: true }));
  fill(byId('case-facts'), foreign(manifest.purpose, { limit: 60, brief: true }), ' · lengths in mm · vesselbench ', foreign(manifest.program, { limit: 20, brief: true }), ` · written ${moment(manifest.written).slice(0, 30)}`);
  byId('case-text').hidden = !manifest.text;
  fill(byId('case-text'), foreign(manifest.text, { limit: 400 }));
  byId('case-holds').textContent = `This page holds: ${holds || 'nothing stated'}; ${manifest.slices.length ? 'grey values of the slices shown' : 'no voxels of the image'}. It uses no network.`;
}

function boxOfAll(surfaces) {
  const boxes = surfaces.map(({ points }) => boxOf(points));
  return [0, 1, 2].map((k) => Math.min(...boxes.map((box) => box[k]))).concat([3, 4, 5].map((k) => Math.max(...boxes.map((box) => box[k]))));
}

function middleOf({ points }) {
  const box = boxOf(points);
  return [0, 1, 2].map((k) => (box[k] + box[k + 3]) / 2);
}

/** Names in the view: of openings, and of other structures as a whole. */
function captionsOf(structure, parts, surface) {
  if (structure.kind === 'neighbour') return [{ place: middleOf(surface), name: words(structure.name), part: parts[0] }];
  return openingsOf(surface).map(({ place, name }) => ({ place, name: words(name), part: parts.find((part) => part.name === name) }));
}

class Viewer {
  constructor(manifest) {
    Object.assign(this, { manifest, pool: new Pool(manifest), names: true });
    this.stage = new ModelStage(byId('canvas'));
    this.stage.ondraw = () => drawScaleBar(byId('scale-bar'), this.stage);
    this.marks = new Marks(this.stage);
  }

  async load() {
    const { structures } = this.manifest;
    this.surfaces = await Promise.all(structures.map(({ state }) => this.pool.surface(state)));
    this.box = boxOfAll(this.surfaces);
    let neighbours = 0;
    const entries = [];
    for (const [i, structure] of structures.entries()) {
      const surface = this.surfaces[i];
      const other = structure.kind === 'neighbour' ? neighbourColour(neighbours++) : null;
      const colours = other === null ? patchColours(surface.patches) : surface.patches.map(() => other);
      entries.push({ structure, parts: this.stage.add(surface, { colours, measure: await this.measureOf(structure, surface) }) });
    }
    this.captions = entries.flatMap(({ structure, parts }, i) => captionsOf(structure, parts, this.surfaces[i]));
    listStructures(byId('structures'), entries, (part, how) => { this.stage.setPart(part, how); this.showMarks(); });
    this.bind();
    this.look(VIEWS[0]);
  }

  /** The measure's values of a structure; null: it has none. */
  async measureOf({ state }, surface) {
    const { colour } = this.manifest;
    const own = colour?.values.find((one) => one.state === state);
    if (!own) return null;
    const values = await this.pool.deviation(own, surface);
    const colourOf = (stored) => { const share = shareOf(stored); return share === null ? UNKNOWN : rampColour(share, colour.ramp); };
    return { values, colourOf, gradient: rampGradient(colour.ramp, 'right') };
  }

  bind() {
    const page = { say, changed: () => this.showMarks(), look: (centre, radius) => this.aim(centre, radius, null) };
    this.lengths = new Lengths({ gaps: byId('gaps'), first: byId('gap-first'), second: byId('gap-second'), gap: byId('gap'), list: byId('measured'), clear: byId('clear'), tool: byId('measure') }, this.manifest, page);
    this.clip = new ClipPanel({ box: byId('clip'), axis: byId('clip-axis'), at: byId('clip-at'), flip: byId('clip-flip'), place: byId('clip-place') }, this.stage, this.box, say);
    bindClicks(byId('canvas'), (x, y) => { if (this.lengths.armed) this.lengths.place(this.stage.pick(x, y)); });
    byId('names').addEventListener('change', () => { this.names = byId('names').checked; this.showMarks(); });
    fill(byId('views'), ...VIEWS.map((view, i) => make('button', { type: 'button', 'aria-keyshortcuts': String(i + 1), onclick: () => this.look(view) }, view.name, make('kbd', { 'aria-hidden': 'true' }, String(i + 1)))));
    this.showLegend();
    this.showSlices();
    this.showMarks();
  }

  showLegend() {
    const { colour } = this.manifest;
    byId('legend').hidden = !colour;
    byId('legend-text').hidden = !colour;
    if (!colour) return;
    const { least, most, unit, ramp } = colour;
    const ticks = tickTexts([1, 0.75, 0.5, 0.25, 0].map((share) => least + share * (most - least)));
    const label = [foreign(colour.label, { limit: 60, brief: true }), unit ? ' [' : '', unit ? foreign(unit, { limit: 12, brief: true }) : '', unit ? ']' : ''];
    byId('legend-bar').style.setProperty('--ramp', rampStops(ramp));  // its side depends on the width of the screen
    fill(byId('legend-ticks'), ...ticks.map((tick) => make('span', {}, tick)));
    fill(byId('legend-title'), ...label);
    byId('legend').setAttribute('aria-label', `Scale of the wall's colours from ${ticks.at(-1)} to ${ticks[0]}`);
    fill(byId('legend-text'), 'Colour of the wall: ', foreign(colour.label, { limit: 60, brief: true }), ` from ${ticks.at(-1)} to ${ticks[0]} `, unit ? foreign(unit, { limit: 12, brief: true }) : '', '; values beyond have the colour of the end.');
  }

  showSlices() {
    const { slices, slicesPlace, patient } = this.manifest;
    byId('slices-part').hidden = !(slices.length && slicesPlace);
    if (byId('slices-part').hidden) return;
    this.slices = new Slices(byId('slices'), this.pool, { patient, after: 'of the model' });
    const reach = Math.max(...slices.map(({ width, height, spacing }) => Math.max(width * spacing[0], height * spacing[1]))) / 2;
    this.slices.show({ slices }, null, this.surfaces[0], slicesPlace, reach);
  }

  showMarks() {
    if (!this.lengths) return;
    byId('crosshair').hidden = !this.lengths.armed;
    byId('canvas').classList.toggle('aiming', this.lengths.armed);
    this.marks.show({ pins: [], distances: this.lengths.lines() }, { warnings: [] }, this.names ? this.captions.filter(({ part }) => part.material.visible) : [], this.lengths.start);
  }

  toggleNames() { byId('names').checked = this.names = !this.names; this.showMarks(); }

  aim(centre, radius, from, exact = false) {
    const [low, high] = [this.box.slice(0, 3), this.box.slice(3)];
    this.stage.view.reach = 4 * Math.hypot(...high.map((x, k) => x - low[k])) + 1;
    this.stage.view.frame(centre, 1.1 * radius, from, { exact });
    this.stage.redraw();
  }

  /** Looks at the whole model. @param {{from: number[] | null, across: number, up: number}} view axes of the picture; without them its ball is framed */
  look({ from = null, across, up }) {
    const centre = [0, 1, 2].map((k) => (this.box[k] + this.box[k + 3]) / 2);
    const half = [0, 1, 2].map((k) => (this.box[k + 3] - this.box[k]) / 2);
    const aspect = byId('canvas').clientWidth / byId('canvas').clientHeight;
    this.aim(centre, from ? ROOM * Math.max(half[up] * Math.min(1, aspect), half[across] / Math.max(1, aspect)) : Math.hypot(...half), from, true);
  }

  redraw() { this.stage.showCuts(); this.slices?.draw(); }
}

async function start() {
  const manifest = manifestOfPage();
  showCase(manifest);
  if (!manifest.structures.length) throw new DataError('This page holds no structures.');
  let viewer;
  try {
    viewer = new Viewer(manifest);
  } catch {
    throw new DataError('This browser offers no 3D view (WebGL 2), which this page needs.');
  }
  await viewer.load();
  const commands = makeViewerCommands(viewer, () => showHelp(commands));
  bindKeys(commands, () => byId('keys-on').checked);
  byId('help-button').addEventListener('click', () => showHelp(commands));
  bindTheme(byId('theme'), () => viewer.redraw());
  viewer.stage.draw();
  performance.measure('viewer:first-picture', { start: 0, end: performance.now() });
}

start().catch((error) => notice(error instanceof DataError ? error.message : `The page could not start: ${error.message}`));
