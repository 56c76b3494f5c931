import assert from 'node:assert/strict';
import { test } from 'node:test';
import { readVerdicts, VerdictError, Verdicts } from '../src/verdicts.js';

const manifest = (changes = {}) => ({ program: '0.2.0', chainHead: 'ab', project: { id: 'p', name: 'Case' },
  edits: [{ id: 1, revision: 1, hash: 'h1', title: 'One' }, { id: 2, revision: 3, hash: 'h2', title: 'Two' }], ...changes });
const make = (changes) => new Verdicts(manifest(changes), () => new Date('2026-03-01T10:00:00Z'));

test('a rejection needs a reason, and is withdrawn without it', () => {
  const verdicts = make();
  assert.equal(verdicts.decide(1, 'reject'), false);
  assert.equal(verdicts.of(1).verdict, 'none');
  verdicts.comment(1, 'Too much removed.');
  assert.equal(verdicts.decide(1, 'reject'), true);
  assert.equal(verdicts.comment(1, ' '), false);
  assert.equal(verdicts.of(1).verdict, 'none');
  assert.equal(verdicts.decideOverall('reject', ''), false);
});

test('the same verdict again withdraws it', () => {
  const verdicts = make();
  verdicts.decide(1, 'accept');
  verdicts.decide(1, 'accept');
  assert.equal(verdicts.of(1).verdict, 'none');
});

test('what is saved binds to edit, revision and hash, and comes back', () => {
  const verdicts = make();
  verdicts.setReviewer(' Dr B ', 'radiologist');
  verdicts.decide(2, 'accept');
  verdicts.addPin(2, [1.00004, 2, 3], 'here');
  verdicts.addDistance(2, [0, 0, 0], [0, 3, 4]);
  verdicts.decideOverall('unsure', 'see pin');
  const file = verdicts.toFile();
  assert.deepEqual(file.edits, [{ edit: 2, revision: 3, hash: 'h2', verdict: 'accept', comment: '', time: '2026-03-01T10:00:00.000Z',
    pins: [{ place: [1, 2, 3], text: 'here' }], distances: [{ from: [0, 0, 0], to: [0, 3, 4], mm: 5, text: '' }] }]);
  assert.deepEqual([file.chain_head, file.reviewer, file.overall.verdict], ['ab', { name: 'Dr B', role: 'radiologist' }, 'unsure']);
  const other = make();
  assert.equal(other.load(JSON.stringify(file)).taken, 1);
  assert.deepEqual(other.toFile(), file);
});

test('another project is refused, newer revisions are left out', () => {
  const verdicts = make();
  verdicts.decide(1, 'accept');
  verdicts.decide(2, 'accept');
  const text = JSON.stringify(verdicts.toFile());
  assert.throws(() => make({ project: { id: 'q', name: '' } }).load(text), /another project/);
  const newer = make({ edits: [{ id: 1, revision: 2, hash: 'h9', title: 'One' }] });
  assert.deepEqual(newer.load(text), { taken: 0, outdated: ['One'], missing: 1 });
});

test('hostile files are refused', () => {
  const good = make().toFile();
  const deep = '['.repeat(200000);
  for (const bad of ['', 'null', '[]', deep, '{"format":"vesselbench-verdicts"}', ' '.repeat(9e6),
    JSON.stringify({ ...good, edits: 3 }), JSON.stringify({ ...good, overall: { verdict: 'maybe', comment: '' } }),
    JSON.stringify({ ...good, edits: [{ edit: 1, revision: 1, hash: 'h1', verdict: 'reject', comment: ' ', time: '', pins: [], distances: [] }] }),
    JSON.stringify({ ...good, edits: [{ edit: 1, revision: 1, hash: 'h1', verdict: 'accept', comment: '', time: '', pins: [{ place: [1, 2], text: '' }], distances: [] }] })])
    assert.throws(() => readVerdicts(bad), VerdictError);
  const extra = readVerdicts(JSON.stringify({ ...good, __proto__x: 1, edits: [{ edit: 1, revision: 1, hash: 'h1', verdict: 'accept', comment: '', time: '', pins: [], distances: [], more: 1 }] }));
  assert.deepEqual(Object.keys(extra), ['project', 'reviewer', 'overall', 'edits']);
  assert.ok(!('more' in extra.edits[0]));
});
