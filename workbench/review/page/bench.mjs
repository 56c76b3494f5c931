// Size and speed of a page of about 100,000 triangles and 12 edits, in Chromium with software rendering: node bench.mjs
// "bound" ends when the buffers are handed to the graphics library and the frame is asked for, before the frame is drawn.
import { readFileSync, statSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { join } from 'node:path';
import { buildPage } from './build.mjs';
import { openPage, shown, startBrowser, writePage } from './test/browser.mjs';
import { makeSample } from './test/sample/sample.mjs';

const { browser, folder, end } = await startBrowser();
const template = join(folder, 'template.html');
await buildPage(template);
const sample = makeSample({ h: 0.2, refine: true, pictures: false });
const address = writePage(folder, 'bench.html', readFileSync(template, 'utf8'), sample);
const triangles = sample.manifest.edits.find((edit) => edit.id === 1).figures[0].value;
console.log(`triangles of the model: ${triangles}; stored once: ${sample.manifest.chunks.reduce((sum, chunk) => sum + chunk.triangles, 0)}`);
console.log(`template: ${(statSync(template).size / 1e6).toFixed(2)} MB; page: ${(statSync(fileURLToPath(address)).size / 1e6).toFixed(2)} MB`);
const page = await openPage(browser, address);
await shown(page);
const times = () => page.evaluate(() => performance.getEntriesByType('measure').map((one) => [one.name, Math.round(one.duration)]));
console.log('first picture bound:', (await times()).filter(([name]) => name === 'review:first-picture')[0][1], 'ms after opening');
await page.keyboard.press('t');
for (let i = 0; i < sample.manifest.edits.length - 6; ++i) {
  await new Promise((resolve) => setTimeout(resolve, 2500));  // a reader looks; the next ones are made ready meanwhile
  await page.keyboard.press('j');
}
await new Promise((resolve) => setTimeout(resolve, 2500));
console.log('edits bound [ms]:', (await times()).filter(([name]) => name.startsWith('review:edit')).map(([name, ms]) => `${name.slice(12)} ${ms}`).join(', '));
if (page.problems.length) console.log('problems:', page.problems);
await end();
