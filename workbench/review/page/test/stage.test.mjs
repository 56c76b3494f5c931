import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ModelStage, visibleIndex } from '../src/model_stage.js';

const part = (visible = true) => ({ material: { visible, opacity: 1, transparent: false, depthWrite: true } });

/** A stage without a canvas, which counts what it does. */
const countingStage = () => Object.assign(Object.create(ModelStage.prototype), { cut: 0, drawn: 0, showCuts() { ++this.cut; }, redraw() { ++this.drawn; } });

test('the triangles of visible parts are cut, and no others', () => {
  const surface = { index: Uint32Array.from([0, 1, 2, 1, 2, 3, 4, 5, 6, 7, 8, 9]), groups: [{ patch: 0, start: 0, count: 2 }, { patch: 2, start: 2, count: 1 }, { patch: 3, start: 3, count: 1 }] };
  const visible = (...shown) => [...visibleIndex(surface, shown.map(part))];
  assert.deepEqual(visible(true, true, true), [...surface.index]);
  assert.deepEqual(visible(false, true, false), [4, 5, 6]);
  assert.deepEqual(visible(true, false, true), [0, 1, 2, 1, 2, 3, 7, 8, 9]);
  assert.deepEqual(visible(false, false, false), []);
});

test('a slider of transparency redraws without a new cut; switching a part cuts', () => {
  const stage = countingStage();
  const wall = part();
  for (const transparency of [0.1, 0.2, 0.3]) stage.setPart(wall, { shown: true, transparency });
  assert.deepEqual([stage.cut, stage.drawn, wall.material.opacity, wall.material.transparent], [0, 3, 0.7, true]);
  stage.setPart(wall, { shown: false, transparency: 0.3 });
  stage.setPart(wall, { shown: true, transparency: 0.3 });
  assert.equal(stage.cut, 2);
});
