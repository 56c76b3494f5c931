/** The table of commands that keys reach. */
import { askOverall } from './dialogs.js';
import { saveVerdicts } from './files.js';
import { MODES } from './scene.js';

const onCanvas = () => document.activeElement?.id === 'canvas';
const MODE_HELP = ['view: after', 'view: before', 'view: dissolve', 'view: side by side with one camera', 'view: deviation map', 'view: slices'];

/** @returns {{keys: string[], help: string, run: Function}[]} */
export function makeCommands({ list, work, panel, verdicts, say, help }) {
  const step = (by) => { if (!list.step(by)) say(by > 0 ? 'This was the last one.' : 'This is the first one.'); };
  const view = (run) => { if (work.stage) run(work.stage.view); };
  const arrow = (right, up, by) => (onCanvas() ? view((one) => one.turn(right, up)) : step(by));
  return [
    { keys: ['j'], help: 'next', run: () => step(1) },
    { keys: ['k'], help: 'previous', run: () => step(-1) },
    { keys: ['ArrowDown', 'ArrowRight'], shown: ['↓', '→'], help: 'next; in the 3D view: turn', run: ({ key }) => (key === 'ArrowDown' ? arrow(0, 1, 1) : arrow(1, 0, 1)) },
    { keys: ['ArrowUp', 'ArrowLeft'], shown: ['↑', '←'], help: 'previous; in the 3D view: turn', run: ({ key }) => (key === 'ArrowUp' ? arrow(0, -1, -1) : arrow(-1, 0, -1)) },
    { keys: ['a'], help: 'accept', run: () => panel.decide('accept', true) },
    { keys: ['r'], help: 'reject (needs a reason)', run: () => panel.decide('reject', true) },
    { keys: ['u'], help: 'unsure', run: () => panel.decide('unsure', true) },
    { keys: ['c'], help: 'comment', run: () => panel.comment.focus() },
    { keys: ['b'], help: 'blink between before and after', run: () => work.blink() },
    ...MODES.map((mode, i) => ({ keys: [String(i + 1)], help: MODE_HELP[i], run: () => { if (!work.modeButtons[i].disabled) work.setMode(mode); else say('Not available for this edit.'); } })),
    { keys: ['p'], help: 'pin: under the cross with Enter, or by a click', run: () => work.arm('pin') },
    { keys: ['d'], help: 'distance: start and end with Enter, or by clicks', run: () => work.arm('distance') },
    { keys: ['Enter'], help: 'place the pin or an end of the distance', run: () => { if (work.tool) work.place(0.5, 0.5); } },
    { keys: ['Escape'], help: 'end the tool, leave a field', run: () => { work.disarm(); work.stopBlinking(true); } },
    { keys: ['Shift+ArrowLeft', 'Shift+ArrowRight', 'Shift+ArrowUp', 'Shift+ArrowDown'], shown: ['Shift + arrows'], help: 'turn the model from anywhere',
      run: ({ key }) => view((one) => one.turn((key === 'ArrowRight') - (key === 'ArrowLeft'), (key === 'ArrowDown') - (key === 'ArrowUp'))) },
    { keys: ['+', '='], help: 'zoom in', run: () => view((one) => one.zoom(1.25)) },
    { keys: ['-'], help: 'zoom out', run: () => view((one) => one.zoom(0.8)) },
    { keys: ['f'], help: 'look at the change', run: () => work.look() },
    { keys: ['g'], help: 'look at the whole model', run: () => work.lookWhole() },
    { keys: ['m'], help: 'mark what changed', run: () => work.toggle('mark') },
    { keys: ['l'], help: 'mesh lines', run: () => work.toggle('lines') },
    { keys: ['t'], help: 'list: queue or all edits', run: () => list.change(list.kind === 'queue' ? 'edits' : 'queue') },
    { keys: ['o'], help: 'overall verdict', run: () => askOverall(verdicts) },
    { keys: ['s'], help: 'save the verdicts', run: () => saveVerdicts(verdicts, say) },
    { keys: ['?'], help: 'these keys', run: help },
  ];
}
