// The level that `talus view` wrote into the page.

import type { LevelSource } from '../app';
import type { BakeSettings } from '../engine/protocol';

export interface Embedded {
  source: LevelSource;
  /** As in a link. */
  hash: string;
  /** What it was baked with, also where nothing is walkable. */
  settings: Partial<BakeSettings>;
}

function decodeBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

export function readEmbedded(): Embedded | null {
  const about = document.getElementById('talus-view');
  const pack = document.getElementById('talus-pack');
  if (!about || !pack) return null;
  const { name, hash, settings } = JSON.parse(about.textContent ?? '{}') as Omit<Embedded, 'source'> & { name: string };
  const bytes = decodeBase64((pack.textContent ?? '').trim());
  pack.remove(); // its text is as large as the level
  return { source: { kind: 'pack', name, bytes }, hash, settings };
}
