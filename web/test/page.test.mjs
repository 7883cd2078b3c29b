// The page by itself: opened from disk, and in browsers that lack something.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
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

test('does without SIMD', async () => {
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.addInitScript(() => { WebAssembly.validate = () => false; });
  await page.goto(`${server.url}#level=sample:courtyard&cellSize=0.5`);
  const viewer = new Viewer(page, context);
  await viewer.ready();
  assert.equal(await viewer.ask(({ simd }) => simd), false);
  assert.ok(await viewer.ask(({ app }) => app.session.get().bake.polygons > 10));
  await viewer.close();
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
