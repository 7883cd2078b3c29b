// SPDX-License-Identifier: MIT

import type { Aabb } from './base.js';
import type { Hull } from './convex.js';
import type { JumpLink } from './nav_tools.js';
import type { Navmesh } from './navmesh.js';
import type { NavVolume } from './nav_bake.js';
import type { Soup } from './soup.js';

/** Where the geometry came from. */
export interface PackMeta {
  name: string;
  sourceVertices: number;
  sourceTriangles: number;
  bounds: Aabb;
  /** The source's up axis; what is baked is y-up. */
  up: 'y' | 'z';
}

export interface PackChunk {
  /** Four characters: META, SOUP, HULL, NAVM, NAVT, LINK, MARK, or the user's own. */
  type: string;
  id: number;
  size: number;
}

/** What a .talus file holds. The objects are the caller's to free. */
export interface Pack {
  meta: PackMeta | null;
  soup: Soup | null;
  hull: Hull | null;
  navmesh: Navmesh | null;
  links: JumpLink[];
  volumes: NavVolume[];
  chunks: PackChunk[];
}

/**
 * Reads a .talus file: every truncated or altered byte is refused.
 * @throws TalusError TL_ERR_MAGIC (not a talus file), TL_ERR_VERSION, TL_ERR_TRUNCATED, TL_ERR_HASH, TL_ERR_CORRUPT
 */
export function loadPack(bytes: ArrayBuffer | Uint8Array): Pack;

/** Writes a .talus file: the bytes that `talus bake` writes of the same parts. */
export function savePack(parts: {
  meta?: PackMeta | null;
  soup?: Soup | null;
  hull?: Hull | null;
  navmesh?: Navmesh | null;
  volumes?: readonly NavVolume[] | null;
}): Uint8Array;
