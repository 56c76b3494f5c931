/** Marks in the 3D view: pins and distances of the reviewer, places of warnings, names of the openings. */
import { BufferAttribute, BufferGeometry, CanvasTexture, Line, LineBasicMaterial, SRGBColorSpace, Sprite, SpriteMaterial } from 'three';
import { plain } from './text.js';

const HEIGHT = 22;   // of a mark [CSS pixels]
const SHARP = 2;     // texture pixels a CSS pixel

function label(text, { ground, ink, round, order = 2 }) {
  const canvas = document.createElement('canvas');
  const context = canvas.getContext('2d');
  const font = `600 ${13 * SHARP}px system-ui, sans-serif`;
  context.font = font;
  const width = Math.ceil(context.measureText(text).width) + 14 * SHARP;  // before the sizes: setting one resets the font
  canvas.height = HEIGHT * SHARP;
  canvas.width = Math.max(canvas.height, width);
  context.font = font;
  context.fillStyle = ground;
  context.strokeStyle = ink;
  context.lineWidth = 1.5 * SHARP;
  context.beginPath();
  context.roundRect(SHARP, SHARP, canvas.width - 2 * SHARP, canvas.height - 2 * SHARP, round ? 11 * SHARP : 4 * SHARP);
  context.fill();
  context.stroke();
  context.fillStyle = ink;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillText(text, canvas.width / 2, canvas.height / 2 + SHARP);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  const sprite = new Sprite(new SpriteMaterial({ map: texture, depthTest: false, transparent: true }));
  sprite.userData.width = canvas.width / SHARP;
  sprite.renderOrder = order;
  return sprite;
}

const PIN = { ground: '#ffe45c', ink: '#1a1a1a', round: true };
const LENGTH = { ground: '#ffffff', ink: '#1a1a1a', round: false, order: 3 };  // over its own ends
const WARNING = { ground: '#7a1f00', ink: '#ffffff', round: false };
const NAME = { ground: '#20303c', ink: '#ffffff', round: false };

export class Marks {
  constructor(stage) {
    this.stage = stage;
    stage.onframe = (perPixel) => this.size(perPixel);
  }

  /** Sprites keep their size on the screen whatever the zoom. */
  size(perPixel) {
    for (const child of this.stage.marks.children)
      if (child.isSprite) child.scale.set(child.userData.width * perPixel, HEIGHT * perPixel, 1);
  }

  clear() {
    for (const child of [...this.stage.marks.children]) {
      this.stage.marks.remove(child);
      child.geometry?.dispose();
      child.material.map?.dispose();
      child.material.dispose();
    }
  }

  put(text, place, style, centre = [0.5, 0.5]) {
    const sprite = label(text, style);
    sprite.position.set(...place);
    sprite.center.set(...centre);
    this.stage.marks.add(sprite);
  }

  line(from, to) {
    const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(Float32Array.from([...from, ...to]), 3));
    const line = new Line(geometry, new LineBasicMaterial({ color: 0xffe45c, depthTest: false }));
    line.renderOrder = 1;
    this.stage.marks.add(line);
    for (const end of [from, to]) this.put('', end, { ...PIN });
  }

  /**
   * @param {object} entry the reviewer's verdict on the edit
   * @param {object} edit
   * @param {{place: number[], name: string}[]} openings
   * @param {number[] | null} start of a distance that waits for its end
   */
  show(entry, edit, openings, start) {
    this.clear();
    for (const { place, name } of openings) this.put(plain(name, 24), place, NAME, [0.5, -0.5]);
    edit.warnings.forEach(({ place }) => place && this.put('!', place, WARNING));
    entry.distances.forEach(({ from, to, mm }) => {
      this.line(from, to);
      this.put(`${mm.toFixed(2)} mm`, from.map((x, k) => (x + to[k]) / 2), LENGTH, [0.5, -0.3]);
    });
    entry.pins.forEach(({ place }, i) => this.put(String(i + 1), place, PIN));
    if (start) this.put('A', start, PIN);
    this.stage.redraw();
  }
}

/** Places and names of the patches that are not wall: the mean of their corners. */
export function openingsOf(surface) {
  if (!surface) return [];
  return surface.groups.filter(({ patch }) => surface.patches[patch].kind !== 'wall').map(({ patch, start, count }) => {
    const sum = [0, 0, 0];
    for (let i = 3 * start; i < 3 * (start + count); ++i)
      for (let k = 0; k < 3; ++k) sum[k] += surface.points[3 * surface.index[i] + k] / (3 * count);
    return { place: sum, name: surface.patches[patch].name };
  });
}
