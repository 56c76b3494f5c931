// Who uses no mouse, sees little contrast, holds a phone, or prints, gets all of the page.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { buildPage } from '../build.mjs';
import { missing, openPage, shown, startBrowser, writePage } from './browser.mjs';
import { faults, weakTexts } from './checks.mjs';
import { makeSample } from './sample/sample.mjs';

describe('the page for everyone', { skip: missing, timeout: 240000 }, () => {
  let tools, address;
  before(async () => {
    tools = await startBrowser();
    const path = join(tools.folder, 'template.html');
    await buildPage(path);
    address = writePage(tools.folder, 'case.html', readFileSync(path, 'utf8'), makeSample({ h: 0.6, slices: true }));
  });
  after(() => tools?.end());
  const open = async (options) => {
    const page = await openPage(await tools.browser.createBrowserContext(), address, options);
    await shown(page);
    return page;
  };

  for (const scheme of ['light', 'dark'])
    test(`contrast and names hold in the ${scheme} theme`, async () => {
      const page = await open({ scheme });
      assert.deepEqual(await page.evaluate(faults), []);
      assert.deepEqual(await page.evaluate(weakTexts), []);
      for (const keys of [['u', 'Escape', '5'], ['j', 'a', '3'], ['t'], ['r'], ['Escape', 'o']]) {
        for (const key of keys) await page.keyboard.press(key);
        await new Promise((resolve) => setTimeout(resolve, 400));
        assert.deepEqual(await page.evaluate(weakTexts), [], `after ${keys}`);
        assert.deepEqual(await page.evaluate(faults), [], `after ${keys}`);
      }
      await page.close();
    });

  test('the button changes the theme', async () => {
    const page = await open({ scheme: 'light' });
    const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await ground();
    await page.click('#theme');
    assert.notEqual(await ground(), light);
    assert.deepEqual(await page.evaluate(weakTexts), []);
    await page.click('#theme');
    assert.equal(await ground(), light);
    await page.close();
  });

  test('the Tab key reaches everything, in reading order, with a visible focus', async () => {
    const page = await open();
    const seen = [];
    for (let i = 0; i < 70; ++i) {
      await page.keyboard.press('Tab');
      const [name, ring] = await page.evaluate(() => {
        const e = document.activeElement;
        return [e.id || e.closest('[id]')?.id, getComputedStyle(e).outlineStyle];
      });
      if (name && !seen.includes(name)) seen.push(name);
      if (name) assert.notEqual(ring, 'none', `no ring on ${name}`);
    }
    const order = ['save', 'finish', 'load', 'print-button', 'theme', 'help-button', 'queue-tab', 'edits-tab', 'list', 'modes', 'canvas', 'tools', 'slices', 'verdict', 'comment'];
    const places = order.map((id) => seen.indexOf(id));
    assert.ok(places.every((place) => place >= 0), `not reached: ${order.filter((_, i) => places[i] < 0)}`);
    assert.deepEqual(places, [...places].sort((a, b) => a - b));
    await page.close();
  });

  for (const [width, height] of [[390, 844], [820, 1180], [1280, 720]])
    test(`nothing lies beside a screen of ${width} x ${height}`, async () => {
      const page = await open({ width, height });
      for (const key of ['1', '4', '5', '6', 't', 'j', 'j']) {
        await page.keyboard.press(key);
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `after ${key}`);
      }
      if (width < 500) {
        const size = await page.$$eval('#thumb-bar button', (all) => all.map((e) => Math.min(e.offsetWidth, e.offsetHeight)));
        assert.ok(Math.min(...size) >= 40, 'buttons are as large as a thumb');
        await page.tap('#thumb-bar button:nth-child(4)');
        await page.waitForSelector('.entry[aria-current=true] .verdict-unsure');
      }
      assert.deepEqual(page.problems, []);
      await page.close();
    });

  test('on paper are all edits with arguments and verdicts', async () => {
    const page = await open();
    await page.keyboard.press('u');
    await page.keyboard.press('Escape');
    await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
    await page.emulateMediaType('print');
    const paper = await page.$eval('#paper', (element) => element.innerText);
    for (const words of ['Inflate the dome at its tip', 'Extrude the outlets', 'threshold', 'chosen by the program', 'unsure', '0.35 × 0.35 × 0.4 mm']) assert.ok(paper.includes(words), words);
    assert.equal((await page.$$('#paper .paper-edit')).length, 12);
    assert.equal(await page.$eval('main', (element) => element.checkVisibility()), false);
    await page.close();
  });
});
