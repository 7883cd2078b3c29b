// SPDX-License-Identifier: MIT
//
// talus/three against three.js itself: its own raycast is the judge.

import assert from 'node:assert/strict';
import test from 'node:test';
import * as THREE from 'three';
import { Hull, Soup, bakeStages, polygonSteps } from '../src/index.js';
import * as out from '../src/three.js';
import { courtyard, randomNumbers } from './support.js';

test('geometry in: frames, instances, mirrors and materials', () => {
  const group = new THREE.Group();
  const box = new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshBasicMaterial());
  box.position.set(5, 0, 0);
  box.scale.set(-1, 1, 1);
  const many = new THREE.InstancedMesh(new THREE.BoxGeometry(), box.material, 2);
  many.setMatrixAt(1, new THREE.Matrix4().makeTranslation(0, 9, 0));
  many.setMatrixAt(0, new THREE.Matrix4());
  group.add(box, many);
  const { mesh, materials } = out.meshFromObject(group);
  assert.deepEqual([mesh.triangleCount, materials.length], [36, 1]);
  assert.deepEqual(mesh.bounds(), { min: [-0.5, -0.5, -0.5], max: [5.5, 9.5, 0.5] });
  assert.equal(Soup.bake(mesh).locate([5, 0, 0]).winding, 1); // not turned inside out
  assert.equal(out.meshFromGeometry(new THREE.SphereGeometry()).triangleCount, new THREE.SphereGeometry().index.count / 3);
});

test('the raycast agrees with three.js', () => {
  const { mesh } = courtyard(), soup = Soup.bake(mesh), random = randomNumbers(3);
  const object = new THREE.Mesh(out.geometryFromMesh(mesh), new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }));
  object.position.set(3, 1, -2);
  object.rotation.set(0.1, 0.7, 0.2);
  object.scale.set(1, 2, 1);
  object.updateMatrixWorld();
  const caster = new THREE.Raycaster(), mine = out.soupRaycast(soup), theirs = object.raycast;
  let compared = 0;
  for (let i = 0; i < 60; i++) {
    caster.ray.origin.set(random() * 40, 20 + random() * 5, random() * 40);
    caster.ray.direction.set(random() - 0.5, -random(), random() - 0.5).normalize();
    caster.firstHitOnly = i % 2 === 0;
    object.raycast = theirs;
    const expected = caster.intersectObject(object);
    object.raycast = mine;
    const hits = caster.intersectObject(object);
    assert.equal(hits.length > 0, expected.length > 0);
    if (hits.length === 0) continue;
    assert.ok(Math.abs(hits[0].distance - expected[0].distance) < 1e-3);
    assert.ok(hits[0].point.distanceTo(expected[0].point) < 1e-3);
    compared++;
  }
  assert.ok(compared > 20);
});

test('every stage as geometry', () => {
  const { mesh, soup, navmesh } = courtyard(), stages = bakeStages(mesh), steps = polygonSteps(mesh, { contour: 0 });
  const { links } = navmesh.findLinks(soup);
  const count = (geometry) => geometry.getAttribute('position').count;
  const stats = soup.stats();
  assert.equal(count(out.soupPairsGeometry(soup)), 3 * (stats.triangleCount - stats.coincidentCount));
  assert.equal(count(out.soupBoxesGeometry(soup, 0)), 24);
  assert.ok(count(out.rayWalkGeometry(soup.walkRay([20, 10, 20], [0, -1, 0]))) >= 48);
  assert.equal(count(out.spansGeometry(stages)), 36 * stages.heightfield.spanCount);
  for (const by of ['area', 'distance', 'region']) assert.equal(count(out.floorsGeometry(stages, by)), 6 * stages.compact.spanCount);
  assert.equal(count(out.contoursGeometry(stages, 'raw')), 2 * stages.contours.raw.vertices.length / 3);
  assert.ok(count(out.polygonStepGeometry(steps, steps.count - 1)) > 6);
  for (const by of ['polygon', 'area', 'tile', 'island']) assert.equal(count(out.navmeshGeometry(navmesh, by)), navmesh.surface().triangles.length);
  assert.equal(count(out.navmeshEdgesGeometry(navmesh)), 2 * navmesh.polygons().links.length);
  assert.equal(count(out.jumpLinksGeometry(links)), 32 * links.length);
  const path = navmesh.findPath([2, 0, 20], [20, 5, 20]);
  assert.equal(count(out.pathGeometry(path)), path.corners.length / 3);
  assert.equal(count(out.hullGeometry(Hull.bake(mesh.vertices))), Hull.bake(mesh.vertices).triangles().length);
  for (const geometry of [out.soupPairsGeometry(soup), out.spansGeometry(stages), out.navmeshGeometry(navmesh)]) {
    assert.ok(geometry.getAttribute('position').array.every(Number.isFinite));
    assert.equal(geometry.getAttribute('color').count, count(geometry));
  }
});
