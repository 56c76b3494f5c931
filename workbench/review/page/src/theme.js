/** Light or dark: the system's wish until the reader chooses. */

const dark = () => (document.documentElement.dataset.theme
  ? document.documentElement.dataset.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches);

/** @param {HTMLButtonElement} button that toggles @param {() => void} changed called after each change */
export function bindTheme(button, changed) {
  const mark = () => {
    button.setAttribute('aria-pressed', String(dark()));
    changed();
  };
  button.addEventListener('click', () => {
    document.documentElement.dataset.theme = dark() ? 'light' : 'dark';
    mark();
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', mark);
  mark();
}

export const calm = () => matchMedia('(prefers-reduced-motion: reduce)').matches;
