// SPDX-License-Identifier: MIT
//
// What the types promise is there, and what is there has a type: every export, and every method of every class.

import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import test from 'node:test';
import ts from 'typescript';
import * as talus from '../src/index.js';
import * as three from '../src/three.js';

const here = (path) => new URL(`../src/${path}`, import.meta.url);

/** The exported values of declaration files: name to the class's members, or null for functions. */
function declared(files) {
  const values = new Map();
  for (const file of files) {
    const source = ts.createSourceFile(file, readFileSync(here(file), 'utf8'), ts.ScriptTarget.Latest);
    for (const statement of source.statements) {
      if (ts.isFunctionDeclaration(statement)) values.set(statement.name.text, null);
      if (ts.isClassDeclaration(statement)) {
        const members = statement.members.filter((m) => m.name && ts.isIdentifier(m.name));
        values.set(statement.name.text, members.map((m) => ({
          name: m.name.text,
          isStatic: m.modifiers?.some((k) => k.kind === ts.SyntaxKind.StaticKeyword) ?? false,
          isMethod: ts.isMethodDeclaration(m),
        })));
      }
    }
  }
  return values;
}

const types = declared(readdirSync(here('types')).map((file) => `types/${file}`));

test('every declared function and class is exported, and the other way round', () => {
  assert.ok(types.size > 25);
  assert.deepEqual(Object.keys(talus).sort(), [...types.keys()].sort());
});

test('every declared method exists, and every method is declared', () => {
  let methods = 0;
  for (const [name, members] of types) {
    if (members === null) continue;
    const made = talus[name];
    for (const { name: member, isStatic, isMethod } of members.filter((m) => m.isMethod)) {
      const owner = isStatic ? made : made.prototype;
      assert.equal(typeof owner[member], 'function', `${name}.${member}`);
      methods++;
      assert.ok(isMethod);
    }
    const known = new Set(members.map((m) => m.name));
    for (const own of Object.getOwnPropertyNames(made.prototype)) {
      assert.ok(own === 'constructor' || own.startsWith('_') || known.has(own), `${name}.${own} has no type`);
    }
  }
  assert.ok(methods > 80);
});

test('talus/three has what its types say', () => {
  const declaredThree = declared(['three.d.ts']);
  for (const name of declaredThree.keys()) assert.equal(typeof three[name], 'function', name);
  assert.deepEqual(Object.keys(three).sort(), [...declaredThree.keys()].sort());
});
