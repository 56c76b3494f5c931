// What every page must hold, whatever it shows; both functions run in the page.

/** Runs in the page: visible texts whose contrast is below that of WCAG 2 AA. */
export function weakTexts() {
  const canvas = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
  const rgba = (colour) => { canvas.clearRect(0, 0, 1, 1); canvas.fillStyle = colour; canvas.fillRect(0, 0, 1, 1); return [...canvas.getImageData(0, 0, 1, 1).data]; };
  const light = ([r, g, b]) => [r, g, b].map((x) => x / 255).map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4)).reduce((sum, x, i) => sum + x * [0.2126, 0.7152, 0.0722][i], 0);
  const ground = (element) => { for (let e = element; e; e = e.parentElement) { const c = rgba(getComputedStyle(e).backgroundColor); if (c[3] > 250) return c; } return [255, 255, 255, 255]; };
  const weak = [];
  for (const element of document.querySelectorAll('body *')) {
    const own = [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
    if (!own || !element.checkVisibility() || element.closest('button:disabled, script, style')) continue;
    const style = getComputedStyle(element);
    const [a, b] = [light(rgba(style.color)), light(ground(element))].sort((x, y) => y - x);
    const ratio = (a + 0.05) / (b + 0.05);
    const size = parseFloat(style.fontSize);
    if (ratio < (size >= 24 || (size >= 18.6 && style.fontWeight >= 700) ? 3 : 4.5)) weak.push(`${element.tagName}.${element.className} “${element.textContent.slice(0, 30)}” ${ratio.toFixed(2)}`);
  }
  return weak;
}

/** Runs in the page: controls without a name, doubled ids, labels that point nowhere, pictures without text. */
export function faults() {
  const named = (e) => e.getAttribute('aria-label')?.trim() || e.innerText?.trim() || e.labels?.length || (e.getAttribute('aria-labelledby') && document.getElementById(e.getAttribute('aria-labelledby')));
  const out = [...document.querySelectorAll('button, input, select, textarea, summary, a, dialog, [role=toolbar], [role=group], [role=img]:not([hidden])')]
    .filter((e) => (e.checkVisibility() || e.localName === 'dialog') && !named(e)).map((e) => `no name: ${e.outerHTML.slice(0, 90)}`);
  const ids = [...document.querySelectorAll('[id]')].map((e) => e.id);
  out.push(...ids.filter((id, i) => ids.indexOf(id) !== i).map((id) => `id twice: ${id}`));
  out.push(...[...document.querySelectorAll('label[for]')].filter((e) => !document.getElementById(e.htmlFor)).map((e) => `label of nothing: ${e.htmlFor}`));
  out.push(...[...document.querySelectorAll('img:not([alt])')].map((e) => `picture without text: ${e.outerHTML.slice(0, 60)}`));
  if (!document.documentElement.lang || !document.querySelector('main') || !document.querySelector('h1')) out.push('no language, main or heading');
  return out;
}
