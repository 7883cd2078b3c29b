// SPDX-License-Identifier: MIT

import type { Aabb, Vec3, Vec3Like } from './base.js';
import type { Hull } from './convex.js';
import type { JumpLink } from './nav_tools.js';
import type { Navmesh, OffMeshLink } from './navmesh.js';
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

/**
 * The level's own coordinates: a point of the level less `origin`, turned from `axes`, is a point of what was baked,
 * which is y-up and right-handed.
 */
export interface PackFrame {
  /** Metres, in the level's axes. */
  origin: Vec3;
  /** 'y' and 'z' are right-handed; 'y-left' as in Unity, 'z-left' as in Unreal. */
  axes: 'y' | 'z' | 'y-left' | 'z-left';
}

export interface PackChunk {
  /** Four characters: META, FRAM, SOUP, HULL, NAVM, NAVT, LINK, OFFM, AREA, MARK, PRUN, PRUT, ROUT, or the user's own. */
  type: string;
  id: number;
  size: number;
}

/** What a .talus file holds. The objects are the caller's to free. */
export interface Pack {
  meta: PackMeta | null;
  /** null: the level's coordinates are those of what was baked. */
  frame: PackFrame | null;
  soup: Soup | null;
  hull: Hull | null;
  navmesh: Navmesh | null;
  /** Found ones; they are in the navmesh. */
  links: JumpLink[];
  /** Set by hand; they are in the navmesh. */
  offMeshLinks: Required<OffMeshLink>[];
  /** The areas that materials gave the source's triangles, which `audit` wants; null: all have 63. */
  areas: Uint8Array | null;
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
  frame?: PackFrame | null;
  soup?: Soup | null;
  hull?: Hull | null;
  /** With its jump links; not with others, see offMeshLinks. */
  navmesh?: Navmesh | null;
  /** Set by hand, to be added to the navmesh when the file is read. */
  offMeshLinks?: readonly OffMeshLink[];
  /** Areas by the source's triangle. */
  areas?: ArrayLike<number> | null;
  volumes?: readonly NavVolume[] | null;
}): Uint8Array;

/** A point of the level, metres, to a point of what was baked; `frame` null: the same point. */
export function pointFromLevel(frame: PackFrame | null, point: Vec3Like): Vec3;

/** A point of what was baked, such as a path's corner, to a point of the level. */
export function pointToLevel(frame: PackFrame | null, point: Vec3Like): Vec3;
