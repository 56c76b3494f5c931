/** The list of structures: each part with a check box and a slider for its transparency. */
import { foreign, make, plain, words } from './text.js';

const nameOf = (structure, part, single) => (single ? structure.name : part.name);

/** A line of the list. @param {string} look CSS background of its sample @param {(how: {shown, transparency}) => void} changed */
function partLine(name, look, start, changed) {
  const box = make('input', { type: 'checkbox', checked: true });
  const slider = make('input', { type: 'range', min: 0, max: 100, step: 5, 'aria-label': `Transparency of ${plain(words(name), 60)}` });
  const output = make('output', {});
  slider.value = String(100 * start);
  const apply = () => {
    slider.disabled = !box.checked;
    output.textContent = `${slider.value} %`;
    slider.setAttribute('aria-valuetext', `${slider.value} percent`);
    changed({ shown: box.checked, transparency: slider.value / 100 });
  };
  box.addEventListener('change', apply);
  slider.addEventListener('input', apply);
  apply();
  const swatch = make('span', { class: 'swatch', 'aria-hidden': 'true' });
  swatch.style.background = look;
  return { box, apply, element: make('li', {}, make('label', { class: 'check' }, box, swatch, foreign(words(name), { limit: 60, brief: true })), slider, output) };
}

/**
 * Fills the list.
 * @param {HTMLElement} element
 * @param {{structure: {name, kind}, parts: object[]}[]} entries
 * @param {(part, how) => void} set
 */
export function listStructures(element, entries, set) {
  for (const { structure, parts } of entries) {
    const single = parts.length === 1 || structure.kind === 'neighbour';
    const start = structure.kind === 'neighbour' ? 0.6 : 0;
    const lines = (single ? [parts] : parts.map((part) => [part])).map((own) =>
      partLine(nameOf(structure, own[0], single), own[0].look, start, (how) => own.forEach((part) => set(part, how))));
    if (single) { element.append(...lines.map((line) => line.element)); continue; }
    element.append(make('li', { class: 'group' }, groupBox(structure, lines), make('ul', {}, ...lines.map((line) => line.element))));
  }
}

/** Shows or hides all parts of a structure. */
function groupBox(structure, lines) {
  const box = make('input', { type: 'checkbox', checked: true });
  const refresh = () => {
    const shown = lines.filter((line) => line.box.checked).length;
    box.checked = shown > 0;
    box.indeterminate = shown > 0 && shown < lines.length;
  };
  box.addEventListener('change', () => { for (const line of lines) { line.box.checked = box.checked; line.apply(); } });
  for (const line of lines) line.box.addEventListener('change', refresh);
  return make('label', { class: 'check' }, box, make('strong', {}, foreign(words(structure.name), { limit: 60, brief: true })));
}
