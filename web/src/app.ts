// What panels and tools share: the view, the picture, the engine, and what is open.

import type { EngineHost } from './engine/host';
import type { BakeInfo, LevelInfo, LevelMesh, Progress } from './engine/protocol';
import type { Layers } from './layers/layers';
import type { Stage } from './scene/stage';
import type { Store } from './state/store';
import type { View } from './state/view';

/** What goes on, for panels to show. Not part of a link. */
export interface Session {
  level: LevelInfo | null;
  bake: BakeInfo | null;
  progress: Progress | null;
  baking: boolean;
  /** A long question that is being answered: an audit, a search for links. */
  working: string | null;
  /** Changes with every bake, and with every change of tiles. */
  bakeNumber: number;
  tilesNumber: number;
  message: { text: string; kind: 'info' | 'error'; field?: string } | null;
}

/** A level to open: triangles, a baked file, or a sample by name. */
export type LevelSource =
  | { kind: 'mesh'; mesh: LevelMesh }
  | { kind: 'pack'; name: string; bytes: Uint8Array<ArrayBuffer> }
  | { kind: 'sample'; name: string };

export interface App {
  readonly view: Store<View>;
  readonly session: Store<Session>;
  readonly stage: Stage;
  readonly engine: EngineHost;
  readonly layers: Layers;
  /** What was opened; a bake starts from it. */
  source: LevelSource | null;
  say(text: string, kind?: 'info' | 'error', field?: string): void;
  open(source: LevelSource, keepCamera?: boolean): Promise<void>;
  rebake(): void;
  cancel(): void;
  tilesChanged(): void;
  /** Shows that a long question is being answered; `cancel` ends it. */
  work<T>(label: string, task: () => Promise<T>): Promise<T>;
}
