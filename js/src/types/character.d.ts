// SPDX-License-Identifier: MIT

import type { Freeable, Pose, Vec3, Vec3Like } from './base.js';
import type { Scene, SceneFilter } from './scene.js';
import type { Soup, TriangleFilter } from './soup.js';

/** The shape of characters and what they can do. */
export interface CharacterOptions {
  /** Metres, > 0. Default 0.3. */
  radius?: number;
  /** Metres, >= 2 radius, from the feet to the top. Default 1.8. */
  height?: number;
  /** Metres, >= 0: the highest step that it climbs, and follows down. Default 0.4. */
  stepHeight?: number;
  /** Degrees, 0 to 85: steeper ground is a wall when it walks, and slides off. Default 45. */
  maxSlope?: number;
  /** Metres, > 0, at most radius / 4: kept free around the capsule. Default 0.002. */
  gap?: number;
  /** Near a character at one time, >= 16. Default 1024. */
  maxTriangles?: number;
}

/** A character. Begin with `{ position }`; a move fills in the rest. Copy and store it as you like: it is all there is. */
export interface CharacterState {
  /** Metres, of its feet: the lowest point of the capsule. */
  position: Vec3Like;
  /** Metres a second: the part of the last wish that its contacts allow, and what its ground gave it when it left that. */
  velocity?: Vec3;
  /** Unit, of the face that it stands on; zero in the air. */
  groundNormal?: Vec3;
  groundPoint?: Vec3;
  /** Whether it stands on something that can be walked on. */
  grounded?: boolean;
  /** In its soup; null: it stands on a shape. */
  groundTriangle?: number | null;
  /** In the scene; 0 in a soup. */
  groundInstance?: number;
  /** Of that instance, at the end of the last move. */
  groundPose?: Pose;
}

/** What a character is to do in one step of the game. */
export interface CharacterStep {
  /**
   * Metres a second. On the ground it is relative to the ground, x and z alone count, and the ground is followed; with
   * `jump` y counts too. In the air it is the velocity in the world: gravity is yours to add.
   */
  velocity: Vec3Like;
  /** >= 0. */
  seconds: number;
  /** The ground does not hold it in this step. Default false. */
  jump?: boolean;
}

/** Something that a character touched or ran into. */
export interface CharacterHit {
  point: Vec3;
  /** Unit, towards the character. */
  normal: Vec3;
  instance: number;
  /** Null: a shape. */
  triangle: number | null;
  material: number;
  /** 'slope': faces up, too steep. */
  surface: 'ground' | 'slope' | 'wall' | 'ceiling';
}

/** What a move did. */
export interface CharacterReport {
  /** It came from the air to the ground. */
  landed: boolean;
  /** The other way: a jump, a ledge, a slope too steep. */
  leftGround: boolean;
  /** A wall or steep slope took a part of the motion. */
  blocked: boolean;
  /** Something above stopped it. */
  hitCeiling: boolean;
  /** It overlaps the level at its end, and no small motion parts them. */
  stuck: boolean;
  /** Metres climbed over steps. */
  steppedUp: number;
  /** Metres that it was pushed out of what it overlapped at its start. */
  pushed: number;
  /** Metres, by the platform that it stands on. */
  carried: Vec3;
  /** That platform's rotation since the last move, a quaternion x, y, z, w: turn the character's heading by it. */
  turned: [x: number, y: number, z: number, w: number];
  /** Things met, each triangle once; of more than eight the first. */
  hits: CharacterHit[];
}

/**
 * Moves characters: upright capsules that slide along walls, follow steps and slopes, ride on platforms, and get out of
 * what they were put into; nothing is tunnelled through. One mover serves any number of characters. The same state, level
 * and step give the same numbers on every machine.
 */
export class CharacterMover implements Freeable {
  private constructor();
  /** TL_ERR_ARGUMENT with the option in `field`, TL_ERR_MEMORY. */
  static create(options?: CharacterOptions): CharacterMover;
  readonly freed: boolean;
  free(): void;
  [Symbol.dispose](): void;
  /**
   * Moves a character for one step and writes its state. After an error it is unchanged: TL_ERR_ARGUMENT,
   * TL_ERR_NOT_FINITE, TL_ERR_RANGE (farther than 1 km in a step, or too far out for floats), TL_ERR_LIMIT
   * (`maxTriangles`).
   */
  move(level: Soup, state: CharacterState, step: CharacterStep, filter?: TriangleFilter | null): CharacterReport;
  move(level: Scene, state: CharacterState, step: CharacterStep, filter?: SceneFilter | null): CharacterReport;
}
