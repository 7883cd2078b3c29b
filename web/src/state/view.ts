// All that a link reproduces: the level's name, settings, layers, tool, points and camera.

import type { BakeSettings, LayerName, Obstacle, OffmeshLink, Vec3 } from '../engine/protocol';
import { DEFAULTS } from './parameters';

export const TOOLS = ['look', 'path', 'why', 'obstacle', 'link', 'ray', 'sight', 'climb', 'steps', 'audit'] as const;
export type ToolName = (typeof TOOLS)[number];

export interface Camera {
  eye: Vec3;
  target: Vec3;
}

export interface View {
  /** "sample:courtyard", or the name of a file that has to be dropped again. */
  level: string;
  /** The file's axis that points up, and metres a unit of it. */
  up: 'y' | 'z';
  scale: number;
  settings: BakeSettings;
  layers: readonly LayerName[];
  tool: ToolName;
  camera: Camera | null;
  start: Vec3 | null;
  goal: Vec3 | null;
  /** Metres; 0: that of the bake. */
  walkRadius: number;
  why: Vec3 | null;
  ray: { origin: Vec3; direction: Vec3 } | null;
  guard: Vec3 | null;
  eyeHeight: number;
  boxDepth: number;
  /** Metres: what lies above is not drawn. */
  cut: number | null;
  obstacles: readonly Obstacle[];
  links: readonly OffmeshLink[];
  theme: 'auto' | 'light' | 'dark';
}

export function defaultView(): View {
  return {
    level: 'sample:courtyard',
    up: 'y',
    scale: 1,
    settings: { ...DEFAULTS },
    layers: ['triangles', 'tiles'],
    tool: 'look',
    camera: null,
    start: null,
    goal: null,
    walkRadius: 0,
    why: null,
    ray: null,
    guard: null,
    eyeHeight: 1.6,
    boxDepth: 4,
    cut: null,
    obstacles: [],
    links: [],
    theme: 'auto',
  };
}
