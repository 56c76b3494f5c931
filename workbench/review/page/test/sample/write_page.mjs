// Writes a page of the sample: node write_page.mjs TEMPLATE OUT [cell size in mm]
import { readFileSync, writeFileSync } from 'node:fs';
import { fillPage } from './encode.mjs';
import { makeSample } from './sample.mjs';

const [template, out, h] = process.argv.slice(2);
if (out) {
  const { manifest, blobs } = makeSample({ slices: true, h: Number(h ?? 0.42) });
  writeFileSync(out, fillPage(readFileSync(template, 'utf8'), manifest, blobs));
}
