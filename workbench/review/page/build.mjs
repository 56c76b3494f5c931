// Bundles a page into one HTML file: node build.mjs OUT.html [review|viewer]
import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const MARKER = '<!-- vesselbench data -->';

async function bundle(entry) {
  const result = await build({ entryPoints: [join(here, 'src', entry)], bundle: true, minify: true, write: false, format: 'iife', charset: 'utf8',
    target: ['chrome100', 'firefox113', 'safari16.4'], legalComments: entry.endsWith('.js') ? 'inline' : 'none', logLevel: 'warning' });
  return result.outputFiles[0].text.trim();
}

const hash = (text) => `sha256-${createHash('sha256').update(text).digest('base64')}`;

function fillTemplate(template, values) {
  return template.replace(/\{\{([a-z-]+)\}\}/g, (_, name) => values[name]);
}

/** Fails rather than write a page that a browser would cut short or the program could not fill. */
function check(page, script, style) {
  if (/<\/script|<!--/i.test(script)) throw new Error('the script holds an end or a comment of HTML');
  if (/<\/style/i.test(style)) throw new Error('the style holds its own end');
  if (page.split(MARKER).length !== 2) throw new Error('the page does not hold its marker exactly once');
}

/** The pages: that on which experts review edits, and that which shows a model. */
const PAGES = { review: ['main.js', 'style.css', 'page.html'], viewer: ['viewer.js', 'viewer.css', 'viewer.html'] };

/** @param {string} out path of the page @param {string} name of PAGES */
export async function buildPage(out, name = 'review') {
  const [entry, look, html] = PAGES[name];
  const [script, style] = await Promise.all([bundle(entry), bundle(look)]);
  const template = readFileSync(join(here, 'src', html), 'utf8');
  const page = fillTemplate(template, { script, style, 'script-hash': hash(script), 'style-hash': hash(style) });
  check(page, script, style);
  mkdirSync(dirname(resolve(out)), { recursive: true });
  writeFileSync(`${out}.part`, page);  // a build that is stopped leaves no half page
  renameSync(`${out}.part`, out);
}

if (process.argv[1] && resolve(process.argv[1]) === fileURLToPath(import.meta.url)) {
  const [out, name = 'review'] = process.argv.slice(2);
  if (!out || !PAGES[name]) { console.error('usage: node build.mjs OUT.html [review|viewer]'); process.exit(3); }
  await buildPage(out, name);
}
