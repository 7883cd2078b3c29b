// The layers in the order of the pipeline: what each shows, and how it is drawn.

import type { LayerName } from '../engine/protocol';
import type { LayerStyle } from './build';

export interface LayerEntry {
  name: LayerName;
  label: string;
  help: string;
  stage: 'Level' | 'Rays' | 'Voxels' | 'Regions' | 'Polygons' | 'Navmesh' | 'Convex';
  style: LayerStyle;
}

const entry = (
  stage: LayerEntry['stage'], name: LayerName, label: string, help: string, rank: number, lit = false, opacity = 1,
): LayerEntry => ({ name, label, help, stage, style: { rank, lit, opacity } });

export const CATALOGUE: readonly LayerEntry[] = [
  { ...entry('Level', 'triangles', 'Triangles', 'The level as it was read.', 0, true), style: { rank: 0, lit: true, opacity: 1, openBacks: true } },
  entry('Rays', 'pairs', 'Soup pairs', 'Triangles that share an edge are stored and tested together: a hue each pair.', 1, true),
  entry('Rays', 'boxes', 'Tree boxes', 'The boxes of the ray tree down to a depth.', 2),
  entry('Voxels', 'spans', 'Spans', 'Solid voxels of each column, their walkable tops coloured.', 1),
  entry('Voxels', 'floors', 'Floors', 'Open floors by area after the filters and erosion by the radius.', 2),
  entry('Voxels', 'distance', 'Distance field', 'How far each floor is from the nearest wall or ledge.', 3),
  entry('Regions', 'regions', 'Regions', 'What the partition made of the floors: a hue each region.', 4),
  entry('Regions', 'contours', 'Contours', 'Traced outlines, thin, and the simplified ones over them.', 5),
  entry('Polygons', 'merging', 'Triangles to merge', 'The contours as triangles, before merging.', 5, false, 0.85),
  entry('Polygons', 'polygons', 'Polygons', 'Convex polygons, a hue each region; dark edges are walls.', 6, false, 0.85),
  entry('Polygons', 'detail', 'Detail mesh', 'Heights inside the polygons.', 7, false, 0.9),
  entry('Navmesh', 'tiles', 'Tiles', 'What queries read: the tiles with their borders, polygons by area.', 8, false, 0.85),
  entry('Navmesh', 'links', 'Links', 'Drops, jumps and climbs, and off-mesh links.', 9),
  entry('Convex', 'hull', 'Hull', 'The convex hull of the level.', 1, false, 0.25),
];

// What a bake makes of the level, stage by stage. Spans hide the triangles that they are made of.
const STAGES: readonly (readonly LayerName[])[] = [
  ['triangles'], ['spans'],
  ...(['floors', 'distance', 'regions', 'contours', 'merging', 'polygons', 'detail', 'tiles'] as const)
    .map((name): readonly LayerName[] => ['triangles', name]),
];

/** The layers of the stage after the last one shown, or before it. */
export function nextStage(shown: readonly LayerName[], by: 1 | -1): readonly LayerName[] {
  let at = STAGES.length - 1;
  while (at > 0 && !shown.includes(STAGES[at]!.at(-1)!)) at--;
  return STAGES[Math.min(STAGES.length - 1, Math.max(0, at + by))]!;
}
