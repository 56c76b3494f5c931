/** The 3D view: the states before and after an edit with one camera, in the ways to compare them. */
import { Color, DirectionalLight, Group, HemisphereLight, Raycaster, Scene, Vector2, WebGLRenderer } from 'three';
import { View } from './camera.js';
import { AFTER, BEFORE, GHOST } from './colours.js';
import { Dissolve } from './dissolve.js';
import { makeModel, makeNeighbour } from './models.js';

/** Ways to look, in the order of the keys 1 to 6; `slices` is drawn elsewhere. */
export const MODES = ['after', 'before', 'dissolve', 'side', 'deviation', 'slices'];

function litScene() {
  const scene = new Scene();
  const lamp = new DirectionalLight(0xffffff, 1.9);
  scene.add(new HemisphereLight(0xffffff, 0xb8b8c8, 1.5), lamp, lamp.target);
  return { scene, lamp, model: null };
}

export class Stage {
  /** @param {HTMLCanvasElement} canvas @throws if the browser offers no WebGL 2 */
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.autoClear = false;
    this.view = new View(canvas, () => this.redraw());
    this.sides = { before: litScene(), after: litScene() };
    this.marks = new Scene();
    this.neighbours = new Group();
    this.dissolve = new Dissolve();
    Object.assign(this, { mode: 'after', share: 0.5, blinkSide: null, lines: false, mark: true, waiting: false, ondraw: () => {}, onframe: () => {} });
    new ResizeObserver(() => this.redraw()).observe(canvas);
  }

  /**
   * Shows the surfaces of an edit.
   * @param {object | null} before @param {object | null} after
   * @param {{added, removed, deviation, max}} difference corners only in one of them; deviations [mm] of the one after
   */
  show(before, after, difference) {
    this.setSurface('before', before);
    this.setSurface('after', after);
    const [old, now] = [this.sides.before.model, this.sides.after.model];
    if (old && difference.removed.length) old.addMarked(difference.removed, BEFORE);
    if (now && difference.added.length) now.addMarked(difference.added, AFTER);
    // Where all of the surface moved a little, a ghost of the old one would only dim the map.
    if (old && now && difference.removed.length && difference.removed.length < before.index.length / 2) old.addGhost(difference.removed, GHOST);
    if (now && difference.deviation) now.addDeviation(difference.deviation, difference.max);
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

  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => { this.waiting = false; this.draw(); });
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
    lamp.position.copy(this.view.camera.position).add(this.view.camera.up.clone().multiplyScalar(this.view.reach * 0.4));
    lamp.target.position.copy(this.view.controls.target);
    if (!model) return;
    const map = this.mode === 'deviation' && !this.blinkSide && model.extra.deviation;
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
    if (!marks) return;
    this.onframe(this.view.perPixel(this.canvas.clientHeight));
    this.renderer.render(this.marks, this.view.camera);
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

  draw() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height, false);
    }
    const colour = getComputedStyle(this.canvas).getPropertyValue('--stage').trim();
    this.renderer.setClearColor(new Color(colour || '#ffffff'));
    this.renderer.setScissorTest(false);
    this.renderer.setViewport(0, 0, width, height);
    this.renderer.clear();
    if (this.mode === 'dissolve' && !this.blinkSide) this.drawDissolved(width, height, ratio);
    else for (const [name, left, share] of this.pictures()) this.drawPart(name, left * width, share * width, height);
    this.ondraw();
  }

  drawDissolved(width, height, ratio) {
    this.view.setAspect(width / height);
    const draws = ['before', 'after'].map((name) => () => this.drawSide(name, false));
    this.dissolve.render(this.renderer, width * ratio, height * ratio, draws, this.share);
    this.onframe(this.view.perPixel(height));
    this.renderer.render(this.marks, this.view.camera);
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
    this.view.setAspect((width * this.canvas.clientWidth) / this.canvas.clientHeight);
    this.view.camera.updateMatrixWorld();  // the camera may have turned since the last frame
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2(((x - left) / width) * 2 - 1, 1 - 2 * y), this.view.camera);
    const visible = model.patches.visible;
    model.patches.visible = true;
    const hit = caster.intersectObject(model.patches, false)[0];
    model.patches.visible = visible;
    return hit ? hit.point.toArray() : null;
  }
}
