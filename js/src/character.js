// SPDX-License-Identifier: MIT
//
// Characters: a capsule that walks over a soup or a scene. Its state is a plain object of the caller's, whose numbers
// are 32-bit floats: it goes to the module and comes back exactly (wasm/js_character.c).

import { argumentError } from './error.js';
import { Handle, PRIVATE, refuseNew } from './handle.js';
import { F64, SLOT, check, fail, putPose, putVec3, ready, slotVec3, wasm } from './module.js';
import { Scene, sceneFiltered } from './scene.js';
import { Soup, filtered } from './soup.js';

const OPTIONS = ['radius', 'height', 'stepHeight', 'maxSlope', 'gap', 'maxTriangles'];
const SURFACES = ['ground', 'slope', 'wall', 'ceiling'];
const NO_TRIANGLE = 0xffffffff;
const ZERO = [0, 0, 0];
const STEP = 22, REPORT = 22, HITS = 37, HIT_NUMBERS = 10, MOST_HITS = 8; // places in the slot

const slotQuat = (at) => [F64[SLOT + at], F64[SLOT + at + 1], F64[SLOT + at + 2], F64[SLOT + at + 3]];
const triangleAt = (at) => (F64[SLOT + at] === NO_TRIANGLE ? null : F64[SLOT + at]);

function putState(state) {
  if (!(state?.position?.length >= 3)) throw argumentError('position', 'a character begins with { position: [x, y, z] }');
  putVec3(0, state.position);
  putVec3(3, state.velocity ?? ZERO);
  putVec3(6, state.groundNormal ?? ZERO);
  putVec3(9, state.groundPoint ?? ZERO);
  F64[SLOT + 12] = state.grounded ? 1 : 0;
  F64[SLOT + 13] = state.groundTriangle === null ? NO_TRIANGLE : state.groundTriangle ?? 0;
  F64[SLOT + 14] = state.groundInstance ?? 0;
  putPose(15, state.groundPose);
}

function takeState(state) {
  state.position = slotVec3(0);
  state.velocity = slotVec3(3);
  state.groundNormal = slotVec3(6);
  state.groundPoint = slotVec3(9);
  state.grounded = F64[SLOT + 12] !== 0;
  state.groundTriangle = triangleAt(13);
  state.groundInstance = F64[SLOT + 14];
  state.groundPose = { rotation: slotQuat(15), position: slotVec3(19) };
}

function takeHit(at) {
  return { point: slotVec3(at), normal: slotVec3(at + 3), instance: F64[SLOT + at + 6], triangle: triangleAt(at + 7),
           material: F64[SLOT + at + 8], surface: SURFACES[F64[SLOT + at + 9]] };
}

function takeReport() {
  const s = SLOT + REPORT, count = Math.min(F64[s + 14], MOST_HITS);
  return {
    landed: F64[s] !== 0, leftGround: F64[s + 1] !== 0, blocked: F64[s + 2] !== 0, hitCeiling: F64[s + 3] !== 0,
    stuck: F64[s + 4] !== 0, steppedUp: F64[s + 5], pushed: F64[s + 6], carried: slotVec3(REPORT + 7), turned: slotQuat(REPORT + 10),
    hits: Array.from({ length: count }, (_, i) => takeHit(HITS + HIT_NUMBERS * i)),
  };
}

export class CharacterMover extends Handle {
  constructor(key, address) {
    refuseNew(key, 'CharacterMover');
    super(address, 'js_character_free');
  }

  static create(options = {}) {
    ready().js_character_default();
    OPTIONS.forEach((name, i) => {
      if (options[name] !== undefined) F64[SLOT + i] = options[name];
    });
    const address = wasm.js_character_create() >>> 0;
    if (address === 0) fail(F64[SLOT]);
    return new CharacterMover(PRIVATE, address);
  }

  move(level, state, { velocity, seconds, jump = false }, filter = null) {
    const mover = this._address, inScene = level instanceof Scene;
    if (!inScene && !(level instanceof Soup)) throw argumentError('level', 'give a Soup or a Scene');
    const address = level._address;
    const result = (inScene ? sceneFiltered : filtered)(filter, (f) => {
      putState(state);
      putVec3(STEP, velocity);
      F64[SLOT + STEP + 3] = seconds;
      F64[SLOT + STEP + 4] = jump ? 1 : 0;
      return inScene ? wasm.js_character_move(mover, 0, address, 0, f) : wasm.js_character_move(mover, address, 0, f, 0);
    });
    check(result);
    takeState(state);
    return takeReport();
  }
}
