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
  assert.deepEqual(file.edits.slice(1), [{ edit: 2, revision: 3, hash: 'h2', verdict: 'accept', comment: '', time: '2026-03-01T10:00:00.000Z',
    pins: [{ place: [1, 2, 3], text: 'here' }], distances: [{ from: [0, 0, 0], to: [0, 3, 4], mm: 5, text: '' }] }]);
  assert.deepEqual([file.chain_head, file.reviewer, file.overall.verdict], ['ab', { name: 'Dr B', role: 'radiologist' }, 'unsure']);
  const other = make();
  assert.equal(other.load(JSON.stringify(file)).taken, 1);
  assert.deepEqual(other.toFile(), file);
});

test('an overall verdict lists every edit as it was seen; none is judged by that', () => {
  const verdicts = make();
  verdicts.decide(2, 'accept');
  assert.deepEqual(verdicts.toFile().edits.map((entry) => entry.edit), [2]);
  verdicts.decideOverall('accept', '');
  const file = verdicts.toFile();
  assert.deepEqual(file.edits[0], { edit: 1, revision: 1, hash: 'h1', verdict: 'none', comment: '', time: file.written, pins: [], distances: [] });
  assert.equal(file.edits.length, 2);
  const other = make();
  assert.deepEqual(other.load(JSON.stringify(file)), { taken: 1, outdated: [], missing: 0, overallOutdated: false });
  assert.deepEqual([other.counts().none, other.overall.verdict, other.toFile().edits.length], [1, 'accept', 2]);
  other.decideOverall('none', '');
  assert.deepEqual(other.toFile().edits.map((entry) => entry.edit), [2]);
});

test('an overall verdict on other edits is not taken over', () => {
  const verdicts = make();
  verdicts.decideOverall('accept', 'fine');
  const file = verdicts.toFile();
  const newer = make({ edits: [{ id: 1, revision: 2, hash: 'h9', title: 'One' }, { id: 2, revision: 3, hash: 'h2', title: 'Two' }] });
  assert.deepEqual(newer.load(JSON.stringify(file)), { taken: 0, outdated: [], missing: 0, overallOutdated: true });
  assert.deepEqual([newer.overall, newer.toFile().edits], [{ verdict: 'none', comment: 'fine' }, []]);
  const partial = make();
  assert.equal(partial.load(JSON.stringify({ ...file, edits: file.edits.slice(1) })).overallOutdated, true);
});

test('another project is refused, newer revisions are left out', () => {
  const verdicts = make();
  verdicts.decide(1, 'accept');
  verdicts.decide(2, 'accept');
  const text = JSON.stringify(verdicts.toFile());
  assert.throws(() => make({ project: { id: 'q', name: '' } }).load(text), /another project/);
  const newer = make({ edits: [{ id: 1, revision: 2, hash: 'h9', title: 'One' }] });
  assert.deepEqual(newer.load(text), { taken: 0, outdated: ['One'], missing: 1, overallOutdated: false });
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
