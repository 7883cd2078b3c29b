// Two algorithms step by step: how the support function climbs a hull, and how a contour becomes polygons.

import type { Hull, OutlineStage, PolygonSteps } from 'talus';
import type { ClimbAnswer, PolygonStep, StepsAnswer, Vec3 } from './protocol';

const pointAt = (numbers: ArrayLike<number>, i: number): Vec3 =>
  [numbers[3 * i]!, numbers[3 * i + 1]!, numbers[3 * i + 2]!];

/** `start`: a vertex, or -1: the one farthest the other way. */
export function climbAnswer(hull: Hull, direction: Vec3, start: number): ClimbAnswer {
  const vertices = hull.vertices();
  const first = start >= 0 && start < hull.vertexCount ? start
    : hull.support(-direction[0], -direction[1], -direction[2]);
  const path = hull.supportClimb(direction, first);
  const neighbours = new Map<number, number[]>();
  const edges = hull.edges();
  for (let i = 0; i < edges.length; i += 2) {
    const [a, b] = [edges[i]!, edges[i + 1]!];
    neighbours.set(a, [...(neighbours.get(a) ?? []), b]);
    neighbours.set(b, [...(neighbours.get(b) ?? []), a]);
  }
  const height = (v: number): number => pointAt(vertices, v).reduce((sum, x, i) => sum + x * direction[i]!, 0);
  return {
    path: [...path].map((v) => pointAt(vertices, v)),
    neighbours: [...path].map((v) => (neighbours.get(v) ?? []).map((n) => pointAt(vertices, n))),
    heights: [...path].map(height),
    answer: pointAt(vertices, hull.support(...direction)),
    vertices: hull.vertexCount,
    faces: hull.faceCount,
  };
}

function isInside(outline: readonly Vec3[], point: Vec3): boolean {
  let inside = false;
  for (let i = 0, j = outline.length - 1; i < outline.length; j = i++) {
    const [a, b] = [outline[i]!, outline[j]!];
    if (a[2] > point[2] !== b[2] > point[2] &&
        point[0] < ((b[0] - a[0]) * (point[2] - a[2])) / (b[2] - a[2]) + a[0]) inside = !inside;
  }
  return inside;
}

function outlineOf(stage: OutlineStage, i: number): Vec3[] {
  const points: Vec3[] = [];
  for (let v = stage.firstVertex[i]!; v < stage.firstVertex[i + 1]!; v++) points.push(pointAt(stage.vertices, v));
  return points;
}

/** The contour at the point and nearest to its height; without one, a contour worth a look. */
function chooseContour(stage: OutlineStage, point: Vec3 | null): number {
  let best = 0;
  let bestScore = -Infinity;
  for (let i = 0; i < stage.count; i++) {
    const outline = outlineOf(stage, i);
    // Large enough to have a story, small enough to be followed.
    let score = -Math.abs(outline.length - 16);
    if (point) {
      const height = outline.reduce((sum, p) => sum + p[1], 0) / outline.length;
      const away = Math.min(...outline.map((p) => Math.hypot(p[0] - point[0], p[2] - point[2])));
      score = isInside(outline, point) ? -Math.abs(height - point[1]) : -1000 - away;
    }
    if (score > bestScore) {
      best = i;
      bestScore = score;
    }
  }
  return best;
}

export function stepsAnswer(steps: PolygonSteps, contours: OutlineStage, point: Vec3 | null): StepsAnswer {
  const contour = chooseContour(contours, point);
  const range = (first: Uint32Array, numbers: Float32Array, i: number): Vec3[] => {
    const points: Vec3[] = [];
    for (let k = first[i]!; k < first[i + 1]!; k++) points.push(pointAt(numbers, k));
    return points;
  };
  const chosen: PolygonStep[] = [];
  for (let i = 0; i < steps.count; i++) {
    if (steps.contour[i] !== contour) continue;
    const partitions: Vec3[] = [];
    for (let k = 2 * steps.firstPartition[i]!; k < 2 * steps.firstPartition[i + 1]!; k++) {
      partitions.push(pointAt(steps.partitions, k));
    }
    chosen.push({
      kind: steps.kind[i] === 0 ? 'cut' : 'merge',
      corners: range(steps.firstCorner, steps.corners, i),
      partitions,
      outline: range(steps.firstOutline, steps.outline, i),
    });
  }
  return {
    contour,
    contours: contours.count,
    cuts: chosen.filter((step) => step.kind === 'cut').length,
    merges: chosen.filter((step) => step.kind === 'merge').length,
    steps: chosen,
    outline: contours.count > 0 ? outlineOf(contours, contour) : [],
  };
}
