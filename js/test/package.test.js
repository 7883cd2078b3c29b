// SPDX-License-Identifier: MIT
//
// What is packed is what works: the tarball is installed into an empty folder, and each snippet of the README runs there
// as it stands and prints what the README says.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('..', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'talus-package-'));
process.on('exit', () => rmSync(folder, { recursive: true }));

execFileSync('npm', ['pack', '--silent', '--pack-destination', folder], { cwd: root, stdio: 'pipe' });
const tarball = readdirSync(folder).find((name) => name.endsWith('.tgz'));
writeFileSync(join(folder, 'package.json'), '{ "type": "module" }');
execFileSync('npm', ['install', '--silent', '--offline', '--no-audit', '--no-fund', '--legacy-peer-deps', tarball], { cwd: folder, stdio: 'pipe' });
// three.js is the user's own.
mkdirSync(join(folder, 'node_modules/three'), { recursive: true });
cpSync(join(root, 'node_modules/three'), join(folder, 'node_modules/three'), { recursive: true });

test('the tarball holds the modules, the types and nothing of the tests', () => {
  const packed = join(folder, 'node_modules/talus');
  assert.deepEqual(readdirSync(packed).sort(), ['LICENSE', 'README.md', 'dist', 'package.json', 'src']);
  assert.deepEqual(readdirSync(join(packed, 'dist')).sort(), ['talus-simd.wasm', 'talus.wasm']);
});

const blocks = [...readFileSync(join(root, 'README.md'), 'utf8').matchAll(/^## (.*)$[^]*?^```js\n([^]*?)^```\n\n```text\n([^]*?)^```/gm)];
const sources = readFileSync(join(root, 'README.md'), 'utf8').match(/^```js$/gm).length;

test('the README has snippets, all with what they print', () => {
  assert.ok(blocks.length >= 7);
  assert.equal(blocks.length, sources);
});

blocks.forEach(([, title, source, printed], i) => {
  test(`README: ${title}`, () => {
    writeFileSync(join(folder, `snippet${i}.js`), source);
    assert.equal(execFileSync('node', [`snippet${i}.js`], { cwd: folder, encoding: 'utf8', timeout: 120000 }), printed);
  });
});
