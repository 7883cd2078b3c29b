// SPDX-License-Identifier: MIT
//
// What is packed is what works: the tarball is installed into an empty folder, and each snippet of the README runs there
// as it stands, prints what the README says, and is TypeScript that the strictest settings accept.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync } from 'node:zlib';
import ts from 'typescript';
import { installPackage, snippets, sourceCount } from './snippets.js';

const folder = mkdtempSync(join(tmpdir(), 'talus-package-'));
process.on('exit', () => rmSync(folder, { recursive: true }));
installPackage(folder);

test('the tarball holds the modules, the types and nothing of the tests', () => {
  const packed = join(folder, 'node_modules/talus');
  assert.deepEqual(readdirSync(packed).sort(), ['LICENSE', 'README.md', 'dist', 'package.json', 'src']);
  assert.deepEqual(readdirSync(join(packed, 'dist')).sort(), ['talus-queries.wasm', 'talus-simd.wasm', 'talus-threads.wasm', 'talus.wasm']);
});

test('the module of queries is a small download', () => {
  const bytes = brotliCompressSync(readFileSync(join(folder, 'node_modules/talus/dist/talus-queries.wasm')));
  assert.ok(bytes.length <= 160 * 1024, `${bytes.length} bytes`);
});

test('the README has snippets, all with what they print', () => {
  assert.ok(snippets.length >= 7);
  assert.equal(snippets.length, sourceCount);
});

snippets.forEach(({ title, source, printed }, i) => {
  test(`README: ${title}`, () => {
    writeFileSync(join(folder, `snippet${i}.js`), source);
    assert.equal(execFileSync('node', [`snippet${i}.js`], { cwd: folder, encoding: 'utf8', timeout: 120000 }), printed);
  });
});

test('the README is strict TypeScript as it stands', () => {
  symlinkSync(fileURLToPath(new URL('../node_modules/@types', import.meta.url)), join(folder, 'node_modules/@types'));
  const files = snippets.map(({ source }, i) => {
    const file = join(folder, `typed${i}.ts`);
    writeFileSync(file, source);
    return file;
  });
  const program = ts.createProgram(files, {
    strict: true, noUncheckedIndexedAccess: true, noEmit: true, skipLibCheck: true, types: [], target: ts.ScriptTarget.ES2022,
    module: ts.ModuleKind.NodeNext, moduleResolution: ts.ModuleResolutionKind.NodeNext,
    lib: ['lib.es2022.d.ts', 'lib.esnext.disposable.d.ts', 'lib.dom.d.ts'],
  });
  const names = { getCanonicalFileName: (name) => name, getCurrentDirectory: () => folder, getNewLine: () => '\n' };
  assert.equal(ts.formatDiagnostics(ts.getPreEmitDiagnostics(program), names), '');
});
