// The trajectories of links.

import { jumpLinkPoint, type JumpLink, type OffMeshLinkState } from 'talus';
import type { LayerData, Vec3 } from '../protocol';
import { INK } from '../../scene/palette';
import { plural } from '../../plural';
import { Writer } from './writer';

const PIECES = 12;

export function linkLayer(found: readonly JumpLink[], placed: readonly OffMeshLinkState[], anchor: Vec3): LayerData {
  const writer = new Writer(anchor, 0.1);
  const counts = { drop: 0, jump: 0, climb: 0 };
  for (const link of found) {
    counts[link.kind]++;
    let before = jumpLinkPoint(link, 0);
    for (let i = 1; i <= PIECES; i++) {
      const next = jumpLinkPoint(link, i / PIECES);
      writer.line([...before, ...next], 0, 3, INK[link.kind]);
      before = next;
    }
  }
  for (const link of placed) {
    const start = [...Array.from(link.start)] as Vec3;
    const end = [...Array.from(link.end)] as Vec3;
    const rise = 0.25 * Math.hypot(end[0] - start[0], end[1] - start[1], end[2] - start[2]);
    let before = start;
    for (let i = 1; i <= PIECES; i++) {
      const t = i / PIECES;
      const next: Vec3 = [
        start[0] + t * (end[0] - start[0]),
        start[1] + t * (end[1] - start[1]) + 4 * t * (1 - t) * rise,
        start[2] + t * (end[2] - start[2]),
      ];
      writer.line([...before, ...next], 0, 3, link.anchored ? 0x8e44ad : 0x777777);
      before = next;
    }
  }
  const loose = placed.filter((link) => !link.anchored).length;
  return {
    anchor,
    lines: writer.lines(),
    summary: found.length + placed.length === 0 ? 'none yet: place or find some with the link tool'
      : `${plural(counts.drop, 'drop')}, ${plural(counts.jump, 'jump')}, ${plural(counts.climb, 'climb')}, ${placed.length} placed` +
        (loose > 0 ? `, ${loose} of them without floor at an end` : ''),
    legends: [
      { colour: INK.drop, text: 'drop' }, { colour: INK.jump, text: 'jump' }, { colour: INK.climb, text: 'climb' },
      { colour: 0x8e44ad, text: 'off-mesh link' },
      ...(loose > 0 ? [{ colour: 0x777777, text: 'not anchored' }] : []),
    ],
  };
}
