// A browser of the system with a fresh profile, and pages that record what must not happen: a headless Chromium, or, if
// FIREFOX names one, a Firefox, which draws in 3D only on a display (xvfb-run).
import { existsSync, mkdirSync, mkdtempSync, readdirSync, renameSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import puppeteer from 'puppeteer-core';
import { fillPage } from './sample/encode.mjs';

const FIREFOX = process.env.FIREFOX;
const BROWSER = FIREFOX ?? process.env.CHROMIUM ?? '/usr/bin/chromium';
export const emulatesMedia = !FIREFOX;
export const missing = existsSync(BROWSER) ? false : `no browser at ${BROWSER}`;

const FLAGS = ['--headless=new', '--no-sandbox', '--disable-background-networking', '--disable-component-update', '--disable-sync', '--no-first-run'];
const SOFTWARE = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

const chromium = (webgl) => ({ args: [...FLAGS, ...(webgl ? SOFTWARE : ['--disable-gpu', '--disable-3d-apis'])], headless: true });
const firefox = (webgl, folder) => ({ browser: 'firefox', headless: !process.env.DISPLAY,
  extraPrefsFirefox: { 'browser.download.folderList': 2, 'browser.download.dir': join(folder, 'downloads'), 'webgl.disabled': !webgl } });

/** @param {{webgl?: boolean}} options @returns browser, folder, and a way to end both */
export async function startBrowser({ webgl = true } = {}) {
  const folder = mkdtempSync(join(tmpdir(), 'review-page-'));
  mkdirSync(join(folder, 'downloads'));
  const browser = await puppeteer.launch({ executablePath: BROWSER, userDataDir: join(folder, 'profile'), protocolTimeout: 120000,
    ...(FIREFOX ? firefox(webgl, folder) : chromium(webgl)) });
  const end = async () => { await browser.close(); rmSync(folder, { recursive: true, force: true, maxRetries: 5 }); };
  return { browser, folder, end };
}

/** Another reader's browser: nothing is remembered of the others. What it saves goes to the folder's downloads. */
export const newReader = ({ browser, folder }) => browser.createBrowserContext(
  FIREFOX ? {} : { downloadBehavior: { policy: 'allow', downloadPath: join(folder, 'downloads') } });

/** Waits for the one file that a page saves, and puts it aside. @returns its path, and the name that the page gave it */
export async function savedFile({ folder }, aside) {
  const downloads = join(folder, 'downloads');
  const whole = () => { const [file, more] = readdirSync(downloads); return file && !more && statSync(join(downloads, file)).size > 0 && /\.json$/.test(file) ? file : null; };
  let file = whole();
  for (let i = 0; i < 1200 && !file; ++i, file = whole()) await new Promise((resolve) => setTimeout(resolve, 50));
  if (!file) throw new Error(`the page saved no file within a minute: ${readdirSync(downloads)}`);
  const path = join(folder, aside);
  renameSync(join(downloads, file), path);
  return { path, name: file };
}

/** Writes a page of a template and a sample. @returns {string} its file address */
export function writePage(folder, name, template, { manifest, blobs }) {
  const path = join(folder, name);
  writeFileSync(path, fillPage(template, manifest, blobs));
  return pathToFileURL(path).href;
}

/** Opens an address. `page.problems` collects errors of the console and the page, and every request beside the file itself. */
export async function openPage(browser, address, { width = 1440, height = 900, scheme = 'light', motion = 'no-preference', prepare } = {}) {
  const page = await browser.newPage();
  page.problems = [];
  page.on('console', (message) => { if (['error', 'warn', 'warning'].includes(message.type()) && !/GL Driver Message|GPU stall/.test(message.text())) page.problems.push(`console: ${message.text()}`); });
  page.on('pageerror', (error) => page.problems.push(`error: ${error.message}`));
  page.on('request', (request) => { if (request.url() !== address && !/^(data|blob):/.test(request.url())) page.problems.push(`request: ${request.url()}`); });
  page.on('dialog', (dialog) => dialog.accept());
  await page.setViewport(FIREFOX ? { width, height } : { width, height, hasTouch: width < 500, isMobile: width < 500 });
  if (emulatesMedia) await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }, { name: 'prefers-reduced-motion', value: motion }]);
  if (prepare) await prepare(page);
  await page.goto(address);
  return page;
}

/** Waits until the first edit is shown. */
export const shown = (page) => page.waitForFunction(() => performance.getEntriesByName('review:first-picture').length > 0, { timeout: 60000 });
export const text = (page, selector) => page.$eval(selector, (element) => element.innerText);
export const focused = (page) => page.evaluate(() => document.activeElement?.id || document.activeElement?.className || document.activeElement?.tagName);
/** Waits until the page has said something that a pattern matches. */
export async function said(page, pattern) {
  try {
    await page.waitForFunction((source) => new RegExp(source).test(document.getElementById('say').textContent), { timeout: 10000, polling: 50 }, pattern.source);
  } catch {
    throw new Error(`${pattern} was not said, but “${await text(page, '#say')}”, focus on ${await focused(page)}`);
  }
}
