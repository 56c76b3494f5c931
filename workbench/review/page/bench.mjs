// Size and speed of a page in Chromium with software rendering: node bench.mjs [PAGE.html], by default of a sample of about
// 100,000 triangles and 12 edits. It opens the queue's first edit, then the first six of all edits, as a reader would.
// "bound" ends when the buffers are handed to the graphics library and the frame is asked for, before the frame is drawn.
import { readFileSync, statSync } from 'node:fs';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { join, resolve } from 'node:path';
import { buildPage } from './build.mjs';
import { openPage, shown, startBrowser, writePage } from './test/browser.mjs';
import { makeSample } from './test/sample/sample.mjs';

async function samplePage(folder) {
  const template = join(folder, 'template.html');
  await buildPage(template);
  const sample = makeSample({ h: 0.2, refine: true, pictures: false });
  console.log('triangles of the model:', sample.manifest.edits.find((edit) => edit.id === 1).figures[0].value);
  return writePage(folder, 'bench.html', readFileSync(template, 'utf8'), sample);
}

const { browser, folder, end } = await startBrowser();
const address = process.argv[2] ? pathToFileURL(resolve(process.argv[2])).href : await samplePage(folder);
console.log(`page: ${(statSync(fileURLToPath(address)).size / 1e6).toFixed(2)} MB`);
const page = await openPage(browser, address);
await shown(page);
const times = () => page.evaluate(() => performance.getEntriesByType('measure').map((one) => [one.name, Math.round(one.duration)]));
console.log('first picture bound:', (await times()).filter(([name]) => name === 'review:first-picture')[0][1], 'ms after opening');
await page.keyboard.press('t');
for (let i = 0; i < 6; ++i) {
  await new Promise((resolve) => setTimeout(resolve, 2500));  // a reader looks; the next ones are made ready meanwhile
  await page.keyboard.press('j');
}
await new Promise((resolve) => setTimeout(resolve, 2500));
console.log('edits bound [ms]:', (await times()).filter(([name]) => name.startsWith('review:edit')).map(([name, ms]) => `${name.slice(12)} ${ms}`).join(', '));
if (page.problems.length) console.log('problems:', page.problems);
await end();
