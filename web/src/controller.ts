// What the page does: opens levels, bakes when a setting changes, and keeps link and view alike.

import type { App, LevelSource, Session } from './app';
import { Cancelled, EngineError, EngineHost } from './engine/host';
import type { BakeInfo, BakeSettings, LevelInfo } from './engine/protocol';
import { Layers } from './layers/layers';
import type { Stage } from './scene/stage';
import { hashHasSettings, hashToView, viewToHash } from './state/hash';
import { keyOfField } from './state/parameters';
import { Store } from './state/store';
import type { View } from './state/view';

const SETTLE = 120; // milliseconds: a slider that moves on starts no bake
const MOST_COLUMNS = 16e6; // of a level that is opened with default settings

export class Controller implements App {
  readonly session = new Store<Session>({
    level: null, bake: null, progress: null, baking: false, working: null, bakeNumber: 0, tilesNumber: 0, message: null,
  });
  readonly layers: Layers;
  source: LevelSource | null = null;
  private asked: BakeSettings | null = null;
  private settle = 0;
  private write = 0;
  private lastHash = '';

  constructor(readonly view: Store<View>, readonly stage: Stage, readonly engine: EngineHost) {
    this.engine.onProgress = (progress) => {
      const { baking, working } = this.session.get();
      if (baking || working) this.session.set({ progress });
    };
    this.layers = new Layers(stage, this.engine, view, (text) => this.say(text, 'error'));
    view.watch((now, before) => {
      if (now.settings !== before.settings) this.rebake();
      this.writeHashSoon();
    });
    stage.controls.addEventListener('end', () => this.cameraMoved());
    addEventListener('hashchange', () => this.hashChanged());
  }

  say(text: string, kind: 'info' | 'error' = 'info', field?: string): void {
    this.session.set({ message: text === '' ? null : { text, kind, field } });
  }

  cameraMoved(): void {
    this.view.set({ camera: this.stage.getCamera() });
  }

  // -------------------------------------------------------------------------------------------------------
  // Levels.

  async open(source: LevelSource, keepView = false): Promise<void> {
    const name = source.kind === 'sample' ? `sample:${source.name}` : source.kind === 'mesh' ? source.mesh.name : source.name;
    clearTimeout(this.settle);
    this.begin();
    try {
      const done = await this.engine.replace(async (call) => {
        const level = source.kind === 'sample' ? await call('openSample', source.name)
          : source.kind === 'mesh' ? await call('openMesh', source.mesh, null)
            : await call('openPack', source.name, source.bytes);
        const before = this.view.get();
        const edits = keepView ? before : { ...before, obstacles: [], links: [] };
        if (level.baked && !this.settingsAreWanted(level, keepView)) {
          return { level, bake: level.baked, settings: level.settings!, fault: null };
        }
        const settings = keepView ? before.settings : this.suitableSettings(level, before.settings);
        // A level that cannot be baked with these settings is open all the same.
        try {
          const bake = await call('bake', settings, edits.obstacles, edits.links, before.layers);
          return { level, bake, settings, fault: null };
        } catch (error) {
          if (error instanceof Cancelled) throw error;
          return { level, bake: null, settings, fault: error };
        }
      });
      this.opened(source, name, done, keepView);
    } catch (error) {
      this.ended(error, source.kind === 'pack' ? source.name : null);
    }
  }

  /** Whether a link asks for other settings than those that a file was baked with. */
  private settingsAreWanted(level: LevelInfo, keepView: boolean): boolean {
    return keepView && hashHasSettings(location.hash) && !sameSettings(this.view.get().settings, level.settings!);
  }

  /** Cells as large as a level needs that is far larger than a game's: said, not done in silence. */
  private suitableSettings(level: LevelInfo, settings: BakeSettings): BakeSettings {
    const [x, z] = [level.max[0] - level.min[0], level.max[2] - level.min[2]];
    const least = Math.sqrt((x * z) / MOST_COLUMNS);
    if (!(least > settings.cellSize)) return settings;
    const cellSize = Number(least.toPrecision(2));
    const times = cellSize / settings.cellSize;
    this.say(`This level is ${Math.round(x).toLocaleString('en')} × ${Math.round(z).toLocaleString('en')} m: the cell size was set ` +
      `from ${settings.cellSize} to ${cellSize} m, and heights, radius and climb likewise. If its unit is not the metre, set "metres a unit".`);
    const scaled = (value: number): number => Number((value * times).toPrecision(2));
    return {
      ...settings, cellSize, cellHeight: scaled(settings.cellHeight), agentHeight: scaled(settings.agentHeight),
      agentRadius: scaled(settings.agentRadius), agentMaxClimb: scaled(settings.agentMaxClimb), edgeMaxLen: scaled(settings.edgeMaxLen),
    };
  }

  private opened(
    source: LevelSource, name: string,
    done: { level: LevelInfo; bake: BakeInfo | null; settings: BakeSettings; fault: unknown }, keepView: boolean,
  ): void {
    this.source = source;
    this.asked = done.settings;
    const { level } = done;
    const fresh: Partial<View> = keepView ? {} : {
      camera: null, cut: null, start: null, goal: null, why: null, ray: null, guard: null, obstacles: [], links: [],
    };
    this.stage.setLevel(level.min, level.max, keepView ? this.view.get().camera : null);
    this.view.set({ level: name, settings: done.settings, ...fresh });
    this.layers.forgetLevel();
    this.finish({ level, bake: done.bake });
    if (done.fault) this.report(done.fault);
    else this.warnIfEmpty(done.bake);
  }

  // -------------------------------------------------------------------------------------------------------
  // Baking.

  rebake(): void {
    clearTimeout(this.settle);
    if (!this.engine.ready || (this.asked && sameSettings(this.asked, this.view.get().settings))) return;
    this.settle = window.setTimeout(() => void this.bakeNow(), SETTLE);
  }

  private async bakeNow(): Promise<void> {
    const { settings, obstacles, links, layers } = this.view.get();
    this.begin();
    this.asked = settings;
    try {
      const { mesh, soup } = await this.engine.call('levelCopy');
      const bake = await this.engine.replace(async (call) => {
        await call('openMesh', mesh, soup);
        return call('bake', settings, obstacles, links, layers);
      });
      this.layers.forgetBake();
      // What is too steep follows from a setting too.
      this.layers.forget(['triangles']);
      this.finish({ bake });
      this.warnIfEmpty(bake);
    } catch (error) {
      if (!(error instanceof Cancelled)) this.asked = null;
      this.ended(error);
    }
  }

  async work<T>(label: string, task: () => Promise<T>): Promise<T> {
    this.session.set({ working: label, progress: null });
    try {
      return await task();
    } finally {
      this.session.set({ working: null });
    }
  }

  cancel(): void {
    if (!this.engine.baking) {
      // A question cannot be interrupted; its engine can be ended, and the level opened again.
      if (this.session.get().working && this.source) {
        this.engine.endCurrent();
        void this.open(this.source, true);
      }
      return;
    }
    this.engine.cancel();
    this.session.set({ baking: false, progress: null });
    this.say('Cancelled. What was baked before is still shown.');
  }

  /** The tiles changed, not the settings: obstacles or links. */
  tilesChanged(): void {
    this.layers.forgetTiles();
    void this.layers.update();
    this.session.set({ tilesNumber: this.session.get().tilesNumber + 1 });
  }

  private begin(): void {
    this.session.set({ baking: true, progress: null, message: null });
  }

  private finish(part: Partial<Session>): void {
    const { bakeNumber, tilesNumber } = this.session.get();
    this.session.set({ ...part, baking: false, progress: null, bakeNumber: bakeNumber + 1, tilesNumber: tilesNumber + 1 });
    void this.layers.update();
  }

  private ended(error: unknown, file: string | null = null): void {
    if (error instanceof Cancelled) {
      // A newer bake may have taken its place.
      if (!this.engine.baking) this.session.set({ baking: false, progress: null });
      return;
    }
    this.session.set({ baking: false, progress: null });
    this.report(error, file);
  }

  /** Says what went wrong: with the file that could not be read, or as a sentence. */
  private report(error: unknown, file: string | null = null): void {
    const cause = error instanceof Error ? error.message : String(error);
    const text = file === null ? cause.replace(/^./, (letter) => letter.toUpperCase()) : `${file}: ${cause}`;
    const field = error instanceof EngineError && error.field ? keyOfField(error.field) ?? undefined : undefined;
    const memory = error instanceof EngineError && error.result === 'TL_ERR_MEMORY'
      ? ' A larger cell size, or tiles, take less.' : '';
    this.say(text.replace(/[^.!?]$/, '$&.') + memory, 'error', field);
  }

  private warnIfEmpty(bake: BakeInfo | null): void {
    if (bake?.polygons === 0) {
      this.say('Nothing is walkable with these settings. Choose the Why tool and click a floor to learn the reason.', 'error');
    }
  }

  // -------------------------------------------------------------------------------------------------------
  // The link.

  private writeHashSoon(): void {
    clearTimeout(this.write);
    this.write = window.setTimeout(() => {
      if (!this.source) return;
      this.lastHash = viewToHash(this.view.get());
      if (location.hash !== this.lastHash) history.replaceState(null, '', this.lastHash);
    }, 200);
  }

  private hashChanged(): void {
    if (location.hash === this.lastHash) return;
    const { view, faults } = hashToView(location.hash);
    const before = this.view.get();
    if (view.camera) this.stage.setCamera(view.camera);
    if (view.level !== before.level && view.level.startsWith('sample:')) {
      this.view.set({ ...view, level: before.level });
      void this.open({ kind: 'sample', name: view.level.slice(7) }, true);
    } else {
      this.view.set({ ...view, level: before.level });
    }
    if (faults.length > 0) this.say(`The link could not be read whole: ${faults.join('; ')}`, 'error');
  }
}

function sameSettings(a: BakeSettings, b: BakeSettings): boolean {
  return (Object.keys(a) as (keyof BakeSettings)[]).every((key) =>
    typeof a[key] === 'number' ? Math.fround(a[key] as number) === Math.fround(b[key] as number) : a[key] === b[key]);
}
