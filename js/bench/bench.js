// SPDX-License-Identifier: MIT
//
// JavaScript peers in node: rays one call each (three-mesh-bvh, Rapier), batches in no order and of a camera, bakes
// (recast-navigation), paths (recast-navigation, navcat). Warmed, alternated, medians; answers are compared first. Figures
// are times as fast as the peer: above 1 talus is faster. Arguments are levels, OBJ files or names of built-in ones; without
// any, two built-in ones. In the end the batches once more, in a process whose talus has as many threads as the machine;
// TALUS_THREADS=2 gives it threads in all rows, which no peer has. TALUS_SCALAR=1 takes SIMD away.

import RAPIER from '@dimforge/rapier3d-compat';
import { DEFAULT_QUERY_FILTER, findPath } from 'navcat';
import { generateSoloNavMesh as navcatBake } from 'navcat/blocks';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { basename } from 'node:path';
import { NavMeshQuery, init as initRecast } from 'recast-navigation';
import { generateSoloNavMesh as recastBake } from 'recast-navigation/generators';
import { fileURLToPath } from 'node:url';
import * as THREE from 'three';
import { MeshBVH } from 'three-mesh-bvh';
import { Mesh, Navmesh, Soup, hasSimd, init, sampleLevel, threads } from '../src/index.js';

const RAYS = 20000, PAIRS = 400, ROUNDS = 7, NO_TRIANGLE = 0xffffffff;
const ratios = new Map();

function randomNumbers(seed) { // mulberry32
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

const median = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];

/**
 * Medians of each runner's milliseconds, alternated. The first rounds warm: the engine begins with quick code, and replaces
 * it function by function while that runs.
 */
function race(runners, rounds = ROUNDS, warming = 4) {
  const times = runners.map(() => []);
  for (let round = 0; round < warming + rounds; round++) {
    runners.forEach((run, i) => {
      const start = performance.now();
      run();
      if (round >= warming) times[i].push(performance.now() - start);
    });
  }
  return times.map(median);
}

function note(what, level, own, peer, more = '') {
  ratios.set(what, [...(ratios.get(what) ?? []), peer / own]);
  console.log(`${level.padEnd(24)} ${what.padEnd(42)} ${(peer / own).toFixed(2).padStart(6)}  ${more}`);
}

// --------------------------------------------------------------------------------------------------------

/** A picture of 160 by 125 pixels, row by row, from the middle of the level: 20,000 rays. */
function cameraRays({ min, max }) {
  const eye = [0, 1, 2].map((k) => 0.5 * (min[k] + max[k])), rays = new Float32Array(7 * RAYS);
  for (let i = 0; i < RAYS; i++) {
    const x = (i % 160) / 80 - 1, y = 0.8 - Math.floor(i / 160) / 78;
    rays.set([...eye, x, y - 0.3, -1, 1e6], 7 * i);
  }
  return rays;
}

/** From anywhere in the level into any direction. */
function randomRays({ min, max }) {
  const random = randomNumbers(1), rays = new Float32Array(7 * RAYS);
  for (let i = 0; i < RAYS; i++) {
    const d = [random() - 0.5, random() - 0.5, random() - 0.5], length = Math.hypot(...d);
    for (let k = 0; k < 3; k++) {
      rays[7 * i + k] = min[k] + random() * (max[k] - min[k]);
      rays[7 * i + 3 + k] = d[k] / length;
    }
    rays[7 * i + 6] = 1e6;
  }
  return rays;
}

function castEach(soup, rays, t) {
  for (let i = 0, r = 0; i < RAYS; i++, r += 7) {
    const hit = soup.castRay(rays[r], rays[r + 1], rays[r + 2], rays[r + 3], rays[r + 4], rays[r + 5], rays[r + 6]);
    t[i] = hit === null ? -1 : hit.t;
  }
}

/** One call for all rays against one for each; the hits are the same. */
function benchBatch(what, name, soup, rays) {
  const out = soup.castRays(rays), t = new Float32Array(RAYS);
  castEach(soup, rays, t);
  const differ = t.findIndex((one, i) => one !== (out.triangle[i] === NO_TRIANGLE ? -1 : out.t[i]));
  if (differ >= 0) throw new Error(`${name}: ray ${differ} has another hit in the batch`);
  const [batch, single] = race([() => soup.castRays(rays, null, out), () => castEach(soup, rays, t)]);
  const { count } = threads();
  note(`${what}${count > 1 ? `, ${count} threads` : ''}`, name, batch, single, `${(1e6 * batch / RAYS).toFixed(0)} ns a ray`);
}

function benchBatches(name, mesh) {
  const soup = Soup.bake(mesh);
  benchBatch('batch in no order: single calls', name, soup, randomRays(mesh.bounds()));
  benchBatch('batch of a camera: single calls', name, soup, cameraRays(mesh.bounds()));
  soup.free();
}

function benchRays(name, mesh) {
  const rays = randomRays(mesh.bounds()), soup = Soup.bake(mesh);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(mesh.vertices, 3));
  geometry.setIndex(new THREE.BufferAttribute(mesh.indices.slice(), 1)); // the BVH puts it in an order of its own
  const bvh = new MeshBVH(geometry), ray = new THREE.Ray();
  const world = new RAPIER.World({ x: 0, y: 0, z: 0 });
  world.createCollider(RAPIER.ColliderDesc.trimesh(mesh.vertices, mesh.indices));
  world.step();
  const rapierRay = new RAPIER.Ray({ x: 0, y: 0, z: 0 }, { x: 1, y: 0, z: 0 });
  const answers = [0, 1, 2].map(() => new Float32Array(RAYS));
  const runs = [
    () => castEach(soup, rays, answers[0]),
    () => {
      for (let i = 0, r = 0; i < RAYS; i++, r += 7) {
        ray.origin.set(rays[r], rays[r + 1], rays[r + 2]);
        ray.direction.set(rays[r + 3], rays[r + 4], rays[r + 5]);
        const hit = bvh.raycastFirst(ray, THREE.DoubleSide);
        answers[1][i] = hit === null ? -1 : hit.distance;
      }
    },
    () => {
      for (let i = 0, r = 0; i < RAYS; i++, r += 7) {
        rapierRay.origin.x = rays[r];
        rapierRay.origin.y = rays[r + 1];
        rapierRay.origin.z = rays[r + 2];
        rapierRay.dir.x = rays[r + 3];
        rapierRay.dir.y = rays[r + 4];
        rapierRay.dir.z = rays[r + 5];
        const hit = world.castRay(rapierRay, 1e6, true);
        answers[2][i] = hit === null ? -1 : hit.timeOfImpact;
      }
    },
  ];
  runs.forEach((run) => run());
  const differ = [1, 2].map((peer) => answers[0].reduce((n, t, i) => n + (Math.abs(t - answers[peer][i]) > 1e-3 * Math.max(1, t) ? 1 : 0), 0));
  if (differ.some((n) => n > RAYS / 100)) throw new Error(`${name}: rays differ: ${differ}`);
  const [own, three, rapier] = race(runs);
  note('rays: three-mesh-bvh', name, own, three, `${(1e6 * own / RAYS).toFixed(0)} ns a ray, ${differ[0]} of ${RAYS} differ`);
  note('rays: Rapier', name, own, rapier, `${differ[1]} differ`);
  soup.free();
  world.free();
}

const HALF = [2, 4, 2];

function benchNav(name, mesh) {
  const options = { cellSize: 0.3, cellHeight: 0.2, agentRadius: 0.6, agentHeight: 2, agentMaxClimb: 0.8 };
  const recastOptions = { cs: 0.3, ch: 0.2, walkableSlopeAngle: 45, walkableHeight: 10, walkableClimb: 4, walkableRadius: 2, maxEdgeLen: 40,
                          maxSimplificationError: 1.3, minRegionArea: 8, mergeRegionArea: 20, maxVertsPerPoly: 6, detailSampleDist: 6,
                          detailSampleMaxError: 1, borderSize: 0 };
  const { mesh: welded } = mesh.weld();
  const talusBake = () => Navmesh.bake(welded, options);
  const peerBake = () => recastBake(welded.vertices, welded.indices, recastOptions);
  const begin = performance.now(), navmesh = talusBake(), middle = performance.now(), peer = peerBake(), end = performance.now();
  if (!peer.success) throw new Error(`${name}: recast-navigation: ${peer.error}`);
  if (!ratios.has('bake: recast-navigation')) note('the first bake: recast-navigation', name, middle - begin, end - middle, `${(middle - begin).toFixed(0)} ms`);
  const [own, theirs] = race([() => talusBake().free(), () => peerBake().navMesh.destroy()], 9, 12);
  note('bake: recast-navigation', name, own, theirs, `${own.toFixed(0)} ms`);

  const cat = navcatBake({ positions: welded.vertices, indices: welded.indices }, {
    cellSize: 0.3, cellHeight: 0.2, walkableRadiusVoxels: 2, walkableRadiusWorld: 0.6, walkableClimbVoxels: 4, walkableClimbWorld: 0.8,
    walkableHeightVoxels: 10, walkableHeightWorld: 2, walkableSlopeAngleDegrees: 45, borderSize: 0, minRegionArea: 64, mergeRegionArea: 400,
    maxSimplificationError: 1.3, maxEdgeLength: 40, maxVerticesPerPoly: 6, detailSampleDistance: 1.8, detailSampleMaxError: 0.2 }).navMesh;
  const query = new NavMeshQuery(peer.navMesh), random = randomNumbers(2), pairs = [];
  const xyz = ([x, y, z]) => ({ x, y, z }), box = xyz(HALF), wide = { halfExtents: box, maxPathPolys: 2048, maxStraightPathPoints: 2048 };
  const near = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) < 1;
  let missed = 0;
  const point = () => navmesh.randomPoint({ random }).point;
  for (let tries = 0; pairs.length < PAIRS && tries < 20 * PAIRS; tries++) {
    const [a, b] = [point(), point()];
    // Paths that all three find: the others' meshes may be connected otherwise, and a partial path ends early.
    const found = query.computePath(xyz(a), xyz(b), wide).path.at(-1), other = findPath(cat, a, b, HALF, DEFAULT_QUERY_FILTER).path.at(-1);
    const ends = found && other && near([found.x, found.y, found.z], b) && near(other.position, b);
    if (!ends) missed++;
    else if (navmesh.findPath(a, b)?.status === 'complete') pairs.push([a, b]);
  }
  const lengths = (path, at) => path.reduce((sum, p, i) => (i === 0 ? 0 : sum + Math.hypot(at(p)[0] - at(path[i - 1])[0], at(p)[2] - at(path[i - 1])[2])), 0);
  const shorter = pairs.filter(([a, b]) => {
    const found = query.computePath(xyz(a), xyz(b), wide);
    return found.success && lengths(found.path, (p) => [p.x, p.y, p.z]) < navmesh.findPath(a, b).length * 0.97;
  }).length;
  const path = () => { for (const [a, b] of pairs) navmesh.findPath(a, b, { halfExtents: HALF }); };
  const [plain, recast, navcat] = race([path,
    () => { for (const [a, b] of pairs) query.computePath(xyz(a), xyz(b), wide); },
    () => { for (const [a, b] of pairs) findPath(cat, a, b, HALF, DEFAULT_QUERY_FILTER); },
  ]);
  navmesh.prepare();
  const [prepared, recastAgain] = race([path,
    () => { for (const [a, b] of pairs) query.computePath(xyz(a), xyz(b), wide); }]);
  const more = `${(1e3 * plain / pairs.length).toFixed(1)} us a path, the peer's is shorter by 3% in ${shorter} of ${pairs.length}, ${missed} pairs left out`;
  note('paths: recast-navigation', name, plain, recast, more);
  note('paths: navcat', name, plain, navcat);
  note('prepared paths: recast-navigation', name, prepared, recastAgain);
  navmesh.free();
}

/** An OBJ file's triangles: polygons as fans. */
function readObj(path) {
  const vertices = [], indices = [];
  for (const line of readFileSync(path, 'utf8').split('\n')) {
    const words = line.trim().split(/\s+/);
    if (words[0] === 'v') vertices.push(Number(words[1]), Number(words[2]), Number(words[3]));
    if (words[0] !== 'f') continue;
    const corners = words.slice(1).map((word) => parseInt(word, 10)).map((k) => (k < 0 ? vertices.length / 3 + k : k - 1));
    for (let i = 2; i < corners.length; i++) indices.push(corners[0], corners[i - 1], corners[i]);
  }
  return new Mesh(vertices, indices);
}

const levels = process.argv.length > 2 ? process.argv.slice(2) : ['courtyard', 'dungeon'];
const ownThreads = Number(process.env.TALUS_THREADS ?? 1), onlyBatches = Boolean(process.env.TALUS_ONLY_BATCHES);

await init({ simd: !process.env.TALUS_SCALAR, threads: ownThreads });
await RAPIER.init();
await initRecast();
console.log(`talus ${hasSimd() ? 'with' : 'without'} SIMD, threads: ${threads().count}, node ${process.version}; times as fast as the peer`);
for (const level of levels) {
  const name = basename(level), mesh = level.endsWith('.obj') ? readObj(level) : sampleLevel(level);
  if (!onlyBatches) benchRays(name, mesh);
  benchBatches(name, mesh);
  if (!onlyBatches) benchNav(name, mesh);
}
console.log('\ngeometric mean, worst');
for (const [what, list] of ratios) {
  const mean = Math.exp(list.reduce((sum, x) => sum + Math.log(x), 0) / list.length);
  console.log(`${what.padEnd(42)} ${mean.toFixed(2).padStart(6)} ${Math.min(...list).toFixed(2).padStart(6)}`);
}
// A process has one module, with threads or without.
if (ownThreads === 1 && availableParallelism() > 1) {
  console.log();
  const env = { ...process.env, TALUS_THREADS: `${availableParallelism()}`, TALUS_ONLY_BATCHES: '1' };
  execFileSync(process.execPath, [fileURLToPath(import.meta.url), ...levels], { env, stdio: 'inherit' });
}
