// Puts the page together.

import './style.css';
import { Controller } from './controller';
import { readEmbedded } from './boot/embedded';
import { showFailure } from './boot/failure';
import { loadWasm } from './boot/wasm';
import { EngineHost } from './engine/host';
import { ENDINGS, LevelError, readLevel } from './load/level_file';
import { fill, h } from './panels/dom';
import { footer } from './panels/footer';
import { helpDialog } from './panels/help';
import { layersPanel, stepStage } from './panels/layers_panel';
import { levelChooser, levelPanel } from './panels/level_panel';
import { settingsPanel } from './panels/settings_panel';
import { exportPicture, shareButtons } from './panels/share_panel';
import { themeButton } from './panels/theme';
import { flyByKeys, takesKeys } from './scene/fly';
import { Stage } from './scene/stage';
import { hashHasSettings, hashToView } from './state/hash';
import { Store } from './state/store';
import type { View } from './state/view';
import { AuditTool } from './tools/audit_tool';
import { ClimbTool } from './tools/climb_tool';
import { LinkTool } from './tools/link_tool';
import { LookTool } from './tools/look_tool';
import { ObstacleTool } from './tools/obstacle_tool';
import { PathTool } from './tools/path_tool';
import { Pointer } from './tools/pointer';
import { RayTool } from './tools/ray_tool';
import { SightTool } from './tools/sight_tool';
import { StepsTool } from './tools/steps_tool';
import type { Tool } from './tools/tool';
import { WhyTool } from './tools/why_tool';

function makeTools(app: Controller): { tools: readonly Tool[]; chosen(): Tool; panel: HTMLElement; buttons: HTMLElement; hint: HTMLElement } {
  const tools: readonly Tool[] = [
    new LookTool(app), new PathTool(app), new WhyTool(app), new ObstacleTool(app), new LinkTool(app), new RayTool(app),
    new SightTool(app), new ClimbTool(app), new StepsTool(app), new AuditTool(app),
  ];
  const chosen = (): Tool => tools.find((tool) => tool.name === app.view.get().tool)!;
  const panel = h('section', { id: 'tool-panel' });
  const hint = h('div', { class: 'hint' }, h('span'));
  const buttons = h('nav', { class: 'tools', 'aria-label': 'Tools' });
  for (const tool of tools) {
    buttons.append(h('button', {
      id: `tool-${tool.name}`, title: `${tool.hint} (${tool.key})`, onclick: () => app.view.set({ tool: tool.name }),
    }, tool.label));
  }
  // Where the panels are drawers, what the tool answers is told in the picture.
  new MutationObserver(() => {
    const answer = panel.querySelector('.good, .bad');
    hint.classList.toggle('answered', answer !== null);
    hint.dataset.answer = answer?.textContent ?? '';
  }).observe(panel, { childList: true, subtree: true });
  const choose = (): void => {
    const now = chosen();
    for (const tool of tools) {
      if (tool !== now) tool.leave();
      document.getElementById(`tool-${tool.name}`)?.setAttribute('aria-pressed', String(tool === now));
    }
    fill(panel, h('h2', {}, now.label), now.panel);
    hint.firstElementChild!.textContent = now.hint;
    // All of them: paths, obstacles and links stay in the picture while another tool is in hand.
    for (const tool of tools) tool.refresh();
  };
  app.view.watch((now, before) => {
    if (now.tool !== before.tool) choose();
  });
  app.session.watch((now, before) => {
    if (now.bakeNumber !== before.bakeNumber || now.tilesNumber !== before.tilesNumber) {
      for (const tool of tools) tool.refresh();
    }
  });
  queueMicrotask(choose);
  return { tools, chosen, panel, buttons, hint };
}

function messageBox(app: Controller): HTMLElement {
  const box = h('div', { class: 'message', role: 'status', 'aria-live': 'polite', id: 'message' });
  let timer = 0;
  app.session.watch(({ message }, before) => {
    if (message === before.message && box.childElementCount > 0) return;
    clearTimeout(timer);
    box.hidden = message === null;
    if (!message) return;
    box.classList.toggle('error', message.kind === 'error');
    fill(box, h('span', {}, message.text), h('button', { class: 'quiet', 'aria-label': 'Close', onclick: () => app.say('') }, '✕'));
    if (message.kind === 'info') timer = window.setTimeout(() => app.say(''), 9000);
  });
  return box;
}

/** Files that are dropped anywhere, or chosen. */
function fileOpener(app: Controller, view: HTMLElement): { open(files: readonly File[]): void; reopen(): void } {
  let last: File | null = null;
  const read = async (file: File, keepView: boolean): Promise<void> => {
    last = file;
    try {
      app.say(`Reading ${file.name} …`);
      const { up, scale } = app.view.get();
      await app.open(await readLevel(file, { up, scale }), keepView);
    } catch (error) {
      app.say(error instanceof LevelError ? error.message : String(error), 'error');
    }
  };
  const open = (files: readonly File[]): void => {
    const file = files[0];
    if (!file) return;
    // A link names the file it was made with: then the view is the link's.
    const wanted = app.session.get().level === null && app.view.get().level === file.name;
    if (!wanted) app.view.set({ up: 'y', scale: 1 });
    void read(file, wanted);
  };
  const veil = h('div', { class: 'drop', hidden: true }, `Drop ${ENDINGS.join(' ')}`);
  view.append(veil);
  addEventListener('dragover', (event) => {
    event.preventDefault();
    veil.hidden = false;
  });
  addEventListener('dragleave', (event) => {
    if (event.relatedTarget === null) veil.hidden = true;
  });
  addEventListener('drop', (event) => {
    event.preventDefault();
    veil.hidden = true;
    open([...(event.dataTransfer?.files ?? [])]);
  });
  return { open, reopen: () => { if (last) void read(last, false); } };
}

function keys(app: Controller, tools: readonly Tool[], help: () => void, root: HTMLElement): void {
  const actions: Record<string, () => void> = {
    f: () => { app.stage.showAll(); app.cameraMoved(); },
    t: () => document.getElementById('theme')?.click(),
    o: () => document.getElementById('file')?.click(),
    p: () => exportPicture(app),
    h: () => root.classList.toggle('bare'),
    ',': () => stepStage(app, -1),
    '.': () => stepStage(app, 1),
    '?': help,
    Escape: () => app.cancel(),
  };
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || takesKeys(event.target)) return;
    const tool = tools.find((one) => one.key === event.key);
    if (tool) app.view.set({ tool: tool.name });
    else actions[event.key.length === 1 ? event.key.toLowerCase() : event.key]?.();
  });
  flyByKeys(app.stage, () => app.cameraMoved());
}

/** The page as a stranger sees it first: a path, which may be dragged. */
const FIRST_SIGHT: Partial<View> = { tool: 'path', start: [14, 0, 28], goal: [20, 5, 20] };

/** Once what else is under way has begun. */
async function startStage(canvas: HTMLCanvasElement): Promise<Stage> {
  await Promise.resolve();
  return new Stage(canvas);
}

async function start(root: HTMLElement): Promise<void> {
  const embedded = readEmbedded();
  const asked = location.hash.length > 1 ? location.hash : embedded?.hash ?? '';
  const { view: first, faults } = hashToView(asked);
  if (asked === '') Object.assign(first, FIRST_SIGHT);
  if (embedded && !hashHasSettings(asked)) first.settings = { ...first.settings, ...embedded.settings };
  const canvas = h('canvas', { tabIndex: 0, 'aria-label': 'The level in three dimensions' });
  const viewBox = h('main', { class: 'view' }, canvas);
  root.replaceChildren(viewBox);
  // The module is compiled and the worker starts beside the graphics, which hold this thread until they are there.
  const compiled = loadWasm();
  const engine = new EngineHost(compiled);
  const [wasm, stage] = await Promise.all([compiled, startStage(canvas)]);
  const app = new Controller(new Store<View>(first), stage, engine);
  const files = fileOpener(app, viewBox);
  const chooser = levelChooser(app, files.open);
  const help = helpDialog();
  const { tools, chosen, panel, buttons, hint } = makeTools(app);
  const left = h('aside', { class: 'left', 'aria-label': 'Settings' }, levelPanel(app, files.reopen), settingsPanel(app));
  const right = h('aside', { class: 'right', 'aria-label': 'Tool and layers' }, panel, layersPanel(app));
  const drawer = (side: HTMLElement, label: string): HTMLElement =>
    h('button', { class: 'drawer', onclick: () => side.classList.toggle('open') }, label);
  root.append(
    h('header', {}, h('h1', {}, 'talus'), chooser.element, buttons, h('span', { class: 'space' }),
      drawer(left, 'Bake'), drawer(right, 'Layers'),
      h('span', { class: 'row wide', style: 'margin: 0; flex-wrap: nowrap' }, ...shareButtons(app)), themeButton(app), help.button),
    left, right, footer(app, wasm.simd, wasm.reason));
  viewBox.append(hint, messageBox(app));
  new Pointer(app, chosen);
  keys(app, tools, help.show, root);
  (window as unknown as { talusViewer: unknown }).talusViewer = { app, tools, simd: wasm.simd, threads: wasm.threads };
  if (faults.length > 0) app.say(`The link could not be read whole: ${faults.join('; ')}`, 'error');

  if (embedded) await app.open(embedded.source, true);
  else if (first.level.startsWith('sample:')) await app.open({ kind: 'sample', name: first.level.slice(7) }, true);
  else app.say(`This link shows ${first.level}: drop that file here to see it.`);
  chooser.setSamples(await engine.samples());
}

const root = document.getElementById('app')!;
start(root).catch((error: unknown) => showFailure(root, error));
