// SPDX-License-Identifier: MIT
//
// The README's snippets, and the package as its users get it: packed, then installed into an empty folder.

import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('..', import.meta.url));
const readme = readFileSync(join(root, 'README.md'), 'utf8');

/** A title, a source and what it prints for each snippet; a section may have several. */
export const snippets = [];
let title = '';
for (const [, heading, source, printed] of readme.matchAll(/^## (.*)$|^```js\n([^]*?)^```\n\n```text\n([^]*?)^```/gm)) {
  if (heading !== undefined) title = heading;
  else snippets.push({ title, source, printed });
}

/** How many sources there are: each must be a snippet. */
export const sourceCount = readme.match(/^```js$/gm).length;

/** Installs the tarball of `npm pack`, and three.js from a folder of modules, as that is the user's own. */
export function installPackage(folder, modules = join(root, 'node_modules')) {
  execFileSync('npm', ['pack', '--silent', '--pack-destination', folder], { cwd: root, stdio: 'pipe' });
  const tarball = readdirSync(folder).find((name) => name.endsWith('.tgz'));
  writeFileSync(join(folder, 'package.json'), '{ "type": "module" }');
  execFileSync('npm', ['install', '--silent', '--offline', '--no-audit', '--no-fund', '--legacy-peer-deps', tarball], { cwd: folder, stdio: 'pipe' });
  mkdirSync(join(folder, 'node_modules/three'), { recursive: true });
  cpSync(join(modules, 'three'), join(folder, 'node_modules/three'), { recursive: true });
}
