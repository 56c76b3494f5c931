// The page that shows a model: structures, clipping, distances and views, by pointer and by keyboard alone.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { buildPage } from '../build.mjs';
import { missing, openPage, said, startBrowser, text, writePage } from './browser.mjs';
import { faults, weakTexts } from './checks.mjs';
import { makeViewerSample } from './sample/viewer_sample.mjs';

const EVIL = ['<script>window.harmed = 1</script>', '"><img src=x onerror="window.harmed = 1">', 'left \u202e right', 'x'.repeat(100000)];
const press = async (page, ...keys) => { for (const key of keys) await page.keyboard.press(key); };
const drawn = (page) => page.waitForFunction(() => performance.getEntriesByName('viewer:first-picture').length > 0, { timeout: 60000 });

/** After two frames: how many pixels of the picture are not its ground, and the mean of their colours. @param rows of it, in shares from its upper edge */
async function picture(page, rows = [0, 1]) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return page.evaluate(([first, last]) => {
    const view = document.getElementById('canvas');
    const canvas = Object.assign(document.createElement('canvas'), { width: view.width, height: view.height });
    const context = canvas.getContext('2d');
    context.drawImage(view, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    let model = 0;
    const sum = [0, 0, 0];
    const row = (share) => 4 * canvas.width * Math.round(share * canvas.height);
    for (let i = row(first); i < row(last); i += 4) {
      if ([0, 1, 2].every((k) => Math.abs(data[i + k] - data[k]) < 4)) continue;
      ++model;
      for (let k = 0; k < 3; ++k) sum[k] += data[i + k];
    }
    return { model, colour: sum.map((x) => x / Math.max(1, model)) };
  }, rows);
}

/** Whether the wall is coloured by its height, on the sample's ramp: yellow above, violet below. */
async function rises(page) {
  const [[red, , blue], [, lowGreen, lowBlue]] = [(await picture(page, [0, 0.3])).colour, (await picture(page, [0.7, 1])).colour];
  return red > blue + 30 && lowBlue > lowGreen + 30;
}

describe('the page that shows a model', { skip: missing, timeout: 240000 }, () => {
  let tools, template, plain, full;
  before(async () => {
    tools = await startBrowser();
    const path = join(tools.folder, 'template.html');
    await buildPage(path, 'viewer');
    template = readFileSync(path, 'utf8');
    plain = writePage(tools.folder, 'plain.html', template, makeViewerSample());
    full = writePage(tools.folder, 'full.html', template, makeViewerSample({ colour: true, slices: true }));
  });
  after(() => tools?.end());
  const open = async (address, options) => {
    const page = await openPage(await tools.browser.createBrowserContext(), address, options);
    await drawn(page);
    return page;
  };
  const box = (page, name) => page.evaluateHandle((label) => [...document.querySelectorAll('#structures label')].find((one) => one.textContent === label).querySelector('input'), name);

  /** Hides all parts but one, and the names. */
  const showOnly = async (page, name) => {
    await press(page, 'n');
    for (const other of ['wall', 'inlet', 'outlet 1', 'outlet 2', 'tumour', 'optic nerve'].filter((one) => one !== name)) await (await box(page, other)).click();
  };

  test('it opens without an error or a request, and says what it holds', async () => {
    const page = await open(plain);
    assert.equal(await text(page, '#case-name'), 'Case 7, middle cerebral artery');
    assert.equal(await text(page, '#case-provenance'), 'project carotid, cfd, accepted by A. Kern, model 1a2b3c4d5e6f');
    assert.match(await text(page, '#case-text'), /how far is the tumour/);
    assert.match(await text(page, '#case-holds'), /surface, neighbours; no voxels/);
    const names = await page.$$eval('#structures label', (all) => all.map((one) => one.textContent));
    assert.deepEqual(names, ['vessel', 'wall', 'inlet', 'outlet 1', 'outlet 2', 'tumour', 'optic nerve']);
    assert.ok((await picture(page)).model > 5000);
    assert.equal(await page.$eval('#slices-part', (element) => element.checkVisibility()), false);
    assert.equal(await page.$eval('#legend', (element) => element.checkVisibility()), false);
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  test('structures are switched off, seen through, and back', async () => {
    const page = await open(plain);
    await press(page, 'n');
    const whole = (await picture(page)).model;
    await (await box(page, 'vessel')).click();
    const others = (await picture(page)).model;
    assert.ok(others < 0.8 * whole, `${others} of ${whole} pixels`);
    for (const name of ['tumour', 'optic nerve']) await (await box(page, name)).click();
    assert.equal((await picture(page)).model, 0);
    await (await box(page, 'wall')).click();
    const wall = await picture(page);
    assert.ok(wall.model > 0);
    assert.equal(await (await box(page, 'vessel')).evaluate((one) => one.indeterminate), true);
    await page.$eval('input[aria-label="Transparency of wall"]', (slider) => { slider.value = '70'; slider.dispatchEvent(new Event('input')); });
    const through = await picture(page);
    assert.ok(Math.hypot(...wall.colour.map((x, k) => x - through.colour[k])) > 10, 'the colour fades towards the ground');
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  test('the plane cuts the model, moves and turns', async () => {
    const page = await open(plain);
    await press(page, 'n');
    const whole = (await picture(page)).model;
    await press(page, 'x');
    await said(page, /Clipping at x = /);
    const half = (await picture(page)).model;
    assert.ok(half < 0.9 * whole);
    for (let i = 0; i < 15; ++i) await press(page, ',');
    const less = (await picture(page)).model;
    assert.ok(less < half);
    await press(page, 'v');
    assert.ok((await picture(page)).model > half);
    await press(page, 'c');
    assert.equal((await picture(page)).model, whole);
    await page.click('#clip');
    await page.select('#clip-axis', '2');
    assert.match(await text(page, '#clip-place'), /z = -?[0-9.]+ mm/);
    const cut = async (view) => { await press(page, view, 'y'); return page.$eval('#clip-flip', (button) => button.getAttribute('aria-pressed')); };
    assert.notEqual(await cut('1'), await cut('2'), 'the side towards the viewer is cut away');
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  test('the section is drawn of visible parts alone', async () => {
    const page = await open(plain);
    await showOnly(page, 'inlet');
    const inlet = (await picture(page)).model;
    assert.ok(inlet > 0);
    await press(page, 'z');  // through the middle, far from the inlet: one side keeps all of it, the other nothing
    const side = (await picture(page)).model;
    await press(page, 'v');
    const other = (await picture(page)).model;
    assert.deepEqual([side, other].sort((a, b) => a - b), [0, inlet]);
    await (await box(page, 'inlet')).click();
    await (await box(page, 'wall')).click();
    await page.$eval('input[aria-label="Transparency of wall"]', (slider) => { slider.value = '100'; slider.dispatchEvent(new Event('input')); });
    assert.ok((await picture(page)).model > 0, 'the section of a visible part, however transparent');
    await press(page, 'c');
    assert.equal((await picture(page)).model, 0);
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  test('the smallest distance of two chosen structures is shown', async () => {
    const page = await open(plain);
    const { manifest } = makeViewerSample();
    await page.select('#gap-first', '2');
    assert.match(await text(page, '#gap'), /Choose two/);
    await page.select('#gap-second', '0');
    assert.ok((await text(page, '#gap')).startsWith(`${manifest.distances[1].mm.toFixed(2)} mm between optic nerve and vessel`));
    await page.click('#gap button');
    await page.select('#gap-second', '2');
    assert.match(await text(page, '#gap'), /two different/);
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  test('a distance is measured by two clicks, and by keyboard', async () => {
    const page = await open(plain);
    const canvas = await (await page.$('#canvas')).boundingBox();
    await page.click('#measure');
    await page.mouse.click(canvas.x + 4, canvas.y + 4);
    await said(page, /no model/);
    await page.mouse.click(canvas.x + canvas.width / 2, canvas.y + canvas.height / 2);
    await said(page, /Start set/);
    await page.mouse.click(canvas.x + canvas.width / 2, canvas.y + canvas.height / 2 + 40);
    await said(page, /Distance [0-9.]+ mm/);
    const mm = Number(/([0-9.]+) mm/.exec(await text(page, '#measured'))[1]);
    assert.ok(mm > 0.5 && mm < 12, `${mm}`);
    await press(page, 'd', 'Enter');
    await said(page, /Start set/);
    await press(page, 'k', 'k', 'Enter');
    await said(page, /Distance [0-9.]+ mm/);
    assert.equal((await page.$$('#measured li')).length, 2);
    await page.click('#clear');
    assert.equal((await page.$$('#measured li')).length, 0);
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  test('a measure colours the wall, with a legend of unit and range', async () => {
    const page = await open(full);
    const { colour } = makeViewerSample({ colour: true }).manifest;
    assert.equal(await text(page, '#legend-title'), 'Height [mm]');
    const ticks = await page.$$eval('#legend-ticks span', (all) => all.map((one) => Number(one.textContent.replace('\u2212', '-'))));
    assert.ok(Math.abs(ticks[0] - colour.most) < 0.06 && Math.abs(ticks[4] - colour.least) < 0.06, `${ticks}`);
    assert.match(await text(page, '#legend-text'), /Colour of the wall: Height from .* to .* mm/);
    assert.match(await text(page, '#case-holds'), /vertex measure, image slices; grey values/);
    assert.equal((await page.$$('#slices canvas')).length, 3);
    await showOnly(page, 'wall');
    assert.ok(await rises(page), 'the ramp is on the wall');
    assert.deepEqual(page.problems, []);
    await page.close();
    const bare = await open(plain);
    await showOnly(bare, 'wall');
    assert.ok(!(await rises(bare)), 'without a measure the wall is plain');
    await bare.close();
  });

  test('it is used by keyboard alone', async () => {
    const page = await open(plain);
    const front = (await picture(page)).model;
    await press(page, '3');
    assert.notEqual((await picture(page)).model, front);
    await press(page, '2', '4', '5', '6', 'g', '1', '+', '-');
    await press(page, '?');
    assert.ok(await page.$('dialog#help[open]'));
    await press(page, 'Escape');
    const seen = [];
    for (let i = 0; i < 50; ++i) {
      await press(page, 'Tab');
      const [name, ring] = await page.evaluate(() => [document.activeElement.id || document.activeElement.closest('[id]')?.id, getComputedStyle(document.activeElement).outlineStyle]);
      if (name && !seen.includes(name)) seen.push(name);
      if (name) assert.notEqual(ring, 'none', `no ring on ${name}`);
    }
    for (const id of ['theme', 'help-button', 'views', 'canvas', 'structures', 'names', 'clip', 'gap-first', 'gap-second', 'measure']) assert.ok(seen.includes(id), `not reached: ${id}`);
    await (await box(page, 'tumour')).focus();
    await press(page, 'Space');
    assert.equal(await (await box(page, 'tumour')).evaluate((one) => one.checked), false);
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  test('hostile texts appear as text and run nothing', async () => {
    const evil = makeViewerSample({ colour: true });
    Object.assign(evil.manifest, { title: EVIL[0], text: EVIL[3], purpose: EVIL[1], provenance: EVIL[0] + EVIL[3], program: EVIL[2], holds: EVIL });
    evil.manifest.structures.forEach((one, i) => { one.name = EVIL[i + 1]; });
    evil.manifest.states[0].patches.forEach((patch, i) => { patch.name = EVIL[i]; });
    Object.assign(evil.manifest.colour, { label: EVIL[1], unit: EVIL[0] });
    const page = await open(writePage(tools.folder, 'evil.html', template, evil));
    assert.equal(await text(page, '#case-name'), EVIL[0]);
    const line = await text(page, '#case-provenance');
    assert.ok(line.startsWith(EVIL[0]) && line.length === 200, 'cut, without a way to the rest');
    const all = await text(page, 'body');
    assert.ok(all.includes('left ⟨U+202E⟩ right'), 'made visible');
    assert.ok(!all.includes('\u202e'), `unseen near ${all.slice(Math.max(0, all.indexOf('\u202e') - 60)).slice(0, 90)}`);
    await page.select('#gap-first', '0');
    await page.select('#gap-second', '1');
    assert.ok((await text(page, '#gap')).includes('<img src=x'));
    assert.equal(await page.evaluate(() => window.harmed), undefined);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    assert.deepEqual(page.problems, []);
    await page.close();
  });

  test('damaged, missing and foreign data are named', async () => {
    const broken = makeViewerSample();
    broken.blobs['chunk-1'] = broken.blobs['chunk-1'].slice(0, 400);
    const page = await openPage(tools.browser, writePage(tools.folder, 'broken.html', template, broken));
    await page.waitForFunction(() => /chunk-1” is damaged/.test(document.getElementById('notice').textContent));
    await page.goto(`file://${join(tools.folder, 'template.html')}`);
    assert.match(await text(page, '#notice'), /no model yet/);
    const none = makeViewerSample();
    none.manifest.structures = [];
    await page.goto(writePage(tools.folder, 'none.html', template, none));
    await page.waitForFunction(() => /no structures/.test(document.getElementById('notice').textContent));
    const review = makeViewerSample();
    review.manifest.format = 'vesselbench-review';
    await page.goto(writePage(tools.folder, 'review.html', template, review));
    await page.waitForFunction(() => /holds no model/.test(document.getElementById('notice').textContent));
    await page.close();
  });

  for (const scheme of ['light', 'dark'])
    test(`contrast and names hold in the ${scheme} theme`, async () => {
      const page = await open(full, { scheme });
      for (const keys of [[], ['c'], ['d'], ['?']]) {
        await press(page, ...keys);
        assert.deepEqual(await page.evaluate(weakTexts), [], `after ${keys}`);
        assert.deepEqual(await page.evaluate(faults), [], `after ${keys}`);
      }
      await page.close();
    });

  for (const [width, height] of [[390, 844], [820, 1180], [1280, 720]])
    test(`nothing lies beside a screen of ${width} x ${height}`, async () => {
      const page = await open(full, { width, height });
      await page.select('#gap-first', '0');
      await page.select('#gap-second', '1');
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
      assert.ok((await picture(page)).model > 2000);
      assert.deepEqual(page.problems, []);
      await page.close();
    });
});

test('without WebGL the page says what it needs', { skip: missing, timeout: 120000 }, async () => {
  const tools = await startBrowser({ webgl: false });
  const path = join(tools.folder, 'template.html');
  await buildPage(path, 'viewer');
  const page = await openPage(tools.browser, writePage(tools.folder, 'case.html', readFileSync(path, 'utf8'), makeViewerSample({ h: 0.8 })));
  await page.waitForFunction(() => /WebGL 2/.test(document.getElementById('notice').textContent));
  await tools.end();
});
