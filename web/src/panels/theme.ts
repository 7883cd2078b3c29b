// Light, dark, or as the system has it.

import type { App } from '../app';
import { h } from './dom';

const NEXT = { auto: 'light', light: 'dark', dark: 'auto' } as const;
const SIGN = { auto: '◐', light: '○', dark: '●' } as const;

export function themeButton(app: App): HTMLElement {
  const system = matchMedia('(prefers-color-scheme: dark)');
  const button = h('button', {
    id: 'theme', class: 'quiet', onclick: () => app.view.set({ theme: NEXT[app.view.get().theme] }),
  });
  const apply = (): void => {
    const { theme } = app.view.get();
    const dark = theme === 'dark' || (theme === 'auto' && system.matches);
    document.documentElement.dataset.theme = dark ? 'dark' : 'light';
    button.textContent = SIGN[theme];
    button.title = `Theme: ${theme} (T)`;
    button.setAttribute('aria-label', `Theme: ${theme}`);
    app.stage.setBackground(getComputedStyle(document.documentElement).getPropertyValue('--sky').trim());
  };
  system.addEventListener('change', apply);
  app.view.watch((now, before) => {
    if (now.theme !== before.theme || now === before) apply();
  });
  return button;
}
