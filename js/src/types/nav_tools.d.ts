// SPDX-License-Identifier: MIT
//
// Jump links, the audit, and why a point is not walkable.

import type { Aabb, BakeHooks, Vec3, Vec3Like } from './base.js';
import type { NavRef } from './navmesh.js';
import type { NavInput, NavOptions } from './nav_bake.js';

/** What an agent can do. A limit of 0 turns its kind of link off. */
export interface LinkOptions extends BakeHooks {
  /** Metres between two places that are tried along a ledge, > 0. Default 0.5. */
  spacing?: number;
  /** Metres. Default 4. */
  maxDrop?: number;
  /** Metres, horizontally. Default 3. */
  maxJump?: number;
  /** Metres: of a jump's highest point above its start. Default 1. */
  jumpHeight?: number;
  /** Metres a second, horizontally. Default 6. */
  maxSpeed?: number;
  /** Metres a second squared. Default 9.81. */
  gravity?: number;
  /** Metres up a wall. Default 1.2. */
  maxClimb?: number;
  /** >= 1: the path without the link is at least so many times as long. Default 3. */
  minGain?: number;
  /** Nodes of each search for the path without. Default 4096. */
  maxNodes?: number;
}

export interface JumpLink {
  kind: 'drop' | 'jump' | 'climb';
  start: Vec3;
  end: Vec3;
  /** Metres that a jump rises above its start. */
  apex: number;
  bothWays: boolean;
}

/** Where the agent's feet are at `t` in [0, 1] of a link. */
export function jumpLinkPoint(link: JumpLink, t: number): Vec3;

export interface LinksReport {
  ledgeCount: number;
  sampleCount: number;
  noLanding: number;
  tooFast: number;
  kinds: Record<'drop' | 'jump' | 'climb', { tried: number; blocked: number; useless: number; kept: number }>;
}

export interface AuditOptions extends BakeHooks, NavInput {
  /** Random shortest paths. Default 2000. */
  pathCount?: number;
  /** Of their ends. Default 1. */
  seed?: number | bigint;
  /** Metres; negative: what the settings promise. Default -1. */
  probeRadius?: number;
  /** Square metres: smaller missing floors are ignored; negative: the smallest island that a bake keeps. Default -1. */
  minMissingArea?: number;
}

/** One fault of a navmesh, however many paths met it. */
export interface Finding {
  kind: 'blocked' | 'step' | 'no floor' | 'missing';
  /** That blocks the probe, or on which the missing floor lies. */
  triangle: number | null;
  polygon: NavRef | null;
  /** The worst of its places. */
  point: Vec3;
  contact: Vec3;
  /** Metres: how deep, how high, how far one falls. */
  depth: number;
  /** Places a cell apart that were merged into it. */
  count: number;
  bounds: Aabb;
  /** Square metres, of missing floor. */
  area: number;
}

export interface Audit {
  /** By kind, then the worst first. Empty: no contradiction. */
  findings: Finding[];
  /** Metres: what was swept. */
  probe: { radius: number; step: number; height: number; surface: number; gap: number };
  pathCount: number;
  pathMetres: number;
  polygonCount: number;
  portalCount: number;
  stepCount: number;
  contradictions: number;
  floorSamples: number;
  /** Metres. */
  sampleSpacing: number;
  /** Square metres. */
  missingArea: number;
}

export type Cause =
  | 'none' | 'outside' | 'no floor' | 'slope' | 'area input' | 'ledge' | 'ceiling' | 'radius' | 'volume' | 'island'
  | 'outline' | 'changed' | 'pruned';

/** One cause, and the setting that removes it. */
export interface Reason {
  cause: Cause;
  /** One to four words. */
  name: string;
  /** A sentence. */
  text: string;
  stage: string;
  /** The option to blame, or null when none helps. */
  option: keyof NavOptions | null;
  /** Of that option now. */
  value: number;
  /** The nearest value with which this cause is gone. */
  needed: number;
  /** What was found at the point: degrees, metres or columns. */
  measured: number;
  triangle: number | null;
}

export interface WhyAnswer {
  walkable: boolean;
  /** The floor that the answer is about. */
  floor: Vec3;
  /** The first is why; each other one is what is left once those before it are removed. */
  reasons: Reason[];
  /** The tile was baked with all the needed values, and the point lies on its navmesh. */
  proven: boolean;
  /** The options with those values. */
  needed: Required<NavOptions>;
  tileX: number;
  tileZ: number;
  bakeCount: number;
  /** Walkable, but not on the largest island. */
  apart: boolean;
  /** Square metres. */
  islandArea: number;
  largestIslandArea: number;
}
