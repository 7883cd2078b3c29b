// How long each stage takes. A bake in tiles tells of tiles alone, for they run side by side and each is silent: there, some
// of them are baked once more, one by one, and what a stage takes of those is taken for its share of all.

import { bakeStages, Mesh, type NavOptions, type NavTileInfo } from 'talus';
import type { StageTime } from './protocol';

const SHARE = 0.15; // of the bake's own time: what measuring may take
const LEAST = 10; // milliseconds: clocks of pages that are not isolated tell a tenth of one
const LONG = 250; // milliseconds: a tile that takes longer, and longer than the share, is not baked again for this
const STRIDE = 0.618; // of the list, from one tile that is measured to the next: spread evenly wherever it ends

export interface StageTimes {
  stages: StageTime[];
  /** How many tiles they were measured on; null: on all that there is. */
  measuredTiles: number | null;
}

/** `times`: what the bake itself told, by stage. */
export function stageTimes(times: Record<string, number>, mesh: Mesh, options: Required<NavOptions>, tiles: readonly NavTileInfo[]): StageTimes {
  const told = Object.entries(times).map(([stage, milliseconds]) => ({ stage, milliseconds }));
  const all = times.tiles ?? 0;
  if (all === 0 || tiles.length === 0 || all / tiles.length > Math.max(LONG, SHARE * all)) return { stages: told, measuredTiles: null };
  try {
    const { count, sum, measured } = measureTiles(mesh, options, tiles, SHARE * all);
    const scale = all / sum;
    const shares = Object.entries(measured).map(([stage, milliseconds]) => ({ stage, milliseconds: milliseconds * scale }));
    if (sum > 0) return { stages: told.flatMap((one) => (one.stage === 'tiles' ? shares : [one])), measuredTiles: count };
  } catch {
    // A tile in one piece, with the data of all stages, may need more than the bake had. That went well all the same.
  }
  return { stages: told, measuredTiles: null };
}

function measureTiles(
  mesh: Mesh, options: Required<NavOptions>, tiles: readonly NavTileInfo[], room: number,
): { count: number; sum: number; measured: Record<string, number> } {
  // Memory grows for what a bake alone frees at once: not in a time that counts.
  timeTile(mesh, options, tiles[0]!, {});
  const measured: Record<string, number> = {};
  const end = performance.now() + Math.max(LEAST, room);
  let count = 0;
  do {
    timeTile(mesh, options, tiles[Math.floor(((count * STRIDE) % 1) * tiles.length)]!, measured);
    count++;
  } while (count < tiles.length && performance.now() < end);
  return { count, sum: Object.values(measured).reduce((sum, one) => sum + one, 0), measured };
}

function timeTile(mesh: Mesh, options: Required<NavOptions>, { x, z }: NavTileInfo, times: Record<string, number>): void {
  let begun = 0;
  bakeStages(trianglesAround(mesh, options, x, z), {
    ...options, tileX: x, tileZ: z,
    onProgress: (stage, done, total) => {
      const now = performance.now();
      if (done === 0) begun = now;
      else if (done === total) times[stage] = (times[stage] ?? 0) + now - begun;
    },
  });
}

/** Those that a bake gives a tile: in it, or in the border that it sees of its neighbours. */
function trianglesAround({ vertices, indices }: Mesh, { bounds, cellSize, tileSize, agentRadius }: Required<NavOptions>, tileX: number, tileZ: number): Mesh {
  const side = tileSize * cellSize;
  const border = agentRadius + 4 * cellSize;
  const [minX, minZ] = [bounds!.min[0] + tileX * side - border, bounds!.min[2] + tileZ * side - border];
  const [maxX, maxZ] = [minX + side + 2 * border, minZ + side + 2 * border];
  const corners: number[] = [];
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [3 * indices[i]!, 3 * indices[i + 1]!, 3 * indices[i + 2]!];
    const [ax, bx, cx] = [vertices[a]!, vertices[b]!, vertices[c]!];
    if (Math.max(ax, bx, cx) < minX || Math.min(ax, bx, cx) > maxX) continue;
    const [az, bz, cz] = [vertices[a + 2]!, vertices[b + 2]!, vertices[c + 2]!];
    if (Math.max(az, bz, cz) < minZ || Math.min(az, bz, cz) > maxZ) continue;
    corners.push(ax, vertices[a + 1]!, az, bx, vertices[b + 1]!, bz, cx, vertices[c + 1]!, cz);
  }
  return new Mesh(corners);
}
