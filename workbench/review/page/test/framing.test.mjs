/** Where an edit's first picture looks. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { framing, withContext } from '../src/prepare.js';

/** A model of 40 mm along z, with one vertex at each end. */
const surface = { points: Float32Array.from([0, 0, 0, 0, 0, 40]), normals: Float32Array.from([0, -1, 0, 0, -1, 0]) };
const shown = { before: null, after: surface };
const edit = { place: [0, 0, 38], radius: 0.5, changedBox: null };

test('the first picture of a small change shows what is around it', () => {
  const near = framing(edit, shown), first = withContext(near, shown);
  assert.deepEqual(first.centre, near.centre);
  assert.ok(near.radius < 2);
  assert.equal(first.radius, 8);
});

test('a change that is as large as its surroundings stays as it is', () => {
  const whole = framing({ ...edit, place: null, radius: null }, shown);
  assert.deepEqual(withContext(whole, shown), whole);
});
