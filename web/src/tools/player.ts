// Steps that are played: a slider, play and pause, one on and one back.

import { h } from '../panels/dom';

export interface Player {
  element: HTMLElement;
  at(): number;
  setCount(count: number, at?: number): void;
  go(step: number): void;
  say(text: string): void;
  stop(): void;
}

export function player(options: { id: string; label: string; change: (step: number) => void }): Player {
  let count = 0;
  let timer = 0;
  const range = h('input', { type: 'range', min: '0', max: '0', step: '1', value: '0', id: options.id });
  const text = h('p', { class: 'muted step-text', 'aria-live': 'polite' });
  const label = h('label', { htmlFor: options.id }, options.label);
  const play = h('button', { 'aria-label': 'Play', title: 'Play', onclick: () => (timer ? stop() : start()) }, '▶');

  const go = (step: number): void => {
    range.value = String(Math.max(0, Math.min(count - 1, step)));
    label.textContent = `${options.label} ${count === 0 ? 0 : Number(range.value) + 1} of ${count}`;
    options.change(Number(range.value));
  };
  const stop = (): void => {
    clearInterval(timer);
    timer = 0;
    play.textContent = '▶';
    play.setAttribute('aria-label', 'Play');
  };
  const start = (): void => {
    if (count < 2) return;
    if (Number(range.value) >= count - 1) go(0);
    play.textContent = '❚❚';
    play.setAttribute('aria-label', 'Pause');
    // A long story is told in half a minute.
    const step = Math.max(1, Math.round(count / 150));
    timer = window.setInterval(() => {
      go(Number(range.value) + step);
      if (Number(range.value) >= count - 1) stop();
    }, Math.max(60, Math.min(500, 12_000 / count)));
  };
  range.addEventListener('input', () => {
    stop();
    go(Number(range.value));
  });
  const element = h('div', { class: 'player' }, label, h('div', { class: 'row' },
    h('button', { 'aria-label': 'One step back', onclick: () => { stop(); go(Number(range.value) - 1); } }, '‹'), play,
    h('button', { 'aria-label': 'One step on', onclick: () => { stop(); go(Number(range.value) + 1); } }, '›'), range), text);
  return {
    element,
    at: () => Number(range.value),
    go,
    stop,
    say: (words) => { text.textContent = words; },
    setCount: (now, at = now - 1) => {
      stop();
      count = now;
      range.max = String(Math.max(0, now - 1));
      go(at);
    },
  };
}
