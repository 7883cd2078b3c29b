# SPDX-License-Identifier: MIT
"""Rays, nearest points and shapes against loops in numpy over all triangles."""

from __future__ import annotations

import math

import numpy as np
import pytest
import talus

from conftest import Mesh, box_mesh


def brute_force(vertices: np.ndarray, faces: np.ndarray, origins: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """t of the closest hit of each ray in double (Moeller and Trumbore), infinite where there is none."""
    a, b, c = (vertices[faces[:, k]].astype(np.float64) for k in range(3))
    result = np.full(len(origins), np.inf)
    for i, (o, d) in enumerate(zip(origins.astype(np.float64), directions.astype(np.float64), strict=True)):
        p = np.cross(d, c - a)
        det = np.einsum("ij,ij->i", b - a, p)
        with np.errstate(divide="ignore", invalid="ignore"):
            u = np.einsum("ij,ij->i", o - a, p) / det
            q = np.cross(o - a, b - a)
            v = q @ d / det
            t = np.einsum("ij,ij->i", c - a, q) / det
            good = (det != 0) & (u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0)
        if good.any():
            result[i] = t[good].min()
    return result


@pytest.fixture(scope="module")
def soup(hall: Mesh) -> talus.Soup:
    return talus.Soup(*hall)


def random_rays(count: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(7)
    origins = rng.uniform([-5, -3, -5], [45, 9, 45], (count, 3)).astype(np.float32)
    return origins, rng.normal(size=(count, 3)).astype(np.float32)


@pytest.mark.parametrize("layout", ["fast", "compact"])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_cast(hall: Mesh, layout: str, dtype: type) -> None:
    soup = talus.Soup(hall[0].astype(dtype), hall[1], layout=layout)  # type: ignore[arg-type]
    origins, directions = random_rays(500)
    hits = soup.cast(origins.astype(dtype), directions.astype(dtype))
    expected = brute_force(hall[0].astype(np.float32), hall[1], origins, directions)
    assert (hits.hit == np.isfinite(expected)).all()
    assert 100 < hits.hit.sum() < 450
    np.testing.assert_allclose(hits.t[hits.hit], expected[hits.hit], rtol=1e-5)
    assert (soup.any_hit(origins, directions) == hits.hit).all()
    corners = hall[0][hall[1][hits.triangle[hits.hit]]]
    u, v = hits.barycentric[hits.hit].T
    points = corners[:, 0] * (1 - u - v)[:, None] + corners[:, 1] * u[:, None] + corners[:, 2] * v[:, None]
    np.testing.assert_allclose(points, hits.points[hits.hit], atol=1e-4)
    assert np.isnan(hits.points[~hits.hit]).all()
    assert (hits.triangle[~hits.hit] == -1).all()


def test_threads_give_the_same(soup: talus.Soup) -> None:
    origins, directions = random_rays(100_000)
    one = soup.cast(origins, directions, threads=1)
    for threads in (2, 7, None):
        other = soup.cast(origins, directions, threads=threads)
        assert (one.t == other.t).all()
        assert (one.triangle == other.triangle).all()


def test_broadcast_and_strides(soup: talus.Soup) -> None:
    down = soup.cast([[1, 5, 1], [2, 5, 2]], [0, -1, 0])
    assert down.t.tolist() == [5, 5]
    wide = np.zeros((2, 6), np.float32)
    wide[:, :3] = [[1, 5, 1], [2, 5, 2]]
    wide[:, 3:] = [0, -1, 0]
    assert soup.cast(wide[:, :3], wide[::-1, 3:]).t.tolist() == [5, 5]
    assert len(soup.cast(np.zeros((0, 3)), np.zeros((0, 3)))) == 0


def layouts_of(rows: np.ndarray) -> dict[str, np.ndarray]:
    """The same float32 rows as arrays that lie in memory in other ways."""
    records = np.zeros(len(rows), np.dtype([("tag", "u1"), ("at", "f4", 3)]))  # not aligned
    records["at"] = rows
    wide = np.zeros((len(rows), 5), np.float32)
    wide[:, 4:1:-1] = rows
    frozen = rows.copy()
    frozen.flags.writeable = False
    return {
        "float64": rows.astype(np.float64),
        "columns first": np.asfortranarray(rows),
        "float64, columns first": np.asfortranarray(rows.astype(np.float64)),
        "reversed": rows[::-1].copy()[::-1],
        "columns backwards": wide[:, 4:1:-1],
        "records": records["at"],
        "other byte order": rows.astype(rows.dtype.newbyteorder()),
        "read-only": frozen,
        "list": rows.tolist(),  # type: ignore[dict-item]
    }


def same_hits(a: talus.RayHits, b: talus.RayHits) -> bool:
    names = ("t", "triangle", "barycentric", "normal", "material", "back")
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in names)


@pytest.mark.parametrize("count", [1, 5, 259])
def test_layouts_give_the_same(soup: talus.Soup, count: int) -> None:
    origins, directions = random_rays(count)
    expected = soup.cast(origins, directions)
    segments = soup.cast_segments(origins, directions)
    assert count < 9 or 0 < expected.hit.sum() < count
    for name, other in layouts_of(origins).items():
        assert same_hits(soup.cast(other, directions), expected), name
        assert same_hits(soup.cast_segments(other, directions), segments), name
    for name, other in layouts_of(directions).items():
        assert same_hits(soup.cast(origins, other), expected), name
        assert (soup.any_hit(origins, other) == expected.hit).all(), name
        assert (soup.line_of_sight(origins, other) == ~segments.hit).all(), name


def test_one_row_serves_all(soup: talus.Soup) -> None:
    origins, directions = random_rays(1000)
    fan = soup.cast(origins[0], directions)
    assert same_hits(fan, soup.cast(np.tile(origins[:1], (1000, 1)), directions))
    assert fan.points.shape == (1000, 3)
    assert same_hits(soup.cast(origins, directions[:1]), soup.cast(origins, np.tile(directions[:1], (1000, 1))))
    with pytest.raises(ValueError, match="origins, directions have 2 and 3 rows"):
        soup.cast(origins[:2], directions[:3])


def test_batches_are_single_casts(hall: Mesh) -> None:
    materials = (np.arange(len(hall[1])) * 9973 + 60_000).astype(np.uint16)  # above and below 2^15
    soup = talus.Soup(*hall, materials=materials)
    origins, directions = random_rays(1027)
    all_hits = soup.cast(origins, directions)
    some_hit = all_hits.hit
    assert 200 < some_hit.sum() < 1000
    assert all_hits.back.sum() > 50
    assert (all_hits.material[some_hit] == materials[all_hits.triangle[some_hit]]).all()
    assert all_hits.material.max() > 0x8000 > all_hits.material[some_hit].min()
    for i in range(0, 1027, 13):
        one = soup.cast(origins[i], directions[i])
        for name in ("t", "triangle", "barycentric", "normal", "material", "back"):
            assert np.array_equal(getattr(one, name)[0], getattr(all_hits, name)[i]), (name, i)


def test_values_beyond_float32_miss(soup: talus.Soup) -> None:
    far = soup.cast([[1e300, 5, 1], [1, 5, 1], [np.nan, 5, 1]], np.array([[0, -1, 0], [0, -1e300, 0], [0, -1, 0]]))
    assert (~far.hit).all()
    assert np.isinf(far.t).all()
    assert (far.normal == 0).all()


def test_limits_cull_and_materials(hall: Mesh) -> None:
    materials = np.zeros(len(hall[1]), np.uint16)
    materials[:12] = 5  # the floor
    soup = talus.Soup(*hall, materials=materials)
    origins, down = [[1, 5, 1]], [0, -1, 0]
    assert soup.cast(origins, down).material.tolist() == [5]
    assert not soup.cast(origins, down, max_distance=4.9).hit[0]
    assert soup.cast(origins, down, max_distance=[5.0]).hit[0]
    assert not soup.cast(origins, down, ignored_materials=[5]).hit[0]
    front = soup.cast(origins, down, cull="front")
    assert front.hit[0]
    assert front.back[0]
    assert front.t[0] == 6
    with pytest.raises(ValueError, match="cull"):
        soup.cast(origins, down, cull="left")  # type: ignore[arg-type]


def test_segments_and_sight(soup: talus.Soup) -> None:
    hits = soup.cast_segments([[1, 5, 1]], [[1, -5, 1]])
    assert hits.t.tolist() == [0.5]
    np.testing.assert_allclose(hits.points, [[1, 0, 1]])
    assert soup.line_of_sight([[1, 1, 1], [1, 1, 1]], [[3, 1, 3], [35, 1, 1]]).tolist() == [True, False]


def test_all_hits(soup: talus.Soup) -> None:
    hits = soup.all_hits([1.5, 10, 1.2], [0, -1, 0])
    assert hits.t.tolist() == [10, 11]
    assert hits.back.tolist() == [False, True]
    crossed = soup.all_hits([20, 10, 20], [0, -1, 0], rule="crossed")
    assert len(crossed) == 4
    many = talus.Soup(*_plates(100)).all_hits([0.2, 1, 0.3], [0, -1, 0])
    assert len(many) == 100
    assert (np.diff(many.t) > 0).all()


def _plates(count: int) -> Mesh:
    vertices = np.array([[[0, -k, 0], [0, -k, 1], [1, -k, 0]] for k in range(count)], np.float64).reshape(-1, 3)
    return vertices, np.arange(3 * count).reshape(-1, 3)


def test_nearest_and_contains() -> None:
    soup = talus.Soup(*box_mesh((0, 0, 0), (2, 2, 2)))
    rng = np.random.default_rng(3)
    points = rng.uniform(-1, 3, (500, 3)).astype(np.float32)
    inside = ((points > 0) & (points < 2)).all(axis=1)
    assert (soup.contains(points) == inside).all()
    nearest = soup.nearest(points)
    outside = np.maximum(np.maximum(-points, points - 2), 0)
    depth = np.minimum(points, 2 - points).min(axis=1)
    expected = np.where(inside, depth, np.linalg.norm(outside, axis=1))
    np.testing.assert_allclose(nearest.distance, expected, atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(points - nearest.point, axis=1), nearest.distance, atol=1e-6)
    assert (soup.nearest([[9, 9, 9]], max_distance=1).triangle == -1).all()
    assert soup.locate([[1, 1, 0]]).side.tolist() == [0]


def test_open_surface_is_named(hall: Mesh) -> None:
    vertices, faces = box_mesh((0, 0, 0), (2, 2, 2))
    soup = talus.Soup(vertices, faces[:-1])
    with pytest.raises(talus.Error) as caught:
        soup.check_closed()
    assert caught.value.result == "TL_ERR_NOT_CLOSED"
    assert caught.value.element == "triangle"


def test_shapes_against_the_soup(soup: talus.Soup) -> None:
    ball = talus.sphere(0.5)
    assert soup.overlaps(ball, [[1, 0.4, 1], [1, 0.6, 1]]).tolist() == [True, False]
    assert len(soup.find_overlaps(ball, [1, 0.4, 1])) >= 1
    hits = soup.sweep(ball, [[0, -10, 0]], [[1, 5.5, 1], [60, 5.5, 1]])
    assert abs(hits.t[0] - 0.5) < 1e-5
    assert hits.hit.tolist() == [True, False]
    assert math.isinf(hits.t[1])
    np.testing.assert_allclose(hits.normal[0], [0, 1, 0], atol=1e-6)


def test_refit(hall: Mesh) -> None:
    soup = talus.Soup(*hall)
    moved = hall[0] + [0, 2, 0]
    soup.refit(moved)
    assert soup.cast([[1, 5, 1]], [0, -1, 0]).t.tolist() == [3]
    origins, directions = random_rays(300)
    fresh = talus.Soup(moved, hall[1]).cast(origins, directions)
    assert (fresh.t == soup.cast(origins, directions).t).all()


@pytest.mark.parametrize(
    ("vertices", "faces", "result"),
    [
        (np.zeros((3, 3)), np.zeros((0, 3), int), "TL_ERR_EMPTY"),
        ([[0, 0, 0], [0, 0, 1], [1, 0, 0]], [[0, 1, 3]], "TL_ERR_INDEX"),
        ([[0, 0, 0], [0, 0, 1], [np.nan, 0, 0]], [[0, 1, 2]], "TL_ERR_NOT_FINITE"),
        ([[0, 0, 0], [0, 0, 1], [1e13, 0, 0]], [[0, 1, 2]], "TL_ERR_RANGE"),
        ([[0, 0, 0], [0, 0, 1], [0, 0, 2]], [[0, 1, 2]], "TL_ERR_DEGENERATE"),
    ],
)
def test_bad_meshes(vertices: object, faces: object, result: str) -> None:
    with pytest.raises(talus.Error) as caught:
        talus.Soup(vertices, faces)  # type: ignore[arg-type]
    assert caught.value.result == result


@pytest.mark.parametrize(
    ("vertices", "faces"),
    [
        (np.zeros((3, 2)), [[0, 1, 2]]),
        (np.zeros((3, 3)), [[0, 1, 2, 0]]),
        (np.zeros((3, 3)), [[0.0, 1.5, 2.0]]),
        (np.zeros((3, 3)), [[0, 1, -1]]),
        (np.zeros((3, 3)), [[0, 1, 1 << 40]]),
    ],
)
def test_bad_arrays(vertices: object, faces: object) -> None:
    with pytest.raises(ValueError):
        talus.Soup(vertices, faces)  # type: ignore[arg-type]


def test_extension_refuses_short_buffers(soup: talus.Soup) -> None:
    from talus import _talus

    origins = np.zeros((8, 3), np.float32)
    short = np.empty(7, np.float32)
    with pytest.raises(ValueError, match="t has 28 bytes"):
        _talus.cast(
            soup._soup, 0, origins, origins, np.float32([1]), 0, 0, 1, short, np.empty(8, np.int32), None, None, None,
            None, None,
        )  # fmt: skip
    with pytest.raises(ValueError):
        _talus.soup_stats(talus.Hull(np.eye(4, 3))._hull)
