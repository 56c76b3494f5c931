// The page in a browser: walked by keyboard, verdicts taken and saved, nothing asked of the network.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { buildPage } from '../build.mjs';
import { emulatesMedia, focused, missing, newReader, openPage, said, savedFile, shown, startBrowser, text, writePage } from './browser.mjs';
import { makeSample } from './sample/sample.mjs';

const EVIL = ['<script>window.harmed = 1</script>', '"><img src=x onerror="window.harmed = 1">', 'left \u202e right', 'x'.repeat(100000)];
const press = async (page, ...keys) => { for (const key of keys) await page.keyboard.press(key); };
const opened = (page, id) => page.waitForFunction((name) => performance.getEntriesByName(name).length > 0, {}, `review:edit:${id}`);
const title = (page) => text(page, '#edit-head h2');

describe('the page in a browser', { skip: missing, timeout: 240000 }, () => {
  let tools, template, sample, address;
  before(async () => {
    tools = await startBrowser();
    const path = join(tools.folder, 'template.html');
    await buildPage(path);
    template = readFileSync(path, 'utf8');
    sample = makeSample({ h: 0.6, slices: true });
    address = writePage(tools.folder, 'case.html', template, sample);
  });
  after(() => tools?.end());
  const fresh = () => newReader(tools);

  test('the queue is walked by keyboard; there is no error and no request', async () => {
    const page = await openPage(await fresh(), address);
    await shown(page);
    const seen = [await title(page)];
    for (let i = 1; i < sample.manifest.queue.length; ++i) {
      await press(page, i % 2 ? 'j' : 'ArrowDown');
      seen.push(await title(page));
      await opened(page, sample.manifest.queue[i].edit);
    }
    assert.deepEqual(seen, sample.manifest.queue.map((item) => sample.manifest.edits.find((edit) => edit.id === item.edit).title));
    await press(page, 'j');
    await said(page, /last one/);
    await press(page, 'k', 'ArrowUp', 't', '?');
    assert.ok(await page.$('dialog#help[open]'));
    await press(page, 'Escape');
    for (const key of ['1', '2', '3', '4', '5', '6', 'b']) await press(page, key);
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  test('findings that are more likely wrong than right are folded under one line', async () => {
    const manifest = structuredClone(sample.manifest);
    const last = manifest.queue.at(-1);
    manifest.queue.push({ ...last, kind: 'finding', title: 'Bump', why: '31 % that the wall rises there', folded: true },
                        { ...last, kind: 'finding', title: 'Dent', why: '20 % that the wall is pressed in there', folded: true });
    const page = await openPage(await fresh(), writePage(tools.folder, 'folded.html', template, { ...sample, manifest }));
    await shown(page);
    const entries = () => page.$$eval('.entry', (all) => all.length);
    assert.equal(await entries(), sample.manifest.queue.length);
    assert.match(await text(page, '#queue-tab'), new RegExp(`\\(${sample.manifest.queue.length}\\)`));
    assert.equal(await text(page, '#unfold'), '2 more below 50 %');
    await page.click('#unfold');
    assert.equal(await entries(), sample.manifest.queue.length + 2);
    assert.match(await text(page, '.entry[aria-current=true]'), /Bump/);
    assert.equal(await page.$('#unfold'), null);
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  test('verdicts, pin and distance by keyboard are saved', async () => {
    const page = await openPage(await fresh(), address);
    await shown(page);
    await press(page, 'r');
    await said(page, /needs a reason/);
    assert.equal(await focused(page), 'comment');
    await press(page, 'Escape');
    assert.match(await text(page, '.entry[aria-current=true]'), /open/);
    await press(page, 'r');
    await page.keyboard.type('The dome was round in the scan. <b>');
    await page.keyboard.down('Control');
    await press(page, 'Enter');
    await page.keyboard.up('Control');
    await page.waitForSelector('dialog#who[open]');
    await page.keyboard.type('Dr Ä. Reader');
    await press(page, 'Tab');
    await page.keyboard.type('neuroradiologist');
    await press(page, 'Enter');
    await page.waitForSelector('dialog#who:not([open])');
    await page.waitForFunction(() => !document.activeElement.closest('dialog'));
    assert.notEqual(await focused(page), 'comment');  // keys are commands again
    await press(page, 'r');
    await said(page, /Its button withdraws it/);
    await press(page, 'p', 'Enter');
    await said(page, /Pin 1 placed/);
    await page.keyboard.type('here');  // the remark is asked for
    await press(page, 'Enter', 'd', 'Enter');
    await said(page, /Start set/);
    await page.focus('#canvas');
    await press(page, 'ArrowRight', 'ArrowRight', 'ArrowRight', 'Enter');
    await said(page, /Distance [0-9.]+ mm/);
    await press(page, 'Enter', 'j', 'a');
    await said(page, /Accepted/);
    await press(page, 'j', 'u', 's');
    const { path, name } = await savedFile(tools, 'first.json');
    assert.equal(name, 'verdicts-case-7-middle-cerebral-artery-dr-a-reader.json');
    const file = JSON.parse(readFileSync(path, 'utf8'));
    const edit = (id) => sample.manifest.edits.find((one) => one.id === id);
    assert.deepEqual(file.edits.map((one) => [one.edit, one.verdict]).sort(), [[12, 'accept'], [5, 'reject'], [6, 'unsure']]);
    const rejected = file.edits.find((one) => one.edit === 5);
    assert.equal(rejected.comment, 'The dome was round in the scan. <b>');
    assert.deepEqual([rejected.revision, rejected.hash], [edit(5).revision, edit(5).hash]);
    assert.deepEqual(rejected.pins.map((pin) => pin.text), ['here']);
    assert.ok(rejected.distances[0].mm > 0.05 && rejected.distances[0].mm < 6);
    assert.deepEqual([file.format, file.version, file.chain_head, file.project.id], ['vesselbench-verdicts', 1, sample.manifest.chain_head, 'p-7f3a']);
    assert.deepEqual(file.reviewer, { name: 'Dr Ä. Reader', role: 'neuroradiologist' });
    assert.doesNotMatch(await text(page, '#progress'), /unsaved/);
    const input = await page.$('#file');
    await press(page, 'a');
    await input.uploadFile(path);
    await page.waitForFunction(() => /Verdicts on 3 edits/.test(document.getElementById('notice').textContent));
    assert.match(await text(page, '.entry[aria-current=true]'), /unsure/);
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  test('a click places a pin where it hits', async () => {
    const page = await openPage(await fresh(), address);
    await shown(page);
    await page.click('#tools button');
    const box = await (await page.$('#canvas')).boundingBox();
    await page.mouse.click(box.x + 4, box.y + box.height / 2);
    await said(page, /no surface|Pin 1/);
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await said(page, /Pin 1 placed/);
    await page.close();
  });

  test('a draft survives closing the page', async () => {
    const context = await fresh();
    const page = await openPage(context, address);
    await shown(page);
    await press(page, 'c');
    await page.keyboard.type('Look again');
    await press(page, 'Escape', 'u');
    await page.waitForSelector('dialog#who[open]');
    await press(page, 'Escape');
    await page.close({ runBeforeUnload: false });
    const again = await openPage(context, address);
    await shown(again);
    assert.equal(await again.$eval('#comment', (field) => field.value), 'Look again');
    assert.match(await text(again, '.entry[aria-current=true]'), /unsure/);
    assert.match(await text(again, '#progress'), /unsaved/);
    const asks = await again.evaluate(() => { const event = new Event('beforeunload', { cancelable: true }); window.dispatchEvent(event); return event.defaultPrevented; });
    assert.ok(asks);
    await again.close();
  });

  test('hostile texts appear as text and run nothing', async () => {
    const evil = structuredClone(sample);
    const { manifest } = evil;
    manifest.project.name = EVIL[0];
    Object.assign(manifest.edits[4], { title: EVIL[1], author: EVIL[2], note: EVIL[3], operation: EVIL[0], step_title: EVIL[1], thumbnail: 'data:image/svg+xml,<svg onload="window.harmed=1"/>' });
    manifest.edits[4].arguments = EVIL.map((value) => ({ name: value, value, unit: value, automatic: true }));
    manifest.edits[4].warnings = EVIL.map((value) => ({ text: value, place: [4, 8, 4] }));
    manifest.queue[0].title = EVIL[3];
    manifest.queue[0].why = EVIL[1];
    manifest.states.at(-1).patches.forEach((patch, i) => { patch.name = EVIL[i % 4]; });
    const page = await openPage(await fresh(), writePage(tools.folder, 'evil.html', template, evil));
    await shown(page);
    assert.equal(await text(page, '#case-name'), EVIL[0]);
    assert.equal(await title(page), EVIL[1]);
    const all = await text(page, '#side');
    assert.ok(all.includes('left ⟨U+202E⟩ right') && !all.includes('\u202e'));
    assert.ok(all.length < 20000, 'long texts are shortened');
    const more = await page.$$('#facts .more');
    await more[0].evaluate((button) => button.click());
    assert.ok((await text(page, '#facts')).includes(EVIL[3]), 'and reachable in full');
    await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
    assert.equal(await page.evaluate(() => window.harmed), undefined);
    assert.equal(await page.$$eval('img', (images) => images.filter((image) => !image.src.startsWith('data:image/png') && image.src).length), 0);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  test('missing and damaged parts are said, texts and verdicts go on', async () => {
    const broken = structuredClone(sample);
    delete broken.blobs['state-4'];
    broken.blobs['chunk-9'] = broken.blobs['chunk-9'].slice(0, 400);
    const page = await openPage(await fresh(), writePage(tools.folder, 'broken.html', template, broken));
    await page.waitForFunction(() => /state-4” is missing/.test(document.getElementById('view-message').textContent));
    await press(page, 'u');
    await said(page, /unsure/);
    await press(page, 'Escape');
    await page.evaluate(() => [...document.querySelectorAll('.entry')].at(-1).click());
    await page.waitForFunction(() => /chunk-9” is damaged/.test(document.getElementById('view-message').textContent));
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  test('the empty template says that it holds no case', async () => {
    const page = await openPage(tools.browser, `file://${join(tools.folder, 'template.html')}`);
    assert.match(await text(page, '#notice'), /no case/);
    await page.close();
  });

  test('who asks for less motion blinks by hand', { skip: !emulatesMedia && 'the browser emulates no media features' }, async () => {
    const page = await openPage(await fresh(), address, { motion: 'reduce' });
    await shown(page);
    await press(page, 'b');
    await said(page, /Shown: before/);
    await new Promise((resolve) => setTimeout(resolve, 1500));
    assert.equal(await text(page, '#label-left'), 'Before');
    await press(page, 'b');
    assert.equal(await text(page, '#label-left'), 'After');
    await page.close();
  });
});

test('without WebGL, texts, slices and verdicts work', { skip: missing, timeout: 120000 }, async () => {
  const tools = await startBrowser({ webgl: false });
  const path = join(tools.folder, 'template.html');
  await buildPage(path);
  const page = await openPage(tools.browser, writePage(tools.folder, 'case.html', readFileSync(path, 'utf8'), makeSample({ h: 0.7 })));
  await shown(page);
  assert.match(await text(page, '#view-message'), /no 3D view/);
  await press(page, 'j', 'a');
  await said(page, /Accepted/);
  assert.equal((await page.$$('#slices canvas')).length, 3);
  await tools.end();
});
