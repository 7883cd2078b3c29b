// SPDX-License-Identifier: MIT

import type { Freeable, Vec3, Vec3Like } from './base.js';
import type { Navmesh, NavFilter, NavLocation, NavRef, NearestOptions } from './navmesh.js';

/** An agent of a crowd, or a group. A name is not used again before 2^32 others had its place. */
export type AgentRef = bigint;
export type GroupRef = bigint;

/** How large a crowd is, and how far it looks ahead. */
export interface CrowdOptions {
  /** 1 to 2^20; their memory is taken at once. Default 1024. */
  maxAgents?: number;
  /** Polygons of its corridor that an agent keeps, 4 to 1024; it asks for more in time. */
  maxPath?: number;
  /** That an agent avoids, the nearest ones, 1 to 32. Default 10. */
  maxNeighbors?: number;
  /** Searches of one step, >= 1; the others wait. Default 64. */
  pathsPerStep?: number;
  /** Of one search. Default 4096. */
  maxNodes?: number;
  /** Goals whose paths are found by one search for all that walk there, 0 to 8. Default 4. */
  maxSharedGoals?: number;
  /** Groups at a time. Default 32. */
  maxGroups?: number;
  /** Members of all groups together. Default 256. */
  maxMembers?: number;
  /** Metres, > 0: agents whose rims are farther apart do not see one another. Default 4. */
  neighborDistance?: number;
  /** Seconds, > 0: collisions with agents are avoided so far ahead. Default 2. */
  agentHorizon?: number;
  /** Seconds, > 0: walls are approached so that they are not reached sooner. Default 0.25. */
  wallHorizon?: number;
}

/** An agent: an upright cylinder that stands on the navmesh. */
export interface AgentOptions {
  /** Metres; moved to the navmesh's nearest point within reach. */
  position: Vec3Like;
  /** Metres, >= 0: half the edge of the box in which that point is sought. Default 2. */
  reach?: number;
  /** Metres, > 0, at most 1000. One above the mesh's own keeps the difference from walls. Default 0.3. */
  radius?: number;
  /** Metres, > 0, at most 1000: agents whose heights do not overlap ignore one another. Default 1.8. */
  height?: number;
  /** Metres a second, 0 to 1000. Default 1.4. */
  maxSpeed?: number;
  /** Metres a second squared, > 0. Default 8. */
  maxAcceleration?: number;
  /** Metres in the plane, >= 0: so near to its goal an agent has arrived. Default 0.1. */
  arriveDistance?: number;
  /** 0 to 1: of two agents the one with more evades less. Default 0.5. */
  priority?: number;
  /** The place of its filter (`setFilter`), 0 to 15. Default 0. */
  filter?: number;
  /** Its motion is yours (`setMotion`): a player, a vehicle. The others evade it. Default false. */
  isFixed?: boolean;
}

/** 'gave up': `maxNodes` are too few to find the rest of its path. */
export type AgentStatus =
  | 'idle' | 'waiting' | 'walking' | 'arrived' | 'unreachable' | 'queued' | 'on link' | 'off mesh' | 'gave up' | 'fixed';

/** An agent as it is after the last step. */
export interface AgentState {
  status: AgentStatus;
  /** Metres, on the surface. */
  position: Vec3;
  /** Metres a second, as it moved in the last step. */
  velocity: Vec3;
  /** Metres a second: what steering asked for, before others were avoided. */
  wanted: Vec3;
  /** Under it; on a link where the link lands; null of fixed agents. */
  polygon: NavRef | null;
  /** 'on link': which. */
  link: NavRef | null;
  /** Metres; its position when it has none. Of one that follows: its slot. */
  goal: Vec3;
  radius: number;
  height: number;
}

/** All agents, for drawing. */
export interface CrowdAgents {
  count: number;
  agents: BigUint64Array;
  /** Three numbers each, metres. */
  positions: Float32Array;
  /** Three numbers each, metres a second. */
  velocities: Float32Array;
  status: AgentStatus[];
}

/** What a step did: searches, and agents with each status after it. */
export interface CrowdStepReport {
  /** Paths, and trees of paths to shared goals. */
  searched: number;
  /** Paths that are still to be searched. */
  waiting: number;
  walking: number;
  arrived: number;
  unreachable: number;
  /** Queued ones not counted. */
  onLink: number;
  offMesh: number;
  /** Paths that were taken from the search of a shared goal. */
  shared: number;
}

/** 'column': on the leader's trail; 'wedge': two rows at 45 degrees behind it; 'slots': as `slots` says. */
export type Formation = 'loose' | 'line' | 'column' | 'wedge' | 'ring' | 'slots';

export interface GroupOptions {
  /** Default 'loose'. */
  formation?: Formation;
  /** Metres, > 0, at most 1000: between neighbours, also in a column. Default 1.2. */
  spacing?: number;
  /** Metres, > 0: the leader stands while somebody is so far from its slot. Default 4. */
  waitDistance?: number;
  /** Metres, > 0: who is farther from its slot is not waited for. Default 30. */
  lostDistance?: number;
  /** Of formation 'slots': metres forward and left of the leader, two numbers for each agent but the leader. */
  slots?: ArrayLike<number>;
  /** Agent k of the list takes slot k. Default false: slots are dealt so that ways are short. */
  keepOrder?: boolean;
}

/** A group as it is after the last step. */
export interface GroupState {
  formation: Formation;
  /** Agents, the leader included. */
  count: number;
  /** Those no farther than half the spacing from their slots; the leader is. */
  inPlace: number;
  /** Those whose slots are on the leader's trail. */
  onTrail: number;
  /** Metres: of those who are waited for, the largest distance to a slot. */
  lag: number;
  /** Metres a second: what the leader may walk. */
  speed: number;
  /** Unit, in the plane: where the formation faces. */
  heading: Vec3;
  leader: AgentRef;
}

/**
 * Agents that walk a navmesh to their goals, avoid one another and its walls, and never leave it. The same steps give
 * the same bytes on every machine (`save`, `hash`). The navmesh may change between steps. Only in the full module.
 */
export class Crowd implements Freeable {
  private constructor();
  /** An empty crowd; takes all memory that its steps will use. @throws TalusError TL_ERR_ARGUMENT, TL_ERR_MEMORY */
  static create(navmesh: Navmesh, options?: CrowdOptions): Crowd;
  readonly freed: boolean;
  free(): void;
  [Symbol.dispose](): void;

  /**
   * Adds an agent without a goal. Null: no polygon within reach.
   * @throws TalusError TL_ERR_LIMIT (maxAgents), TL_ERR_ARGUMENT, TL_ERR_NOT_FINITE
   */
  add(options: AgentOptions): AgentRef | null;
  /** Also from its group: where it led one, the next one leads. @throws TalusError TL_ERR_STALE */
  remove(agent: AgentRef): void;
  /**
   * Sends an agent to a place; null: it stops. False: no polygon is near the point.
   * @throws TalusError TL_ERR_STALE, TL_ERR_ARGUMENT (a fixed agent, or one that follows)
   */
  setGoal(agent: AgentRef, goal: NavLocation | Vec3Like | null, options?: NearestOptions): boolean;
  /** Where a fixed agent is now, metres, and how fast it moves, metres a second: before each step in which it moves. */
  setMotion(agent: AgentRef, position: Vec3Like, velocity: Vec3Like): void;
  /** A filter for the agents with its place, 0 to 15; null: the default one. Not part of `save`. */
  setFilter(place: number, filter: NavFilter | null): void;
  /** Moves all agents by `dt` seconds, above 0 and at most 1. @throws TalusError TL_ERR_ARGUMENT (dt) */
  step(dt: number): CrowdStepReport;
  /** @throws TalusError TL_ERR_STALE */
  agent(agent: AgentRef): AgentState;
  /** All of them, in an order that adding and removing others does not change. */
  agents(): CrowdAgents;
  /** The corners of an agent's path from its position on, three numbers each. Null: it has none. */
  corners(agent: AgentRef): Float32Array | null;

  /** Agents that follow the first of them: send that one. @throws TalusError TL_ERR_STALE, TL_ERR_LIMIT, TL_ERR_ARGUMENT */
  addGroup(agents: Iterable<AgentRef>, options?: GroupOptions): GroupRef;
  /** The leader keeps its goal, the others stop. */
  removeGroup(group: GroupRef): void;
  setFormation(group: GroupRef, options?: GroupOptions): void;
  /** @throws TalusError TL_ERR_STALE */
  group(group: GroupRef): GroupState;
  /** By their slots, the leader first. */
  members(group: GroupRef): BigUint64Array;
  /** Null: it is in none. */
  groupOf(agent: AgentRef): GroupRef | null;

  /** The state, to be kept, sent or compared: the same bytes for crowds in the same state. */
  save(): Uint8Array;
  /** Safe on any bytes. @throws TalusError TL_ERR_MAGIC, TL_ERR_TRUNCATED, TL_ERR_ARGUMENT (another size), TL_ERR_CORRUPT */
  restore(bytes: Uint8Array): void;
  /** Of the bytes that `save` gives. */
  hash(): bigint;
}
