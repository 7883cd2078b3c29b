# SPDX-License-Identifier: MIT
"""Convex shapes and hulls against closed formulas."""

from __future__ import annotations

import math

import numpy as np
import pytest
import talus


def test_distances_of_balls() -> None:
    rng = np.random.default_rng(5)
    at = rng.uniform(-5, 5, (200, 3))
    found = talus.distance(talus.sphere(1), talus.sphere(0.5), pose_b=at)
    expected = np.maximum(np.linalg.norm(at, axis=1) - 1.5, 0)
    np.testing.assert_allclose(found.distance, expected, atol=1e-5)
    assert (found.overlap == (expected == 0)).all()
    assert (found.lower_bound <= found.distance).all()
    assert (found.status == "converged").all()


def test_penetration_of_boxes() -> None:
    found = talus.penetration(talus.box([1, 1, 1]), talus.box([1, 1, 1]), pose_b=[1.5, 0.2, 0])
    assert math.isclose(found.depth[0], 0.5, abs_tol=1e-6)
    np.testing.assert_allclose(found.normal[0], [1, 0, 0], atol=1e-6)


def test_rotations() -> None:
    """A box turned by 45 degrees reaches as far as its diagonal; by quaternion, matrix and 4 by 4 matrix alike."""
    turn = math.pi / 4
    matrix = np.array([[math.cos(turn), 0, math.sin(turn)], [0, 1, 0], [-math.sin(turn), 0, math.cos(turn)]])
    whole = np.eye(4)
    whole[:3, :3] = matrix
    whole[:3, 3] = [5, 0, 0]
    expected = 5 - 1 - math.sqrt(2)
    for pose in (
        talus.poses([5, 0, 0], [0, math.sin(turn / 2), 0, math.cos(turn / 2)]),
        talus.poses([5, 0, 0], matrix),
        whole,
    ):
        found = talus.distance(talus.box([1, 1, 1]), talus.box([1, 1, 1]), pose_b=pose)
        assert math.isclose(found.distance[0], expected, abs_tol=1e-5)
    rng = np.random.default_rng(2)
    q = rng.normal(size=(50, 4))
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    x, y, z, w = q.T
    matrices = np.empty((50, 3, 3))
    matrices[:, 0] = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], 1)
    matrices[:, 1] = np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], 1)
    matrices[:, 2] = np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], 1)
    back = talus.poses(rotations=matrices)[:, :4]
    np.testing.assert_allclose(np.abs(np.einsum("ij,ij->i", back, q)), 1, atol=1e-6)


def test_casts() -> None:
    hits = talus.cast(talus.box([1, 1, 1]), talus.sphere(1), [-10, 0, 0], pose_b=[[7, 0, 0], [7, 3, 0]])
    assert math.isclose(hits.t[0], 0.5, abs_tol=1e-5)
    assert not hits.hit[1]
    assert math.isinf(hits.t[1])


def test_contacts() -> None:
    rest = talus.contacts(talus.box([2, 1, 2]), talus.box([1, 1, 1]), pose_b=[0, 2, 0])
    assert len(rest) == 4
    assert np.abs(rest.separation).max() < 1e-6
    np.testing.assert_allclose(rest.normal, [0, 1, 0], atol=1e-6)
    assert len(talus.contacts(talus.sphere(1), talus.sphere(1), pose_b=[5, 0, 0])) == 0


def test_other_shapes() -> None:
    far = [0, 9, 0]
    for shape, reach in (
        (talus.capsule([0, -1, 0], [0, 1, 0], 0.5), 1.5),
        (talus.cylinder([0, -1, 0], [0, 1, 0], 0.5), 1.0),
        (talus.cone([0, 0, 0], [0, 2, 0], 1.0), 2.0),
        (talus.triangle([0, 0, 0], [1, 0, 0], [0, 1, 0]), 1.0),
        (talus.convex([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]), 1.0),
        (talus.convex(talus.Hull([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]), radius=0.25), 1.25),
    ):
        found = talus.distance(shape, talus.sphere(0), pose_b=far)
        assert math.isclose(found.distance[0], 9 - reach, abs_tol=1e-5)
        assert math.isclose(shape.bounds()[1, 1], reach, abs_tol=1e-5)


def test_hull() -> None:
    points = np.random.default_rng(1).normal(size=(400, 3)).astype(np.float32)
    hull = talus.Hull(points)
    assert (points[hull.sources] == hull.vertices).all()
    assert hull.contains(points).all()
    assert not hull.contains([[9, 9, 9]])[0]
    corners = hull.vertices[hull.triangles].astype(np.float64)
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    assert math.isclose(hull.volume, volume, rel_tol=1e-9)
    planes = hull.planes
    assert (points @ planes[:, :3].T <= planes[:, 3] + 1e-5).all()
    directions = np.random.default_rng(2).normal(size=(100, 3)).astype(np.float32)
    best = (hull.vertices.astype(np.float64) @ directions.T.astype(np.float64)).argmax(axis=0)
    assert (hull.support(directions) == best).all()


def test_hull_within_a_tolerance() -> None:
    ball = np.random.default_rng(5).normal(size=(2000, 3))
    ball /= np.linalg.norm(ball, axis=1, keepdims=True)
    hull = talus.Hull(ball, tolerance=0.01)
    assert len(hull.vertices) < 500
    assert hull.points_left_out > 1500
    assert 0.0 < hull.max_outside <= 0.01
    with pytest.raises(talus.Error) as caught:
        talus.Hull(ball, tolerance=-1.0)
    assert caught.value.field == "tolerance"


def test_hull_moves_and_mass() -> None:
    cube = talus.Hull([[x, y, z] for x in (0, 2) for y in (0, 2) for z in (0, 2)])
    assert len(cube) == 8
    assert all(len(loop) == 4 for loop in cube.polygons)
    assert cube.volume == 8
    np.testing.assert_allclose(cube.inertia, np.eye(3) * 8 * (4 + 4) / 12, atol=1e-9)
    twice = cube.transform([10, 0, 0], scale=[2, 1, 1])
    assert twice.volume == 16
    assert twice.center.tolist() == [12, 1, 1]


@pytest.mark.parametrize(
    ("points", "result"),
    [
        (np.zeros((0, 3)), "TL_ERR_EMPTY"),
        (np.ones((5, 3)), "TL_ERR_COINCIDENT"),
        ([[0, 0, 0], [1, 1, 1], [2, 2, 2], [3, 3, 3]], "TL_ERR_COLLINEAR"),
        ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], "TL_ERR_COPLANAR"),
        ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, np.inf]], "TL_ERR_NOT_FINITE"),
    ],
)
def test_bad_hulls(points: object, result: str) -> None:
    with pytest.raises(talus.Error) as caught:
        talus.Hull(points)  # type: ignore[arg-type]
    assert caught.value.result == result


def test_bad_shapes() -> None:
    with pytest.raises(ValueError, match="radius"):
        talus.sphere(-1)
    with pytest.raises(ValueError, match="NaN"):
        talus.box([1, math.nan, 1], [math.nan, 0, 0])
    with pytest.raises(ValueError, match="shape"):
        talus.distance(talus.sphere(1), talus.sphere(1), pose_b=np.zeros((2, 2)))
    with pytest.raises(ValueError, match="rows"):
        talus.distance(talus.sphere(1), talus.sphere(1), np.zeros((2, 3)), np.zeros((3, 3)))
