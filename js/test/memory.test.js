// SPDX-License-Identifier: MIT
//
// Memory: what is freed, what grows, what runs out.

import assert from 'node:assert/strict';
import test from 'node:test';
import { Hull, Mesh, Navmesh, Soup, memoryBytes, sampleLevel } from '../src/index.js';
import { courtyard, errorOf, floor } from './support.js';

test('a freed object says so; a second free does nothing', () => {
  const objects = [Soup.bake(floor()), Hull.bake(courtyard().mesh.vertices), Navmesh.bake(floor())];
  const calls = [(o) => o.castRay(0, 1, 0, 0, -1, 0), (o) => o.support(1, 0, 0), (o) => o.findNearest([0, 0, 0])];
  objects.forEach((object, i) => {
    assert.equal(object.freed, false);
    object.free();
    object.free();
    assert.equal(object.freed, true);
    assert.equal(errorOf(() => calls[i](object)).result, 'TL_ERR_STALE');
  });
});

test('baking and freeing again and again does not grow the memory', () => {
  const { mesh, source } = courtyard();
  const round = () => {
    const soup = Soup.bake(source), navmesh = Navmesh.bake(mesh), hull = Hull.bake(mesh.vertices);
    navmesh.findPath([2, 0, 20], [20, 5, 20]);
    [soup, navmesh, hull].forEach((object) => object.free());
    errorOf(() => Navmesh.bake(mesh, { cellSize: -1 }));
    assert.throws(() => Navmesh.bake(mesh, { onProgress: () => { throw new RangeError(); } }), RangeError);
  };
  for (let i = 0; i < 3; i++) round();
  const before = memoryBytes();
  for (let i = 0; i < 20; i++) round();
  assert.equal(memoryBytes(), before);
});

test('arrays and objects outlive growth of the memory', () => {
  const { soup } = courtyard();
  const pairs = soup.pairs(), hit = soup.castRay(20, 10, 20, 0, -1, 0), before = memoryBytes(), corner = pairs.corners[0];
  const city = sampleLevel('city', { triangles: 150000 });
  const large = Soup.bake(city);
  assert.ok(memoryBytes() > before);
  assert.equal(pairs.corners[0], corner);
  assert.equal(hit.t, 5);
  assert.equal(soup.castRay(20, 10, 20, 0, -1, 0).t, 5);
  // Views of the module's memory are made anew within a call too: progress may come after growth.
  const stages = [];
  large.free();
  const navmesh = Navmesh.bake(city.weld().mesh, { onProgress: (stage) => stages.push(stage) });
  assert.ok(stages.every((stage) => /^[a-z ]+$/.test(stage)));
  navmesh.free();
});

test('memory that runs out is an error, and all goes on', () => {
  const mesh = new Mesh([0, 0, 0, 0, 0, 5e4, 5e4, 0, 0], [0, 1, 2]);
  const error = errorOf(() => Navmesh.bake(mesh, { cellSize: 1.6, cellHeight: 0.2, agentRadius: 0 }));
  assert.equal(error.result, 'TL_ERR_MEMORY');
  assert.equal(courtyard().soup.castRay(20, 10, 20, 0, -1, 0).t, 5);
});
