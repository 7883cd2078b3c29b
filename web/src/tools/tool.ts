// What a tool is: it answers clicks and drags on the level, draws marks, and says in a panel what it found.

import type { RayHit, Vec3 } from '../engine/protocol';
import type { ToolName } from '../state/view';

/** A point that can be dragged over the level. */
export interface Handle {
  name: string;
  at: Vec3;
  move(hit: RayHit): void;
}

/** How a second kind of click is made here: fingers have no Shift key. */
export const SECOND_CLICK = matchMedia('(pointer: coarse)').matches ? 'A long press' : 'Shift-click';

export interface Click {
  /** What the ray through the pointer hits first. */
  hit: RayHit | null;
  ray: { origin: Vec3; direction: Vec3 };
  /** With Shift held, or a long press of a finger. */
  second: boolean;
}

export interface Tool {
  readonly name: ToolName;
  readonly label: string;
  /** The key that chooses it. */
  readonly key: string;
  /** What to do with it, in a line. */
  readonly hint: string;
  readonly panel: HTMLElement;
  /** Points that can be dragged while the tool is chosen. */
  handles(): readonly Handle[];
  click(click: Click): void;
  /** The tool was chosen, or what it shows may have changed: the bake, its tiles, the view. */
  refresh(): void;
  /** Another tool was chosen. */
  leave(): void;
}
