# SPDX-License-Identifier: MIT
"""Characters: they stand, climb, slide and stop; the capsule is in no wall, whatever they are told."""

from __future__ import annotations

import numpy as np
import pytest
import talus

from conftest import Mesh, box_mesh, join

DT = 1 / 30


@pytest.fixture(scope="module")
def level(hall: Mesh) -> Mesh:
    """The hall, and a flight of steps of 0.25 m along x, at z 34 to 38."""
    steps = [box_mesh((24 + 0.5 * i, 0, 34), (30, 0.25 * (i + 1), 38)) for i in range(6)]
    return join(hall, *steps)


@pytest.fixture(scope="module")
def soup(level: Mesh) -> talus.Soup:
    return talus.Soup(*level)


def test_falls_and_stands(soup: talus.Soup) -> None:
    one = talus.Characters(soup, [3, 2, 20])
    assert len(one) == 1
    assert not one.grounded.any()
    landed = 0
    for _ in range(60):
        landed += int(one.move([0, -3, 0], DT).landed[0])
    assert landed == 1
    assert one.grounded.all()
    assert 0 < one.positions[0, 1] < 0.01
    assert one.states["ground_normal"][0].tolist() == [0, 1, 0]
    moves = one.move([0, 3, 0], DT, leave_ground=True)
    assert moves.left_ground[0]
    assert not one.grounded[0]


def test_walls_stop_and_steps_do_not(soup: talus.Soup) -> None:
    both = talus.Characters(soup, [[15, 0.01, 20], [22, 0.01, 36]], radius=0.3, step_height=0.4)
    both.move([0, -1, 0], DT)
    blocked = False
    climbed = 0.0
    for _ in range(120):
        moves = both.move([1.8, 0, 0], DT)
        blocked |= bool(moves.blocked[0])
        climbed += float(moves.stepped_up[1])
    assert blocked
    assert 18.6 < both.positions[0, 0] < 18.7  # the wall is at 19, the radius 0.3
    assert both.positions[1, 1] == pytest.approx(1.5, abs=0.01)
    assert 1 < climbed < 1.55  # the rest is the round end of the capsule, which slides over an edge
    assert both.grounded.all()
    hits = both.move([1.8, 0, 0], DT).hits[0]
    assert 2 in hits["surface"][hits["triangle"] >= 0]  # a wall


def test_never_in_a_wall(level: Mesh, soup: talus.Soup) -> None:
    rng = np.random.default_rng(5)
    count = 64
    places = np.stack([rng.uniform(2, 17, count), np.full(count, 3.0), rng.uniform(2, 38, count)], axis=1)
    walkers = talus.Characters(soup, places, threads=2)
    body = talus.capsule([0, 0.3, 0], [0, 1.5, 0], 0.3)
    assert not soup.overlaps(body, walkers.positions).any()
    velocity = rng.normal(size=(count, 3)) * [6, 0, 6]
    met = 0
    left = np.zeros(count, np.bool_)  # over the rim of the floor
    for step in range(150):
        if step % 25 == 0:
            velocity = rng.normal(size=(count, 3)) * [6, 0, 6]
            velocity[:8] *= 60  # up to hundreds of metres a second
        velocity[:, 1] = np.where(walkers.grounded, 0, -8)
        moves = walkers.move(velocity, DT, leave_ground=rng.random(count) < 0.02)
        met += int(moves.blocked.sum())
        assert not moves.stuck.any()
        assert not soup.overlaps(body, walkers.positions).any(), step
        at = walkers.positions[:, [0, 2]]
        left |= ((at < 0) | (at > 40)).any(axis=1)
        assert (walkers.positions[~left, 1] > 0).all(), step  # nobody falls through
    assert met > 300
    assert 10 < (~left).sum() < count


def test_threads_copies_and_rollback(soup: talus.Soup) -> None:
    rng = np.random.default_rng(6)
    places = np.stack([rng.uniform(2, 17, 50), np.full(50, 0.01), rng.uniform(12, 38, 50)], axis=1)
    velocity = rng.normal(size=(50, 3)) * [3, 0, 3]
    one, three = talus.Characters(soup, places), talus.Characters(soup, places, threads=3)
    for _ in range(20):
        one.move(velocity, DT)
        three.move(velocity, DT)
    assert one.states.tobytes() == three.states.tobytes()
    kept = one.states.copy()
    one.move(velocity, DT)
    assert one.states.tobytes() != kept.tobytes()
    after = one.states.tobytes()
    one.states[...] = kept
    one.move(velocity, DT)
    assert one.states.tobytes() == after
    one.positions[0] = [3, 5, 20]  # a view
    assert one.states["position"][0].tolist() == [3, 5, 20]


def test_what_is_refused(soup: talus.Soup) -> None:
    walkers = talus.Characters(soup, [[3, 0.01, 20]] * 40)
    before = walkers.states.tobytes()
    velocity = np.zeros((40, 3))
    velocity[:, 0] = 1
    velocity[33] = np.nan
    with pytest.raises(talus.Error) as refused:
        walkers.move(velocity, DT)
    assert (refused.value.result, refused.value.field) == ("TL_ERR_NOT_FINITE", "velocity")
    assert (refused.value.element, refused.value.element_index) == ("character", 33)
    assert walkers.states.tobytes() == before  # none has moved
    with pytest.raises(talus.Error) as refused:
        walkers.move([1e5, 0, 0], 1)
    assert refused.value.result == "TL_ERR_RANGE"
    with pytest.raises(ValueError, match="3 velocities for 40"):
        walkers.move(np.zeros((3, 3)), DT)
    with pytest.raises(ValueError, match="leave_ground"):
        walkers.move([0, 0, 0], DT, leave_ground=[True, False])
    with pytest.raises(talus.Error) as refused:
        talus.Characters(soup, [0, 0, 0], radius=1, height=1)
    assert refused.value.field == "height"
    nobody = talus.Characters(soup, np.zeros((0, 3)))
    assert len(nobody.move([1, 0, 0], DT)) == 0


def test_ignored_materials(level: Mesh) -> None:
    materials = np.zeros(len(level[1]), np.uint16)
    materials[12:24] = 7  # the wall
    soup = talus.Soup(*level, materials=materials)
    for ignored, passes in (((), False), ((7,), True)):
        one = talus.Characters(soup, [15, 0.01, 20], ignored_materials=ignored)
        one.move([0, -1, 0], DT)
        for _ in range(30):
            one.move([10, 0, 0], DT)
        assert (one.positions[0, 0] > 21) == passes
