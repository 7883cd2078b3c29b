// The `talus` command lines that do what the page shows.

import { DEFAULTS, PARAMETERS, showNumber } from './parameters';
import type { View } from './view';
import type { BakeSettings, Vec3 } from '../engine/protocol';

export function bakeOptions(settings: Readonly<BakeSettings>): string[] {
  const words: string[] = [];
  for (const parameter of PARAMETERS) {
    const value = settings[parameter.key];
    if (value === DEFAULTS[parameter.key]) continue;
    if (parameter.kind === 'flag') words.push(`--${parameter.option}`);
    else words.push(`--${parameter.option}`, typeof value === 'number' ? showNumber(value) : String(value));
  }
  return words;
}

const quote = (word: string): string => (/^[\w.,:/+@=-]+$/.test(word) ? word : `'${word.replace(/'/g, `'\\''`)}'`);
const point = (p: Vec3): string => p.map((v) => String(Number(v.toFixed(3)))).join(',');

/** One command a line. `name` is the level's file. */
export function commandLines(view: Readonly<View>, name: string): string {
  const lines: string[] = [];
  const sample = view.level.startsWith('sample:') ? view.level.slice(7) : null;
  const level = quote(sample ? `${sample}.obj` : name);
  const baked = quote((sample ?? name).replace(/\.[^.]*$/, '') + '.talus');
  if (sample) lines.push(`talus sample ${quote(sample)} -o ${level}`);
  if (!name.endsWith('.talus') || sample) {
    const links = view.layers.includes('links') ? ['--links'] : [];
    const levelOptions = sample ? [] : [
      ...(view.up === 'z' ? ['--up', 'z'] : []), ...(view.scale !== 1 ? ['--scale', showNumber(view.scale)] : []),
    ];
    lines.push(['talus bake', level, '-o', baked, ...levelOptions, ...bakeOptions(view.settings), ...links].join(' '));
  }
  if (view.tool === 'path' && view.start && view.goal) {
    const radius = view.walkRadius > 0 ? ` --radius ${showNumber(view.walkRadius)}` : '';
    lines.push(`talus path ${baked} ${point(view.start)} ${point(view.goal)}${radius}`);
  }
  if (view.tool === 'why' && view.why) lines.push(`talus why ${baked} ${point(view.why)}`);
  if (view.tool === 'ray' && view.ray) {
    lines.push(`talus ray ${baked} ${point(view.ray.origin)} ${point(view.ray.direction)}`);
  }
  if (view.tool === 'audit') lines.push(`talus audit ${baked}`);
  return lines.join('\n');
}
