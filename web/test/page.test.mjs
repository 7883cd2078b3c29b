// The page by itself: opened from disk, and in browsers that lack something.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { execFileSync, spawn } from 'node:child_process';
import { once } from 'node:events';
import { mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { fileUrl, openBrowser, PAGE, serve, SHOTS, Viewer } from './harness.mjs';
import { TALUS } from './native.mjs';

let browser;
let server;
let folder;

before(async () => {
  browser = await openBrowser();
  server = await serve();
  folder = mkdtempSync(join(tmpdir(), 'talus-page-'));
});
after(async () => {
  await browser?.close();
  server?.close();
  if (folder) rmSync(folder, { recursive: true });
});

test('is one file of a sane size, that names no other', () => {
  const { size } = statSync(PAGE);
  assert.ok(size < 6e6, `${size} bytes`);
  const html = readFileSync(PAGE, 'utf8');
  assert.equal(html.split('<!--talus-level-->').length, 2, 'one mark for talus view');
  const outside = html.match(/<(?:script|link|img)[^>]+(?:src|href)="(?!data:)[^"]+"/g);
  assert.equal(outside, null);
});

test('opens from disk with a level and its bake inside', { skip: TALUS ? false : 'the command is not built' }, async () => {
  const env = { ...process.env, TALUS_VIEWER: PAGE };
  const run = (...words) => execFileSync(TALUS, words, { cwd: folder, env });
  run('sample', 'courtyard', '-o', 'courtyard.obj');
  run('view', 'courtyard.obj', '-o', 'page.html', '--agent-radius', '0.4', '--tile-size', '48', '--from', '2,0,20', '--to', '20,5,20');
  const viewer = await Viewer.open(browser, fileUrl(join(folder, 'page.html')));
  assert.doesNotMatch(await viewer.page.locator('body').innerText(), /without SIMD/);
  const asked = [];
  viewer.page.on('request', (request) => asked.push(request.url()));
  await viewer.ready();
  await viewer.page.waitForSelector('#path-status.good');
  assert.deepEqual(await viewer.ask(({ app }) => {
    const { settings } = app.view.get();
    return [settings.agentRadius, settings.tileSize].map((v) => Math.round(1e4 * v) / 1e4);
  }), [0.4, 48]);
  assert.match(await viewer.page.locator('#total').innerText(), /as baked/);
  assert.equal(asked.filter((url) => !/^(data|blob):/.test(url)).length, 0, `asked for ${asked}`);
  await viewer.shot('from-disk');
  // It bakes there too.
  await viewer.ask(({ app }) => app.view.set({ settings: { ...app.view.get().settings, agentRadius: 1.2 } }));
  await viewer.until(({ app }) => app.session.get().bake?.milliseconds > 0 && !app.session.get().baking);
  await viewer.close();
});

test('shows a level with nothing walkable, with its settings', { skip: TALUS ? false : 'the command is not built' }, async () => {
  execFileSync(TALUS, ['sample', 'courtyard', '-o', 'courtyard.obj'], { cwd: folder });
  execFileSync(TALUS, ['view', 'courtyard.obj', '-o', 'empty.html', '--region-min-size', '400'],
    { cwd: folder, env: { ...process.env, TALUS_VIEWER: PAGE }, stdio: 'pipe' });
  const viewer = await Viewer.open(browser, fileUrl(join(folder, 'empty.html')), '#tool=why');
  await viewer.until(({ app }) => app.session.get().level && !app.session.get().baking);
  assert.equal(await viewer.ask(({ app }) => app.view.get().settings.regionMinSize), 400);
  await viewer.page.waitForSelector('#message.error');
  await viewer.ask(({ app }) => app.view.set({ why: [12, 0, 12] }));
  await viewer.page.waitForSelector('#why-text.bad');
  assert.match(await viewer.page.locator('#tool-panel').innerText(), /Min size: 400 →/);
  await viewer.shot('nothing-walkable');
  await viewer.close();
});

async function fatalWords(page) {
  await page.waitForSelector('#fatal');
  return page.locator('#fatal').innerText();
}

test('says what is missing without WebGL 2', async () => {
  const poor = await openBrowser(['--no-sandbox', '--disable-3d-apis', '--disable-gpu', '--disable-software-rasterizer']);
  const page = await poor.newPage();
  await page.goto(server.url);
  assert.match(await fatalWords(page), /WebGL 2/);
  await page.screenshot({ path: `${SHOTS}no-webgl.png` });
  await poor.close();
});

test('says what is missing without WebAssembly', async () => {
  const page = await browser.newPage();
  await page.addInitScript(() => { delete window.WebAssembly; });
  await page.goto(server.url);
  assert.match(await fatalWords(page), /WebAssembly/);
  await page.screenshot({ path: `${SHOTS}no-wasm.png` });
  await page.close();
});

test('says so where the browser cannot read the script', async () => {
  const page = await browser.newPage();
  // Syntax of a later year, as ours is for an old browser.
  const html = readFileSync(PAGE, 'utf8').replace('<script type="module">', '<script type="module">let let = of the future;');
  await page.route(server.url, (route) => route.fulfill({ contentType: 'text/html', body: html }));
  await page.goto(server.url);
  await page.getByText('This browser cannot read it').waitFor({ state: 'visible' });
  await page.screenshot({ path: `${SHOTS}old-browser.png` });
  await page.close();
});

test('does without SIMD, and says so', async () => {
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.addInitScript(() => { WebAssembly.validate = () => false; });
  await page.goto(`${server.url}#level=sample:courtyard&cellSize=0.5`);
  const viewer = new Viewer(page, context);
  await viewer.ready();
  assert.equal(await viewer.ask(({ simd }) => simd), false);
  const total = page.locator('#total');
  assert.match(await total.innerText(), /^bake .*, without SIMD$/);
  assert.match(await total.getAttribute('title'), /lacks WebAssembly SIMD/);
  await viewer.shot('no-simd');
  assert.ok(await viewer.ask(({ app }) => app.session.get().bake.polygons > 10));
  await viewer.close();
});

/** The server of `make viewer`. */
async function startOwnServer() {
  const own = spawn('node', [fileURLToPath(new URL('../serve.mjs', import.meta.url))], { env: { ...process.env, PORT: '0' }, stdio: ['ignore', 'pipe', 'inherit'] });
  const [line] = await once(own.stdout, 'data');
  return { url: String(line).match(/http:\S+/)[0], close: () => own.kill() };
}

/** Opens the page on a machine of three processors, and gives the bytes of its tiles. */
async function bakedTiles(url, before) {
  const context = await browser.newContext();
  const page = await context.newPage();
  const viewer = new Viewer(page, context);
  page.on('console', (message) => { if (message.type() === 'error') viewer.errors.push(message.text()); });
  await page.addInitScript(() => { Object.defineProperty(navigator, 'hardwareConcurrency', { value: 3 }); });
  if (before) await before(page);
  await page.goto(`${url}#level=sample:dungeon&tileSize=48`);
  await viewer.ready();
  const answer = await viewer.ask(async ({ app }) => {
    const bytes = new Uint8Array(await app.engine.call('save'));
    const hash = new Uint8Array(await crypto.subtle.digest('SHA-256', bytes)).join();
    return { hash, threads: app.session.get().bake.threads, total: document.getElementById('total').innerText, why: document.getElementById('total').title };
  });
  return { viewer, answer };
}

test('bakes on several threads where the server isolates the page, the same bytes', async () => {
  const own = await startOwnServer();
  const many = await bakedTiles(own.url);
  assert.deepEqual(many.answer.threads, { count: 3, reason: null });
  assert.match(many.answer.total, /, 3 threads$/);
  await many.viewer.shot('threads');
  // A bake that is cancelled ends its threads, and the next one has its own.
  await many.viewer.ask(({ app }) => app.view.set({ settings: { ...app.view.get().settings, cellSize: 0.05 } }));
  await many.viewer.until(({ app }) => app.session.get().baking);
  await many.viewer.ask(({ app }) => app.cancel());
  await many.viewer.ask(({ app }) => app.view.set({ settings: { ...app.view.get().settings, cellSize: 0.5 } }));
  await many.viewer.until(({ app }) => !app.session.get().baking && app.session.get().bake.threads.count === 3);
  await many.viewer.close();
  const one = await bakedTiles(server.url);
  assert.equal(one.answer.threads.count, 1);
  assert.match(one.answer.why, /server that isolates the page/);
  assert.equal(many.answer.hash, one.answer.hash);
  await one.viewer.close();
  const missing = await bakedTiles(own.url, (page) => page.route('**/talus-threads.wasm', (route) => route.fulfill({ status: 204 })));
  assert.match(missing.answer.why, /talus-threads.wasm, beside the page, could not be loaded/);
  await missing.viewer.close();
  own.close();
});

test('tells of memory that ran out, and goes on', async () => {
  const viewer = await Viewer.open(browser, server.url, '#level=sample:courtyard&cellSize=0.5');
  await viewer.ready();
  // A thousand million columns: within the library's limit, and more than a browser has memory for.
  await viewer.ask(({ app }) => app.view.set({ settings: { ...app.view.get().settings, cellSize: 0.00125 } }));
  await viewer.page.waitForSelector('#message.error', { timeout: 60_000 });
  const words = await viewer.page.locator('#message').innerText();
  assert.match(words, /memory|limit|large|columns/i);
  assert.ok(await viewer.ask(({ app }) => app.session.get().bake.polygons > 10), 'what was baked before is shown');
  await viewer.shot('out-of-memory');
  await viewer.close();
});
