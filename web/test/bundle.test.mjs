// The npm package as a web project uses it: installed from its tarball, each snippet of its README bundled by vite as it
// stands, opened in the browser, and compared with what the README says it prints.

import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { build } from 'vite';
import { installPackage, snippets } from '../../js/test/snippets.js';
import { ISOLATED, openBrowser } from './harness.mjs';

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm' };
let folder;
let server;
let browser;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'talus-bundle-'));
  installPackage(folder, fileURLToPath(new URL('../node_modules', import.meta.url)));
  const input = {};
  snippets.forEach(({ source }, i) => {
    mkdirSync(join(folder, `${i}`));
    writeFileSync(join(folder, `${i}/main.js`), `${source}\nconsole.log('the end');\n`);
    writeFileSync(join(folder, `${i}/index.html`), '<!doctype html><link rel="icon" href="data:,"><script type="module" src="./main.js"></script>');
    input[i] = join(folder, `${i}/index.html`);
  });
  await build({ root: folder, base: './', logLevel: 'error', configFile: false, build: { rollupOptions: { input }, target: 'es2022' }, worker: { format: 'es' } });
  server = createServer((request, response) => {
    try {
      const bytes = readFileSync(join(folder, 'dist', new URL(request.url, 'http://localhost').pathname));
      response.writeHead(200, { 'content-type': TYPES[extname(request.url)] ?? 'application/octet-stream', ...ISOLATED }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  browser = await openBrowser();
});

after(async () => {
  await browser?.close();
  server?.close();
  rmSync(folder, { recursive: true });
});

snippets.forEach(({ title, printed }, i) => {
  test(`bundled by vite: ${title}`, async () => {
    const page = await browser.newPage();
    const lines = [];
    const ended = new Promise((resolve, reject) => {
      page.on('console', (message) => (message.text() === 'the end' ? resolve() : lines.push(`${message.text()}\n`)));
      page.on('pageerror', reject);
      setTimeout(() => reject(new Error(`no end after 60 s; printed: ${lines.join('')}`)), 60_000).unref();
    });
    await page.goto(`http://127.0.0.1:${server.address().port}/${i}/index.html`);
    await ended;
    assert.equal(lines.join(''), printed);
    await page.close();
  });
});
