// SPDX-License-Identifier: MIT
//
// The package as TypeScript's strictest users write it. It is not run: `npx tsc -p .` must accept it as it stands, and
// refuse each line below a @ts-expect-error, so that a type that became too loose is found too.

import {
  CharacterMover, Corridor, Crowd, Hull, Mesh, Navmesh, Scene, Soup, TalusError, TalusWorker, castRayAtShape, contacts, distance, init, loadPack,
  penetration, sampleLevel, savePack, threads, type CharacterState, type NavPath, type Shape, type Vec3,
} from 'talus';
import { navmeshGeometry } from 'talus/three';
import type { BufferGeometry } from 'three';

export async function rays(vertices: Float32Array, indices: Uint32Array): Promise<number> {
  await init({ threads: 2, wasm: new URL('talus.wasm', 'https://example.org/') });
  const reason: string | null = threads().reason;
  using soup = Soup.bake(new Mesh(vertices, indices));
  const hit = soup.castRay(0, 1, 0, 0, -1, 0);
  // @ts-expect-error: nothing may be hit
  const unasked = hit.t;
  const all = soup.castRays(new Float32Array([0, 1, 0, 0, -1, 0, 10]));
  // @ts-expect-error: a direction is missing
  soup.castRay(0, 1, 0);
  return (hit?.t ?? 0) + all.t[0]! + unasked + (reason?.length ?? 0);
}

export function paths(): Vec3[] {
  const { mesh } = sampleLevel('courtyard').weld();
  const abort = new AbortController();
  const navmesh = Navmesh.bake(mesh, { agentRadius: 0.4, tileSize: 48, obstacles: true, signal: abort.signal, onProgress: (stage, done) => stage.length < done });
  // @ts-expect-error: the name is agentRadius
  Navmesh.bake(mesh, { agent_radius: 0.4 });
  const id: bigint = navmesh.addObstacle({ type: 'box', base: [0, 0, 0], height: 2, halfX: 1, halfZ: 1 });
  // @ts-expect-error: a cylinder has a radius
  navmesh.addObstacle({ type: 'cylinder', base: [0, 0, 0], height: 2 });
  navmesh.removeObstacle(id);
  const path: NavPath | null = navmesh.findPath([2, 0, 20], [20, 5, 20]);
  // @ts-expect-error: there is no such status
  const wrong = path?.status === 'found';
  const reasons = navmesh.why(mesh, [0, 0, 0]).reasons.map(({ option, needed }) => `${option}: ${needed}`);
  const geometry: BufferGeometry = navmeshGeometry(navmesh);
  const bytes: Uint8Array = savePack({ navmesh });
  const corridor = Corridor.create(loadPack(bytes).navmesh!, [2, 0, 20]);
  const crowd = Crowd.create(navmesh, { maxAgents: 10 });
  const agent = crowd.add({ position: [2, 0, 20] });
  // @ts-expect-error: there may be no room
  crowd.setGoal(agent, [0, 0, 0]);
  return wrong || reasons.length > geometry.id || corridor === null ? [] : [corridor.position];
}

export function shapes(hull: Hull): string {
  const ball: Shape = { type: 'sphere', radius: 1 }, other: Shape = { type: 'hull', hull };
  // @ts-expect-error: a capsule has two ends
  const capsule: Shape = { type: 'capsule', radius: 1 };
  const apart: number = distance(ball, null, other, { position: [3, 0, 0] }).distance;
  const deep = penetration(ball, null, capsule, null)?.depth ?? 0;
  const touching = contacts(ball, null, other, null), ray = castRayAtShape(other, null, [0, 9, 0], [0, -1, 0]);
  const scene = Scene.bake([{ shape: ball, pose: { position: [0, 0, 0] } }]);
  const state: CharacterState = { position: [0, 5, 0] };
  CharacterMover.create({ radius: 0.3, height: 1.8 }).move(scene, state, { velocity: [0, -1, 0], seconds: 1 / 60 });
  return `${apart} ${deep} ${touching} ${ray} ${state.grounded}`;
}

export async function worker(mesh: Mesh): Promise<string> {
  const baker = new TalusWorker();
  try {
    const navmesh: Navmesh = await baker.bakeNavmesh(mesh, { cellSize: 0.2 });
    return navmesh.report === null ? 'loaded' : `${navmesh.report.polygonCount}`;
  } catch (error) {
    if (error instanceof TalusError && error.result === 'TL_ERR_MEMORY') return error.advice ?? '';
    // @ts-expect-error: no result has this name
    if (error instanceof TalusError && error.result === 'TL_ERR_MEMROY') return '';
    throw error;
  }
}
