/** Slices through the place of an edit: both contours, over the image where the page has it, with a scale bar. */
import { cutSurface, ORTHOGONAL } from './contours.js';
import { barLength } from './scale_bar.js';
import { fill, make } from './text.js';

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Whether two planes show the same rows and columns, in the same directions. */
const parallel = (a, b) => dot(a.u, b.u) + dot(a.v, b.v) > 1.99;

/** The planes to show: those of the page's image slices first, completed by orthogonal ones to three. */
function planesOf(edit, place) {
  const own = edit.slices.map((image) => {
    const { name, letters } = ORTHOGONAL.find((plane) => parallel(plane, image)) ?? { name: 'Oblique' };
    return { title: `${name}, image`, origin: place, u: image.u, v: image.v, image, letters };
  });
  // An image slice is shown where it was taken: the place is moved into its plane.
  for (const plane of own) {
    const d = plane.origin.map((x, k) => x - plane.image.origin[k]);
    const [s, t] = [dot(d, plane.u), dot(d, plane.v)];
    plane.origin = plane.image.origin.map((x, k) => x + s * plane.u[k] + t * plane.v[k]);
  }
  const rest = ORTHOGONAL.map((plane) => ({ title: plane.name, origin: place, ...plane })).filter((plane) => !own.some((one) => parallel(one, plane)));
  return [...own, ...rest].slice(0, 3);
}

function drawImage(context, plane, pixels, scale) {
  const { width, height, spacing, origin, u, v } = plane.image;
  const canvas = make('canvas', { width, height });
  const data = new ImageData(width, height);
  for (let i = 0; i < pixels.length; ++i) data.data.set([pixels[i], pixels[i], pixels[i], 255], 4 * i);
  canvas.getContext('2d').putImageData(data, 0, 0);
  const d = origin.map((x, k) => x - plane.origin[k]);
  context.drawImage(canvas, (dot(d, u) - spacing[0] / 2) * scale, (dot(d, v) - spacing[1] / 2) * scale, width * spacing[0] * scale, height * spacing[1] * scale);
}

function drawLines(context, lines, scale, { colour, dash, width }) {
  const trace = () => {
    context.beginPath();
    for (const line of lines)
      for (let i = 0; i < line.length; i += 2) context[i ? 'lineTo' : 'moveTo'](line[i] * scale, line[i + 1] * scale);
    context.stroke();
  };
  context.setLineDash(dash);
  context.strokeStyle = colour;
  context.lineWidth = width;
  trace();
}

function drawBar(context, size, scale, ink) {
  const mm = barLength(1 / scale, size * 0.4);
  const [x, y, length] = [10, size - 12, mm * scale];
  context.setLineDash([]);
  context.strokeStyle = ink;
  context.fillStyle = ink;
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(x, y - 4);
  context.lineTo(x, y);
  context.lineTo(x + length, y);
  context.lineTo(x + length, y - 4);
  context.stroke();
  context.textAlign = 'left';
  context.textBaseline = 'bottom';
  context.fillText(`${mm} mm`, x, y - 5);
}

/** Left, right, top and bottom of the patient; only where the coordinates are an image's. */
function drawLetters(context, letters, size) {
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  const [left, right, top, bottom] = letters;
  [[left, 9, size / 2], [right, size - 9, size / 2], [top, size / 2, 10], [bottom, size / 2, size - 10]]
    .forEach(([letter, x, y]) => context.fillText(letter, x, y));
}

export class Slices {
  /**
   * @param {HTMLElement} element @param pool
   * @param {{patient: boolean, before?: string, after?: string}} options patient: the coordinates are an image's; what the contours are, for readers of the screen
   */
  constructor(element, pool, { patient, before = 'dashed before', after = 'solid after' }) {
    Object.assign(this, { element, pool, patient, contours: { before, after }, figures: [] });
    new ResizeObserver(() => this.draw()).observe(element);
  }

  /** @param {number[]} place @param {number} reach half of what a slice shows [mm] */
  show(edit, before, after, place, reach) {
    this.figures = planesOf(edit, place).map((plane) => ({ plane, offset: 0, before, after, reach, pixels: null }));
    fill(this.element, ...this.figures.map((figure) => this.makeFigure(figure)));
    this.draw();
    for (const one of this.figures.filter(({ plane }) => plane.image))
      this.pool.slice(one.plane.image).then((pixels) => { one.pixels = pixels; this.drawFigure(one); },
                                            (error) => { one.caption.append(make('strong', {}, ` ${error.message}`)); });
  }

  makeFigure(one) {
    one.canvas = make('canvas', { role: 'img' });
    one.caption = make('figcaption');
    const parts = [one.canvas, one.caption];
    if (!one.plane.image) {
      const step = one.reach / 50;
      one.range = make('input', { type: 'range', min: -one.reach, max: one.reach, step, 'aria-label': `Move the ${one.plane.title.toLowerCase()} slice`,
        oninput: () => { one.offset = Number(one.range.value); this.drawFigure(one); } });
      one.range.value = '0';
      parts.push(one.range);
    }
    return make('figure', {}, ...parts);
  }

  draw() { this.figures.forEach((one) => this.drawFigure(one)); }

  drawFigure(one) {
    const size = Math.floor(one.canvas.clientWidth);
    if (!size) return;
    const ratio = window.devicePixelRatio || 1;
    one.canvas.width = one.canvas.height = size * ratio;
    const context = one.canvas.getContext('2d');
    const style = getComputedStyle(one.canvas);
    const colour = (name) => style.getPropertyValue(name).trim();
    context.scale(ratio, ratio);
    context.fillStyle = one.pixels ? '#000' : colour('--stage');
    context.fillRect(0, 0, size, size);
    const scale = size / (2 * one.reach);
    const plane = { ...one.plane, origin: one.plane.axis === undefined ? one.plane.origin
      : one.plane.origin.map((x, k) => x + (k === one.plane.axis ? one.offset : 0)) };
    context.save();
    context.translate(size / 2, size / 2);
    if (one.pixels) drawImage(context, plane, one.pixels, scale);
    const cut = (surface) => (surface ? cutSurface(surface, plane) : []);
    const over = Boolean(one.pixels);
    drawLines(context, cut(one.after), scale, { colour: over ? '#6cc4ff' : colour('--after'), dash: [], width: 1.6 });
    drawLines(context, cut(one.before), scale, { colour: over ? '#ffb25c' : colour('--before'), dash: [5, 4], width: 1.8 });
    context.restore();
    context.font = '12px system-ui, sans-serif';
    const ink = over ? '#fff' : colour('--ink');
    drawBar(context, size, scale, ink);
    if (this.patient && plane.letters) drawLetters(context, plane.letters, size);
    this.describe(one, plane);
  }

  describe(one, plane) {
    const at = plane.axis === undefined ? '' : `, ${'xyz'[plane.axis]} = ${(Math.round(10 * plane.origin[plane.axis]) / 10 + 0).toFixed(1)} mm`;
    fill(one.caption, `${plane.title}${at}`);
    const shown = [one.before && this.contours.before, one.after && this.contours.after].filter(Boolean).join(', ');
    one.canvas.setAttribute('aria-label', `${plane.title} slice${at}: contours ${shown}`);
  }
}
