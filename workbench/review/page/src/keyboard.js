/** Keys to commands. One table serves the keys, their help and the tests. */

const EDITABLE = 'input:not([type=range]):not([type=checkbox]):not([type=radio]), textarea, select';

/**
 * Binds the commands' keys to the document.
 * @param {{keys: string[], help: string, run: (event) => void, when?: () => boolean}[]} commands when: the key is the command's only then
 * @param {() => boolean} enabled whether single keys are on
 */
export function bindKeys(commands, enabled) {
  const byKey = new Map(commands.flatMap((command) => command.keys.map((key) => [key, command])));
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector('dialog[open]')) return;
    const { target } = event;
    if (target.matches(EDITABLE)) {
      if (event.key === 'Escape') target.blur();
      return;
    }
    const name = (event.shiftKey && event.key.startsWith('Arrow') ? 'Shift+' : '') + event.key;
    // A range, a disclosure or a button keeps the keys that are its own.
    if (target.matches('input[type=range]') && event.key.startsWith('Arrow')) return;
    if (event.key === 'Enter' && target.matches('button, summary, a, input')) return;
    const command = byKey.get(name);
    if (!command || command.when?.() === false || (event.key.length === 1 && event.key !== '?' && !enabled())) return;
    event.preventDefault();
    command.run(event);
  });
}
