/** The controls of the clipping plane. */
import { make } from './text.js';

const STEPS = 100;  // of the plane from one end of the model to the other
const AXES = ['x', 'y', 'z'];
const SIDES = ['left and right', 'front and back', 'above and below'];

export class ClipPanel {
  /** @param {{box, axis, at, flip, place}} elements @param stage @param {number[]} box of the model [mm] @param {(text) => void} say */
  constructor(elements, stage, box, say) {
    Object.assign(this, { ...elements, stage, bounds: box, say, flipped: false });
    this.axis.append(...AXES.map((name, k) => make('option', { value: k }, `${name}: ${SIDES[k]}`)));
    this.at.max = String(STEPS);
    this.at.value = String(STEPS / 2);
    for (const control of [this.box, this.axis]) control.addEventListener('change', () => this.begin());
    this.at.addEventListener('input', () => this.apply());
    this.flip.addEventListener('click', () => this.turn());
    this.apply();
  }

  /** Cuts the side away that is towards the viewer: what is behind the plane is to be seen. */
  begin() {
    const { camera, controls } = this.stage.view;
    const toViewer = camera.position.clone().sub(controls.target).normalize().getComponent(Number(this.axis.value));
    this.flipped = toViewer < -0.05;
    this.apply();
  }

  apply() {
    const axis = Number(this.axis.value), share = this.at.value / STEPS;
    const mm = this.bounds[axis] + share * (this.bounds[axis + 3] - this.bounds[axis]);
    for (const control of [this.axis, this.at, this.flip]) control.disabled = !this.box.checked;
    this.place.textContent = this.box.checked ? `${AXES[axis]} = ${mm.toFixed(1)} mm` : '';
    this.at.setAttribute('aria-valuetext', `${mm.toFixed(1)} millimetres`);
    this.flip.setAttribute('aria-pressed', String(this.flipped));
    this.stage.setClip({ on: this.box.checked, axis, at: mm, flipped: this.flipped });
  }

  toggle() { this.box.checked = !this.box.checked; this.begin(); this.say(this.box.checked ? `Clipping at ${this.place.textContent}.` : 'Clipping is off.'); }

  turn() { this.flipped = !this.flipped; this.box.checked = true; this.apply(); this.say('The other side is cut away.'); }

  choose(axis) { this.axis.value = String(axis); this.box.checked = true; this.begin(); this.say(`Clipping at ${this.place.textContent}.`); }

  move(steps) {
    if (!this.box.checked) { this.box.checked = true; this.begin(); }
    this.at.value = String(Math.min(STEPS, Math.max(0, Number(this.at.value) + steps)));
    this.apply();
    this.say(`Clipping at ${this.place.textContent}.`);
  }
}
