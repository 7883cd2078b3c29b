// Elements, made in one expression.

type Child = Node | string | null | undefined | false;
type Properties = Record<string, unknown>;

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K, properties: Properties = {}, ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith('on') && typeof value === 'function') {
      element.addEventListener(name.slice(2), value as EventListener);
    } else if (name === 'class') {
      element.className = String(value);
    } else if (name === 'style') {
      element.style.cssText = String(value);
    } else if (name in element && !name.startsWith('aria') && name !== 'role') {
      (element as unknown as Properties)[name] = value;
    } else {
      element.setAttribute(name, value === true ? '' : String(value));
    }
  }
  element.append(...children.filter((child): child is Node | string => child !== null && child !== undefined && child !== false));
  return element;
}

export function fill(parent: HTMLElement, ...children: Child[]): void {
  parent.replaceChildren(...children.filter((child): child is Node | string => Boolean(child)));
}

export function metres(value: number): string {
  const size = Math.abs(value);
  if (!Number.isFinite(value)) return '∞';
  return `${size >= 1000 ? count(Math.round(value)) : Number(value.toPrecision(size >= 1 ? 5 : 3))} m`;
}

export function count(value: number): string {
  return value.toLocaleString('en');
}

export function milliseconds(value: number): string {
  if (value >= 10_000) return `${(value / 1000).toFixed(1)} s`;
  if (value >= 100) return `${count(Math.round(value))} ms`;
  return `${value.toFixed(value >= 10 ? 1 : 2)} ms`;
}

export function bytes(value: number): string {
  if (value >= 1 << 20) return `${(value / (1 << 20)).toFixed(1)} MB`;
  return `${Math.max(1, Math.round(value / 1024))} KB`;
}

/** Rows of a name and a value. */
export function facts(rows: readonly (readonly [string, string])[]): HTMLElement {
  return h('dl', { class: 'facts' }, ...rows.flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value)]));
}

export interface SliderOptions {
  label: string;
  unit: string;
  min: number;
  max: number;
  step: number;
  ratio?: boolean;
  help?: string;
  value: number;
  id: string;
  change(value: number): void;
}

/** A slider with a field for the exact number beside it; the field takes numbers beyond the slider's ends. */
export function slider(options: SliderOptions): { element: HTMLElement; set(value: number): void } {
  const { min, max, step, ratio, unit, id } = options;
  const toSlider = (value: number): number =>
    ratio ? 1000 * Math.log(Math.min(max, Math.max(min, value)) / min) / Math.log(max / min) : value;
  const fromSlider = (place: number): number => {
    const value = ratio ? min * Math.pow(max / min, place / 1000) : place;
    const rounding = ratio ? (value < 0.1 ? 0.005 : value < 1 ? 0.01 : 0.05) : step;
    return Number((Math.round(value / rounding) * rounding).toFixed(4));
  };
  const range = h('input', {
    type: 'range', id, min: String(ratio ? 0 : min), max: String(ratio ? 1000 : max), step: String(ratio ? 1 : step),
    'aria-describedby': options.help ? `${id}-help` : undefined,
  });
  const field = h('input', { type: 'number', step: 'any', class: 'number', 'aria-label': `${options.label}, exact` });
  range.addEventListener('input', () => {
    const value = fromSlider(Number(range.value));
    field.value = String(value);
    range.setAttribute('aria-valuetext', `${value} ${unit}`);
    options.change(value);
  });
  field.addEventListener('change', () => {
    const value = Number(field.value);
    if (field.value === '' || !Number.isFinite(value)) return;
    range.value = String(toSlider(value));
    options.change(value);
  });
  const set = (value: number): void => {
    range.value = String(toSlider(value));
    range.setAttribute('aria-valuetext', `${value} ${unit}`);
    if (document.activeElement !== field) field.value = String(Number(value.toPrecision(6)));
  };
  set(options.value);
  const element = h('div', { class: 'parameter', title: options.help ?? '' },
    h('label', { htmlFor: id }, options.label), field, h('span', { class: 'unit' }, unit), range,
    options.help ? h('p', { class: 'help', id: `${id}-help` }, options.help) : null);
  return { element, set };
}
