// From the library's answers to what the page shows.

import type { Navmesh, Soup, WhyAnswer as Why } from 'talus';
import type { BakeSettings, PathAnswer, RayWalk, SightAnswer, Vec3, WalkStep, WhyAnswer } from './protocol';
import { DEFAULTS, showNumber } from '../state/parameters';

const pointAt = (numbers: ArrayLike<number>, i: number): Vec3 =>
  [numbers[3 * i]!, numbers[3 * i + 1]!, numbers[3 * i + 2]!];

function pointsOf(numbers: ArrayLike<number>): Vec3[] {
  return Array.from({ length: numbers.length / 3 }, (_, i) => pointAt(numbers, i));
}

export function pathAnswer(navmesh: Navmesh, start: Vec3, goal: Vec3, radius: number): PathAnswer {
  const begin = performance.now();
  const answer: PathAnswer = {
    status: 'no start', corners: [], polygons: 0, length: 0, surfaceLength: 0, lowerBound: 0, exact: false,
    straight: Math.hypot(goal[0] - start[0], goal[2] - start[2]), clearance: null, nodes: 0, milliseconds: 0,
  };
  const from = navmesh.findNearest(start);
  const to = navmesh.findNearest(goal);
  if (!from || !to) return { ...answer, status: from ? 'no goal' : 'no start' };
  if (radius > navmesh.options.agentRadius) {
    const wide = navmesh.findWidePath(from, to, radius)!;
    answer.status = wide.status;
    answer.corners = pointsOf(wide.corners);
    answer.length = wide.length;
    answer.surfaceLength = wide.surfaceLength;
    answer.clearance = wide.wallDistance;
    if (wide.status === 'goal blocked') answer.nearest = navmesh.findWidePlace(to, radius, { radius: 50 })?.point;
  } else {
    const path = navmesh.findPath(from, to, { polygons: true })!;
    answer.status = path.status;
    answer.corners = pointsOf(path.corners);
    answer.polygons = path.polygons.length;
    answer.length = path.length;
    answer.surfaceLength = path.surfaceLength;
    answer.lowerBound = path.lowerBound;
    answer.exact = path.status === 'complete';
    answer.nodes = path.nodeCount;
  }
  if (answer.status === 'unreachable') {
    const near = navmesh.findNearestReachable(from, goal);
    answer.nearest = near?.point;
    if (near && radius <= navmesh.options.agentRadius) {
      const part = navmesh.findPath(from, near);
      if (part) answer.corners = pointsOf(part.corners);
    }
  }
  answer.milliseconds = performance.now() - begin;
  return answer;
}

export function walkAnswer(soup: Soup, origin: Vec3, direction: Vec3): RayWalk {
  const walk = soup.walkRay(origin, direction);
  const steps: WalkStep[] = [];
  for (let i = 0; i < walk.count; i++) {
    steps.push({
      min: [...walk.boxes.subarray(6 * i, 6 * i + 3)] as Vec3,
      max: [...walk.boxes.subarray(6 * i + 3, 6 * i + 6)] as Vec3,
      depth: walk.depth[i]!,
      leaf: walk.leaf[i] === 1,
      hit: walk.entered[i] === 1,
      enter: walk.enter[i]!,
    });
  }
  const { hit } = walk;
  return {
    hit: hit && {
      point: origin.map((v, i) => v + hit.t * direction[i]!) as Vec3,
      normal: [hit.nx, hit.ny, hit.nz],
      t: hit.t,
      triangle: hit.triangle,
      back: hit.back,
    },
    steps,
    boxes: steps.filter((step) => step.hit).length,
    leaves: steps.filter((step) => step.hit && step.leaf).length,
  };
}

const UNITS: Record<string, [string, string]> = {
  slope: ['Its slope is', '°'],
  ledge: ['The drop or stair is', ' m in voxels'],
  ceiling: ['There are', ' m of free height'],
  radius: ['The floor keeps', ' m from them'],
  island: ['It has', ' columns'],
  'no floor': ['The next floor lies', ' m below'],
  outside: ['It is', ' m'],
};

export function whyAnswer(why: Why): WhyAnswer {
  return {
    walkable: why.walkable,
    floor: [...why.floor] as Vec3,
    proven: why.proven,
    bakes: why.bakeCount,
    apart: why.apart,
    islandArea: why.islandArea,
    largestIslandArea: why.largestIslandArea,
    reasons: why.reasons.map((reason) => {
      const words = UNITS[reason.cause];
      return {
        cause: reason.name,
        stage: reason.stage,
        text: reason.text,
        measured: words && Number.isFinite(reason.measured)
          ? `${words[0]} ${showNumber(Number(reason.measured.toPrecision(4)))}${words[1]}.` : '',
        parameter: reason.option !== null && reason.option in DEFAULTS ? (reason.option as keyof BakeSettings) : null,
        rawParameter: reason.option,
        value: reason.value,
        needed: reason.needed,
      };
    }),
  };
}

/** The outline in a level plane at eye height, and the area inside. */
export function sightAnswer(soup: Soup, place: Vec3, eyeHeight: number, distance: number): SightAnswer {
  const begin = performance.now();
  const eye: Vec3 = [place[0], place[1] + eyeHeight, place[2]];
  const rim = pointsOf(soup.visibleOutline(eye, { count: 1440, distance }).points);
  let area = 0;
  rim.forEach((a, i) => {
    const b = rim[(i + 1) % rim.length]!;
    area += (a[0] - eye[0]) * (b[2] - eye[2]) - (b[0] - eye[0]) * (a[2] - eye[2]);
  });
  return { eye, rim, area: Math.abs(area) / 2, milliseconds: performance.now() - begin };
}
