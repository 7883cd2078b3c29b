# SPDX-License-Identifier: MIT
"""Navmeshes in versions: readers see all of an edit or nothing of it, and what they hold does not change."""

from __future__ import annotations

import threading

import numpy as np
import pytest
import talus

from conftest import Mesh

START, GOAL = [12, 0, 20], [12, 0, 36]
WALL = talus.Obstacle.box([12, 0, 29], half_x=5, half_z=1, height=2)


@pytest.fixture
def versions(hall: Mesh) -> talus.NavVersions:
    return talus.NavVersions(talus.Navmesh.bake(*hall, agent_radius=0.4, cell_size=0.2, tile_size=48, obstacles=True))


def length(navmesh: talus.Navmesh) -> float:
    return navmesh.shortest_path(START, GOAL).length


def test_first_version_is_the_navmesh(hall: Mesh) -> None:
    navmesh = talus.Navmesh.bake(*hall, agent_radius=0.4, cell_size=0.2, tile_size=48)
    link = navmesh.add_link([3, 0, 3], [12, 6.5, 34], both_ways=True)
    assert link
    versions = talus.NavVersions(navmesh)
    with versions.acquire() as version:
        assert version.area == navmesh.area
        assert len(version.links()) == 1
        ends = np.random.default_rng(2).uniform(0, 40, (2, 40, 3)) * [1, 0, 1]
        assert np.array_equal(version.shortest_paths(*ends).length, navmesh.shortest_paths(*ends).length)
        assert version.shortest_path([30, 0, 30], [12, 6.5, 34]).status == "complete"  # over the link
        assert version.settings == navmesh.settings
        assert bool(version.audit(path_count=10)) == bool(navmesh.audit(path_count=10))
        saved = talus.Level(navmesh=version).to_bytes()
    assert saved == talus.Level(navmesh=navmesh).to_bytes()


def test_edits_are_seen_after_their_block(versions: talus.NavVersions) -> None:
    with versions.acquire() as old:
        before = length(old)
        with versions.edit() as draft:
            wall = draft.add_obstacle(WALL)
            assert length(draft) > before + 1
            with versions.acquire() as still:
                assert length(still) == before
        with versions.acquire() as new:
            after = length(new)
            assert after > before + 1
            assert length(old) == before
            state = versions.state
            assert (state.version_count, state.newest - state.oldest) == (2, 1)
            assert state.waiting_bytes > 0
    state = versions.state
    assert (state.version_count, state.waiting_bytes) == (1, 0)
    with versions.edit() as draft:
        draft.remove_obstacle(wall)
    with versions.acquire() as new:
        assert length(new) == before


def test_what_is_refused(versions: talus.NavVersions, hall: Mesh) -> None:
    with versions.acquire() as version:
        for change in (
            lambda: version.add_link([3, 0, 3], [4, 0, 4]),
            lambda: version.add_obstacle(WALL),
            version.prepare,
            lambda: talus.NavVersions(version),
        ):
            with pytest.raises(ValueError, match=r"NavVersions\.edit"):
                change()
    for use in (lambda: length(version), lambda: version.area, lambda: talus.Level(navmesh=version).to_bytes()):
        with pytest.raises(ValueError, match="given back"):
            use()
    with versions.edit() as draft:
        with pytest.raises(ValueError, match="draft"):
            talus.NavVersions(draft)
        with pytest.raises(ValueError, match="before"):
            draft.find_links()
        assert draft.find_links(max_drop=7, add=False).size > 0
    with pytest.raises(ValueError, match="given back"):
        draft.add_link([3, 0, 3], [4, 0, 4])
    navmesh = talus.Navmesh.bake(*hall)
    talus.NavVersions(navmesh)
    with pytest.raises(ValueError, match=r"NavVersions\.edit"):
        navmesh.add_link([3, 0, 3], [4, 0, 4])
    assert navmesh.shortest_path(START, GOAL)  # it can still be asked


def test_a_failed_edit_is_not_published(versions: talus.NavVersions) -> None:
    def edit_and_fail() -> None:
        with versions.edit() as draft:
            draft.add_obstacle(WALL)
            raise KeyError("something else")

    with versions.acquire() as version:
        before, newest = length(version), versions.state.newest
    with pytest.raises(KeyError):
        edit_and_fail()
    assert versions.state.newest == newest
    with versions.acquire() as version:
        assert length(version) == before
    with versions.edit() as draft:
        assert length(draft) > before + 1  # it goes on where it was
    with versions.acquire() as version:
        assert length(version) > before + 1


def test_readers_beside_a_writer(versions: talus.NavVersions) -> None:
    with versions.acquire() as version:
        free = length(version)
    with versions.edit() as draft:
        wall = draft.add_obstacle(WALL)
        around = length(draft)
        draft.remove_obstacle(wall)
    seen: list[float] = []
    wrong: list[float] = []
    stop = threading.Event()

    def read() -> None:
        while not stop.is_set():
            with versions.acquire() as version:
                lengths = {length(version) for _ in range(5)}
            seen.extend(lengths)
            if len(lengths) != 1 or not lengths <= {free, around}:
                wrong.extend(lengths)

    readers = [threading.Thread(target=read) for _ in range(3)]
    for reader in readers:
        reader.start()
    # Each edit takes the wall away, and puts it elsewhere first: in between lies what nobody may see.
    for i in range(40):
        with versions.edit() as draft:
            other = draft.add_obstacle(talus.Obstacle.cylinder([12, 0, 33], radius=1.5, height=2))
            if i % 2 == 0:
                wall = draft.add_obstacle(WALL)
            else:
                draft.remove_obstacle(wall)
            draft.remove_obstacle(other)
    stop.set()
    for reader in readers:
        reader.join()
    assert wrong == []
    assert set(seen) == {free, around}
    assert versions.state.version_count == 1


def test_a_crowd_goes_from_version_to_version(versions: talus.NavVersions) -> None:
    with versions.acquire() as version:
        crowd = talus.Crowd(version)
        agent = crowd.add(START, max_speed=3)
        crowd.set_goals(agent, GOAL)
        crowd.step(1 / 20, count=20)
    with pytest.raises(ValueError, match="given back"):
        crowd.step(1 / 20)
    with versions.edit() as draft:
        draft.add_obstacle(WALL)
    for _ in range(400):
        with versions.acquire() as crowd.navmesh:
            report = crowd.step(1 / 20)
        x, _, z = crowd.positions[0]
        assert not (abs(x - 12) < 5.2 and abs(z - 29) < 1.2)
        if report.arrived:
            break
    assert crowd.states(agent).status.tolist() == ["arrived"]
