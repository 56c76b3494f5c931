/** The keys of the page that shows a model. */

/** Directions to the viewer, in coordinates that grow to the left, the back and the head (LPS); from above and below, the front is at the top. */
export const VIEWS = [
  { name: 'Front', from: [0, -1, 0], across: 0, up: 2 }, { name: 'Back', from: [0, 1, 0], across: 0, up: 2 },
  { name: 'Left', from: [1, 0, 0], across: 1, up: 2 }, { name: 'Right', from: [-1, 0, 0], across: 1, up: 2 },
  { name: 'Top', from: [0, 0.001, 1], across: 0, up: 1 }, { name: 'Bottom', from: [0, -0.001, -1], across: 0, up: 1 }];

const onCanvas = () => document.activeElement?.id === 'canvas';

/** @returns {{keys: string[], help: string, run: Function}[]} */
export function makeViewerCommands(viewer, help) {
  const { stage, clip, lengths } = viewer;
  const turn = ({ key }) => stage.view.turn((key === 'ArrowRight') - (key === 'ArrowLeft'), (key === 'ArrowDown') - (key === 'ArrowUp'));
  return [
    ...VIEWS.map((view, i) => ({ keys: [String(i + 1)], help: `view: ${view.name.toLowerCase()}`, run: () => viewer.look(view) })),
    { keys: ['g'], help: 'look at the whole model', run: () => viewer.look({}) },
    { keys: ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown'], shown: ['arrows'], help: 'in the 3D view: turn', when: onCanvas, run: turn },
    { keys: ['Shift+ArrowLeft', 'Shift+ArrowRight', 'Shift+ArrowUp', 'Shift+ArrowDown'], shown: ['Shift + arrows'], help: 'turn the model from anywhere', run: turn },
    { keys: ['h', 'j', 'k', 'l'], help: 'look further left, down, up, right', run: ({ key }) => stage.view.pan((key === 'l') - (key === 'h'), (key === 'k') - (key === 'j')) },
    { keys: ['+', '='], help: 'zoom in', run: () => stage.view.zoom(1.25) },
    { keys: ['-'], help: 'zoom out', run: () => stage.view.zoom(0.8) },
    { keys: ['c'], help: 'clipping plane on or off', run: () => clip.toggle() },
    { keys: ['x', 'y', 'z'], help: 'clip across this axis', run: ({ key }) => clip.choose('xyz'.indexOf(key)) },
    { keys: [',', '.'], help: 'move the clipping plane', run: ({ key }) => clip.move(key === ',' ? -2 : 2) },
    { keys: ['v'], help: 'cut the other side away', run: () => clip.turn() },
    { keys: ['n'], help: 'names on or off', run: () => viewer.toggleNames() },
    { keys: ['d'], help: 'distance: start and end with Enter, or by clicks', run: () => lengths.arm() },
    { keys: ['Enter'], help: 'place an end of the distance under the cross', when: () => lengths.armed, run: () => lengths.place(stage.pick(0.5, 0.5)) },
    { keys: ['Escape'], help: 'end the tool, leave a field', run: () => lengths.disarm() },
    { keys: ['?'], help: 'these keys', run: help },
  ];
}
