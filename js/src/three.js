// SPDX-License-Identifier: MIT
//
// talus/three: geometry in, the stages of a bake out, and raycasts by a soup. Colours are vertex colours: give the
// material vertexColors: true.

import { BufferGeometry, Float32BufferAttribute, Matrix4, Vector3 } from 'three';
import { Mesh, jumpLinkPoint } from './index.js';

// --------------------------------------------------------------------------------------------------------
// In.

/** x, y, z of a geometry's vertices, whatever their attribute's layout, in a frame. */
function positionsOf(geometry, matrix = null) {
  const position = geometry.getAttribute('position'), point = new Vector3();
  const vertices = new Float32Array(3 * position.count);
  for (let i = 0; i < position.count; i++) {
    point.fromBufferAttribute(position, i);
    if (matrix !== null) point.applyMatrix4(matrix);
    point.toArray(vertices, 3 * i);
  }
  return vertices;
}

function indicesOf(geometry) {
  const count = geometry.getAttribute('position').count;
  return geometry.index === null ? Uint32Array.from({ length: count - count % 3 }, (_, i) => i)
                                 : Uint32Array.from({ length: geometry.index.count }, (_, i) => geometry.index.getX(i));
}

export function meshFromGeometry(geometry) {
  return new Mesh(positionsOf(geometry), indicesOf(geometry));
}

export function meshFromObject(object) {
  const vertices = [], indices = [], ids = [], materials = [];
  let base = 0;
  object.updateWorldMatrix(true, true);
  object.traverseVisible((child) => {
    if (!child.isMesh || !child.geometry.getAttribute('position')) return;
    const frames = child.isInstancedMesh ? Array.from({ length: child.count }, (_, i) => {
      const matrix = new Matrix4();
      child.getMatrixAt(i, matrix);
      return matrix.premultiply(child.matrixWorld);
    }) : [child.matrixWorld];
    for (const frame of frames) {
      const positions = positionsOf(child.geometry, frame), list = indicesOf(child.geometry);
      // A mirrored frame turns triangles inside out.
      if (frame.determinant() < 0) for (let i = 0; i < list.length; i += 3) [list[i], list[i + 1]] = [list[i + 1], list[i]];
      vertices.push(positions);
      indices.push(list.map((i) => i + base));
      ids.push(materialsOf(child, list.length / 3, materials));
      base += positions.length / 3;
    }
  });
  return { mesh: new Mesh(concat(Float32Array, vertices), concat(Uint32Array, indices), concat(Uint16Array, ids)), materials };
}

/** The number of each triangle's material in the list, which gets new ones. */
function materialsOf(object, triangleCount, materials) {
  const own = [object.material].flat(), ids = new Uint16Array(triangleCount);
  const numberOf = (material) => {
    const known = materials.indexOf(material);
    return known >= 0 ? known : materials.push(material) - 1;
  };
  ids.fill(numberOf(own[0]));
  if (own.length > 1) {
    for (const { start, count, materialIndex } of object.geometry.groups) {
      ids.fill(numberOf(own[materialIndex]), start / 3, Math.min((start + count) / 3, triangleCount));
    }
  }
  return ids;
}

function concat(Type, arrays) {
  const whole = new Type(arrays.reduce((sum, array) => sum + array.length, 0));
  let at = 0;
  for (const array of arrays) {
    whole.set(array, at);
    at += array.length;
  }
  return whole;
}

export function geometryFromMesh(mesh) {
  return triangleGeometry(spread(mesh.vertices, mesh.indices));
}

/** The corners of indexed triangles, three points each: so faces have normals and colours of their own. */
function spread(vertices, indices) {
  const points = new Float32Array(3 * indices.length);
  for (let i = 0; i < indices.length; i++) {
    for (let k = 0; k < 3; k++) points[3 * i + k] = vertices[3 * indices[i] + k];
  }
  return points;
}

// --------------------------------------------------------------------------------------------------------
// Raycasts.

/** A direction by a matrix without its translation. */
function turn(m, d) {
  const [x, y, z] = d;
  for (let i = 0; i < 3; i++) d[i] = m[i] * x + m[4 + i] * y + m[8 + i] * z;
}

export function soupRaycast(soup) {
  const inverse = new Matrix4(), origin = new Vector3();
  return function raycast(raycaster, intersects) {
    inverse.copy(this.matrixWorld).invert();
    // Turned and scaled, not normalized: so t counts metres of the world.
    const start = origin.copy(raycaster.ray.origin).applyMatrix4(inverse).toArray();
    const direction = raycaster.ray.direction.toArray();
    turn(inverse.elements, direction);
    const side = [this.material].flat()[0]?.side ?? 0; // FrontSide 0, BackSide 1, DoubleSide 2
    const filter = side === 2 ? null : { cull: side === 0 ? 'back' : 'front' };
    const hits = raycaster.firstHitOnly
      ? [soup.castRay(...start, ...direction, raycaster.far, filter)].filter((hit) => hit !== null)
      : soup.castRayAll(start, direction, { maxT: raycaster.far, filter });
    for (const hit of hits) {
      if (hit.t < raycaster.near) continue;
      const point = raycaster.ray.at(hit.t, new Vector3());
      const normal = new Vector3(hit.nx, hit.ny, hit.nz);
      const index = this.geometry.index, corner = (k) => (index ? index.getX(3 * hit.triangle + k) : 3 * hit.triangle + k);
      intersects.push({
        distance: hit.t, point, object: this, faceIndex: hit.triangle,
        face: { a: corner(0), b: corner(1), c: corner(2), normal, materialIndex: 0 },
        barycoord: new Vector3(1 - hit.u - hit.v, hit.u, hit.v),
      });
    }
  };
}

// --------------------------------------------------------------------------------------------------------
// Out: geometry with a colour for each triangle or line.

/** A colour that differs from those of near numbers: the golden ratio around the circle of hues. */
function colourOf(number) {
  const hue = (number * 0.6180339887498949) % 1;
  return [0, 2 / 3, 1 / 3].map((shift) => {
    const x = Math.abs(((hue + shift) % 1) * 6 - 3) - 1;
    return 0.35 + 0.55 * Math.min(1, Math.max(0, x));
  });
}

function geometryOf(points, colours) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(points, 3));
  if (colours) geometry.setAttribute('color', new Float32BufferAttribute(colours, 3));
  return geometry;
}

function triangleGeometry(points, colours) {
  const geometry = geometryOf(points, colours);
  geometry.computeVertexNormals();
  return geometry;
}

const BOX_EDGES = [0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7];

/** Lines of boxes: six numbers each. */
function boxLines(boxes, count, colour) {
  const points = new Float32Array(72 * count), colours = new Float32Array(72 * count);
  for (let i = 0; i < count; i++) {
    const box = boxes.subarray(6 * i, 6 * i + 6), rgb = colour(i);
    BOX_EDGES.forEach((corner, k) => {
      for (let axis = 0; axis < 3; axis++) {
        points[72 * i + 3 * k + axis] = box[(corner >> axis & 1) * 3 + axis];
        colours[72 * i + 3 * k + axis] = rgb[axis];
      }
    });
  }
  return geometryOf(points, colours);
}

export function soupPairsGeometry(soup) {
  const pairs = soup.pairs(), points = [], colours = [];
  for (let i = 0; i < pairs.count; i++) {
    const c = pairs.corners.subarray(12 * i, 12 * i + 12), rgb = colourOf(i);
    const single = pairs.triangles[2 * i + 1] === 0xffffffff;
    points.push(...c.subarray(0, 9));
    for (let k = 0; k < 3; k++) colours.push(...rgb);
    if (single) continue;
    points.push(...c.subarray(0, 3), ...c.subarray(6, 12));
    for (let k = 0; k < 3; k++) colours.push(...rgb.map((x) => 0.75 * x));
  }
  return triangleGeometry(points, colours);
}

export function soupBoxesGeometry(soup, depth) {
  const all = soup.boxes(depth);
  const kept = Array.from({ length: all.count }, (_, i) => i).filter((i) => depth === undefined || all.depth[i] === depth);
  const boxes = new Float32Array(6 * kept.length);
  kept.forEach((i, at) => boxes.set(all.boxes.subarray(6 * i, 6 * i + 6), 6 * at));
  return boxLines(boxes, kept.length, (i) => colourOf(all.depth[kept[i]]));
}

export function rayWalkGeometry(walk) {
  const kept = Array.from({ length: walk.count }, (_, i) => i).filter((i) => walk.entered[i]);
  const boxes = new Float32Array(6 * kept.length);
  kept.forEach((i, at) => boxes.set(walk.boxes.subarray(6 * i, 6 * i + 6), 6 * at));
  return boxLines(boxes, kept.length, (i) => colourOf(walk.depth[kept[i]]));
}

/** Column by column: calls `visit(x, z, span)` with the column's lower corner in metres. */
function eachSpan(stage, visit) {
  for (let c = 0; c < stage.width * stage.height; c++) {
    const x = stage.bounds.min[0] + (c % stage.width) * stage.cellSize;
    const z = stage.bounds.min[2] + Math.floor(c / stage.width) * stage.cellSize;
    for (let span = stage.firstSpan[c]; span < stage.firstSpan[c + 1]; span++) visit(x, z, span);
  }
}

const BOX_FACES = [[0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3], [0, 1, 3, 2], [4, 6, 7, 5]];

export function spansGeometry(stages) {
  const h = stages.heightfield, points = new Float32Array(108 * h.spanCount), colours = new Float32Array(108 * h.spanCount);
  let at = 0;
  eachSpan(h, (x, z, span) => {
    const low = [x, h.bounds.min[1] + h.min[span] * h.cellHeight, z];
    const high = [x + h.cellSize, h.bounds.min[1] + h.max[span] * h.cellHeight, z + h.cellSize];
    BOX_FACES.forEach((face, f) => {
      const rgb = f === 1 && h.area[span] !== 0 ? [0.35, 0.65, 0.9] : [0.6, 0.6, 0.62];
      for (const k of [0, 1, 2, 0, 2, 3]) {
        for (let axis = 0; axis < 3; axis++, at++) {
          points[at] = face[k] >> axis & 1 ? high[axis] : low[axis];
          colours[at] = rgb[axis];
        }
      }
    });
  });
  return triangleGeometry(points, colours);
}

export function floorsGeometry(stages, by = 'area') {
  const c = stages.compact, points = new Float32Array(18 * c.spanCount), colours = new Float32Array(18 * c.spanCount);
  const colour = {
    area: (i) => (c.area[i] === 0 ? [0.35, 0.35, 0.38] : c.area[i] === 63 ? [0.35, 0.65, 0.9] : colourOf(c.area[i])),
    distance: (i) => Array(3).fill((c.distance[i] ?? 0) / Math.max(1, c.maxDistance)),
    region: (i) => (c.region[i] === 0 ? [0.35, 0.35, 0.38] : colourOf(c.region[i] & 0x7fffffff)),
  }[by];
  let at = 0;
  eachSpan(c, (x, z, i) => {
    const y = c.bounds.min[1] + c.floor[i] * c.cellHeight, rgb = colour(i);
    for (const [dx, dz] of [[0, 0], [0, 1], [1, 1], [0, 0], [1, 1], [1, 0]]) {
      points.set([x + dx * c.cellSize, y, z + dz * c.cellSize], at);
      colours.set(rgb, at);
      at += 3;
    }
  });
  return triangleGeometry(points, colours);
}

/** Closed outlines as lines: outline i holds the points first[i] to first[i + 1] - 1. */
function outlineLines(count, first, point, colour) {
  const points = [], colours = [];
  for (let i = 0; i < count; i++) {
    const n = first[i + 1] - first[i];
    for (let k = 0; k < n; k++) {
      points.push(...point(first[i] + k), ...point(first[i] + (k + 1) % n));
      colours.push(...colour(i, k), ...colour(i, k));
    }
  }
  return geometryOf(points, colours);
}

const pointIn = (array) => (i) => array.subarray(3 * i, 3 * i + 3);

export function contoursGeometry(stages, which = 'simplified') {
  const c = stages.contours[which];
  return outlineLines(c.count, c.firstVertex, pointIn(c.vertices), (i) => colourOf(c.region[i] & 0x7fffffff));
}

export function polygonStepGeometry(steps, index) {
  const pieces = new Map(), key = (s) => Array.from(steps.corners.subarray(3 * steps.firstCorner[s], 3 * steps.firstCorner[s + 1])).join();
  const corners = (s) => steps.firstCorner[s + 1] - steps.firstCorner[s];
  for (let s = 0; s <= index; s++) {
    if (steps.kind[s] === 1) {
      // The merged polygon stands for those that lie in it: whose corners are all its own.
      const own = new Set(cornerKeys(steps, s));
      for (const [id, other] of pieces) if (steps.contour[other] === steps.contour[s] && cornerKeys(steps, other).every((k) => own.has(k))) pieces.delete(id);
    }
    pieces.set(key(s), s);
  }
  const points = [], colours = [], at = pointIn(steps.corners), partition = pointIn(steps.partitions);
  for (const s of pieces.values()) {
    for (let k = 0; k < corners(s); k++) {
      points.push(...at(steps.firstCorner[s] + k), ...at(steps.firstCorner[s] + (k + 1) % corners(s)));
      const rgb = s === index ? [1, 0.8, 0.2] : [0.5, 0.6, 0.7];
      colours.push(...rgb, ...rgb);
    }
  }
  for (let p = steps.firstPartition[index]; p < steps.firstPartition[index + 1]; p++) {
    points.push(...partition(2 * p), ...partition(2 * p + 1));
    const rgb = p === steps.firstPartition[index] ? [1, 0.35, 0.3] : [0.35, 0.35, 0.4];
    colours.push(...rgb, ...rgb);
  }
  return geometryOf(points, colours);
}

function cornerKeys(steps, s) {
  return Array.from({ length: steps.firstCorner[s + 1] - steps.firstCorner[s] },
                    (_, k) => steps.corners.subarray(3 * (steps.firstCorner[s] + k), 3 * (steps.firstCorner[s] + k) + 3).join());
}

export function navmeshGeometry(navmesh, by = 'polygon') {
  const surface = navmesh.surface(), polygons = navmesh.polygons();
  const number = { polygon: (p) => p, area: (p) => polygons.area[p], tile: (p) => polygons.tile[p], island: (p) => polygons.island[p] }[by];
  const colours = new Float32Array(3 * surface.triangles.length);
  surface.polygons.forEach((p, t) => {
    const rgb = colourOf(number(p));
    for (let k = 0; k < 3; k++) colours.set(rgb, 9 * t + 3 * k);
  });
  return triangleGeometry(spread(surface.vertices, surface.triangles), colours);
}

export function navmeshEdgesGeometry(navmesh) {
  const p = navmesh.polygons();
  return outlineLines(p.count, p.first, pointIn(p.corners), (i, k) => {
    const link = p.links[p.first[i] + k];
    return link === 0xffffffff ? [0.1, 0.2, 0.5] : link >= 0x80000000 ? [0.9, 0.5, 0.2] : [0.5, 0.6, 0.8];
  });
}

export function jumpLinksGeometry(links) {
  const points = [], colours = [], pieces = 16;
  const colourOfKind = { drop: [0.95, 0.6, 0.2], jump: [0.3, 0.8, 0.4], climb: [0.7, 0.4, 0.9] };
  for (const link of links) {
    for (let i = 0; i < pieces; i++) {
      points.push(...jumpLinkPoint(link, i / pieces), ...jumpLinkPoint(link, (i + 1) / pieces));
      colours.push(...colourOfKind[link.kind], ...colourOfKind[link.kind]);
    }
  }
  return geometryOf(points, colours);
}

export function pathGeometry(path, lift = 0.1) {
  return geometryOf(path.corners.map((x, i) => (i % 3 === 1 ? x + lift : x)));
}

export function hullGeometry(hull) {
  return triangleGeometry(spread(hull.vertices(), hull.triangles()));
}
