# SPDX-License-Identifier: MIT
"""Worlds larger than memory: what is in memory answers as the whole navmesh does, and what is not is said to be so."""

from __future__ import annotations

import os
import subprocess
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
import talus

from conftest import Mesh, comb

EXTENTS = (1, 2, 1)


@pytest.fixture(scope="module")
def land(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, talus.Navmesh]:
    """A tiled navmesh, in a file and in memory."""
    file = tmp_path_factory.mktemp("world") / "land.talus"
    navmesh = talus.Navmesh.bake(*comb(120), agent_radius=0.5, cell_size=0.3, tile_size=32)
    talus.Level(navmesh=navmesh, name="comb").save(file)
    return file, navmesh


def random_ends(count: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(5)
    points = rng.uniform(1, 119, (2, count, 3))
    points[:, :, 1] = 0
    return points[0], points[1]


def test_whole_world_answers_as_the_navmesh(land: tuple[Path, talus.Navmesh]) -> None:
    file, navmesh = land
    with talus.World(file) as world:
        assert world.settings["tile_size"] == 32
        np.testing.assert_allclose(world.bounds[:, [0, 2]], [[0, 0], [120, 120]], atol=1e-3)
        assert world.state.loaded == 0
        state = world.stream([[60, 0, 60]], radius=500)
        assert state.loaded == state.places > 100
        assert (state.missing, state.failed, state.loading, state.ready) == (0, 0, 0, 0)
        assert state.bytes <= state.peak_bytes <= world.budget
        starts, goals = random_ends(60)
        near = world.nearest(starts, half_extents=EXTENTS)
        same = navmesh.nearest(starts, half_extents=EXTENTS)
        assert near.loaded.all()
        assert np.array_equal(near.found, same.found)
        np.testing.assert_allclose(near.points, same.points, atol=1e-4)
        complete = 0
        for start, goal in zip(starts, goals, strict=True):
            path = world.shortest_path(start, goal, half_extents=EXTENTS)
            expected = navmesh.shortest_path(start, goal, half_extents=EXTENTS)
            assert path.proven
            assert path.status == expected.status
            if path:
                complete += 1
                assert abs(path.length - expected.length) < 1e-3
                np.testing.assert_allclose(path.points, expected.points, atol=1e-3)
                legs = np.linalg.norm(np.diff(path.points[:, [0, 2]], axis=0), axis=1)
                assert abs(legs.sum() - path.length) < 1e-3
                ray = world.raycast(start, goal)
                assert ray.loaded
                assert ray.hit == (path.length > np.linalg.norm((goal - start)[[0, 2]]) + 1e-3)
        assert complete > 30
        vertices, faces = world.surface()
        whole, _, _ = navmesh.surface()
        assert vertices.shape == whole.shape
        assert faces.max() < len(vertices)
        np.testing.assert_allclose(np.sort(vertices[:, 0]), np.sort(whole[:, 0]), atol=1e-3)


def test_what_is_not_there_is_said(land: tuple[Path, talus.Navmesh]) -> None:
    file, navmesh = land
    world = talus.World(file)
    assert world.shortest_path([5, 0, 5], [10, 0, 5]).status == "not loaded"
    assert world.nearest([5, 0, 5]).loaded.tolist() == [False]
    assert not world.raycast([5, 0, 5], [10, 0, 5]).loaded
    world.stream([5, 0, 60], radius=12)
    assert 0 < world.state.loaded < world.state.places / 2
    assert world.covers([5, 0, 60], 5)
    assert not world.covers([5, 0, 60], 50)
    near = world.nearest([[5, 0, 60], [110, 0, 60], [5, 0, 900]])
    assert near.loaded.tolist() == [True, False, True]
    assert near.found.tolist() == [True, False, False]
    assert world.shortest_path([5, 0, 60], [5, 0, 66]).proven
    assert world.shortest_path([5, 0, 60], [110, 0, 60]).status == "not loaded"
    assert world.shortest_path([5, 0, 60], [5, 0, 900]).status == "no navmesh at goal"
    ray = world.raycast([5, 0, 60], [5, 0, 119])
    assert not ray.hit
    assert not ray.loaded
    assert 0 < ray.t < 1
    with pytest.raises(ValueError, match="no navmesh is near start"):
        world.raycast([5, 0, 900], [5, 0, 119])
    # The way around the first wall leads over tiles that are not there: it is open, and bounded.
    world.stream([[10, 0, 60], [22, 0, 60]], radius=4)
    path = world.shortest_path([10, 0, 60], [22, 0, 60])
    assert path.status == "not loaded"
    assert not path.proven
    assert path.lower_bound <= navmesh.shortest_path([10, 0, 60], [22, 0, 60]).length


def test_budget_is_kept_on_a_walk(land: tuple[Path, talus.Navmesh]) -> None:
    file, _ = land
    world = talus.World(file, budget=192 << 10)
    seen = set()
    for step in range(60):
        at = [2 + 1.9 * step, 0, 3]
        world.update([at], radius=15, max_changes=2)
        world.load(max_loads=2)
        state = world.state
        assert state.bytes <= state.peak_bytes <= 192 << 10
        seen.add(state.loaded)
    world.stream([[116, 0, 3]], radius=500)  # more than fits: it ends nevertheless
    state = world.state
    assert 0 < state.loaded < state.places
    assert state.missing > 0
    assert world.covers([116, 0, 3], 2)  # the nearest first
    assert len(seen) > 1


def test_loads_on_threads(land: tuple[Path, talus.Navmesh]) -> None:
    file, navmesh = land
    world = talus.World(file)
    stop = threading.Event()
    wrong: list[str] = []

    def ask() -> None:
        while not stop.is_set():
            path = world.shortest_path([5, 0, 5], [12, 0, 100])
            if path and abs(path.length - expected) > 1e-3:
                wrong.append(f"{path.length} m")

    expected = navmesh.shortest_path([5, 0, 5], [12, 0, 100]).length
    reader = threading.Thread(target=ask)
    reader.start()
    with ThreadPoolExecutor(4) as pool:
        for _ in range(400):
            world.update([[60, 0, 60]], radius=200, max_changes=4)
            running = []
            while len(running) < 4 and (load := world.begin_load()) is not None:
                running.append(pool.submit(load.run))
            state = world.state
            if not running and state.loaded == state.places:
                break
            for future in running:
                future.result()
    stop.set()
    reader.join()
    assert state.loaded == state.places
    assert wrong == []
    assert world.shortest_path([5, 0, 5], [12, 0, 100]).proven


def test_loads_that_are_dropped_begin_anew(land: tuple[Path, talus.Navmesh]) -> None:
    file, _ = land
    world = talus.World(file)
    world.update([[60, 0, 60]], radius=10)
    first = world.begin_load()
    second = world.begin_load()
    assert first is not None
    assert second is not None
    assert first.tile != second.tile
    assert world.state.loading == 2
    dropped = second.tile
    del second
    assert world.state.loading == 1
    first.run()
    with pytest.raises(ValueError, match="once"):
        first.run()
    again = world.begin_load()
    assert again is not None
    assert again.tile == dropped
    world.close()
    again.run()  # its world is closed, and it does no harm
    for call in (world.load, lambda: world.state, lambda: world.nearest([0, 0, 0])):
        with pytest.raises(ValueError, match="closed"):
            call()  # type: ignore[operator]
    assert "closed" in repr(world)


def test_damage_is_named(land: tuple[Path, talus.Navmesh], tmp_path: Path) -> None:
    data = bytearray(land[0].read_bytes())
    data[-200] ^= 1  # in the last tile
    bad = tmp_path / "bad.talus"
    bad.write_bytes(data)
    world = talus.World(bad)
    with pytest.raises(talus.Error) as refused:
        world.stream([[60, 0, 60]], radius=500)
    assert refused.value.result == "TL_ERR_HASH"
    assert refused.value.element is not None
    assert refused.value.element.startswith("tile ")
    state = world.stream([[60, 0, 60]], radius=500)  # the others
    assert (state.failed, state.loaded) == (1, state.places - 1)
    bad.write_bytes(data[: len(data) // 2])
    with pytest.raises(talus.Error, match="TRUNCATED|truncated|end") as refused:
        talus.World(bad).stream([[60, 0, 60]], radius=500)
    assert refused.value.result == "TL_ERR_TRUNCATED"
    bad.write_bytes(b"nothing of ours" * 100)
    with pytest.raises(talus.Error) as refused:
        talus.World(bad)
    assert refused.value.result == "TL_ERR_MAGIC"
    with pytest.raises(FileNotFoundError):
        talus.World(tmp_path / "none.talus")


def test_what_is_refused(land: tuple[Path, talus.Navmesh], hall: Mesh, tmp_path: Path) -> None:
    world = talus.World(land[0])
    with pytest.raises(talus.Error) as refused:
        talus.World(land[0], budget=1000)
    assert refused.value.field == "budget"
    with pytest.raises(talus.Error):
        world.update([[0, 0, 0]], radius=-1)
    with pytest.raises(talus.Error) as refused:
        world.update([[np.nan, 0, 0]])
    assert refused.value.result == "TL_ERR_NOT_FINITE"
    with pytest.raises(ValueError, match="radius has the shape"):
        world.update([[0, 0, 0]], radius=[1, 2])
    with pytest.raises(ValueError, match="should be"):
        world.nearest([[1, 2]])
    with pytest.raises(ValueError, match="no routes"):
        world.route([5, 0, 5], [100, 0, 5])
    with pytest.raises(TypeError):
        talus.WorldLoad()
    assert world.update(np.zeros((0, 3))) is False
    soup = tmp_path / "soup.talus"
    talus.Level(soup=talus.Soup(*hall)).save(soup)
    with pytest.raises(ValueError, match="no navmesh"):
        talus.World(soup)
    linked = talus.Navmesh.bake(*hall, tile_size=48)
    linked.find_links(soup=talus.Soup(*hall), max_drop=7)
    talus.Level(navmesh=linked).save(soup)
    with pytest.raises(talus.Error) as refused:
        talus.World(soup)
    assert refused.value.result == "TL_ERR_UNSUPPORTED"


@pytest.mark.skipif("TALUS_COMMAND" not in os.environ, reason="the talus command is not at hand (TALUS_COMMAND)")
def test_routes_bound_the_shortest_path(land: tuple[Path, talus.Navmesh], tmp_path: Path) -> None:
    _, navmesh = land
    file = tmp_path / "routes.talus"
    command = os.environ["TALUS_COMMAND"]
    subprocess.run([command, "world", "routes", land[0], "-o", file], check=True, capture_output=True)
    world = talus.World(file)
    assert world.route([5, 0, 5], [110, 0, 5]).status == "not loaded"
    starts, goals = random_ends(25)
    compared = 0
    for start, goal in zip(starts, goals, strict=True):
        expected = navmesh.shortest_path(start, goal, half_extents=EXTENTS)
        world.stream([start, goal], radius=3)  # the tiles of both ends alone
        route = world.route(start, goal, half_extents=EXTENTS)
        assert route.status == expected.status
        if route:
            compared += 1
            assert route.lower_bound - 1e-3 <= expected.length <= route.length + 1e-3
            assert len(route.points) == len(route.lengths) == len(route.tiles) >= 2
            assert (np.diff(route.lengths) >= 0).all()
            assert route.lengths[-1] == route.length
            np.testing.assert_allclose(route.points[[0, -1]][:, [0, 2]], np.stack([start, goal])[:, [0, 2]], atol=1.5)
    assert compared > 10


@pytest.mark.skipif("TALUS_COMMAND" not in os.environ, reason="the talus command is not at hand (TALUS_COMMAND)")
def test_far_from_the_origin(tmp_path: Path) -> None:
    command = os.environ["TALUS_COMMAND"]
    obj, file = tmp_path / "yard.obj", tmp_path / "yard.talus"
    subprocess.run([command, "sample", "courtyard", "-o", obj], check=True, capture_output=True)
    words = ["--no-soup", "--tile-size", "32"]
    subprocess.run([command, "bake", obj, "-o", file, *words], check=True, capture_output=True)
    away = np.array([6.4e6, 0, -3.2e6])
    moved = tmp_path / "moved.talus"
    lines = []
    for line in obj.read_text().splitlines():
        if line.startswith("v "):
            place = np.array(line.split()[1:4], dtype=np.float64) + away
            line = "v " + " ".join(repr(float(value)) for value in place)
        lines.append(line)
    (tmp_path / "moved.obj").write_text("\n".join(lines))
    origin = ",".join(repr(float(value)) for value in away)
    subprocess.run(
        [command, "bake", tmp_path / "moved.obj", "-o", moved, *words, "--origin", origin],
        check=True,
        capture_output=True,
    )
    here, there = talus.World(file), talus.World(moved)
    here.stream([20, 0, 20], radius=500)
    there.stream(np.array([20, 0, 20]) + away, radius=500)
    a, b = np.array([2.0, 0, 20]), np.array([20.0, 5, 20])
    near, far = here.shortest_path(a, b), there.shortest_path(a + away, b + away)
    assert near
    assert abs(near.length - far.length) < 1e-3
    np.testing.assert_allclose(far.points - away, near.points, atol=1e-3)
    np.testing.assert_allclose(there.bounds - away, here.bounds, atol=1e-3)
