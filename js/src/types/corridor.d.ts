// SPDX-License-Identifier: MIT

import type { Freeable, Vec3, Vec3Like } from './base.js';
import type { NavFilter, NavLocation, NavRef, Navmesh, NearestOptions, PathStatus } from './navmesh.js';

export interface CorridorOptions extends NearestOptions {
  /** Polygons that it can hold, 1 to 1,048,576. A longer path is cut off there, and searched on when the agent comes near. Default 256. */
  capacity?: number;
}

export interface FilterOption {
  filter?: NavFilter | null;
}

/** How a search for a corridor ended. */
export interface CorridorSearch {
  /** 'unreachable': the corridor leads as near to the goal as a path does. */
  status: PathStatus;
  /** Metres times area costs. */
  cost: number;
  /** Nodes that the search used; 0: the corridor was whole. */
  nodeCount: number;
}

/** The next corners of the straight path. */
export interface CorridorCorners {
  /** x, y, z of each, metres. The first is where the agent stands, the second where it goes. */
  corners: number[];
  /** The polygon that is entered at each corner. */
  cornerPolygons: bigint[];
  /** TL_NAV_CORNER_... of each: 1 start, 2 end, 4 left, 8 right, 16 takes an off-mesh link. */
  cornerFlags: number[];
  /** Others follow. */
  more: boolean;
}

/**
 * The polygons from an agent to its target, kept while both move and tiles come and go: for agents whose motion is yours.
 * (A crowd keeps one for each of its agents.) A path is searched once; each move then changes the corridor's ends only.
 * Functions throw TL_ERR_STALE after the tile of a polygon that they need has left: call `repair`. Where one throws, the
 * corridor stays as it was.
 */
export class Corridor implements Freeable {
  private constructor();
  /**
   * A corridor with agent and target at one place: a location, or a point that is moved to the nearest polygon. Null: none
   * is near. TL_ERR_ARGUMENT with `capacity` in `field`, TL_ERR_MEMORY. It uses the navmesh for as long as it is there.
   */
  static create(navmesh: Navmesh, at: Vec3Like | NavLocation, options?: CorridorOptions): Corridor | null;
  readonly freed: boolean;
  free(): void;
  [Symbol.dispose](): void;

  /** Of the agent, metres. */
  readonly position: Vec3;
  /** The goal, or as near to it as the path leads. */
  readonly target: Vec3;
  /** The goal that was asked for. */
  readonly goal: Vec3;
  /** The target is the goal. */
  readonly reaches: boolean;
  /** From the agent's to the target's, off-mesh links among them. */
  readonly polygons: NavRef[];

  /** Puts agent and target in one place. False: no polygon is near. */
  reset(at: Vec3Like | NavLocation, options?: NearestOptions): boolean;
  /** Searches the path from the agent to a goal. Null: no polygon is near the goal. */
  find(goal: Vec3Like | NavLocation, options?: NearestOptions): CorridorSearch | null;
  /** The next corners, `count` of them at most, 1 to 65,536; no more of the path is looked at than that takes. Default 3. */
  corners(count?: number): CorridorCorners;
  /** Moves the agent towards a point, along walls, and gives where it stands. TL_ERR_LIMIT: over more than 256 polygons. */
  move(to: Vec3Like, options?: FilterOption): Vec3;
  /** Moves the target in the same way, to follow something that walks. For one that jumps, call `find`. */
  moveTarget(to: Vec3Like, options?: FilterOption): Vec3;
  /**
   * Takes the next off-mesh link: the corridor then begins where that lands. Call it where the agent stands at a corner
   * with flag 16. Null: there is no link ahead.
   */
  passLink(): { link: NavRef; from: NavLocation; to: NavLocation } | null;
  /** Shortens it by straight lines of at most `range` metres along the surface, default 20. True: it changed. */
  shorten(range?: number, options?: FilterOption): boolean;
  /**
   * Improves it by a search of at most `maxSteps` nodes (default 256), whose path replaces the first `ahead` polygons
   * (default 32) where it costs less: for doors that have opened, and targets that have moved far. True: it changed.
   */
  improve(options?: FilterOption & { ahead?: number; maxSteps?: number }): boolean;
  /** How many of its first polygons (of `maxCount` at most) exist, pass the filter, and lead to the next. */
  validCount(maxCount?: number, options?: FilterOption): number;
  /**
   * After tiles have changed: a corridor that is whole stays as it is; else agent and goal are moved to the polygons
   * nearest to them within `halfExtents`, and the path is searched anew. Null: no polygon is near the agent, and the
   * corridor is unchanged.
   */
  repair(options?: NearestOptions): CorridorSearch | null;
}
