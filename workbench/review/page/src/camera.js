/** The one camera: parallel projection, so that lengths and the scale bar hold everywhere in the picture. */
import { OrthographicCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

const TURN = Math.PI / 24;  // of an arrow key [rad]
const SHIFT = 0.04;         // of a key, in heights of the picture

export class View {
  /** @param {HTMLElement} element that takes pointer and touch @param {Function} changed called when the camera moved */
  constructor(element, changed) {
    this.camera = new OrthographicCamera();
    this.camera.up.set(0, 0, 1);  // heads are up
    this.controls = new OrbitControls(this.camera, element);
    this.controls.addEventListener('change', changed);
    this.height = 1;
    this.reach = 100;
  }

  /** @param {number} aspect width / height of one picture */
  setAspect(aspect) {
    // A tall, narrow picture shows the framed ball in its width.
    const half = (this.height / 2) * Math.max(1, 1 / aspect);
    Object.assign(this.camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half });
    this.camera.updateProjectionMatrix();
  }

  /**
   * Looks at a ball from a direction.
   * @param {number[]} centre [mm] @param {number} radius [mm] @param {number[] | null} from direction to the viewer; null keeps it
   * @param {{exact?: boolean}} options exact: also from straight above or below, with what `from` has besides as the picture's down or up
   */
  frame(centre, radius, from, { exact = false } = {}) {
    const direction = from ? new Vector3(...from).normalize() : this.camera.position.clone().sub(this.controls.target).normalize();
    if (!exact && Math.abs(direction.z) > 0.98) direction.set(0.15, -0.2, direction.z).normalize();  // never along "up"
    this.height = 2 * radius;
    this.camera.zoom = 1;
    this.controls.target.set(...centre);
    this.camera.position.copy(this.controls.target).addScaledVector(direction, this.reach);
    this.camera.near = 0.01;
    this.camera.far = 2 * this.reach;
    this.controls.update();
  }

  /** Turns around what is looked at, in steps of the keyboard. */
  turn(right, up) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const azimuth = Math.atan2(offset.y, offset.x) + right * TURN;
    const polar = Math.min(Math.PI - 0.05, Math.max(0.05, Math.acos(offset.z / offset.length()) - up * TURN));
    offset.set(Math.sin(polar) * Math.cos(azimuth), Math.sin(polar) * Math.sin(azimuth), Math.cos(polar)).multiplyScalar(this.reach);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
  }

  /** Moves over the picture, in steps of the keyboard. */
  pan(right, up) {
    const step = (SHIFT * (this.camera.top - this.camera.bottom)) / this.camera.zoom;
    this.camera.updateMatrixWorld();
    const along = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0).multiplyScalar(right * step)
      .addScaledVector(new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1), up * step);
    this.controls.target.add(along);
    this.camera.position.add(along);
    this.controls.update();
  }

  zoom(factor) {
    this.camera.zoom = Math.min(200, Math.max(0.05, this.camera.zoom * factor));
    this.camera.updateProjectionMatrix();
    this.controls.update();
  }

  /** Millimetres that a picture of `pixels` shows a pixel. */
  perPixel(pixels) { return (this.camera.top - this.camera.bottom) / this.camera.zoom / pixels; }
}
