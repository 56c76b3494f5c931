/** The page's dialogs: keys, who reviews, overall verdict. */
import { fill, make } from './text.js';

const byId = (id) => document.getElementById(id);

/** Shows the table of keys. */
export function showHelp(commands) {
  const rows = commands.map(({ keys, shown = keys, help }) => make('tr', {}, make('th', { scope: 'row' }, ...shown.flatMap((key, i) => [i ? ' ' : '', make('kbd', {}, key)])), make('td', {}, help)));
  fill(byId('help-body'), make('table', {}, make('tbody', {}, ...rows)));
  byId('help').showModal();
}

/** Opens a dialog and waits for its end. @returns {Promise<string>} value of the button */
function ask(dialog) {
  dialog.returnValue = '';
  dialog.showModal();
  return new Promise((resolve) => dialog.addEventListener('close', () => resolve(dialog.returnValue), { once: true }));
}

/** Asks for the reviewer unless known. @returns {Promise<boolean>} whether there is a name now */
export async function askReviewer(verdicts) {
  if (verdicts.reviewer.name) return true;
  byId('who-role').value = verdicts.reviewer.role;
  if (await ask(byId('who')) === 'ok') verdicts.setReviewer(byId('who-name').value, byId('who-role').value);
  return Boolean(verdicts.reviewer.name);
}

/** Asks for the overall verdict. @returns {Promise<boolean>} whether one was kept */
export async function askOverall(verdicts) {
  const counts = verdicts.counts();
  fill(byId('overall-counts'), `${counts.accept} accepted, ${counts.reject} rejected, ${counts.unsure} unsure, ${counts.none} open.`);
  byId('overall-problem').textContent = '';
  byId('overall-comment').value = verdicts.overall.comment;
  const current = document.querySelector(`input[name=overall][value=${verdicts.overall.verdict}]`);
  current.checked = true;
  let warned = false;
  const chosen = () => document.querySelector('input[name=overall]:checked').value;
  byId('overall-ok').onclick = (event) => {
    const unreasoned = chosen() === 'reject' && !byId('overall-comment').value.trim();
    const contradicts = chosen() === 'accept' && counts.reject + counts.none > 0 && !warned;
    if (!unreasoned && !contradicts) return;
    event.preventDefault();
    if (unreasoned) byId('overall-comment').focus();
    byId('overall-problem').textContent = unreasoned ? 'A rejection needs a reason.'
      : `${counts.reject} rejected and ${counts.none} open: press again to accept the whole all the same.`;
    warned = contradicts;
  };
  const answer = ask(byId('overall'));
  current.focus();
  if (await answer !== 'ok') return false;
  return verdicts.decideOverall(chosen(), byId('overall-comment').value);
}
