// SPDX-License-Identifier: MIT

import type { BakeHooks, InitOptions, Threads } from './base.js';
import type { DecomposeOptions, Decomposition, Hull, HullOptions } from './convex.js';
import type { Mesh, WeldOptions } from './mesh.js';
import type { NavBakeOptions, NavInput, NavOptions } from './nav_bake.js';
import type { Audit, AuditOptions, JumpLink, LinkOptions, LinksReport, WhyAnswer } from './nav_tools.js';
import type { Navmesh } from './navmesh.js';
import type { Soup, SoupOptions } from './soup.js';
import type { BakeStages, PolygonSteps } from './stages.js';
import type { Vec3Like } from './base.js';

/** How a worker is started. `threads` are its own: two workers with four threads each are eight. */
export interface TalusWorkerOptions extends Omit<InitOptions, 'part' | 'createThread'> {
  /** Where worker.js is; by default beside the package's sources. */
  url?: string | URL;
  /** Makes the worker, for bundlers that want to see `new Worker(...)`; runs `talus/worker-entry`. */
  create?: () => Worker;
}

type StageOptions = NavOptions & NavInput & BakeHooks & { tileX?: number; tileZ?: number };

/**
 * Bakes in a worker, so that the page stays alive. One bake at a time; others wait in turn. An aborted signal ends the
 * bake at once (the worker is replaced), and rejects with the signal's reason.
 *
 * `init` must have ended on the page's own thread too: results live there. Obstacles are baked on the page's thread.
 */
export class TalusWorker {
  constructor(options?: TalusWorkerOptions);
  /** How many threads the worker bakes with, and why no more; null until its first task has ended. */
  readonly threads: Threads | null;
  weld(mesh: Mesh, options?: WeldOptions): Promise<ReturnType<Mesh['weld']>>;
  bakeSoup(mesh: Mesh, options?: SoupOptions): Promise<Soup>;
  bakeHull(points: ArrayLike<number>, options?: HullOptions): Promise<Hull>;
  decompose(mesh: Mesh, options?: DecomposeOptions): Promise<Decomposition>;
  bakeNavmesh(mesh: Mesh, options?: NavBakeOptions): Promise<Navmesh>;
  bakeStages(mesh: Mesh, options?: StageOptions): Promise<BakeStages>;
  polygonSteps(mesh: Mesh, options?: StageOptions & { contour?: number }): Promise<PolygonSteps>;
  findLinks(navmesh: Navmesh, soup: Soup, options?: LinkOptions): Promise<{ links: JumpLink[]; report: LinksReport }>;
  audit(navmesh: Navmesh, soup: Soup, options?: AuditOptions): Promise<Audit>;
  why(navmesh: Navmesh, mesh: Mesh, point: Vec3Like, options?: NavInput & BakeHooks): Promise<WhyAnswer>;
  /** Ends the worker; what waits is rejected. A later bake starts a new one. */
  terminate(): void;
}
