// SPDX-License-Identifier: MIT

import assert from 'node:assert/strict';
import test from 'node:test';
import { Hull, Mesh, Navmesh, Sight, bakeStages, defaultNavOptions, jumpLinkPoint, navmeshFromDetour, navmeshToDetour, polygonSteps, tileGrid } from '../src/index.js';
import { courtyard, cube, errorOf, floor } from './support.js';

const START = [2, 0, 20], GOAL = [20, 5, 20];

test('a bake, its options, its report', () => {
  const { mesh, navmesh } = courtyard();
  assert.equal(defaultNavOptions().cellSize, 0.3);
  assert.equal(navmesh.options.agentRadius, 0.6);
  assert.equal(navmesh.report.polygonCount, navmesh.polygonCount);
  assert.ok(Object.keys(navmesh.report.times).length >= 5);
  assert.deepEqual(tileGrid({ tileSize: 64 }, mesh.bounds()), { x: 3, z: 3 });
  const bad = errorOf(() => Navmesh.bake(mesh, { cellSize: -1 }));
  assert.deepEqual([bad.result, bad.field], ['TL_ERR_ARGUMENT', 'cellSize']);
  assert.equal(errorOf(() => Navmesh.bake(mesh, { partition: 'best' })).field, 'partition');
  assert.equal(errorOf(() => Navmesh.bake(mesh, { cellSize: '1' })).field, 'cellSize');
  assert.equal(errorOf(() => Navmesh.bake(new Mesh([]))).result, 'TL_ERR_EMPTY');
});

test('progress, and how to stop', () => {
  const { mesh } = courtyard(), stages = new Set();
  Navmesh.bake(mesh, { onProgress: (stage) => { stages.add(stage); } });
  assert.ok(stages.has('rasterize') && stages.has('contours'));
  assert.throws(() => Navmesh.bake(mesh, { onProgress: () => { throw new RangeError('mine'); } }), RangeError);
  const stop = new AbortController();
  assert.throws(() => Navmesh.bake(mesh, { signal: stop.signal, onProgress: () => stop.abort(new Error('enough')) }), /enough/);
  assert.throws(() => Navmesh.bake(mesh, { signal: AbortSignal.abort() }), { name: 'AbortError' });
  assert.ok(Navmesh.bake(mesh).polygonCount > 0);
});

test('paths', () => {
  const { navmesh } = courtyard();
  const path = navmesh.findPath(START, GOAL, { polygons: true });
  assert.equal(path.status, 'complete');
  assert.ok(path.length >= path.lowerBound - 1e-6 && path.length - path.lowerBound < 1e-3 && path.surfaceLength > path.length);
  assert.equal(path.corners.length, 3 * path.cornerPolygons.length);
  assert.equal(path.cornerFlags[0], 1);
  assert.ok(path.polygons.length > 5);
  const given = navmesh.findPath(path.start, path.goal);
  assert.equal(given.length, path.length);
  assert.equal(given.polygons.length, 0);
  assert.equal(navmesh.findPath([500, 0, 0], GOAL), null);
  assert.equal(navmesh.isReachable(START, GOAL), true);
  const route = navmesh.findRoute(START, GOAL, { filter: { areaCost: { 63: 2 } } });
  assert.ok(route.cost > 1.99 * path.length && route.cost < 2.4 * path.length);
  assert.equal(navmesh.findWidePath(START, GOAL, 0.7).status, 'complete');
  assert.equal(navmesh.findWidePath(START, GOAL, 30).status, 'start blocked');
  assert.equal(navmesh.findPath(START, GOAL, { filter: { excludeFlags: 1n } }), null);
  assert.equal(navmesh.maxNodes, 2 ** 30); // no search is too large unless it is told so
  navmesh.maxNodes = 4;
  assert.equal(navmesh.findPath(START, GOAL).status, 'out of nodes');
  assert.equal(errorOf(() => navmesh.isReachable(START, GOAL)).result, 'TL_ERR_NODES');
  navmesh.maxNodes = 2 ** 30;
  const prepared = navmesh.prepare();
  assert.equal(prepared.kind, 'table');
  assert.ok(Math.abs(navmesh.findPath(START, GOAL).length - path.length) < 1e-4);
});

test('points and what is around', () => {
  const { navmesh } = courtyard();
  const place = navmesh.findNearest(START);
  assert.ok(Math.abs(place.point[0] - 2) < 1e-6);
  assert.equal(navmesh.findNearest([500, 0, 0]), null);
  assert.ok(Math.abs(navmesh.height(place.polygon, 2, 20) - place.point[1]) < 1e-5);
  assert.equal(navmesh.closestPoint(place.polygon, START).inside, true);
  assert.equal(navmesh.island(place.polygon), navmesh.island(navmesh.findNearest(GOAL).polygon));
  assert.equal(errorOf(() => navmesh.height(1n << 60n, 0, 0)).result, 'TL_ERR_STALE');
  assert.ok(navmesh.findNearestReachable(START, [500, 0, 20]).point[0] < 41);
  assert.equal(navmesh.castRay(START, [-50, 0, 20]).hit, true);
  assert.equal(navmesh.moveAlongSurface(START, [2, 0, 20.1]).polygon !== 0n, true);
  assert.ok(navmesh.findWall(START, 10).distance > 0);
  assert.equal(navmesh.findWall(START, 0.001), null);
  let n = 0;
  assert.notEqual(navmesh.randomPoint({ random: () => (n++ % 7) / 7 }), null);
  assert.notEqual(navmesh.randomPoint({ around: START, radius: 3 }), null);
  assert.notEqual(navmesh.findWidePlace(START, 0.7), null);
});

test('tiles: bytes go round, rebakes give the bytes of a bake', () => {
  const { mesh } = courtyard(), options = { tileSize: 48, bounds: mesh.bounds() };
  const tiled = Navmesh.bake(mesh, options);
  const tiles = tiled.tiles().map((_, i) => tiled.tileBytes(i));
  assert.ok(tiles.length > 4);
  const again = Navmesh.fromTiles(tiles, tiled.options);
  assert.equal(again.findPath(START, GOAL).length, tiled.findPath(START, GOAL).length);
  assert.equal(errorOf(() => Navmesh.fromTiles([tiles[0].slice(0, 64)])).result, 'TL_ERR_TRUNCATED');
  assert.equal(errorOf(() => tiled.tileBytes(1000)).field, 'index');
  const box = new Mesh([...mesh.vertices, 10, 0, 20, 12, 0, 20, 11, 3, 20, 11, 0, 22],
                       [...mesh.indices, ...[0, 1, 2, 0, 2, 3, 1, 3, 2].map((i) => i + mesh.vertexCount)]);
  const count = again.rebake(box, { min: [10, 0, 20], max: [12, 3, 22] });
  assert.ok(count > 0 && count < tiles.length);
  const whole = Navmesh.bake(box, options);
  assert.deepEqual(again.tiles().map((_, i) => again.tileBytes(i)), whole.tiles().map((_, i) => whole.tileBytes(i)));
  assert.notDeepEqual(again.tileBytes(0).length + again.polygonCount, tiled.tileBytes(0).length + tiled.polygonCount);
});

test('areas, volumes, pruning', () => {
  const mesh = new Mesh(floor().vertices, floor().indices, [0, 1]);
  const halves = Navmesh.bake(mesh, { materialAreas: [63, 7] });
  assert.deepEqual([...new Set(halves.polygons().area)].sort(), [7, 63].sort());
  const marked = Navmesh.bake(mesh, { volumes: [{ type: 'box', area: 9, min: [-2, -1, -2], max: [2, 1, 2] },
    { type: 'cylinder', area: 8, base: [3, -1, 3], radius: 1, height: 3 },
    { type: 'polygon', area: 0, points: [-4, 0, -4, -3, 0, -4, -3, 0, -3], minY: -1, maxY: 1 }] });
  assert.ok(marked.polygons().area.includes(9) && marked.polygons().area.includes(8));
  assert.equal(Navmesh.bake(mesh, { islandMinArea: 1000 }).polygonCount, 0);
  assert.equal(errorOf(() => Navmesh.bake(mesh, { reachableFrom: [[100, 0, 100]] })).element, 'seed');
  assert.equal(errorOf(() => Navmesh.bake(mesh, { areas: new Uint8Array(1) })).field, 'areas');
  assert.equal(errorOf(() => Navmesh.bake(mesh, { volumes: [{ type: 'ball', area: 1 }] })).field, 'volumes[0].type');
});

test('obstacles come and go', () => {
  const { mesh } = courtyard();
  const navmesh = Navmesh.bake(mesh, { tileSize: 48, obstacles: true });
  const before = navmesh.findPath(START, GOAL).length, bytes = () => navmesh.tiles().map((_, i) => navmesh.tileBytes(i));
  const empty = bytes();
  const id = navmesh.addObstacle({ type: 'box', base: [2, 0, 18], height: 2, halfX: 2.5, halfZ: 0.5, angle: 0.3 });
  while (navmesh.updateObstacles(1) > 0);
  assert.notDeepEqual(bytes(), empty);
  navmesh.moveObstacle(id, { type: 'cylinder', base: [2, 0, 22], height: 2, radius: 1 });
  navmesh.updateObstacles();
  navmesh.removeObstacle(id);
  assert.equal(navmesh.updateObstacles(), 0);
  assert.equal(navmesh.findPath(START, GOAL).length, before);
  assert.deepEqual(bytes(), empty);
  assert.equal(errorOf(() => navmesh.removeObstacle(id)).result, 'TL_ERR_STALE');
  assert.equal(errorOf(() => courtyard().navmesh.addObstacle({ type: 'cylinder', base: START, height: 1, radius: 1 })).field, 'obstacles');
  assert.equal(errorOf(() => Navmesh.bake(mesh, { obstacles: true })).field, 'tileSize');
});

test('obstacles of any convex shape at any pose', () => {
  const { mesh } = courtyard(), navmesh = Navmesh.bake(mesh, { tileSize: 48, obstacles: true });
  const bytes = () => navmesh.tiles().map((_, i) => navmesh.tileBytes(i)), put = (obstacle) => {
    const id = navmesh.addObstacle(obstacle);
    navmesh.updateObstacles();
    const baked = bytes();
    navmesh.removeObstacle(id);
    navmesh.updateObstacles();
    return baked;
  };
  const empty = bytes(), crate = { type: 'box', halfExtents: [2.5, 1, 0.5] }, pose = { position: [2, 1, 18] };
  const corners = cube().vertices.map((x, i) => x * crate.halfExtents[i % 3]), hull = Hull.bake(corners);
  const upright = put({ type: 'box', base: [2, 0, 18], height: 2, halfX: 2.5, halfZ: 0.5 });
  assert.deepEqual(put({ type: 'convex', shape: crate, pose }), upright);
  assert.deepEqual(put({ type: 'convex', shape: hull, pose }), upright);
  const log = put({ type: 'convex', shape: { type: 'capsule', a: [0, 0.3, 16], b: [4, 0.3, 20], radius: 0.3 } });
  assert.notDeepEqual(log, empty);
  assert.notDeepEqual(put({ type: 'convex', shape: crate, pose, area: 5 }), upright);
  assert.deepEqual(bytes(), empty);
  assert.equal(errorOf(() => put({ type: 'convex', shape: { type: 'points', points: corners }, pose })).field, 'shape');
  assert.equal(errorOf(() => put({ type: 'convex', pose })).field, 'shape');
  // A hull that is freed stays until its obstacle is gone.
  const id = navmesh.addObstacle({ type: 'convex', shape: hull, pose });
  hull.free();
  navmesh.updateObstacles();
  assert.deepEqual(bytes(), upright);
  navmesh.moveObstacle(id, { type: 'convex', shape: crate, pose });
  navmesh.updateObstacles();
  assert.deepEqual(bytes(), upright);
  navmesh.free();
});

test('to Detour and back', () => {
  const { mesh } = courtyard(), navmesh = Navmesh.bake(mesh, { maxVertsPerPoly: 6, tileSize: 64 });
  navmesh.addOffMeshLink({ start: [2, 0, 20], end: [4, 0, 20], radius: 1, user: 7n, flags: 3n, area: 5, bothWays: true });
  for (const refBits of [32, 64]) {
    const { bytes, report } = navmeshToDetour(navmesh, { refBits });
    assert.equal(String.fromCharCode(...bytes.subarray(0, 4)), 'TESM'); // MSET, little-endian
    assert.deepEqual([report.tileCount, report.polygonCount, report.offMeshLinks], [navmesh.tileCount, navmesh.polygonCount, 1]);
    const { navmesh: back, report: read } = navmeshFromDetour(bytes);
    assert.deepEqual([back.polygonCount, read.droppedPolygons, read.offMeshLinks], [navmesh.polygonCount, 0, 1]);
    assert.ok(Math.abs(back.findPath(START, GOAL).length - navmesh.findPath(START, GOAL).length) < 0.05);
    const [link] = back.offMeshLinks();
    assert.deepEqual([link.user, link.flags, link.area, link.bothWays, link.anchored], [7n, 3n, 5, true, true]);
    for (const size of [0, 3, 40, bytes.length - 1]) assert.match(errorOf(() => navmeshFromDetour(bytes.subarray(0, size))).result, /^TL_ERR/);
  }
  assert.equal(errorOf(() => navmeshToDetour(navmesh, { refBits: 16 })).field, 'refBits');
  navmesh.addOffMeshLink({ start: [2, 0, 20], end: [4, 0, 20], flags: 1n << 20n });
  const error = errorOf(() => navmeshToDetour(navmesh));
  assert.deepEqual([error.result, error.element, error.elementIndex], ['TL_ERR_LIMIT', 'off_mesh', 1]);
});

test('off-mesh links, jump links, audit, why, sight', () => {
  const { mesh, soup } = courtyard(), navmesh = Navmesh.bake(mesh);
  const ref = navmesh.addOffMeshLink({ start: START, end: GOAL, bothWays: true, user: 5n });
  const [link] = navmesh.offMeshLinks();
  assert.deepEqual([link.ref, link.anchored, link.user, link.bothWays], [ref, true, 5n, true]);
  assert.ok(navmesh.findPath(START, GOAL).length < 30);
  navmesh.removeOffMeshLink(ref);
  assert.equal(errorOf(() => navmesh.removeOffMeshLink(ref)).result, 'TL_ERR_STALE');
  assert.equal(errorOf(() => navmesh.addOffMeshLink({ start: START, end: GOAL, radius: -1 })).field, 'radius');
  const { links, report } = navmesh.findLinks(soup);
  assert.equal(links.length, report.kinds.drop.kept + report.kinds.jump.kept + report.kinds.climb.kept);
  assert.ok(links.length > 5);
  assert.deepEqual(jumpLinkPoint(links[0], 0), links[0].start);
  navmesh.addJumpLinks(links.map((l) => ({ ...l }))); // not the list that was found: made anew
  assert.equal(navmesh.offMeshLinks().length, links.length);
  const audit = navmesh.audit(soup, { pathCount: 100 });
  assert.equal(audit.pathCount, 100);
  assert.deepEqual(audit.findings, []);
  const pruned = Navmesh.bake(mesh, { islandMinArea: 1e6 });
  assert.deepEqual(pruned.audit(soup, { pathCount: 10 }).findings, []);
  const empty = Navmesh.fromTiles([], pruned.options).audit(soup, { pathCount: 10 });
  assert.equal(empty.findings[0].kind, 'missing');
  const why = navmesh.why(mesh, [0.3, 0, 20]);
  assert.deepEqual([why.walkable, why.reasons[0].cause, why.reasons[0].option, why.proven], [false, 'radius', 'agentRadius', true]);
  assert.ok(Navmesh.bake(mesh, why.needed).findNearest([0.3, 0, 20], { halfExtents: [0.1, 1, 0.1] }) !== null);
  assert.equal(navmesh.why(mesh, START).walkable, true);
  const sight = Sight.bake(navmesh, soup, { maxDistance: 10 });
  const here = navmesh.findNearest(START).polygon;
  assert.ok(sight.pairCount > 10 && sight.sees(here, here) && sight.seenFrom(here).includes(here));
});

test('stages', () => {
  const { mesh, navmesh } = courtyard(), stages = bakeStages(mesh);
  const { heightfield, compact, contours, polygons, detail } = stages;
  assert.equal(heightfield.spanCount, navmesh.report.spanCount);
  assert.equal(compact.spanCount, navmesh.report.compactSpanCount);
  assert.equal(compact.firstSpan[compact.width * compact.height], compact.spanCount);
  for (let i = 0; i < compact.spanCount; i++) {
    for (let d = 0; d < 4; d++) {
      const beside = compact.neighbours[4 * i + d];
      if (beside !== 0xffffffff) assert.equal(compact.neighbours[4 * beside + (d ^ 2)], i);
    }
  }
  assert.equal(contours.simplified.count, navmesh.report.contourCount);
  assert.ok(contours.raw.vertices.length > contours.simplified.vertices.length);
  assert.equal(polygons.count, navmesh.polygonCount);
  assert.equal(detail.triangles.length, 3 * navmesh.report.detailTriangleCount);
  assert.equal(detail.vertices.length, navmesh.surface().vertices.length);
  // The polygons of the stage are those of the tile, corner by corner.
  const tile = navmesh.polygons();
  for (let i = 0; i < polygons.indices.length; i++) {
    for (let k = 0; k < 3; k++) assert.ok(Math.abs(polygons.vertices[3 * polygons.indices[i] + k] - tile.corners[3 * i + k]) < 1e-4);
  }
  const steps = polygonSteps(mesh), one = polygonSteps(mesh, { contour: 1 });
  assert.ok(steps.count > one.count && one.contour.every((c) => c === 1));
  const cuts = steps.kind.filter((k) => k === 0).length;
  assert.ok(cuts - (steps.count - cuts) >= polygons.count);
  assert.equal(steps.corners.length, 3 * steps.firstCorner[steps.count]);
  assert.equal(navmesh.portals().count, navmesh.linkCount());
});
