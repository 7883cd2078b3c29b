// SPDX-License-Identifier: MIT

import assert from 'node:assert/strict';
import test from 'node:test';
import { Hull, Navmesh, loadPack, pointFromLevel, pointToLevel, savePack } from '../src/index.js';
import { courtyard, errorOf } from './support.js';

test('a file holds what was put in, and gives the same bytes again', () => {
  const { mesh, source, soup } = courtyard();
  const volumes = [{ type: 'cylinder', area: 5, base: [20, -1, 20], radius: 3, height: 9 }];
  const navmesh = Navmesh.bake(mesh, { volumes, cellSize: 0.25 }), hull = Hull.bake(mesh.vertices);
  const { links } = navmesh.findLinks(soup);
  navmesh.addJumpLinks(links);
  const meta = { name: 'a level.obj', sourceVertices: source.vertexCount, sourceTriangles: source.triangleCount, bounds: mesh.bounds(), up: 'z' };
  const bytes = savePack({ meta, soup, hull, navmesh, volumes });
  const pack = loadPack(bytes);
  assert.deepEqual(pack.meta, meta);
  assert.deepEqual(pack.volumes, volumes);
  assert.deepEqual(pack.links, links);
  assert.equal(pack.navmesh.options.cellSize, 0.25);
  assert.equal(pack.navmesh.offMeshLinks().length, links.length);
  assert.deepEqual([...new Set(pack.chunks.map((chunk) => chunk.type))], ['META', 'SOUP', 'HULL', 'NAVM', 'NAVT', 'LINK', 'MARK']);
  assert.deepEqual(savePack(pack), bytes);
  assert.deepEqual(loadPack(savePack({ soup })).navmesh, null);
});

test('what was pruned is in the file, and explained', () => {
  const { mesh } = courtyard();
  const navmesh = Navmesh.bake(mesh, { islandMinArea: 1e6 });
  assert.equal(navmesh.polygonCount, 0);
  const whole = Navmesh.bake(mesh), [corner] = [whole.randomPoint(1).point];
  const reasonsOf = (asked) => asked.why(mesh, corner).reasons.map((reason) => reason.cause);
  assert.deepEqual(reasonsOf(navmesh), ['pruned']);
  const bytes = savePack({ navmesh }), pack = loadPack(bytes);
  assert.deepEqual(pack.chunks.map((chunk) => chunk.type).slice(-2), ['PRUN', 'PRUT']);
  assert.deepEqual(reasonsOf(pack.navmesh), ['pruned']);
  assert.deepEqual(savePack(pack), bytes);
  assert.equal(errorOf(() => Navmesh.bake(mesh, { islandMinArea: 1, obstacles: true, tileSize: 32 })).field, 'obstacles');
});

test('the coordinates of the level are kept', () => {
  const { soup } = courtyard();
  for (const axes of ['y', 'z', 'y-left', 'z-left']) {
    const frame = { origin: [500000.25, -7, 5400000.5], axes };
    const pack = loadPack(savePack({ soup, frame }));
    assert.deepEqual(pack.frame, frame);
    assert.deepEqual(pointToLevel(frame, pointFromLevel(frame, [500001.5, 2, 5400004])), [500001.5, 2, 5400004]);
  }
  assert.deepEqual(pointFromLevel({ origin: [1, 2, 3], axes: 'z' }, [2, 4, 6]), [1, 3, -2]);
  assert.equal(loadPack(savePack({ soup })).frame, null);
  assert.equal(errorOf(() => savePack({ soup, frame: { origin: [0, 0, 0], axes: 'x' } })).field, 'frame.axes');
});

test('links set by hand and areas of triangles are kept', () => {
  const { mesh, soup } = courtyard(), navmesh = Navmesh.bake(mesh);
  const offMeshLinks = [
    { start: [2, 0, 20], end: [20, 5, 20], radius: 0.75, costFactor: 2, fixedCost: 3, flags: 5n, user: 7n, area: 9, bothWays: true },
  ];
  const areas = Uint8Array.from({ length: 100 }, (_, i) => i);
  const bytes = savePack({ soup, navmesh, offMeshLinks, areas }), pack = loadPack(bytes);
  assert.deepEqual(pack.offMeshLinks, offMeshLinks);
  assert.deepEqual(pack.areas, areas);
  const { start, end, area, user, bothWays } = pack.navmesh.offMeshLinks()[0];
  assert.deepEqual({ start, end, area, user, bothWays }, { start: [2, 0, 20], end: [20, 5, 20], area: 9, user: 7n, bothWays: true });
  assert.deepEqual(savePack(pack), bytes);
  assert.deepEqual(loadPack(savePack({ soup })).offMeshLinks, []); // not those of the file before
  assert.equal(errorOf(() => savePack({ offMeshLinks: [{ start: [0, 0, 0], end: [1, 0, 0], radius: -1 }] })).result, 'TL_ERR_ARGUMENT');
});

test('every damage is refused', () => {
  const bytes = savePack({ soup: courtyard().soup });
  assert.equal(errorOf(() => loadPack(new Uint8Array(64))).result, 'TL_ERR_MAGIC');
  assert.equal(errorOf(() => loadPack(bytes.slice(0, -64))).result, 'TL_ERR_TRUNCATED');
  for (let at = 200; at < bytes.length; at += 9973) {
    const damaged = bytes.slice();
    damaged[at] ^= 4;
    assert.ok(['TL_ERR_HASH', 'TL_ERR_CORRUPT'].includes(errorOf(() => loadPack(damaged)).result), String(at));
  }
  assert.equal(errorOf(() => loadPack(new Uint8Array(0))).result.startsWith('TL_ERR_'), true);
});
