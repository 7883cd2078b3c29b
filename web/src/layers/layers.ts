// The layers that are shown. Asks the engine for those that are switched on, keeps them until the next bake, and drops
// answers that came too late.

import * as THREE from 'three';
import type { EngineHost } from '../engine/host';
import type { LayerData, LayerName } from '../engine/protocol';
import type { Stage } from '../scene/stage';
import type { Store } from '../state/store';
import type { View } from '../state/view';
import { buildLayer, cutTree, disposeTree } from './build';
import { CATALOGUE } from './catalogue';

export interface ShownLayer {
  data: LayerData;
  group: THREE.Group;
}

/** What changes a layer, beside the level: a bake, navmesh tiles, or nothing. */
const OF_LEVEL: readonly LayerName[] = ['triangles', 'pairs', 'boxes', 'hull'];
const OF_TILES: readonly LayerName[] = ['tiles', 'links'];

export class Layers {
  readonly root = new THREE.Group();
  readonly shown = new Map<LayerName, ShownLayer>();
  private pending = new Set<LayerName>();
  private generation = 0;
  private listeners = new Set<() => void>();

  constructor(
    private stage: Stage,
    private engine: EngineHost,
    private view: Store<View>,
    private failed: (text: string) => void,
  ) {
    this.root.name = 'layers';
    stage.scene.add(this.root);
    view.watch((now, before) => {
      if (now.boxDepth !== before.boxDepth) this.drop(['boxes']);
      if (now.layers !== before.layers || now.boxDepth !== before.boxDepth) void this.update();
      if (now.cut !== before.cut) this.cut();
    });
  }

  watch(listener: () => void): void {
    this.listeners.add(listener);
  }

  /** Whether a layer that is switched on is still on its way. */
  get busy(): boolean {
    return this.pending.size > 0;
  }

  forget(names: readonly LayerName[]): void {
    this.drop(names);
  }

  forgetLevel(): void {
    this.drop([...this.shown.keys()]);
  }

  forgetBake(): void {
    this.drop([...this.shown.keys()].filter((name) => !OF_LEVEL.includes(name)));
  }

  forgetTiles(): void {
    this.drop(OF_TILES);
  }

  private drop(names: readonly LayerName[]): void {
    this.generation++;
    this.pending.clear();
    for (const name of names) {
      const layer = this.shown.get(name);
      if (!layer) continue;
      this.shown.delete(name);
      // The old picture stays until the new one is there, so that a slider does not make the screen flicker.
      layer.group.userData.stale = true;
    }
  }

  async update(): Promise<void> {
    const wanted = this.view.get().layers;
    for (const group of [...this.root.children]) {
      if (!wanted.includes(group.name as LayerName)) this.remove(group);
    }
    for (const name of [...this.shown.keys()]) if (!wanted.includes(name)) this.shown.delete(name);
    this.tell();
    if (!this.engine.ready) return;
    await Promise.all(wanted.filter((name) => !this.shown.has(name) && !this.pending.has(name))
      .map((name) => this.fetch(name)));
    this.tell();
  }

  private async fetch(name: LayerName): Promise<void> {
    const generation = this.generation;
    this.pending.add(name);
    try {
      const data = await this.engine.call('layer', name, { depth: this.view.get().boxDepth });
      if (generation !== this.generation || !this.view.get().layers.includes(name)) return;
      this.put(name, data);
    } catch (error) {
      if (generation === this.generation) {
        this.failed(`${name}: ${error instanceof Error ? error.message : String(error)}`);
      }
    } finally {
      if (generation === this.generation) this.pending.delete(name);
    }
  }

  private put(name: LayerName, data: LayerData): void {
    const entry = CATALOGUE.find((one) => one.name === name)!;
    for (const group of [...this.root.children]) if (group.name === name) this.remove(group);
    const group = buildLayer(data, entry.style);
    group.name = name;
    group.renderOrder = entry.style.rank;
    this.root.add(group);
    this.shown.set(name, { data, group });
    this.cut();
    this.tell();
  }

  /** What lies above the view's height is not drawn, so that one looks into buildings. */
  cut(): void {
    const { cut } = this.view.get();
    cutTree(this.root, cut === null ? null : new THREE.Plane(new THREE.Vector3(0, -1, 0), cut - this.stage.anchor[1]));
    this.stage.render();
  }

  private remove(group: THREE.Object3D): void {
    this.root.remove(group);
    disposeTree(group);
    this.stage.render();
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}
