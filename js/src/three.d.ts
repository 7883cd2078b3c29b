// SPDX-License-Identifier: MIT
//
// `talus/three`: three.js geometry in, debug geometry out, and raycasts by a soup.

import type { BufferGeometry, Mesh as ThreeMesh, Object3D } from 'three';
import type { BakeStages, Hull, JumpLink, Mesh, Navmesh, NavPath, PolygonSteps, RayWalk, Soup } from './index.js';

/** A geometry's triangles; draw ranges and groups are ignored. */
export function meshFromGeometry(geometry: BufferGeometry): Mesh;
/** The triangles of all visible meshes below an object, in the world's frame. Material i of the result is `materials[i]`. */
export function meshFromObject(object: Object3D): { mesh: Mesh; materials: unknown[] };
/** A mesh as geometry, with normals by face. */
export function geometryFromMesh(mesh: Mesh): BufferGeometry;

/**
 * A `raycast` for a three.js mesh: `mesh.raycast = soupRaycast(soup)`. The soup is that of the mesh's own geometry. As
 * three.js does it finds all hits, or with `raycaster.firstHitOnly` the nearest alone, much faster.
 */
export function soupRaycast(soup: Soup): ThreeMesh['raycast'];

// What a bake's stages look like. Triangles for a mesh, or lines for LineSegments; 'color' says what is what.
export function soupPairsGeometry(soup: Soup): BufferGeometry;
/** Lines. `depth`: boxes of that depth alone. */
export function soupBoxesGeometry(soup: Soup, depth?: number): BufferGeometry;
/** Lines: the boxes that a ray enters. */
export function rayWalkGeometry(walk: RayWalk): BufferGeometry;
/** Boxes of solid spans; walkable tops stand out. */
export function spansGeometry(stages: BakeStages): BufferGeometry;
/** A quad a floor. */
export function floorsGeometry(stages: BakeStages, by?: 'area' | 'distance' | 'region'): BufferGeometry;
/** Lines. */
export function contoursGeometry(stages: BakeStages, which?: 'raw' | 'simplified'): BufferGeometry;
/** Lines: what step `index` has done: pieces so far, and its potential partitions. */
export function polygonStepGeometry(steps: PolygonSteps, index: number): BufferGeometry;
/** The surface of a navmesh. */
export function navmeshGeometry(navmesh: Navmesh, by?: 'polygon' | 'area' | 'tile' | 'island'): BufferGeometry;
/** Lines: edges of polygons; walls and portals have colours of their own. */
export function navmeshEdgesGeometry(navmesh: Navmesh): BufferGeometry;
/** Lines. */
export function jumpLinksGeometry(links: readonly JumpLink[]): BufferGeometry;
/** A line strip through a path's corners, `lift` metres above them, by default 0.1. */
export function pathGeometry(path: NavPath, lift?: number): BufferGeometry;
export function hullGeometry(hull: Hull): BufferGeometry;
