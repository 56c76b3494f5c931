/** What the page says: for a moment, or to stay. */

const SAID = 6000;  // a message is seen so long [ms]; readers of the screen hear it at once
let saying = 0;

export function say(text) {
  const element = document.getElementById('say');
  element.textContent = text;
  clearTimeout(saying);
  saying = setTimeout(() => { element.textContent = ''; }, SAID);
}

/** A message that stays. */
export function notice(text) {
  const element = document.getElementById('notice');
  element.hidden = !text;
  element.textContent = text;
}
