# SPDX-License-Identifier: MIT
"""Navmeshes: paths with their proof, points, links, obstacles, audit and why."""

from __future__ import annotations

import gc
import math
import threading

import numpy as np
import pytest
import talus

from conftest import Mesh, box_mesh, comb, join


@pytest.fixture(scope="module")
def navmesh(hall: Mesh) -> talus.Navmesh:
    return talus.Navmesh.bake(*hall, agent_radius=0.5, cell_size=0.25)


def test_bake(navmesh: talus.Navmesh) -> None:
    polygons = navmesh.polygons()
    assert len(polygons) == navmesh.report["polygon_count"] > 5
    assert math.isclose(polygons.sizes.sum(), navmesh.area, rel_tol=1e-6)
    assert (polygons.areas == talus.WALKABLE_AREA).all()
    assert len(np.unique(polygons.islands)) >= 2  # the platform is an island of its own
    vertices, faces, polygon = navmesh.surface()
    corners = vertices[faces].astype(np.float64)
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 1]  # y: the area in the plane
    assert math.isclose(np.abs(cross).sum() / 2, navmesh.area, rel_tol=1e-5)
    assert polygon.max() == len(polygons) - 1
    assert navmesh.settings["agent_radius"] == 0.5
    assert navmesh.settings["agent_height"] == 2.0


def test_path_is_proven(navmesh: talus.Navmesh) -> None:
    path = navmesh.shortest_path([5, 0, 20], [35, 0, 20])
    assert path
    assert path.status == "complete"
    assert path.lower_bound <= path.length <= path.lower_bound * (1 + 1e-6)  # to the rounding of floats
    assert len(path.points) >= 4  # around both ends of the gap
    steps = np.diff(path.points.astype(np.float64), axis=0)[:, [0, 2]]
    assert math.isclose(np.linalg.norm(steps, axis=1).sum(), path.length, rel_tol=1e-6)
    corner = math.hypot(19 - 5 - 0.5, 30.5 - 20)
    assert abs(path.length - (2 * corner + 3)) < 0.5


def test_unreachable(navmesh: talus.Navmesh) -> None:
    path = navmesh.shortest_path([5, 0, 20], [12, 6.5, 34])
    assert not path
    assert path.status == "unreachable"
    assert len(path.points) == 0
    assert math.isinf(path.length)
    assert not navmesh.reachable([5, 0, 20], [12, 6.5, 34])
    near = navmesh.nearest_reachable([5, 0, 20], [12, 6.5, 34])
    assert abs(near[1] - 0.2) < 0.3
    assert navmesh.reachable([5, 0, 20], near)
    assert navmesh.shortest_path([500, 0, 0], [5, 0, 20]).status == "no navmesh at start"
    assert navmesh.shortest_path([5, 0, 20], [500, 0, 0]).status == "no navmesh at goal"


def test_many_paths(navmesh: talus.Navmesh) -> None:
    starts = navmesh.random_points(300, seed=1).points
    goals = navmesh.random_points(300, seed=2).points
    one = navmesh.shortest_paths(starts, goals, threads=1)
    two = navmesh.shortest_paths(starts, goals, threads=3)
    assert (one.length == two.length).all()
    assert (one.points == two.points).all()
    assert len(one) == 300
    assert 200 < one.complete.sum() < 300
    for i in (0, 31, 32, 299):
        single = navmesh.shortest_path(starts[i], goals[i])
        assert single.length == one[i].length
        assert (single.points == one[i].points).all()
    straight = np.linalg.norm((goals - starts)[:, [0, 2]], axis=1)
    assert (one.length >= straight - 1e-4).all()
    assert navmesh.prepare(table_bytes=0, threads=2) == "graph"
    by_graph = navmesh.shortest_paths(starts, goals)
    np.testing.assert_allclose(by_graph.length, one.length, rtol=1e-12)
    assert navmesh.prepare(threads=1) == "table"
    again = navmesh.shortest_paths(starts, goals)
    np.testing.assert_allclose(again.length, one.length, rtol=1e-12)
    assert one[-1].length == one[299].length
    with pytest.raises(IndexError):
        one[300]


def test_wide_agents(navmesh: talus.Navmesh) -> None:
    narrow = navmesh.shortest_path([5, 0, 20], [35, 0, 20])
    wide = navmesh.shortest_path([5, 0, 20], [35, 0, 20], agent_radius=2.0)
    assert wide
    assert wide.length > narrow.length
    assert navmesh.distance_to_wall(wide.points).distance.min() > 1.4
    assert navmesh.shortest_path([5, 0, 20], [35, 0, 20], agent_radius=6.0).status in ("unreachable", "start blocked")


def test_points(navmesh: talus.Navmesh) -> None:
    places = navmesh.nearest([[10, 0, 10], [500, 0, 500]])
    assert places.found.tolist() == [True, False]
    assert np.isnan(places.points[1]).all()
    some = navmesh.random_points(2000, seed=9)
    assert (some.points == navmesh.random_points(2000, seed=9).points).all()
    assert navmesh.nearest(some.points, half_extents=[0.1, 0.5, 0.1]).found.all()
    walls = navmesh.distance_to_wall([[10, 0, 20], [500, 0, 0]], radius=20)
    assert abs(walls.distance[0] - 8.5) < 0.5
    assert math.isinf(walls.distance[1])
    hit = navmesh.raycast([10, 0, 10], [30, 0, 10.5])
    assert hit.hit
    assert abs(hit.point[0] - 18.5) < 0.5
    assert hit.normal[0] < -0.9
    assert not navmesh.raycast([10, 0, 10], [12, 0, 10]).hit
    x, _, z = navmesh.move([16, 0, 10], [23, 0, 11])
    assert abs(x - 18.5) < 0.5
    assert abs(z - 11) < 0.2
    with pytest.raises(ValueError, match="no navmesh is near start"):
        navmesh.raycast([500, 0, 0], [0, 0, 0])


def test_areas_and_filters(hall: Mesh) -> None:
    mud = talus.Box(7, (17, -1, 30), (23, 3, 36))
    navmesh = talus.Navmesh.bake(*hall, volumes=[mud], agent_radius=0.5)
    assert 7 in navmesh.polygons().areas
    start, goal = [10, 0, 33], [30, 0, 33]
    plain = navmesh.shortest_path(start, goal)
    dear = navmesh.shortest_path(start, goal, filter=talus.Filter(area_costs={7: 20}))
    assert dear
    assert dear.length > plain.length
    assert dear.cost > dear.length
    with pytest.raises(ValueError, match="area 7"):
        navmesh.shortest_path(start, goal, filter=talus.Filter(area_costs={7: 0}))
    hole = talus.Navmesh.bake(*hall, volumes=[talus.Cylinder(0, (10, -1, 20), 3, 4)])
    assert not hole.nearest([[10, 0, 20]], half_extents=[1, 1, 1]).found[0]
    prism = talus.Prism(9, ((2, 2), (2, 12), (12, 12), (12, 2)), -1, 4)
    assert 9 in talus.Navmesh.bake(*hall, volumes=[prism]).polygons().areas
    areas = np.full(len(hall[1]), 63)
    areas[:12] = 0
    assert talus.Navmesh.bake(*hall, areas=areas).nearest([[10, 0, 20]]).found.tolist() == [False]


def test_pruning(hall: Mesh) -> None:
    whole = talus.Navmesh.bake(*hall)
    kept = talus.Navmesh.bake(*hall, reachable_from=[[5, 0, 20]])
    assert kept.audit(path_count=20)
    why = kept.why([12, 6.5, 34])
    assert why.reasons[0].cause.startswith("pruned")
    assert kept.area < whole.area
    assert len(np.unique(kept.polygons().islands)) == 1


def test_links(hall: Mesh) -> None:
    navmesh = talus.Navmesh.bake(*hall, agent_radius=0.5)
    start, goal = [12, 6.5, 34], [5, 0, 20]
    assert not navmesh.reachable(start, goal)
    ref = navmesh.add_link(start, goal, radius=1)
    assert navmesh.reachable(start, goal)
    assert not navmesh.reachable(goal, start)
    link = navmesh.links()[0]
    assert link.ref == ref
    assert link.anchored
    assert not link.both_ways
    navmesh.remove_link(ref)
    assert navmesh.links() == []
    with pytest.raises(talus.Error) as caught:
        navmesh.remove_link(ref)
    assert caught.value.result == "TL_ERR_STALE"


def test_found_links() -> None:
    level = join(box_mesh((0, -1, 0), (20, 0, 20)), box_mesh((6, 0, 6), (14, 2.5, 14)))
    navmesh = talus.Navmesh.bake(*level, agent_radius=0.4)
    drops = navmesh.find_links(max_jump=0, max_climb=0, add=False)
    assert len(drops) > 0
    assert (drops["kind"] == 0).all()
    assert (drops["start"][:, 1] > drops["end"][:, 1] + 1).all()
    assert navmesh.links() == []
    assert not navmesh.reachable([10, 2.5, 10], [2, 0, 2])
    navmesh.find_links()
    assert navmesh.reachable([10, 2.5, 10], [2, 0, 2])


def test_obstacles(hall: Mesh) -> None:
    navmesh = talus.Navmesh.bake(*hall, agent_radius=0.5, tile_size=32, obstacles=True)
    start, goal = [5, 0, 20], [15, 0, 20]
    free = navmesh.shortest_path(start, goal).length
    crate = navmesh.add_obstacle(talus.Obstacle.box([10, 0, 20], 1, 4, 2))
    around = navmesh.shortest_path(start, goal).length
    assert around > free + 0.5
    navmesh.move_obstacle(crate, talus.Obstacle.cylinder([10, 0, 28], 1, 2))
    assert navmesh.shortest_path(start, goal).length == free
    third = navmesh.add_obstacle(
        talus.Obstacle.prism([10, 0, 20], [[-1, -3], [-1, 3], [1, 3], [1, -3]], 2), update=False
    )
    assert navmesh.update_obstacles(1) >= 0
    assert navmesh.update_obstacles(threads=3) == 0
    navmesh.remove_obstacle(third)
    navmesh.remove_obstacle(crate)
    assert navmesh.shortest_path(start, goal).length == free
    # A hull that nothing else holds, tilted; and a capsule that lies across the way.
    corners = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-4, 4)]
    tilted = talus.poses([10, 1, 20], [0, 0, 0.3826834, 0.9238795])
    block = navmesh.add_obstacle(talus.Obstacle.convex(talus.convex(talus.Hull(corners)), tilted))
    gc.collect()
    assert navmesh.shortest_path(start, goal).length > free + 0.5
    pipe = talus.capsule([10, 0.5, 18], [10, 0.5, 22], 0.5)
    navmesh.move_obstacle(block, talus.Obstacle.convex(pipe))
    assert navmesh.shortest_path(start, goal).length > free + 0.2
    navmesh.move_obstacle(block, talus.Obstacle.convex(pipe, [0, 30, 0]))  # far above
    assert navmesh.shortest_path(start, goal).length == free
    navmesh.remove_obstacle(block)
    with pytest.raises(ValueError, match="one pose"):
        talus.Obstacle.convex(pipe, [[0, 0, 0], [1, 0, 0]])
    plain = talus.Navmesh.bake(*hall)
    with pytest.raises(ValueError, match="obstacles=True"):
        plain.add_obstacle(talus.Obstacle.cylinder([1, 0, 1], 1, 1))


def test_audit_and_why(navmesh: talus.Navmesh, hall: Mesh) -> None:
    audit = navmesh.audit(path_count=100)
    assert audit, audit.findings
    assert audit.path_count == 100
    assert audit.step_count > 1000
    why = navmesh.why([18.7, 0, 20])
    assert not why.walkable
    assert why.reasons[0].cause == "radius"
    assert why.reasons[0].setting == "agent_radius"
    if why.proven:
        better = talus.Navmesh.bake(*hall, **why.needed)
        assert better.nearest([[18.7, 0, 20]], half_extents=[0.05, 1, 0.05]).found[0]
    assert navmesh.why([10, 0, 20]).walkable


def test_progress_and_cancel(hall: Mesh) -> None:
    stages: list[str] = []

    def note(stage: str, done: int, total: int) -> None:
        assert 0 <= done <= total
        stages.append(stage)

    talus.Navmesh.bake(*hall, progress=note)
    assert len(set(stages)) > 3
    with pytest.raises(talus.Error) as caught:
        talus.Navmesh.bake(*hall, progress=lambda *_: False)
    assert caught.value.result == "TL_ERR_CANCELLED"
    with pytest.raises(ZeroDivisionError):
        talus.Navmesh.bake(*hall, progress=lambda *_: bool(1 / 0))


def test_bad_settings(hall: Mesh) -> None:
    with pytest.raises(TypeError, match="agent_raduis"):
        talus.Navmesh.bake(*hall, agent_raduis=1)
    with pytest.raises(talus.Error) as caught:
        talus.Navmesh.bake(*hall, cell_size=0)
    assert caught.value.field == "cell_size"
    assert "cell_size" in str(caught.value)
    with pytest.raises(ValueError, match="partition"):
        talus.Navmesh.bake(*hall, partition="lakes")
    with pytest.raises(talus.Error):
        talus.Navmesh.bake(*hall, obstacles=True)  # no tile_size
    with pytest.raises(TypeError):
        talus.Navmesh()


def test_threads_share_a_navmesh(navmesh: talus.Navmesh) -> None:
    expected = navmesh.shortest_path([5, 0, 20], [35, 0, 20]).length
    wrong: list[float] = []

    def ask() -> None:
        for _ in range(50):
            length = navmesh.shortest_path([5, 0, 20], [35, 0, 20]).length
            if length != expected:
                wrong.append(length)

    threads = [threading.Thread(target=ask) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_long_ways_round_do_not_run_out_of_nodes() -> None:
    navmesh = talus.Navmesh.bake(*comb(120), agent_radius=0.5, cell_size=0.3, tile_size=32)
    rng = np.random.default_rng(5)
    ends = rng.uniform(1, 119, (2, 60, 3)) * [1, 0, 1]
    paths = navmesh.shortest_paths(*ends, half_extents=(1, 2, 1))
    # A search for the shortest path may take more nodes than there are links.
    assert set(paths.status.tolist()) <= {"complete", "no navmesh at start", "no navmesh at goal"}
    assert paths.complete.sum() > 30
