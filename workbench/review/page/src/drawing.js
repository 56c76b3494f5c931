/** A canvas with one camera that draws when something changed, its light, and marks over all. */
import { Color, DirectionalLight, HemisphereLight, Raycaster, Scene, Vector2, WebGLRenderer } from 'three';
import { View } from './camera.js';

export function litScene() {
  const scene = new Scene();
  const lamp = new DirectionalLight(0xffffff, 1.9);
  scene.add(new HemisphereLight(0xffffff, 0xb8b8c8, 1.5), lamp, lamp.target);
  return { scene, lamp, model: null };
}

/** Subclasses fill the cleared canvas: `paint(width, height, ratio)` in CSS pixels and device pixels of one. */
export class Drawing {
  /** @param {HTMLCanvasElement} canvas @throws if the browser offers no WebGL 2 */
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.autoClear = false;
    this.view = new View(canvas, () => this.redraw());
    this.marks = new Scene();
    Object.assign(this, { waiting: false, ondraw: () => {}, onframe: () => {} });
    new ResizeObserver(() => this.redraw()).observe(canvas);
  }

  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => { this.waiting = false; this.draw(); });
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
    this.paint(width, height, ratio);
    this.ondraw();
  }

  /** The lamp follows the viewer, from a little above. */
  aimLamp(lamp) {
    lamp.position.copy(this.view.camera.position).add(this.view.camera.up.clone().multiplyScalar(this.view.reach * 0.4));
    lamp.target.position.copy(this.view.controls.target);
  }

  drawMarks() {
    this.onframe(this.view.perPixel(this.canvas.clientHeight));
    this.renderer.render(this.marks, this.view.camera);
  }

  /** The ray into a picture of an aspect, through a point of it in shares from its upper left corner. */
  ray(x, y, aspect) {
    this.view.setAspect(aspect);
    this.view.camera.updateMatrixWorld();  // the camera may have turned since the last frame
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2(2 * x - 1, 1 - 2 * y), this.view.camera);
    return caster;
  }
}

/** A click is a press and a release at one place; a drag turns the model. @param {(x, y) => void} clicked in shares of the canvas */
export function bindClicks(canvas, clicked) {
  let down = null;
  canvas.addEventListener('pointerdown', (event) => { down = [event.clientX, event.clientY]; });
  canvas.addEventListener('pointerup', (event) => {
    if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 5) return;
    const box = canvas.getBoundingClientRect();
    clicked((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
  });
}
