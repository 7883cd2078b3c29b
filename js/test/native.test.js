// SPDX-License-Identifier: MIT
//
// The same bytes as natively: each built-in level, and each level of TALUS_DATA_DIR, is baked by the talus command
// (TALUS_COMMAND) and by the package, and the files are compared: soup, hull, tiles, links and all.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { Hull, Mesh, Navmesh, Soup, loadPack, pointFromLevel, sampleLevel, sampleLevels, savePack } from '../src/index.js';
import './support.js';

const command = process.env.TALUS_COMMAND;
const folder = mkdtempSync(join(tmpdir(), 'talus-js-'));
process.on('exit', () => rmSync(folder, { recursive: true }));

/** A mesh as OBJ: decimals that are read back as the same floats. */
function writeObj(path, mesh) {
  const lines = [];
  for (let i = 0; i < mesh.vertexCount; i++) lines.push(`v ${mesh.vertices.subarray(3 * i, 3 * i + 3).join(' ')}`);
  for (let i = 0; i < mesh.indices.length; i += 3) lines.push(`f ${mesh.indices.subarray(i, i + 3).map((k) => k + 1).join(' ')}`);
  writeFileSync(path, `${lines.join('\n')}\n`);
}

/** The triangles of an OBJ file: polygons as fans, no materials. */
function readObj(path) {
  const vertices = [], indices = [];
  for (const line of readFileSync(path, 'utf8').split('\n')) {
    const words = line.trim().split(/\s+/);
    if (words[0] === 'v') vertices.push(...words.slice(1, 4).map(Number));
    if (words[0] !== 'f') continue;
    const corners = words.slice(1).map((word) => parseInt(word, 10)).map((k) => (k < 0 ? vertices.length / 3 + k : k - 1));
    for (let i = 2; i < corners.length; i++) indices.push(corners[0], corners[i - 1], corners[i]);
  }
  return new Mesh(vertices, indices);
}

function compare(mesh, tileSize) {
  const obj = join(folder, 'level.obj'), out = join(folder, 'level.talus');
  writeObj(obj, mesh);
  const run = spawnSync(command, ['bake', obj, '-o', out, '--hull', '--tile-size', String(tileSize)], { encoding: 'utf8' });
  const welded = mesh.weld().mesh;
  if (run.status !== 0) {
    // The one failure that a level may have: the command says so and writes nothing.
    assert.match(run.stderr, /nothing is walkable/);
    assert.equal(Navmesh.bake(welded, { tileSize }).polygonCount, 0);
    return;
  }
  const native = new Uint8Array(readFileSync(out));
  const soup = Soup.bake(mesh), hull = Hull.bake(welded.vertices), navmesh = Navmesh.bake(welded, { tileSize });
  const bytes = savePack({
    meta: { name: 'level.obj', sourceVertices: mesh.vertexCount, sourceTriangles: mesh.triangleCount, bounds: navmesh.options.bounds, up: 'y' },
    soup, hull, navmesh,
  });
  const read = loadPack(native);
  assert.ok(read.navmesh.polygonCount > 0);
  assert.deepEqual(read.soup.toBytes(), soup.toBytes());
  assert.deepEqual(read.hull.toBytes(), hull.toBytes());
  assert.equal(Buffer.compare(bytes, native), 0, 'the files differ');
  [soup, hull, navmesh, read.soup, read.hull, read.navmesh].forEach((object) => object.free());
}

test('the command is there', { skip: command ? false : 'TALUS_COMMAND is not set' }, () => assert.ok(existsSync(command)));

for (const { name } of command ? sampleLevels() : []) {
  test(`${name}: the same file`, () => compare(sampleLevel(name), 0));
}
if (command) test('a pruned level far away: the same file', () => {
  const mesh = sampleLevel('courtyard'), obj = join(folder, 'far.obj'), out = join(folder, 'far.talus');
  writeObj(obj, mesh);
  const words = ['bake', obj, '-o', out, '--up', 'z-left', '--origin', '1,-2,3', '--island-min-area', '40'];
  const run = spawnSync(command, words, { encoding: 'utf8' });
  assert.equal(run.status, 0, run.stderr);
  const frame = { origin: [1, -2, 3], axes: 'z-left' };
  const turned = new Float32Array(mesh.vertices.length);
  for (let i = 0; i < turned.length; i += 3) turned.set(pointFromLevel(frame, mesh.vertices.subarray(i, i + 3)), i);
  const baked = new Mesh(turned, mesh.indices.map((_, i, all) => all[i % 3 === 0 ? i : i % 3 === 1 ? i + 1 : i - 1]));
  const { mesh: welded } = baked.weld();
  const soup = Soup.bake(baked), navmesh = Navmesh.bake(welded, { islandMinArea: 40 });
  const meta = { name: 'far.obj', sourceVertices: mesh.vertexCount, sourceTriangles: mesh.triangleCount, bounds: navmesh.options.bounds, up: 'y' };
  const bytes = savePack({ meta, frame, soup, navmesh });
  assert.ok(loadPack(bytes).chunks.some(({ type }) => type === 'PRUN'));
  assert.equal(Buffer.compare(bytes, new Uint8Array(readFileSync(out))), 0, 'the files differ');
});
if (command) test('dungeon in tiles: the same file', () => compare(sampleLevel('dungeon', { seed: 3 }), 48));

const levels = process.env.TALUS_DATA_DIR ? join(process.env.TALUS_DATA_DIR, 'levels') : '';
if (command && levels && existsSync(levels)) {
  for (const file of readdirSync(levels).filter((name) => name.endsWith('.obj'))) {
    test(`${file}: the same file`, () => compare(readObj(join(levels, file)), 0));
  }
}
