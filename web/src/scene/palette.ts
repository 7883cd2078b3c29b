// Colours that mean the same in every layer; those of `talus draw`.

export const INK = {
  wall: 0x23303f,
  inner: 0xffffff,
  walkable: 0x7fb3d5,
  closed: 0xb9a89c,
  solid: 0xcfc8bb,
  single: 0xe8833a,
  box: 0x1d2f6f,
  path: 0xc0392b,
  corridor: 0xf2c14e,
  start: 0x1e8449,
  goal: 0xc0392b,
  drop: 0x1f77b4,
  jump: 0xd62728,
  climb: 0x2ca02c,
  hit: 0xe74c3c,
  sight: 0xf1c40f,
  border: 0x606060,
  none: 0x9a9a9a,
} as const;

/** Hues a golden angle apart, so that neighbouring numbers differ. */
export function colourOfId(id: number): number {
  const hue = (id * 0.61803398875) % 1;
  const lightness = 0.56 + 0.1 * ((id >> 2) % 2);
  const channel = (offset: number): number => {
    const k = (offset + hue * 12) % 12;
    const a = 0.5 * Math.min(lightness, 1 - lightness);
    return Math.round(255 * (lightness - a * Math.max(-1, Math.min(k - 3, 9 - k, 1))));
  };
  return (channel(0) << 16) | (channel(8) << 8) | channel(4);
}

export function mix(a: number, b: number, t: number): number {
  let mixed = 0;
  for (const shift of [16, 8, 0]) {
    const from = (a >> shift) & 255;
    const to = (b >> shift) & 255;
    mixed |= Math.round(from + (to - from) * t) << shift;
  }
  return mixed;
}

export function colourOfArea(area: number, shade: number): number {
  const colour = area === 63 ? INK.walkable : colourOfId(area);
  return shade === 0 ? colour : mix(colour, 0xffffff, 0.14);
}

export function colourOfDistance(t: number): number {
  return t < 0.5 ? mix(0x27346b, 0x3aa6a0, 2 * t) : mix(0x3aa6a0, 0xf6e27a, 2 * t - 1);
}

export function css(colour: number): string {
  return `#${colour.toString(16).padStart(6, '0')}`;
}
