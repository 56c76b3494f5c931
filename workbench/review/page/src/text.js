/** Texts of the project, shown as text: never as markup, never able to reorder or hide what stands beside them. */

const SHORT = 300;  // characters shown at once; a longer text is one button away
// Controls, marks of direction, zero-width characters, line separators: shown by their code point.
const UNSEEN = /[\u0000-\u0008\u000b-\u001f\u007f-\u009f\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufff9-\ufffb]/g;

const codePoint = (c) => `⟨U+${c.codePointAt(0).toString(16).toUpperCase().padStart(4, '0')}⟩`;

/** A text with its invisible characters made visible. */
export const visible = (text) => String(text).replace(UNSEEN, codePoint);

/** Shortens a text to `limit` characters. */
export const shortened = (text, limit) => (text.length > limit ? `${text.slice(0, limit - 1)}…` : text);

/** A visible, shortened text for places that hold plain characters only (canvas, file names, labels). */
export const plain = (text, limit = 40) => shortened(visible(String(text).slice(0, 4 * limit)), limit);

/**
 * Makes an element. `children` are elements or own, trusted words; attributes are set, never parsed.
 * @param {string} tag
 * @param {object} properties e.g. {class: 'x', 'aria-label': 'y', onclick: f}
 */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (typeof value === 'function') element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined && child !== ''));
  return element;
}

/** A foreign text as an isolated element. Long ones are cut, with a button for the rest unless `brief`. */
export function foreign(text, { limit = SHORT, brief = false } = {}) {
  const whole = String(text ?? '');
  const shown = make('bdi', { dir: 'auto', class: 'foreign' });
  shown.textContent = shortened(visible(whole.slice(0, limit + 1)), limit);
  if (whole.length <= limit || brief) return shown;
  const more = make('button', { type: 'button', class: 'more', 'aria-expanded': 'false' },
                    `Show all ${whole.length.toLocaleString('en')} characters`);
  more.addEventListener('click', () => {
    const open = more.getAttribute('aria-expanded') === 'false';
    more.setAttribute('aria-expanded', String(open));
    more.textContent = open ? 'Show less' : `Show all ${whole.length.toLocaleString('en')} characters`;
    shown.textContent = open ? visible(whole) : shortened(visible(whole.slice(0, limit + 1)), limit);
  });
  return make('span', { class: 'long' }, shown, ' ', more);
}

/** Replaces an element's content. */
export function fill(element, ...children) {
  element.replaceChildren(...children.filter((child) => child !== null && child !== undefined && child !== ''));
  return element;
}

/** A number with at most `digits` figures that matter. */
export function figure(value, digits = 4) {
  if (!Number.isFinite(value)) return '–';
  if (Number.isInteger(value)) return value.toLocaleString('en').replaceAll(',', '\u202f');
  return String(Number(value.toPrecision(digits)));
}

/** Texts of a scale's values, with as many decimals as tell them apart. @param {number[]} values evenly spaced */
export function tickTexts(values) {
  const step = Math.abs(values[1] - values[0]) || 1;
  const decimals = Math.min(8, Math.max(0, 1 - Math.floor(Math.log10(step))));
  return values.map((value) => minus(value.toFixed(decimals)));
}

/** A number's text with the sign U+2212; zero has none. */
export const minus = (text) => text.replace('-', Number(text) === 0 ? '' : '\u2212');

/** Value and unit of an argument or figure in plain words. */
export function inWords({ value, unit }) {
  const one = (x) => (typeof x === 'number' ? figure(x) : typeof x === 'boolean' ? (x ? 'yes' : 'no') : String(x ?? '–'));
  const text = Array.isArray(value)
    ? value.every((x) => typeof x === 'number') ? `(${value.map(one).join(', ')})` : JSON.stringify(value)
    : value && typeof value === 'object' ? JSON.stringify(value) : one(value);
  return unit ? `${text}\u00a0${unit}` : text;
}

/** A stored name as words: target_radius reads "target radius". */
export const words = (name) => String(name).replaceAll('_', ' ');

/** An ISO time, shorter; any other text as it is. */
export function moment(text) {
  const match = /^(\d{4}-\d\d-\d\d)T(\d\d:\d\d)/.exec(text);
  return match ? `${match[1]} ${match[2]}${text.endsWith('Z') ? ' UTC' : ''}` : text;
}
