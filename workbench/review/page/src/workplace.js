/** The middle of the page: 3D view, ways to look, legend, tools, slices. */
import { calm } from './theme.js';
import { deviationRamp, rampGradient } from './colours.js';
import { bindClicks } from './drawing.js';
import { Marks, openingsOf } from './pins.js';
import { framing, Preparer, withContext } from './prepare.js';
import { MODES, Stage } from './scene.js';
import { drawScaleBar } from './scale_bar.js';
import { Slices } from './slices.js';
import { figure, fill, foreign, make, minus } from './text.js';

const byId = (id) => document.getElementById(id);
const MODE_NAMES = { after: 'After', before: 'Before', dissolve: 'Dissolve', side: 'Side by side', deviation: 'Deviation', slices: 'Slices' };
const BLINK = 600;  // a side is seen so long [ms]: below two changes a second, which nobody has to fear

export class Workplace {
  /** Called with 'pins' or 'distances' when one was placed. */
  onmark = null;

  /** @param manifest @param pool @param verdicts @param {(text: string) => void} say */
  constructor(manifest, pool, verdicts, say) {
    Object.assign(this, { manifest, pool, verdicts, say, mode: 'after', shown: null, edit: null, tool: null, start: null, blinking: 0 });
    this.preparer = new Preparer(pool, manifest);
    this.slices = new Slices(byId('slices'), pool, { patient: ['image', 'dicom'].includes(manifest.project.source.kind) });
    this.contours = manifest.holds.includes('contours');  // the writer may have left slices and contours out
    byId('slices-key').hidden = !this.contours;
    this.canvas = byId('canvas');
    this.startStage();
    this.makeModes();
    this.makeTools();
    byId('share').addEventListener('input', (event) => { if (this.stage) { this.stage.share = event.target.value / 100; this.stage.redraw(); } });
    verdicts.addEventListener('change', () => this.showMarks());
  }

  startStage() {
    try {
      this.stage = new Stage(this.canvas);
    } catch {
      this.stage = null;
      this.message('This browser offers no 3D view (WebGL 2). Slices, texts and verdicts work all the same.');
      this.canvas.hidden = true;
      return;
    }
    this.marks = new Marks(this.stage);
    this.stage.ondraw = () => drawScaleBar(byId('scale-bar'), this.stage);
    bindClicks(this.canvas, (x, y) => { if (this.tool) this.place(x, y); });
  }

  message(text) {
    byId('view-message').hidden = !text;
    byId('view-message').textContent = text;
  }

  makeModes() {
    this.modeButtons = MODES.map((mode, i) => make('button', { type: 'button', 'aria-pressed': 'false', 'aria-keyshortcuts': String(i + 1), onclick: () => this.setMode(mode) },
      MODE_NAMES[mode], make('kbd', { 'aria-hidden': 'true' }, String(i + 1))));
    this.blinkButton = make('button', { type: 'button', 'aria-pressed': 'false', 'aria-keyshortcuts': 'b', onclick: () => this.blink() }, 'Blink', make('kbd', { 'aria-hidden': 'true' }, 'b'));
    fill(byId('modes'), ...this.modeButtons, this.blinkButton);
  }

  makeTools() {
    const button = (text, key, run) => make('button', { type: 'button', 'aria-keyshortcuts': key, onclick: run }, text, make('kbd', { 'aria-hidden': 'true' }, key));
    this.pinButton = button('Pin', 'p', () => this.arm('pin'));
    this.distanceButton = button('Distance', 'd', () => this.arm('distance'));
    this.markButton = button('Mark changes', 'm', () => this.toggle('mark'));
    this.linesButton = button('Mesh lines', 'l', () => this.toggle('lines'));
    for (const one of [this.pinButton, this.distanceButton, this.markButton, this.linesButton]) one.setAttribute('aria-pressed', 'false');
    this.markButton.setAttribute('aria-pressed', 'true');
    fill(byId('tools'), this.pinButton, this.distanceButton, this.markButton, this.linesButton,
         button('To the change', 'f', () => this.look()), button('Whole model', 'g', () => this.lookWhole()), ...this.neighbourBoxes());
  }

  neighbourBoxes() {
    return this.manifest.neighbours.map(({ name, state }) => {
      const box = make('input', { type: 'checkbox' });
      let mesh = null;
      box.addEventListener('change', async () => {
        if (!mesh && this.stage) mesh = this.stage.addNeighbour(await this.pool.surface(state).catch((error) => { this.say(error.message); return null; }));
        if (mesh) { mesh.visible = box.checked; this.stage.redraw(); }
      });
      return make('label', { class: 'check' }, box, foreign(name, { limit: 40 }));
    });
  }

  toggle(what) {
    if (!this.stage) return;
    this.stage[what] = !this.stage[what];
    (what === 'mark' ? this.markButton : this.linesButton).setAttribute('aria-pressed', String(this.stage[what]));
    this.stage.redraw();
  }

  setMode(mode) {
    this.stopBlinking();
    this.mode = mode;
    if (this.stage) this.stage.mode = mode === 'slices' ? 'after' : mode;
    this.refresh();
    this.say(this.modeButtons[MODES.indexOf(mode)].disabled ? 'Not available for this edit.' : `View: ${MODE_NAMES[mode]}.`);
  }

  /** Brings buttons, labels and legend up to date with edit and mode. */
  refresh() {
    const { before, after, difference } = this.shown ?? {};
    const usable = { after, before, dissolve: before && after, side: before && after, deviation: difference?.deviation, slices: this.contours && (before || after) };
    this.modeButtons.forEach((button, i) => {
      button.disabled = !usable[MODES[i]];
      button.setAttribute('aria-pressed', String(this.mode === MODES[i]));
    });
    this.blinkButton.disabled = !(before && after);
    const mode = this.mode;
    byId('work').classList.toggle('large-slices', mode === 'slices');
    byId('view').classList.toggle('split', mode === 'side' && !this.stage?.blinkSide);
    byId('share-row').hidden = mode !== 'dissolve';
    const side = mode === 'side' && !this.stage?.blinkSide;
    const single = this.stage?.blinkSide ?? { after: 'after', before: 'before', deviation: 'after' }[mode];
    byId('label-left').hidden = !(side || single);
    byId('label-left').textContent = side || single === 'before' ? 'Before' : mode === 'deviation' && !this.stage?.blinkSide ? 'Deviation, after' : 'After';
    byId('label-right').hidden = !side;
    this.showLegend(mode === 'deviation' && difference?.deviation);
    this.stage?.redraw();
  }

  showLegend(on) {
    byId('legend').hidden = !on;
    byId('legend-text').textContent = '';
    if (!on) {
      if (this.shown?.difference.added.length && ['after', 'before', 'dissolve', 'side'].includes(this.mode)) byId('legend-text').textContent = 'Blue: new after the edit. Orange: gone or replaced.';
      return;
    }
    const { min, max, measure } = this.edit.deviation;
    const digits = max >= 10 ? 1 : max >= 0.1 ? 2 : 4;
    const ticks = [1, 0.75, 0.5, 0.25, 0].map((share) => make('span', {}, `${minus((min + (max - min) * share).toFixed(digits))}${share === 1 ? ' mm' : ''}`));
    byId('legend-bar').style.background = rampGradient(deviationRamp(min));
    fill(byId('legend-ticks'), ...ticks);
    byId('legend').setAttribute('aria-label', `Scale from ${minus(figure(min, 3))} to ${figure(max, 3)} mm`);
    const ghost = this.stage?.sides.before.model?.extra.ghost;
    fill(byId('legend-text'), 'Colour: ', foreign(measure || 'deviation', { limit: 100 }), `, ${minus(figure(min, 3))} to ${figure(max, 3)} mm.`, min < 0 ? ' Blue: the wall moved inwards. Red: outwards.' : '', ghost ? ' Translucent grey: what was there before.' : '');
  }

  blink() {
    if (!this.stage || this.blinkButton.disabled) return;
    if (calm()) {  // by hand, for who asked for less motion
      this.stage.setBlink(this.stage.blinkSide === 'before' ? 'after' : 'before');
      this.say(`Shown: ${this.stage.blinkSide}. Press again to change.`);
      return this.refresh();
    }
    if (this.blinking) return this.stopBlinking(true);
    const swap = () => { this.stage.setBlink(this.stage.blinkSide === 'before' ? 'after' : 'before'); this.refresh(); };
    this.blinking = setInterval(swap, BLINK);
    this.blinkButton.setAttribute('aria-pressed', 'true');
    this.say('Blinking between before and after.');
    return swap();
  }

  stopBlinking(refresh = false) {
    clearInterval(this.blinking);
    this.blinking = 0;
    this.blinkButton.setAttribute('aria-pressed', 'false');
    if (this.stage) this.stage.blinkSide = null;
    if (refresh) this.refresh();
  }

  /** Readies a tool: the next click, or Enter for the middle of the view, places its mark. */
  arm(tool) {
    if (!this.stage) return;
    if (this.tool === tool) { this.place(0.5, 0.5); return; }
    this.tool = tool;
    this.start = null;
    this.markTool();
    if (this.tool) this.say(`${tool === 'pin' ? 'Pin' : 'Distance'}: click the surface, or turn it under the cross and press Enter. Escape ends.`);
  }

  markTool() {
    this.pinButton.setAttribute('aria-pressed', String(this.tool === 'pin'));
    this.distanceButton.setAttribute('aria-pressed', String(this.tool === 'distance'));
    byId('crosshair').hidden = !this.tool;
    // Beside each other, the middle of the view is the border: the cross aims in the right picture.
    byId('crosshair').classList.toggle('aside', this.mode === 'side');
    this.canvas.classList.toggle('aiming', Boolean(this.tool));
    this.showMarks();
  }

  disarm() { this.tool = this.start = null; this.markTool(); }

  /** Places the tool's mark at a point of the view, in shares of it. */
  place(x, y) {
    const centred = x === 0.5 && y === 0.5 && this.mode === 'side';
    const at = this.stage.pick(centred ? 0.75 : x, y);
    if (!at) { this.say('There is no surface at this point.'); return; }
    if (this.tool === 'pin') this.verdicts.addPin(this.edit.id, at);
    else if (!this.start) { this.start = at; this.say('Start set. Now the end.'); this.showMarks(); return; }
    else this.verdicts.addDistance(this.edit.id, this.start, at);
    const entry = this.verdicts.of(this.edit.id);
    this.say(this.tool === 'pin' ? `Pin ${entry.pins.length} placed.` : `Distance ${entry.distances.at(-1).mm.toFixed(2)} mm.`);
    const kind = this.tool === 'pin' ? 'pins' : 'distances';
    this.disarm();
    this.onmark?.(kind);
  }

  showMarks() {
    if (this.marks && this.edit && this.shown) this.marks.show(this.verdicts.of(this.edit.id), this.edit, this.openings, this.start);
  }

  /** Shows an edit. @returns {Promise<object | null>} its surfaces; null if they cannot be shown */
  async show(edit, item) {
    const turn = this.turn = (this.turn ?? 0) + 1;
    this.stopBlinking();
    this.tool = this.start = null;
    let shown;
    try {
      shown = await this.preparer.prepare(edit);
    } catch (error) {
      if (turn === this.turn) this.fail(edit, error);
      return null;
    }
    if (turn !== this.turn) return null;
    Object.assign(this, { edit, shown, item });
    const { before, after, difference, problem } = shown;
    const nothing = !before && !after;
    if (this.stage) this.message(problem || (nothing ? 'This edit has no surface to show.' : !after ? 'This edit made no surface; the model before it is shown.' : ''));
    this.openings = openingsOf(after ?? before);
    this.fitMode(shown);
    this.stage?.show(before, after, difference);
    if (!nothing) this.look(null, true);
    else fill(byId('slices'));
    this.markTool();
    this.refresh();
    this.stage?.draw();
    return shown;
  }

  /** Keeps the way to look from edit to edit where the edit allows it. */
  fitMode({ before, after, difference }) {
    if (this.mode === 'deviation' && !difference.deviation) this.mode = 'after';
    if (['dissolve', 'side'].includes(this.mode) && !(before && after)) this.mode = 'after';
    if (this.mode === 'after' && !after) this.mode = 'before';
    if (this.mode === 'before' && !before) this.mode = 'after';
    if (this.stage) this.stage.mode = this.mode === 'slices' ? 'after' : this.mode;
  }

  fail(edit, error) {
    this.shown = null;
    this.edit = edit;
    this.stage?.show(null, null, { added: [], removed: [] });
    this.marks?.clear();
    fill(byId('slices'));
    this.message(`The model of this edit cannot be shown. ${error.message}`);
    this.refresh();
  }

  /** Looks at what changed, or at a place. @param {boolean} context with what is around it */
  look(place, context = false) {
    if (!this.shown) return;
    const frame = place ? framing({ ...this.edit, changedBox: null }, this.shown, place, this.edit.radius ?? 1.5)
      : framing(this.edit, this.shown, this.item?.place ?? this.edit.place, this.item?.radius ?? this.edit.radius);
    this.aim(context ? withContext(frame, this.shown) : frame);
    const { before, after } = this.shown;
    if (this.contours) this.slices.show(this.edit, before, after, place ?? this.item?.place ?? this.edit.place ?? frame.centre, frame.radius);
  }

  lookWhole() {
    if (this.shown) this.aim(framing({ ...this.edit, changedBox: null }, this.shown, null));
  }

  aim({ centre, radius, from }) {
    if (!this.stage) return;
    this.stage.view.reach = 4 * Math.hypot(...this.manifest.box.slice(3).map((x, k) => x - this.manifest.box[k])) + 1;
    this.stage.view.frame(centre, 1.1 * radius, from);
    this.stage.redraw();
  }

  prefetch(edits) {
    const idle = window.requestIdleCallback ?? ((run) => setTimeout(run, 50));
    idle(async () => { for (const edit of edits) await this.preparer.prepare(edit).catch(() => {}); });
  }

  redraw() { this.stage?.redraw(); this.slices.draw(); }
}
