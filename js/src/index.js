// SPDX-License-Identifier: MIT
//
// The package. Types, units and errors: index.d.ts.

export { init, isReady, hasBakes, hasSimd, threads, version, memoryBytes } from './module.js';
export { TalusError } from './error.js';
export { Mesh, sampleLevel, sampleLevels } from './mesh.js';
export { Soup } from './soup.js';
export { Hull } from './hull.js';
export { decompose } from './decompose.js';
export { Scene } from './scene.js';
export { CharacterMover } from './character.js';
export { distance, overlap, penetration, cast, contacts, castRayAtShape, shapeBounds } from './convex.js';
export { defaultNavOptions, tileGrid } from './nav_options.js';
export { bakeStages, polygonSteps } from './stages.js';
export { Navmesh } from './navmesh.js';
import './nav_query.js';
import './nav_change.js';
export { navmeshFromDetour, navmeshToDetour } from './nav_detour.js';
export { jumpLinkPoint } from './nav_tools.js';
export { Sight } from './sight.js';
export { Corridor } from './corridor.js';
export { Crowd } from './crowd.js';
export { loadPack, pointFromLevel, pointToLevel, savePack } from './pack.js';
export { TalusWorker } from './worker.js';
