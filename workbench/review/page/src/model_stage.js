/** The 3D view of a model: structures of parts that are shown, hidden, seen through and cut by a plane. */
import { BufferGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, Plane, Vector3 } from 'three';
import { css } from './colours.js';
import { cutSurface, ORTHOGONAL } from './contours.js';
import { Drawing, litScene } from './drawing.js';
import { makeModel } from './models.js';

const HIDDEN_SHARE = 0.98;  // so transparent, a part is not hit by clicks

/** Line segments of the cut of a surface with a plane, in space. */
function cutLines(surface, { origin, u, v }) {
  const corners = [];
  for (const line of cutSurface(surface, { origin, u, v }))
    for (let i = 2; i < line.length; i += 2)
      for (const j of [i - 2, i]) for (let k = 0; k < 3; ++k) corners.push(origin[k] + line[j] * u[k] + line[j + 1] * v[k]);
  return corners;
}

/** Corners of a surface's visible triangles. @param {{index, groups}} surface @param parts one a group, in their order */
export function visibleIndex({ index, groups }, parts) {
  const shown = groups.filter((_, i) => parts[i].material.visible);
  const corners = new Uint32Array(3 * shown.reduce((sum, { count }) => sum + count, 0));
  let end = 0;
  for (const { start, count } of shown) {
    corners.set(index.subarray(3 * start, 3 * (start + count)), end);
    end += 3 * count;
  }
  return corners;
}

export class ModelStage extends Drawing {
  constructor(canvas) {
    super(canvas);
    Object.assign(this, litScene());
    this.renderer.localClippingEnabled = true;
    this.structures = [];
    this.cuts = new Group();
    this.scene.add(this.cuts);
    this.clip = { on: false, axis: 0, at: 0, flipped: false };
    this.plane = new Plane();
  }

  /**
   * Adds a structure.
   * @param surface as `makeSurface` returns it @param look as of `makeModel`
   * @returns its parts, one a patch that has triangles: {name, kind, material, look: CSS background of a sample}
   */
  add(surface, look) {
    const model = makeModel(surface, look);
    this.scene.add(model.group);
    const parts = surface.groups.map(({ patch }) => ({ ...surface.patches[patch], material: model.patches.material[patch], look: look.measure && surface.patches[patch].kind === 'wall' ? look.measure.gradient : css(look.colours[patch]) }));
    this.structures.push({ surface, model, parts });
    return parts;
  }

  /** @param part of `add` @param {{shown: boolean, transparency: number}} how transparency in [0, 1] */
  setPart(part, { shown, transparency }) {
    const { material } = part;
    const toggled = material.visible !== shown;
    material.visible = shown;
    material.opacity = 1 - transparency;
    const through = transparency > 0;
    if (material.transparent !== through) { material.transparent = through; material.depthWrite = !through; material.needsUpdate = true; }
    if (toggled) this.showCuts();  // not at each step of a slider: a cut goes through all triangles
    else this.redraw();
  }

  /** Moves the plane that cuts the model away on its side. @param change of `clip`: on, axis 0-2, at [mm], flipped */
  setClip(change) {
    Object.assign(this.clip, change);
    const { on, axis, at, flipped } = this.clip;
    const normal = [0, 0, 0];
    normal[axis] = flipped ? 1 : -1;
    this.plane.set(new Vector3(...normal), flipped ? -at : at);
    for (const { parts } of this.structures) for (const { material } of parts) material.clippingPlanes = on ? [this.plane] : null;
    this.showCuts();
  }

  /** Lines where the plane cuts visible parts: an open shell alone hardly shows its section. */
  showCuts() {
    for (const line of this.cuts.children) { line.geometry.dispose(); line.material.dispose(); }
    this.cuts.clear();
    const { on, axis, at } = this.clip;
    if (on) {
      const { u, v } = ORTHOGONAL.find((plane) => plane.axis === axis);
      const origin = [0, 1, 2].map((k) => (k === axis ? at : 0));
      for (const { surface, parts } of this.structures) {
        const index = visibleIndex(surface, parts);
        if (!index.length) continue;
        const geometry = new BufferGeometry().setAttribute('position', new Float32BufferAttribute(cutLines({ ...surface, index }, { origin, u, v }), 3));
        this.cuts.add(new LineSegments(geometry, new LineBasicMaterial({ color: getComputedStyle(this.canvas).color })));
      }
    }
    this.redraw();
  }

  paint(width, height) {
    this.view.setAspect(width / height);
    this.aimLamp(this.lamp);
    this.renderer.render(this.scene, this.view.camera);
    this.drawMarks();
  }

  /** What is shown under a point of the view, in shares from its upper left corner. @returns {number[] | null} [mm] */
  pick(x, y) {
    const caster = this.ray(x, y, this.canvas.clientWidth / this.canvas.clientHeight);
    const seen = ({ face, object, point }) => {
      const material = object.material[face.materialIndex];
      return material.visible && material.opacity > 1 - HIDDEN_SHARE && !(this.clip.on && this.plane.distanceToPoint(point) < 0);
    };
    const hit = caster.intersectObjects(this.structures.map(({ model }) => model.patches), false).find(seen);
    return hit ? hit.point.toArray() : null;
  }
}
