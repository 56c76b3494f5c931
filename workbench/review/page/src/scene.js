/** The 3D view: the states before and after an edit with one camera, in the ways to compare them. */
import { Group } from 'three';
import { AFTER, BEFORE, GHOST } from './colours.js';
import { Dissolve } from './dissolve.js';
import { Drawing, litScene } from './drawing.js';
import { makeModel, makeNeighbour } from './models.js';

/** Ways to look, in the order of the keys 1 to 6; `slices` is drawn elsewhere. */
export const MODES = ['after', 'before', 'dissolve', 'side', 'deviation', 'slices'];

export class Stage extends Drawing {
  /** @param {HTMLCanvasElement} canvas @throws if the browser offers no WebGL 2 */
  constructor(canvas) {
    super(canvas);
    this.sides = { before: litScene(), after: litScene() };
    this.neighbours = new Group();
    this.dissolve = new Dissolve();
    Object.assign(this, { mode: 'after', share: 0.5, blinkSide: null, lines: false, mark: true });
  }

  /**
   * Shows the surfaces of an edit.
   * @param {object | null} before @param {object | null} after
   * @param {{added, removed, deviation, range: {min, max}}} difference corners only in one of them; deviations [mm] of the one after
   */
  show(before, after, difference) {
    this.setSurface('before', before);
    this.setSurface('after', after);
    const [old, now] = [this.sides.before.model, this.sides.after.model];
    if (old && difference.removed.length) old.addMarked(difference.removed, BEFORE);
    if (now && difference.added.length) now.addMarked(difference.added, AFTER);
    // Where all of the surface moved a little, a ghost of the old one would only dim the map.
    if (old && now && difference.removed.length && difference.removed.length < before.index.length / 2) old.addGhost(difference.removed, GHOST);
    if (now && difference.deviation) now.setDeviation(difference.deviation, difference.range);
    this.redraw();
  }

  setSurface(name, surface) {
    const side = this.sides[name];
    if (side.model) { side.scene.remove(side.model.group); side.model.dispose(); }
    side.model = surface ? makeModel(surface) : null;
    if (side.model) side.scene.add(side.model.group);
  }

  addNeighbour(surface) {
    const mesh = makeNeighbour(surface);
    this.neighbours.add(mesh);
    this.redraw();
    return mesh;
  }

  /** Shows one of the sides whatever the mode: for blinking. */
  setBlink(side) { this.blinkSide = side; this.redraw(); }

  /** The sides drawn now, with the parts of the picture they take: [name, left, width] in shares. */
  pictures() {
    const one = (name) => [[this.sides[name].model ? name : name === 'after' ? 'before' : 'after', 0, 1]];
    if (this.blinkSide) return [[this.blinkSide, 0, 1]];
    if (this.mode === 'side') return [['before', 0, 0.5], ['after', 0.5, 0.5]];
    if (this.mode === 'dissolve') return one(this.share < 0.5 ? 'before' : 'after');
    return one(this.mode === 'before' ? 'before' : 'after');
  }

  prepare(name) {
    const { lamp, model } = this.sides[name];
    this.aimLamp(lamp);
    if (!model) return;
    const map = this.mode === 'deviation' && !this.blinkSide && model.deviation();
    if (this.lines) model.addLines(0x202028);
    for (const [kind, mesh] of Object.entries(model.extra))
      mesh.visible = (kind === 'lines' && this.lines) || (kind === 'deviation' && Boolean(map)) || (kind === 'marked' && this.mark && !map);
    model.patches.visible = !map;
  }

  drawSide(name, marks = true) {
    const ghost = this.sides.before.model?.extra.ghost;
    if (this.mode === 'deviation' && name === 'after' && ghost && !this.blinkSide) this.drawGhost(ghost);
    this.prepare(name);
    const { scene } = this.sides[name];
    scene.add(this.neighbours);
    this.renderer.render(scene, this.view.camera);
    if (marks) this.drawMarks();
  }

  /** The removed part of the surface before, behind all of the map: seen through it, the map's colours would be wrong. */
  drawGhost(ghost) {
    const { model, scene } = this.sides.before;
    this.prepare('before');
    model.patches.visible = false;
    for (const mesh of Object.values(model.extra)) mesh.visible = mesh === ghost;
    this.renderer.render(scene, this.view.camera);
    this.renderer.clearDepth();
  }

  paint(width, height, ratio) {
    if (this.mode === 'dissolve' && !this.blinkSide) this.drawDissolved(width, height, ratio);
    else for (const [name, left, share] of this.pictures()) this.drawPart(name, left * width, share * width, height);
  }

  drawDissolved(width, height, ratio) {
    this.view.setAspect(width / height);
    const draws = ['before', 'after'].map((name) => () => this.drawSide(name, false));
    this.dissolve.render(this.renderer, width * ratio, height * ratio, draws, this.share);
    this.drawMarks();
  }

  drawPart(name, left, width, height) {
    this.view.setAspect(width / height);
    this.renderer.setViewport(left, 0, width, height);
    this.renderer.setScissor(left, 0, width, height);
    this.renderer.setScissorTest(true);
    this.drawSide(name);
  }

  /**
   * The surface under a point of the view.
   * @param {number} x @param {number} y in shares of the view, from its upper left corner
   * @returns {number[] | null} [mm]
   */
  pick(x, y) {
    const [name, left, width] = this.pictures().find(([, from, share]) => x >= from && x <= from + share) ?? this.pictures()[0];
    const model = this.sides[name].model;
    if (!model) return null;
    const caster = this.ray((x - left) / width, y, (width * this.canvas.clientWidth) / this.canvas.clientHeight);
    const visible = model.patches.visible;
    model.patches.visible = true;
    const hit = caster.intersectObject(model.patches, false)[0];
    model.patches.visible = visible;
    return hit ? hit.point.toArray() : null;
  }
}
