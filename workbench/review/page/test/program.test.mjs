// The way of a review: the program writes the page, a reviewer fills it in by keyboard, the program takes the verdicts.
// VESSELBENCH: the program; CASE: a case that it prepares.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { after, before, describe, test } from 'node:test';
import { missing, newReader, openPage, said, savedFile, shown, startBrowser, text } from './browser.mjs';

const PROGRAM = process.env.VESSELBENCH, CASE = process.env.CASE;
const skip = missing || (PROGRAM && CASE ? false : 'no VESSELBENCH and CASE in the environment');
const press = async (page, ...keys) => { for (const key of keys) await page.keyboard.press(key); };

/** @returns {{code: number, out: string, error: string}} */
function run(...words) {
  const done = spawnSync(PROGRAM, words, { encoding: 'utf8', maxBuffer: 1 << 28 });
  return { code: done.status, out: done.stdout, error: done.stderr };
}

function succeed(...words) {
  const done = run(...words);
  assert.equal(done.code, 0, `${words.join(' ')}: ${done.error}`);
  return done.out;
}

async function introduce(page, name, role) {
  await page.waitForSelector('dialog#who[open]');
  await page.keyboard.type(name);
  await press(page, 'Tab');
  await page.keyboard.type(role);
  await press(page, 'Enter');
  await page.waitForSelector('dialog#who:not([open])');
  await page.evaluate(() => document.activeElement.blur());
}

describe('a review from the program to the program', { skip, timeout: 600000 }, () => {
  let tools, project;
  before(async () => {
    tools = await startBrowser();
    const out = join(tools.folder, 'model');
    succeed('prepare', CASE, '--for', 'cfd', '--author', 'Ada', '--out', out);
    project = join(out, 'project.vbench');
  });
  after(() => tools?.end());

  const review = () => JSON.parse(succeed('review', project, '--json'));
  const statuses = () => review().edits.map((edit) => edit.status);

  /** A reviewer accepts every edit but one, and saves. @returns {Promise<string>} path of the verdicts */
  async function reviewed(name, rejected) {
    const address = pathToFileURL(join(tools.folder, 'page.html')).href;
    const page = await openPage(await newReader(tools), address);
    await shown(page);
    await press(page, 't');  // all edits
    const count = (await page.$$('.entry')).length;
    assert.equal(count, review().edits.length);
    for (let i = 0; i < count; ++i) await press(page, 'k');
    for (let i = 0; i < count; ++i) {
      await press(page, i === rejected ? 'r' : 'a');
      if (i === rejected) {
        await said(page, /needs a reason/);
        await page.keyboard.type('The wall was there in the scan.');
        await page.keyboard.down('Control');
        await press(page, 'Enter');
        await page.keyboard.up('Control');
      }
      if (i === 0) await introduce(page, name, 'radiologist');
      await page.evaluate(() => document.activeElement.blur());
      await press(page, 'j');
    }
    await press(page, 's');
    const { path } = await savedFile(tools, `${name}.json`);
    assert.deepEqual(page.problems, []);
    assert.doesNotMatch(await text(page, '#progress'), /unsaved/);
    await page.close();
    return path;
  }

  test('page, verdicts, dispute, gate, and what changes afterwards', async () => {
    succeed('review', project, '--out', join(tools.folder, 'page.html'));
    const first = await reviewed('Kern', -1);
    succeed('review', project, '--import', first);
    assert.ok(statuses().every((status) => status === 'accepted'), statuses().join());
    succeed('audit', project, '--against', first);
    const stl = join(tools.folder, 'model.stl');
    succeed('export', project, stl, '--require', 'accepted');
    assert.equal(run('export', project, stl, '--require', 'accepted=2').code, 1);
    const second = await reviewed('Roth', 2);
    succeed('review', project, '--import', second);
    assert.equal(statuses()[2], 'disputed');
    const refused = run('export', project, stl, '--require', 'accepted');
    assert.equal(refused.code, 1);
    assert.match(refused.error, /disputed/);
    const changed = review().edits.find((edit) => edit.operation === 'smooth');
    succeed('change', project, String(changed.edit), 'iterations=5');
    assert.equal(review().edits.find((edit) => edit.edit === changed.edit).status, 'outdated');
    succeed('audit', project, '--against', first, second);
  });
});
