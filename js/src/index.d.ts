// SPDX-License-Identifier: MIT
//
// The types of the package, part by part. Each has its own file; units and errors stand with the functions.

export * from './types/base.js';
export * from './types/mesh.js';
export * from './types/soup.js';
export * from './types/convex.js';
export * from './types/scene.js';
export * from './types/character.js';
export * from './types/nav_bake.js';
export * from './types/stages.js';
export * from './types/navmesh.js';
export * from './types/nav_tools.js';
export * from './types/corridor.js';
export * from './types/crowd.js';
export * from './types/pack.js';
export * from './types/worker.js';
