// The view as a URL's hash, and back. Only what differs from the defaults is written; what a hash says wrongly is
// ignored, and named.

import { LAYERS, type BakeSettings, type LayerName, type Obstacle, type OffmeshLink, type Vec3 } from '../engine/protocol';
import { DEFAULTS, PARAMETERS, showNumber } from './parameters';
import { defaultView, TOOLS, type ToolName, type View } from './view';

const point = (p: Vec3): string => p.map((v) => String(Number(v.toFixed(4)))).join(',');

export function viewToHash(view: Readonly<View>): string {
  const usual = defaultView();
  const parts: [string, string][] = [['level', view.level]];
  if (view.up !== usual.up) parts.push(['up', view.up]);
  if (view.scale !== usual.scale) parts.push(['scale', showNumber(view.scale)]);
  for (const parameter of PARAMETERS) {
    const value = view.settings[parameter.key];
    if (value !== DEFAULTS[parameter.key]) {
      parts.push([parameter.key, typeof value === 'number' ? showNumber(value) : String(value)]);
    }
  }
  if (view.layers.join() !== usual.layers.join()) parts.push(['layers', view.layers.join(',')]);
  if (view.tool !== usual.tool) parts.push(['tool', view.tool]);
  if (view.camera) parts.push(['camera', `${point(view.camera.eye)};${point(view.camera.target)}`]);
  if (view.start) parts.push(['start', point(view.start)]);
  if (view.goal) parts.push(['goal', point(view.goal)]);
  if (view.walkRadius > 0) parts.push(['walkRadius', showNumber(view.walkRadius)]);
  if (view.why) parts.push(['why', point(view.why)]);
  if (view.ray) parts.push(['ray', `${point(view.ray.origin)};${point(view.ray.direction)}`]);
  if (view.guard) parts.push(['guard', point(view.guard)]);
  if (view.eyeHeight !== usual.eyeHeight) parts.push(['eyeHeight', showNumber(view.eyeHeight)]);
  if (view.boxDepth !== usual.boxDepth) parts.push(['boxDepth', String(view.boxDepth)]);
  if (view.cut !== null) parts.push(['cut', showNumber(view.cut)]);
  if (view.obstacles.length > 0) {
    parts.push(['obstacles', view.obstacles
      .map((o) => `${o.shape}:${point(o.base)}:${showNumber(o.radius)}:${showNumber(o.height)}`).join(';')]);
  }
  if (view.links.length > 0) {
    parts.push(['links', view.links.map((l) => `${point(l.start)}:${point(l.end)}:${l.bothWays ? 2 : 1}`).join(';')]);
  }
  if (view.theme !== usual.theme) parts.push(['theme', view.theme]);
  return '#' + parts.map(([key, value]) => `${key}=${encodeURIComponent(value).replace(/%(2C|3A|3B)/g, decodeURIComponent)}`)
    .join('&');
}

function readNumbers(text: string, count: number): number[] {
  const numbers = text.split(',').map((word) => (word.trim() === '' ? NaN : Number(word)));
  if (numbers.length !== count || !numbers.every(Number.isFinite)) throw new Error(`'${text}' is not ${count} numbers`);
  return numbers;
}

const readPoint = (text: string): Vec3 => readNumbers(text, 3) as Vec3;

function readPair(text: string): [Vec3, Vec3] {
  const [a = '', b = ''] = text.split(';');
  return [readPoint(a), readPoint(b)];
}

function readOne<T extends string>(text: string, words: readonly T[]): T {
  const found = words.find((word) => word === text);
  if (found === undefined) throw new Error(`'${text}' is none of ${words.join(', ')}`);
  return found;
}

function readPositive(text: string): number {
  const [value] = readNumbers(text, 1);
  if (value! < 0) throw new Error(`'${text}' is negative`);
  return value!;
}

function readObstacle(text: string, index: number): Obstacle {
  const [shape = '', base = '', radius = '', height = ''] = text.split(':');
  return {
    id: index + 1,
    shape: readOne(shape, ['cylinder', 'box'] as const),
    base: readPoint(base),
    radius: readPositive(radius),
    height: readPositive(height),
  };
}

function readLink(text: string): OffmeshLink {
  const [start = '', end = '', ways = ''] = text.split(':');
  return { start: readPoint(start), end: readPoint(end), bothWays: readOne(ways, ['1', '2']) === '2' };
}

function readSetting(settings: BakeSettings, key: string, text: string): boolean {
  const parameter = PARAMETERS.find((one) => one.key === key);
  if (!parameter) return false;
  const target = settings as unknown as Record<string, unknown>;
  if (parameter.kind === 'number') {
    // Settings beyond a slider's ends are legal: the bake judges them.
    target[key] = readPositive(text);
  } else if (parameter.kind === 'choice') {
    target[key] = readOne(text, parameter.choices);
  } else {
    target[key] = readOne(text, ['true', 'false']) === 'true';
  }
  return true;
}

const READERS: Record<string, (text: string) => Partial<View>> = {
  level: (text) => ({ level: text }),
  up: (text) => ({ up: readOne(text, ['y', 'z'] as const) }),
  scale: (text) => ({ scale: readPositive(text) || 1 }),
  layers: (text) => ({ layers: text === '' ? [] : text.split(',').map((word) => readOne<LayerName>(word, LAYERS)) }),
  tool: (text) => ({ tool: readOne<ToolName>(text, TOOLS) }),
  camera: (text) => {
    const [eye, target] = readPair(text);
    return { camera: { eye, target } };
  },
  start: (text) => ({ start: readPoint(text) }),
  goal: (text) => ({ goal: readPoint(text) }),
  walkRadius: (text) => ({ walkRadius: readPositive(text) }),
  why: (text) => ({ why: readPoint(text) }),
  ray: (text) => {
    const [origin, direction] = readPair(text);
    return { ray: { origin, direction } };
  },
  guard: (text) => ({ guard: readPoint(text) }),
  eyeHeight: (text) => ({ eyeHeight: readPositive(text) }),
  boxDepth: (text) => ({ boxDepth: Math.min(64, Math.round(readPositive(text))) }),
  cut: (text) => ({ cut: readNumbers(text, 1)[0]! }),
  obstacles: (text) => ({ obstacles: text === '' ? [] : text.split(';').map(readObstacle) }),
  links: (text) => ({ links: text === '' ? [] : text.split(';').map(readLink) }),
  theme: (text) => ({ theme: readOne(text, ['auto', 'light', 'dark'] as const) }),
};

/** Whether a hash names bake settings. */
export function hashHasSettings(hash: string): boolean {
  return PARAMETERS.some(({ key }) => hash.includes(`#${key}=`) || hash.includes(`&${key}=`));
}

/** The view that a hash describes, and what in it could not be read. */
export function hashToView(hash: string): { view: View; faults: string[] } {
  const view = defaultView();
  const faults: string[] = [];
  for (const part of hash.replace(/^#/, '').split('&')) {
    if (part === '') continue;
    const at = part.indexOf('=');
    const key = at < 0 ? part : part.slice(0, at);
    try {
      const text = at < 0 ? '' : decodeURIComponent(part.slice(at + 1));
      if (readSetting(view.settings, key, text)) continue;
      const reader = READERS[key];
      if (!reader) throw new Error('is not known');
      Object.assign(view, reader(text));
    } catch (error) {
      faults.push(`${key}: ${error instanceof Error ? error.message : String(error)}`);
    }
  }
  return { view, faults };
}
