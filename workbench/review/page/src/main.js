/** Starts the page: reads the manifest, joins list, view, verdicts and keys. */
import { showCase } from './case_facts.js';
import { DataError } from './decode.js';
import { heading, showFacts } from './details.js';
import { askOverall, askReviewer, showHelp } from './dialogs.js';
import { draftsAllowed, keepDraft, restoreDraft } from './drafts.js';
import { bindFiles, saveVerdicts } from './files.js';
import { bindKeys } from './keyboard.js';
import { readManifest } from './manifest.js';
import { notice, say } from './messages.js';
import { Pool } from './pool.js';
import { writePaper } from './printing.js';
import { ListPanel } from './queue.js';
import { fill, make } from './text.js';
import { bindTheme } from './theme.js';
import { VerdictPanel } from './verdict_panel.js';
import { Verdicts } from './verdicts.js';
import { Workplace } from './workplace.js';
import { makeCommands } from './commands.js';

const byId = (id) => document.getElementById(id);

function manifestOfPage() {
  const element = byId('case');
  if (!element) throw new DataError('This page holds no case yet: it is the empty template.');
  return readManifest(element.textContent);
}

/** Shows an edit in all parts of the page, and says how long it took. */
async function open({ edit, item }, { list, work, panel, manifest }) {
  const start = performance.now();
  fill(byId('edit-head'), heading(edit));
  panel.show(edit);
  showFacts(byId('facts'), edit, manifest, null, null);
  const shown = await work.show(edit, item);
  if (!shown) return;
  performance.measure(`review:edit:${edit.id}`, { start, end: performance.now() });
  if (!performance.getEntriesByName('review:first-picture').length) performance.measure('review:first-picture', { start: 0, end: performance.now() });
  showFacts(byId('facts'), edit, manifest, shown.after ?? shown.before, (place) => work.look(place));
  work.prefetch(list.neighbours());
}

function showProgress(verdicts, kept) {
  const counts = verdicts.counts();
  const open = verdicts.unsaved ? ` · ${verdicts.unsaved} unsaved ${verdicts.unsaved === 1 ? 'change' : 'changes'}` : '';
  const whole = { accept: ' · the whole: accepted', reject: ' · the whole: rejected', unsure: ' · the whole: unsure' }[verdicts.overall.verdict] ?? '';
  byId('progress').textContent = `${verdicts.manifest.edits.length - counts.none} of ${verdicts.manifest.edits.length} judged${whole}${open}`;
  byId('save').classList.toggle('waiting', verdicts.unsaved > 0);
  if (verdicts.unsaved && !kept) notice('This browser keeps no draft of this page. Save the verdicts before you close it.');
}

/** Drafts: taken over at the start, kept at each change; closing with unsaved changes asks. */
function bindDrafts(verdicts) {
  const allowed = draftsAllowed();
  const report = allowed ? restoreDraft(verdicts) : null;
  if (report && (report.taken || report.outdated.length)) say(`The draft of your verdicts is back (${report.taken}).`);
  const changed = () => showProgress(verdicts, keepDraft(verdicts));
  verdicts.addEventListener('change', changed);
  showProgress(verdicts, allowed);
  window.addEventListener('beforeunload', (event) => {
    if (verdicts.unsaved) { event.preventDefault(); event.returnValue = ''; }
  });
}

function bindButtons(verdicts, work, commands) {
  byId('finish').addEventListener('click', () => askOverall(verdicts));
  byId('save').addEventListener('click', () => saveVerdicts(verdicts, say));
  byId('help-button').addEventListener('click', () => showHelp(commands));
  byId('print-button').addEventListener('click', () => window.print());
  window.addEventListener('beforeprint', () => writePaper(byId('paper'), verdicts.manifest, verdicts));
  bindTheme(byId('theme'), () => work.redraw());
}

/** The bar at the lower edge of small screens: what a thumb needs. */
function bindThumbs(panel, list) {
  const button = (text, label, run) => make('button', { type: 'button', 'aria-label': label, onclick: run }, text);
  fill(byId('thumb-bar'), button('‹', 'Previous', () => list.step(-1)), button('Accept', 'Accept this edit', () => panel.decide('accept')),
       button('Reject', 'Reject this edit', () => panel.decide('reject')), button('Unsure', 'Unsure about this edit', () => panel.decide('unsure')), button('›', 'Next', () => list.step(1)));
}

function start() {
  const manifest = manifestOfPage();
  performance.mark('review:manifest');
  showCase(manifest);
  const verdicts = new Verdicts(manifest);
  bindDrafts(verdicts);
  const work = new Workplace(manifest, new Pool(manifest), verdicts, say);
  let asked = false;
  const panel = new VerdictPanel(byId('verdict'), verdicts, say, () => { if (!asked) { asked = true; askReviewer(verdicts); } });
  work.onmark = (kind) => panel.describe(kind);
  const parts = { work, panel, manifest };
  const list = parts.list = new ListPanel({ list: byId('list'), queueTab: byId('queue-tab'), editsTab: byId('edits-tab') }, manifest, verdicts, (entry) => open(entry, parts));
  const commands = makeCommands({ list, work, panel, verdicts, say, help: () => showHelp(commands) });
  bindKeys(commands, () => byId('keys-on').checked);
  bindButtons(verdicts, work, commands);
  bindThumbs(panel, list);
  bindFiles(byId('load'), byId('file'), verdicts, notice, () => list.current && panel.show(list.current.edit));
  if (list.current) open(list.current, parts);
  else notice('This page holds no edits.');
}

try {
  start();
} catch (error) {
  notice(error instanceof DataError ? error.message : `The page could not start: ${error.message}`);
}
