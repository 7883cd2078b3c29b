// The engine in the worker: one level, its soup and its navmesh, and the answers about them. Each public method is
// called from the page by its name.

import {
  bakeStages, Hull, loadPack, Mesh, Navmesh, polygonSteps, sampleLevel, sampleLevels, savePack, Soup, threads, tileGrid,
  type BakeStages, type JumpLink, type NavOptions, type PackMeta,
} from 'talus';
import { contourLayer, detailLayer, polygonLayer, tileLayer } from './geometry/polygons';
import { boxLayer, hullLayer, pairLayer, triangleLayer } from './geometry/level';
import { linkLayer } from './geometry/links';
import { floorLayer, spanLayer } from './geometry/voxels';
import { climbAnswer, stepsAnswer } from './lessons';
import { stageTimes } from './stage_times';
import { pathAnswer, sightAnswer, walkAnswer, whyAnswer } from './answers';
import type {
  AuditAnswer, BakeInfo, BakeSettings, ClimbAnswer, LayerData, LayerName, LayerOptions, LevelInfo, LevelMesh,
  LinksAnswer, Obstacle, ObstacleUpdate, OffmeshLink, PathAnswer, Progress, RayHit, RayWalk, SampleInfo, SightAnswer,
  StepsAnswer, Vec3, WhyAnswer,
} from './protocol';
import { MOST_OPEN } from './protocol';

/** Layers that are drawn from the data between the stages, which is baked on demand. */
const STAGE_LAYERS: readonly LayerName[] =
  ['spans', 'floors', 'distance', 'regions', 'contours', 'merging', 'polygons', 'detail'];

export class Engine {
  private name = '';
  private source: Mesh | null = null;
  private welded: Mesh | null = null;
  private degenerate = 0;
  private soup: Soup | null = null;
  private soupTime = 0;
  private navmesh: Navmesh | null = null;
  private meta: PackMeta | null = null;
  private hull: Hull | null = null;
  private found: JumpLink[] = [];
  private obstacles = new Map<number, bigint>();
  private settings: BakeSettings | null = null;
  private stages: BakeStages[] | null = null;
  private anchor: Vec3 = [0, 0, 0];

  constructor(private tell: (progress: Progress) => void) {}

  private hooks = {
    onProgress: (stage: string, done: number, total: number): void => this.tell({ stage, done, total }),
  };

  private needSoup(): Soup {
    if (!this.soup) throw new Error('no level is open');
    return this.soup;
  }

  private needNavmesh(): Navmesh {
    if (!this.navmesh) throw new Error('there is no navmesh: nothing is walkable with these settings');
    return this.navmesh;
  }

  private needMesh(): Mesh {
    if (!this.welded) throw new Error('no level is open');
    return this.welded;
  }

  samples(): SampleInfo[] {
    return sampleLevels().map(({ name, description, defaultTriangles }) =>
      ({ name, description, triangles: defaultTriangles }));
  }

  /** Opens a built-in level. */
  openSample(name: string): LevelInfo {
    const mesh = sampleLevel(name);
    return this.adopt(name, mesh, `${name}.obj`);
  }

  /** Opens triangles. A soup that was baked from them already saves baking it again. */
  openMesh(level: LevelMesh, soup: Uint8Array | null): LevelInfo {
    return this.adopt(level.name, new Mesh(level.positions, level.indices), level.sourceName ?? level.name, soup);
  }

  /** Opens a .talus file. Its navmesh is shown as it is, until a setting is changed. */
  openPack(name: string, bytes: Uint8Array): LevelInfo {
    const pack = loadPack(bytes);
    if (!pack.soup) throw new Error(`${name} holds no triangles: bake it without --no-soup`);
    this.soup = pack.soup;
    const info = this.adopt(name, trianglesOf(pack.soup), pack.meta?.name ?? name);
    if (pack.meta) this.meta = pack.meta;
    this.hull = pack.hull;
    this.found = pack.links;
    if (pack.navmesh) {
      this.navmesh = pack.navmesh;
      this.settings = settingsOf(pack.navmesh.options);
      info.settings = this.settings;
      info.baked = this.describeBake(0);
    }
    return info;
  }

  /** What another engine needs to open the same level faster. */
  levelCopy(): { mesh: LevelMesh; soup: Uint8Array } {
    const { vertices, indices } = this.source!;
    return {
      mesh: { name: this.name, sourceName: this.meta?.name, positions: vertices.slice(), indices: indices.slice() },
      soup: this.needSoup().toBytes(),
    };
  }

  private adopt(name: string, mesh: Mesh, sourceName: string, soup: Uint8Array | null = null): LevelInfo {
    this.name = name;
    this.source = mesh;
    const begin = performance.now();
    this.soup ??= soup ? Soup.fromBytes(soup) : Soup.bake(mesh, this.hooks);
    this.soupTime = performance.now() - begin;
    const { mesh: welded, report } = mesh.weld(this.hooks);
    this.welded = welded;
    this.degenerate = report.degenerateTriangles;
    const stats = this.soup.stats();
    const { min, max } = this.soup.bounds();
    this.anchor = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
    this.meta = {
      name: sourceName, sourceVertices: mesh.vertexCount, sourceTriangles: mesh.triangleCount,
      bounds: welded.bounds(), up: 'y',
    };
    return {
      name, triangles: mesh.triangleCount, degenerate: this.degenerate, min, max,
      soupMilliseconds: this.soupTime, pairs: stats.pairCount, depth: stats.depth, soupBytes: stats.size,
    };
  }

  // -------------------------------------------------------------------------------------------------------
  // Baking.

  /** Bakes the navmesh with obstacles and links on it, and the data of the stages if a layer shows it. */
  bake(settings: BakeSettings, obstacles: readonly Obstacle[], links: readonly OffmeshLink[],
       layers: readonly LayerName[]): BakeInfo {
    const begin = performance.now();
    this.settings = settings;
    this.stages = null;
    this.found = [];
    this.navmesh?.free();
    this.navmesh = Navmesh.bake(this.needMesh(), { ...settings, obstacles: settings.tileSize > 0, ...this.hooks });
    const milliseconds = performance.now() - begin;
    this.obstacles.clear();
    if (settings.tileSize > 0) this.setObstacles(obstacles);
    this.setLinks(links);
    if (layers.some((name) => STAGE_LAYERS.includes(name))) this.needStages();
    return this.describeBake(milliseconds);
  }

  private describeBake(milliseconds: number): BakeInfo {
    const navmesh = this.needNavmesh();
    const { report } = navmesh;
    const tiles = navmesh.tiles();
    const grid = tileGrid(navmesh.options, navmesh.options.bounds!);
    return {
      milliseconds,
      threads: threads(),
      ...stageTimes(report?.times ?? {}, this.needMesh(), navmesh.options, tiles),
      tilesX: grid.x,
      tilesZ: grid.z,
      tiles: tiles.length,
      polygons: navmesh.polygonCount,
      vertices: report?.vertexCount ?? 0,
      detailTriangles: report?.detailTriangleCount ?? 0,
      regions: report?.regionCount ?? 0,
      contours: report?.contourCount ?? 0,
      spans: report?.spanCount ?? 0,
      floors: report?.compactSpanCount ?? 0,
      area: tiles.reduce((sum, tile) => sum + tile.area, 0),
      filteredRegions: report?.filteredRegions ?? 0,
      bytes: tiles.reduce((sum, tile) => sum + tile.size, 0),
    };
  }

  private options(): NavOptions {
    return this.navmesh?.options ?? this.settings ?? {};
  }

  private forTiles<T>(work: (tileX: number, tileZ: number) => T): T[] {
    const bounds = this.options().bounds ?? this.needMesh().bounds();
    const grid = tileGrid(this.options(), bounds);
    const all: T[] = [];
    for (let tileZ = 0; tileZ < grid.z; tileZ++) {
      for (let tileX = 0; tileX < grid.x; tileX++) {
        this.tell({ stage: 'stages for layers', done: all.length, total: grid.x * grid.z });
        all.push(work(tileX, tileZ));
      }
    }
    return all;
  }

  private needStages(): BakeStages[] {
    this.stages ??= this.forTiles((tileX, tileZ) => bakeStages(this.needMesh(), { ...this.options(), tileX, tileZ }));
    return this.stages;
  }

  /** Puts exactly these obstacles on the level, and bakes the tiles again that they touch. */
  setObstacles(obstacles: readonly Obstacle[]): ObstacleUpdate {
    const begin = performance.now();
    const navmesh = this.needNavmesh();
    const shapeOf = (one: Obstacle): Parameters<Navmesh['addObstacle']>[0] => one.shape === 'cylinder'
      ? { type: 'cylinder', base: one.base, height: one.height, radius: one.radius }
      : { type: 'box', base: one.base, height: one.height, halfX: one.radius, halfZ: one.radius };
    for (const [id, known] of [...this.obstacles]) {
      if (!obstacles.some((one) => one.id === id)) {
        navmesh.removeObstacle(known);
        this.obstacles.delete(id);
      }
    }
    for (const one of obstacles) {
      const known = this.obstacles.get(one.id);
      if (known === undefined) this.obstacles.set(one.id, navmesh.addObstacle(shapeOf(one)));
      else navmesh.moveObstacle(known, shapeOf(one));
    }
    const tiles = navmesh.updateObstacles(0);
    navmesh.updateObstacles();
    return { tiles, milliseconds: performance.now() - begin };
  }

  /** Puts exactly these off-mesh links on the navmesh. */
  setLinks(links: readonly OffmeshLink[]): number {
    const navmesh = this.needNavmesh();
    for (const old of navmesh.offMeshLinks()) if (old.user === PLACED) navmesh.removeOffMeshLink(old.ref);
    const radius = Math.max(0.5, 2 * (this.options().cellSize ?? 0.3));
    for (const link of links) navmesh.addOffMeshLink({ ...link, radius, user: PLACED });
    return navmesh.offMeshLinks().filter((link) => link.user === PLACED && link.anchored).length;
  }

  findLinks(): LinksAnswer {
    const begin = performance.now();
    const navmesh = this.needNavmesh();
    for (const old of navmesh.offMeshLinks()) if (old.user !== PLACED) navmesh.removeOffMeshLink(old.ref);
    const { links, report } = navmesh.findLinks(this.needSoup(), this.hooks);
    this.found = links;
    navmesh.addJumpLinks(links);
    const { drop, jump, climb } = report.kinds;
    return {
      count: links.length, drops: drop.kept, jumps: jump.kept, climbs: climb.kept,
      tried: drop.tried + jump.tried + climb.tried, milliseconds: performance.now() - begin,
    };
  }

  // -------------------------------------------------------------------------------------------------------
  // Layers.

  layer(name: LayerName, options: LayerOptions): LayerData {
    const { anchor } = this;
    switch (name) {
      case 'triangles': return triangleLayer(this.source!, anchor, this.settings?.agentMaxSlope ?? 45);
      case 'pairs': return pairLayer(this.needSoup(), anchor);
      case 'boxes': return boxLayer(this.needSoup(), anchor, options.depth ?? 4);
      case 'hull': return hullLayer(this.needHull(), anchor);
      case 'tiles': return tileLayer(this.needNavmesh().polygons(), this.needNavmesh().tiles(), anchor);
      case 'links': {
        const placed = this.needNavmesh().offMeshLinks().filter((link) => link.user === PLACED);
        return linkLayer(this.found, placed, anchor);
      }
      default: return this.stageLayer(name);
    }
  }

  private stageLayer(name: LayerName): LayerData {
    const { anchor } = this;
    const lift = this.options().cellHeight ?? 0.2;
    if (name === 'merging') {
      const triangles = this.forTiles((tileX, tileZ) =>
        bakeStages(this.needMesh(), { ...this.options(), maxVertsPerPoly: 3, tileX, tileZ }).polygons);
      return polygonLayer(triangles, anchor, lift, 'triangle');
    }
    const stages = this.needStages();
    switch (name) {
      case 'spans': return spanLayer(stages, anchor);
      case 'floors':
      case 'distance':
      case 'regions': return floorLayer(stages, anchor, name);
      case 'contours': return contourLayer(stages, anchor);
      case 'polygons': return polygonLayer(stages.map((stage) => stage.polygons), anchor, lift, 'polygon');
      case 'detail': return detailLayer(stages, anchor);
      default: throw new Error(`no layer is called '${name}'`);
    }
  }

  private needHull(): Hull {
    this.hull ??= Hull.bake(this.needMesh().vertices, { thickness: 0.001, ...this.hooks });
    return this.hull;
  }

  // -------------------------------------------------------------------------------------------------------
  // Questions.

  /** What is seen first: where backs are a haze a front, or a back where nothing else is. */
  pick(origin: Vec3, direction: Vec3): RayHit | null {
    const soup = this.needSoup();
    const open = soup.stats().sourceTriangleCount <= MOST_OPEN;
    const hit = (open ? soup.castRay(...origin, ...direction, Infinity, { cull: 'back' }) : null) ?? soup.castRay(...origin, ...direction);
    if (!hit) return null;
    const point = origin.map((v, i) => v + hit.t * direction[i]!) as Vec3;
    return { point, normal: [hit.nx, hit.ny, hit.nz], t: hit.t, triangle: hit.triangle, back: hit.back };
  }

  walk(origin: Vec3, direction: Vec3): RayWalk {
    return walkAnswer(this.needSoup(), origin, direction);
  }

  why(point: Vec3): WhyAnswer {
    return whyAnswer(this.needNavmesh().why(this.needMesh(), point));
  }

  path(start: Vec3, goal: Vec3, radius: number): PathAnswer {
    return pathAnswer(this.needNavmesh(), start, goal, radius);
  }

  sight(place: Vec3, eyeHeight: number, distance: number): SightAnswer {
    return sightAnswer(this.needSoup(), place, eyeHeight, distance);
  }

  climb(direction: Vec3, start: number): ClimbAnswer {
    return climbAnswer(this.needHull(), direction, start);
  }

  steps(point: Vec3 | null): StepsAnswer {
    const navmesh = this.needNavmesh();
    const options = navmesh.options;
    const tile = point ? tileAt(options, point) : null;
    const where = tile ?? firstTile(navmesh);
    this.tell({ stage: 'steps', done: 0, total: 1 });
    const steps = polygonSteps(this.needMesh(), { ...options, tileX: where[0], tileZ: where[1] });
    const stages = bakeStages(this.needMesh(), { ...options, tileX: where[0], tileZ: where[1] });
    return stepsAnswer(steps, stages.contours.simplified, point);
  }

  audit(paths: number): AuditAnswer {
    const begin = performance.now();
    const audit = this.needNavmesh().audit(this.needSoup(), { pathCount: paths, ...this.hooks });
    return {
      findings: audit.findings.map(({ kind, point, contact, depth, area, count, triangle }) =>
        ({ kind, point, contact, depth, area, count, triangle: triangle ?? -1 })),
      paths: audit.pathCount, pathMetres: audit.pathMetres, polygons: audit.polygonCount, portals: audit.portalCount,
      steps: audit.stepCount, samples: audit.floorSamples, contradictions: audit.contradictions,
      milliseconds: performance.now() - begin,
    };
  }

  /** A .talus file: what `talus bake` writes. */
  save(): Uint8Array {
    return savePack({ meta: this.meta, soup: this.soup, navmesh: this.navmesh });
  }
}

/** The `user` of links that a person placed; those that were found have their index. */
const PLACED = 0x706c61636564n;

/** Settings as a person wrote them: the file holds 32-bit floats, 0.3 is 0.30000001 there. */
function settingsOf(options: Required<NavOptions>): BakeSettings {
  const { bounds: _, ...settings } = options;
  const numbers = Object.entries(settings).map(([key, value]) => [key, typeof value === 'number' ? shortest(value) : value]);
  return Object.fromEntries(numbers) as BakeSettings;
}

/** The shortest decimal that is the same 32-bit float. */
function shortest(value: number): number {
  for (let digits = 1; digits < 9; digits++) {
    const short = Number(value.toPrecision(digits));
    if (Math.fround(short) === Math.fround(value)) return short;
  }
  return value;
}

/** A soup's triangles in the order of the source. */
function trianglesOf(soup: Soup): Mesh {
  const pairs = soup.pairs();
  const corners = new Map<number, number[]>();
  for (let i = 0; i < pairs.count; i++) {
    const at = 12 * i;
    const [first, second] = [pairs.triangles[2 * i]!, pairs.triangles[2 * i + 1]!];
    corners.set(first, [at, at + 3, at + 6]);
    if (second !== 0xffffffff) corners.set(second, [at, at + 6, at + 9]);
  }
  const order = [...corners.keys()].sort((a, b) => a - b);
  const positions = new Float32Array(9 * order.length);
  order.forEach((triangle, i) => {
    corners.get(triangle)!.forEach((from, k) => {
      positions.set(pairs.corners.subarray(from, from + 3), 9 * i + 3 * k);
    });
  });
  return new Mesh(positions);
}

function tileAt(options: Required<NavOptions>, point: Vec3): [number, number] {
  if (options.tileSize === 0 || !options.bounds) return [0, 0];
  const side = options.tileSize * options.cellSize;
  const grid = tileGrid(options, options.bounds);
  const place = (axis: 0 | 2, count: number): number =>
    Math.min(count - 1, Math.max(0, Math.floor((point[axis] - options.bounds!.min[axis]) / side)));
  return [place(0, grid.x), place(2, grid.z)];
}

function firstTile(navmesh: Navmesh): [number, number] {
  const [tile] = navmesh.tiles();
  return tile ? [tile.x, tile.z] : [0, 0];
}
