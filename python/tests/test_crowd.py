# SPDX-License-Identifier: MIT
"""Crowds: nobody leaves the navmesh, everybody arrives, and the same calls give the same bytes."""

from __future__ import annotations

import numpy as np
import pytest
import talus

from conftest import Mesh

DT = 1 / 20


@pytest.fixture(scope="module")
def navmesh(hall: Mesh) -> talus.Navmesh:
    return talus.Navmesh.bake(*hall, agent_radius=0.4, cell_size=0.2, cell_height=0.1, agent_max_climb=0.4)


def off_mesh(navmesh: talus.Navmesh, positions: np.ndarray) -> float:
    """How far the farthest of some points lies beside the navmesh, metres in the plane."""
    near = navmesh.nearest(positions, half_extents=(0.5, 1, 0.5))
    assert near.found.all()
    return float(np.linalg.norm((near.points - positions)[:, [0, 2]], axis=1).max())


def filled(navmesh: talus.Navmesh, count: int, *, threads: int | None = 1) -> tuple[talus.Crowd, np.ndarray]:
    """Agents on one side of the hall, whose goals are beyond the gap."""
    crowd = talus.Crowd(navmesh, max_agents=256, threads=threads)
    rng = np.random.default_rng(3)
    agents = crowd.add(
        np.stack([rng.uniform(2, 16, count), np.zeros(count), rng.uniform(10, 38, count)], axis=1),
        max_speed=rng.uniform(1.5, 3, count),
        radius=0.3,
    )
    assert (agents != 0).all()
    goals = np.stack([rng.uniform(23, 38, count), np.zeros(count), rng.uniform(14, 38, count)], axis=1)
    assert crowd.set_goals(agents, goals).all()
    return crowd, agents


def test_everybody_arrives_on_the_mesh(navmesh: talus.Navmesh) -> None:
    crowd, agents = filled(navmesh, 60)
    assert len(crowd) == 60
    before = crowd.positions
    kept = before.copy()
    for step in range(1, 1500):
        report = crowd.step(DT)
        assert off_mesh(navmesh, crowd.positions) < 1e-3, step
        # The wall stands on x 19 to 21 and z 0 to 30, and the mesh keeps 0.4 m from it.
        inside = (np.abs(crowd.positions[:, 0] - 20) < 1.3) & (crowd.positions[:, 2] < 30)
        assert not inside.any(), step
        if report.arrived == 60:
            break
    states = crowd.states(agents)
    assert (states.status == "arrived").all()
    assert (states.position[:, 0] > 21).all()
    assert np.array_equal(states.agent, agents)
    assert np.array_equal(before, kept)  # copies: what was read does not change
    assert (crowd.states().velocity == crowd.velocities).all()


def test_threads_and_rollback_give_the_same(navmesh: talus.Navmesh) -> None:
    one, agents = filled(navmesh, 80)
    two, _ = filled(navmesh, 80, threads=2)
    one.step(DT, count=100)
    for _ in range(100):
        two.step(DT)
    assert one.save() == two.save()
    assert one.hash() == two.hash()
    saved = one.save()
    one.remove(agents[:7])
    one.step(DT, count=50)
    assert one.hash() != two.hash()
    one.restore(saved)
    assert one.hash() == two.hash()
    one.step(DT, count=50)
    two.step(DT, count=50)
    assert one.save() == two.save()
    with pytest.raises(talus.Error) as refused:
        one.restore(saved[:-1])
    assert refused.value.result == "TL_ERR_TRUNCATED"
    assert one.save() == two.save()
    broken = bytearray(saved)
    broken[0] ^= 0xFF
    with pytest.raises(talus.Error, match="MAGIC|magic|kind") as refused:
        one.restore(bytes(broken))
    assert refused.value.result == "TL_ERR_MAGIC"


def test_agents_by_arrays(navmesh: talus.Navmesh) -> None:
    crowd = talus.Crowd(navmesh, max_agents=4, filters=[talus.Filter(), talus.Filter(include_flags=0)])
    agents = crowd.add([[3, 0, 20], [4, 0, 20], [-50, 0, 0]], radius=[0.2, 0.3, 0.4])
    assert (agents != 0).tolist() == [True, True, False]  # nothing is within reach of the third
    assert crowd.add([5, 0, 20], filter=1).tolist() == [0]  # its filter passes nothing
    np.testing.assert_array_equal(crowd.states(agents[:2]).radius, np.array([0.2, 0.3], np.float32))
    assert (crowd.states().status == "idle").all()
    with pytest.raises(talus.Error) as refused:
        crowd.add([[3, 0, 22]] * 3)
    assert refused.value.result == "TL_ERR_LIMIT"
    assert len(crowd) == 2
    with pytest.raises(talus.Error) as refused:
        crowd.add([[3, 0, 22], [3, 0, 23]], radius=[0.3, -1])
    assert (refused.value.field, refused.value.element_index) == ("radius", 1)
    assert len(crowd) == 2
    assert crowd.set_goals(agents[:2], [[30, 0, 35], [900, 0, 0]]).tolist() == [True, False]
    crowd.step(DT, count=3)
    assert crowd.states(agents[:2]).status.tolist() == ["walking", "idle"]
    corners = crowd.corners(agents[0])
    assert len(corners) >= 2
    assert crowd.corners(agents[1]).shape[1] == 3
    crowd.stop(agents[0])
    crowd.step(DT)
    assert crowd.states(agents[0]).status.tolist() == ["idle"]
    crowd.remove(agents[0])
    for call in (crowd.remove, crowd.stop, crowd.states):
        with pytest.raises(talus.Error) as refused:
            call(agents[1::-1])  # type: ignore[operator]
        assert refused.value.result == "TL_ERR_STALE"
    assert crowd.agents.tolist() == [agents[1]]  # none was removed
    crowd.remove([agents[1], agents[1]])
    assert len(crowd) == 0
    assert crowd.positions.shape == (0, 3)


def test_what_is_refused(navmesh: talus.Navmesh) -> None:
    crowd = talus.Crowd(navmesh)
    agents = crowd.add([[3, 0, 20], [4, 0, 20]])
    with pytest.raises(ValueError, match="radius has the shape"):
        crowd.add([[3, 0, 22]], radius=[1, 2])
    with pytest.raises(ValueError, match="1 positions and 2 velocities"):
        crowd.set_motion(agents[:1], [[0, 0, 0]], [[0, 0, 0], [0, 0, 0]])
    with pytest.raises(ValueError, match="names"):
        crowd.states([0.5])
    with pytest.raises(ValueError, match="3 goals for 2 agents"):
        crowd.set_goals(agents, np.zeros((3, 3)))
    for dt in (0, -1, 2, float("nan")):
        with pytest.raises(talus.Error, match="dt"):
            crowd.step(dt)
    with pytest.raises(talus.Error) as refused:
        talus.Crowd(navmesh, max_neighbors=99)
    assert refused.value.field == "max_neighbors"
    with pytest.raises(talus.Error):
        crowd.set_motion(agents, np.zeros((2, 3)), np.zeros((2, 3)))  # they are not fixed


def test_fixed_agents_are_evaded(navmesh: talus.Navmesh) -> None:
    def closest(radius: float) -> float:
        crowd = talus.Crowd(navmesh)
        walker = crowd.add([3, 0, 35])
        car = crowd.add([8, 0, 35], fixed=True, radius=radius)
        with pytest.raises(ValueError, match="fixed"):
            crowd.set_goals(car, [3, 0, 35])
        crowd.set_goals(walker, [15, 0, 35])
        nearest = np.inf
        for step in range(200):
            crowd.set_motion(car, [[8, 0, 35 + 0.001 * step]], [[0, 0, 0.02]])
            crowd.step(DT)
            at = crowd.states([walker[0], car[0]]).position
            nearest = min(nearest, float(np.linalg.norm((at[0] - at[1])[[0, 2]])))
        assert crowd.states(walker).status[0] == "arrived"
        assert crowd.states(car).status[0] == "fixed"
        return nearest

    assert closest(1.0) > 1.25
    assert closest(0.01) < 1.0  # so it was the car that they went around


def test_who_cannot_arrive_says_so(navmesh: talus.Navmesh) -> None:
    crowd = talus.Crowd(navmesh)
    agent = crowd.add([3, 0, 20])
    crowd.set_goals(agent, [12, 6.5, 34])  # the platform
    crowd.step(DT, count=400)
    assert crowd.states(agent).status.tolist() == ["unreachable"]
    assert off_mesh(navmesh, crowd.positions) < 1e-3


def test_navmesh_changes_under_them(hall: Mesh) -> None:
    navmesh = talus.Navmesh.bake(*hall, agent_radius=0.4, cell_size=0.2, tile_size=48, obstacles=True)
    crowd = talus.Crowd(navmesh)
    agent = crowd.add([12, 0, 20], max_speed=3)
    crowd.set_goals(agent, [12, 0, 36])
    crowd.step(DT, count=20)
    navmesh.add_obstacle(talus.Obstacle.box([12, 0, 29], half_x=3, half_z=1, height=2))
    for _ in range(400):
        report = crowd.step(DT)
        x, _, z = crowd.positions[0]
        assert not (abs(x - 12) < 3.2 and abs(z - 29) < 1.2)
        if report.arrived:
            break
    assert crowd.states(agent).status.tolist() == ["arrived"]


def test_shared_goals_are_searched_once(navmesh: talus.Navmesh) -> None:
    def searches(shared: int) -> tuple[int, int]:
        crowd = talus.Crowd(navmesh, max_shared_goals=shared)
        places = [[3 + 0.8 * (i % 8), 0, 12 + 0.8 * (i // 8)] for i in range(40)]
        crowd.set_goals(crowd.add(places), [35, 0, 35])
        report = crowd.step(DT, count=5)
        return report.searched, report.shared

    alone, none = searches(0)
    together, shared = searches(4)
    assert alone >= 40
    assert none == 0
    assert together < 10
    assert shared >= 30
    with pytest.raises(talus.Error) as refused:
        talus.Crowd(navmesh, max_shared_goals=9)
    assert refused.value.field == "max_shared_goals"


def test_groups_walk_in_formation(navmesh: talus.Navmesh) -> None:
    crowd = talus.Crowd(navmesh)
    agents = crowd.add([[4 + 0.8 * (i % 3), 0, 32 + 0.8 * (i // 3)] for i in range(7)], max_speed=2)
    crowd.set_goals(agents[3], [16, 0, 36])
    group = crowd.add_group(agents, "line", spacing=2.5, keep_order=True)
    state = crowd.group(group)
    assert (state.formation, len(state)) == ("line", 7)
    assert state.agents.tolist() == agents.tolist()
    assert (crowd.states(agents).status == "idle").all()  # followers have lost their goals
    assert crowd.groups_of().tolist() == [group] * 7
    assert crowd.groups_of(crowd.add([3, 0, 20])).tolist() == [0]
    crowd.set_goals(agents[0], [35, 0, 35])  # through a gap that is narrower than the line
    trail = 0
    for _ in range(800):
        crowd.step(DT)
        trail = max(trail, crowd.group(group).on_trail)
        assert off_mesh(navmesh, crowd.positions) < 1e-3
        if crowd.states(agents[:1]).status[0] == "arrived":
            break
    assert crowd.states(agents[:1]).status[0] == "arrived"
    crowd.set_formation(group, "wedge", spacing=1.0, keep_order=True)
    crowd.step(DT, count=200)
    state = crowd.group(group)
    assert state.formation == "wedge"
    assert state.in_place == 7
    assert state.lag < 0.5
    assert trail > 0
    assert abs(np.linalg.norm(state.heading) - 1) < 1e-5
    # The others stand behind the leader, as far apart as was asked for.
    at = crowd.states(agents).position
    forward = (at[1:] - at[0]) @ np.array(state.heading)
    assert (forward < -0.3).all()
    assert np.linalg.norm(at[1:] - at[0], axis=1).max() < 6

    crowd.set_formation(group, "slots", slots=[[-1 - i, 0] for i in range(6)], keep_order=True)
    crowd.step(DT, count=200)
    at = crowd.states(agents).position - crowd.states(agents[:1]).position
    state = crowd.group(group)
    np.testing.assert_allclose(at[1:] @ np.array(state.heading), [-1, -2, -3, -4, -5, -6], atol=0.3)
    saved = crowd.save()
    crowd.remove(agents[0])  # the next one leads
    assert crowd.group(group).agents[0] == agents[1]
    crowd.remove_group(group)
    assert crowd.groups_of().tolist() == [0] * 7
    with pytest.raises(talus.Error) as refused:
        crowd.group(group)
    assert refused.value.result == "TL_ERR_STALE"
    crowd.restore(saved)
    assert crowd.group(group).formation == "slots"


def test_groups_that_are_refused(navmesh: talus.Navmesh) -> None:
    crowd = talus.Crowd(navmesh, max_groups=2, max_members=6)
    agents = crowd.add([[4, 0, 20 + i] for i in range(8)])
    player = crowd.add([6, 0, 20], fixed=True)
    group = crowd.add_group(agents[:3], "line")
    for call, text in (
        (lambda: crowd.add_group(agents[3:], "square"), "formation is 'square'"),  # type: ignore[arg-type]
        (lambda: crowd.add_group(agents[3:5], "slots", slots=[1, 2, 3]), "slots has the shape"),
        (lambda: crowd.add_group(agents[3:6], "slots", slots=[[1, 2]]), "slots has 8 bytes"),
        (lambda: crowd.set_formation(group, "slots"), "slots has 0 bytes"),
        (lambda: crowd.set_goals(agents[:3], [8, 0, 20]), "follows in a group"),
        (lambda: crowd.stop(agents[1]), "follows in a group"),
    ):
        with pytest.raises(ValueError, match=text):
            call()
    assert (crowd.states(agents).status == "idle").all()
    for call, result in (
        (lambda: crowd.add_group(agents[2:5]), "TL_ERR_ARGUMENT"),
        (lambda: crowd.add_group([agents[3], player[0]]), "TL_ERR_ARGUMENT"),
        (lambda: crowd.add_group([]), "TL_ERR_ARGUMENT"),
        (lambda: crowd.add_group(agents[3:5], spacing=-1), "TL_ERR_ARGUMENT"),
        (lambda: crowd.add_group(agents[3:5], wait_distance=float("nan")), "TL_ERR_NOT_FINITE"),
        (lambda: crowd.add_group([int(agents[3]), 12345]), "TL_ERR_STALE"),
        (lambda: crowd.add_group(agents[3:8]), "TL_ERR_LIMIT"),
        (lambda: crowd.remove_group(7), "TL_ERR_STALE"),
        (lambda: crowd.set_formation(7), "TL_ERR_STALE"),
    ):
        with pytest.raises(talus.Error) as refused:
            call()
        assert refused.value.result == result, result
    led = crowd.add_group([player[0], agents[3]])  # a fixed agent may lead
    crowd.set_motion(player, [[10, 0, 20]], [[1, 0, 0]])
    crowd.step(DT, count=100)
    assert crowd.states(agents[3:4]).position[0, 0] > 6
    crowd.remove_group(led)
