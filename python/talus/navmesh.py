# SPDX-License-Identifier: MIT
"""Navmeshes: where can an agent walk, and how."""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _talus
from ._arrays import ArrayLike, Floats, Progress, mesh_of, points as as_points, same_length, thread_count, triple
from .navmesh_results import (
    JUMP_LINK,
    Audit,
    Finding,
    Link,
    Path,
    Paths,
    Places,
    Polygons,
    Reason,
    SurfaceHit,
    Walls,
    Why,
)
from .navmesh_settings import (
    WALKABLE_AREA,
    Filter,
    Obstacle,
    Settings,
    Volume,
    default_settings,
    filter_tuple,
    volume_tuple,
)
from .soup import Soup

LevelTuple = tuple[Floats, npt.NDArray[np.uint32], "npt.NDArray[np.uint8] | None", list[Any]]
"""What a navmesh was baked from: vertices, faces, areas, volumes."""

_STATUS = {
    0: "none",
    1: "complete",
    2: "unreachable",
    3: "out of nodes",
    250: "no navmesh at start",
    251: "no navmesh at goal",
    252: "start blocked",
    253: "goal blocked",
}


class Navmesh:
    """A navigation mesh: convex polygons on which an agent of one size can walk.

    >>> floor = [[0, 0, 0], [0, 0, 10], [10, 0, 10], [10, 0, 0]]
    >>> navmesh = Navmesh.bake(floor, [[0, 1, 2], [0, 2, 3]], agent_radius=0.5)
    >>> navmesh.shortest_path([1, 0, 1], [9, 0, 1]).length
    8.0

    Any number of threads may use one navmesh: its methods take turns, and batches use threads of their own.
    """

    _navmesh: Any
    _settings: Settings
    _level: LevelTuple
    _report: dict[str, Any]
    _soup: Soup | None
    _lock: threading.RLock

    def __init__(self) -> None:
        raise TypeError("use Navmesh.bake or talus.load")

    @classmethod
    def _of(
        cls,
        capsule: Any,
        settings: Settings,
        level: LevelTuple,
        report: Mapping[str, Any],
    ) -> Navmesh:
        navmesh = cls.__new__(cls)
        navmesh._navmesh = capsule
        navmesh._settings = settings
        navmesh._level = level
        navmesh._report = dict(report)
        navmesh._soup = None
        navmesh._lock = threading.RLock()
        return navmesh

    @classmethod
    def bake(
        cls,
        vertices: Any,
        faces: ArrayLike | None = None,
        *,
        areas: ArrayLike | None = None,
        volumes: Sequence[Volume] = (),
        reachable_from: ArrayLike | None = None,
        drop_inside_solids: bool = False,
        island_min_area: float = 0.0,
        obstacles: bool = False,
        threads: int | None = None,
        progress: Progress | None = None,
        **settings: Any,
    ) -> Navmesh:
        """Bake a navmesh.

        Args:
            vertices: (V, 3) metres, y up; or a mesh object of trimesh, meshio or Open3D, without ``faces``.
            faces: (T, 3) indices, counter-clockwise seen from above for floors.
            areas: (T,) area of each triangle, 0 (not walkable) to 255; by default `WALKABLE_AREA`.
            volumes: boxes, cylinders and prisms that give floors an area.
            reachable_from: (N, 3) places where agents start; islands without one are removed.
            drop_inside_solids: remove islands inside closed parts of the level.
            island_min_area: square metres; smaller islands are removed.
            obstacles: keep what `add_obstacle` needs; it wants a ``tile_size``, of some 48 cells.
            threads: threads of the bake; None is all. The result does not depend on it.
            progress: called with stage, steps done and steps in all; returning False cancels.
            settings: see `Settings`.

        Raises:
            talus.Error: a setting out of range, or a coordinate that is NaN.
            TypeError: a setting of a name that does not exist.
        """
        points, triangles = mesh_of(vertices, faces)
        given = _take_areas(areas, len(triangles))
        level = (points, triangles, given, [volume_tuple(volume) for volume in volumes])
        known = default_settings()
        for name in settings:
            if name not in known:
                raise TypeError(f"there is no setting called {name!r}")
        if obstacles and settings.get("bounds") is None:
            used = points[np.unique(triangles)]
            settings["bounds"] = (tuple(used.min(axis=0).tolist()), tuple(used.max(axis=0).tolist()))
        if obstacles and (reachable_from is not None or drop_inside_solids or island_min_area > 0):
            raise ValueError("a navmesh with obstacles cannot be pruned: its tiles are baked again")
        if settings.get("bounds") is not None:
            low, high = settings["bounds"]
            settings["bounds"] = (triple(low, "bounds"), triple(high, "bounds"))
        seeds = None if reachable_from is None else as_points(reachable_from, "reachable_from")
        capsule, report = _talus.nav_bake(
            level,
            dict(settings),
            (seeds, drop_inside_solids, float(island_min_area)),
            obstacles,
            thread_count(threads),
            progress,
        )
        full: Settings = {**known, **settings}  # type: ignore[typeddict-item]
        return cls._of(capsule, full, level, report)

    # --- what it is made of ---------------------------------------------------------------------------------------

    @property
    def settings(self) -> Settings:
        """The settings that it was baked with."""
        return self._settings

    @property
    def report(self) -> dict[str, Any]:
        """Counts of the bake: spans, regions, contours, polygons, what was left out. Empty for a loaded navmesh."""
        return dict(self._report)

    @property
    def area(self) -> float:
        """Square metres in the plane."""
        return float(self._counts()[5])

    @property
    def tile_count(self) -> int:
        """Tiles, layers counted each."""
        return int(self._counts()[0])

    @property
    def size(self) -> int:
        """Bytes of all tiles."""
        return int(self._counts()[7])

    def _counts(self) -> tuple[Any, ...]:
        with self._lock:
            counts: tuple[Any, ...] = _talus.navmesh_counts(self._navmesh)
            return counts

    def polygons(self) -> Polygons:
        """Its polygons."""
        with self._lock:
            _, count, corners, *_ = self._counts()
            result = Polygons(
                np.empty((corners, 3), np.float32),
                np.empty(count + 1, np.uint32),
                np.empty(count, np.uint64),
                np.empty(count, np.uint8),
                np.empty(count, np.uint64),
                np.empty(count, np.uint32),
                np.empty(count, np.float64),
            )
            _talus.navmesh_polygons(
                self._navmesh, result.corners, result.offsets, result.refs, result.areas, result.flags, result.islands,
                result.sizes,
            )  # fmt: skip
            return result

    def surface(self) -> tuple[Floats, npt.NDArray[np.uint32], npt.NDArray[np.uint32]]:
        """The walkable surface as (V, 3) vertices, (T, 3) faces, and (T,) the polygon of each face."""
        with self._lock:
            _, _, _, vertices, triangles, *_ = self._counts()
            points = np.empty((vertices, 3), np.float32)
            triangle = np.empty((triangles, 3), np.uint32)
            polygon = np.empty(triangles, np.uint32)
            v, t = _talus.navmesh_surface(self._navmesh, points, triangle, polygon)
            return points[:v], triangle[:t], polygon[:t]

    def as_trimesh(self) -> dict[str, Any]:
        """Arguments for ``trimesh.Trimesh(**navmesh.as_trimesh())``: the walkable surface."""
        vertices, triangles, _ = self.surface()
        return {"vertices": vertices, "faces": triangles, "process": False}

    def as_meshio(self) -> dict[str, Any]:
        """Arguments for ``meshio.Mesh(**navmesh.as_meshio())``: the walkable surface."""
        vertices, triangles, polygon = self.surface()
        return {"points": vertices, "cells": [("triangle", triangles)], "cell_data": {"polygon": [polygon]}}

    # --- points ---------------------------------------------------------------------------------------------------

    def nearest(
        self, points: ArrayLike, *, half_extents: ArrayLike = (2, 4, 2), filter: Filter | None = None
    ) -> Places:
        """The points of the navmesh nearest to N points, within a box of these half extents (metres) around each."""
        given = as_points(points, "points")
        result = Places(np.empty((len(given), 3), np.float32), np.empty(len(given), np.uint64))
        with self._lock:
            _talus.navmesh_nearest(
                self._navmesh, filter_tuple(filter), given, triple(half_extents, "half_extents"), result.refs,
                result.points,
            )  # fmt: skip
        return result

    def random_points(self, count: int, *, seed: int | None = None, filter: Filter | None = None) -> Places:
        """Random points of the surface, uniform by area in the plane. A seed gives the same points everywhere."""
        numbers = np.random.default_rng(seed).integers(0, 2**64, size=(count, 2), dtype=np.uint64, endpoint=False)
        result = Places(np.empty((count, 3), np.float32), np.empty(count, np.uint64))
        with self._lock:
            _talus.navmesh_random(self._navmesh, filter_tuple(filter), numbers, result.points, result.refs)
        return result

    def distance_to_wall(self, points: ArrayLike, *, radius: float = 10.0, filter: Filter | None = None) -> Walls:
        """The walls nearest to N points, within ``radius`` metres, that a straight line along the surface reaches.

        A point without a navmesh near it has no wall either.
        """
        places = self.nearest(points, filter=filter)
        found = places.found
        result = Walls(
            np.full(len(places), np.inf, np.float32),
            np.full((len(places), 3), np.nan, np.float32),
            np.zeros((len(places), 3), np.float32),
        )
        some = int(found.sum())
        distance = np.empty(some, np.float32)
        point = np.empty((some, 3), np.float32)
        normal = np.empty((some, 3), np.float32)
        with self._lock:
            _talus.navmesh_walls(
                self._navmesh, filter_tuple(filter), places.refs[found], places.points[found], float(radius), distance,
                point, normal,
            )  # fmt: skip
        result.distance[found] = distance
        result.point[found] = point
        result.normal[found] = normal
        return result

    def raycast(self, start: ArrayLike, end: ArrayLike, *, filter: Filter | None = None) -> SurfaceHit:
        """A straight line along the surface from start towards end, until a wall stops it."""
        place = self._place(start, "start", filter)
        with self._lock:
            hit, t, point, normal = _talus.navmesh_raycast(
                self._navmesh, filter_tuple(filter), place[0], place[1], triple(end, "end")
            )
        return SurfaceHit(hit, t, point, normal)

    def move(self, start: ArrayLike, target: ArrayLike, *, filter: Filter | None = None) -> tuple[float, float, float]:
        """Where one gets from start towards the target along the surface, sliding along walls."""
        place = self._place(start, "start", filter)
        with self._lock:
            _, point = _talus.navmesh_move(
                self._navmesh, filter_tuple(filter), place[0], place[1], triple(target, "target")
            )
        x, y, z = point
        return x, y, z

    def _place(self, point: ArrayLike, name: str, filter: Filter | None) -> tuple[int, tuple[float, float, float]]:
        places = self.nearest(triple(point, name), filter=filter)
        if not places.found[0]:
            raise ValueError(f"no navmesh is near {name}")
        x, y, z = places.points[0].tolist()
        return int(places.refs[0]), (x, y, z)

    # --- paths ----------------------------------------------------------------------------------------------------

    def shortest_path(
        self,
        start: ArrayLike,
        goal: ArrayLike,
        *,
        agent_radius: float = 0.0,
        half_extents: ArrayLike = (2, 4, 2),
        filter: Filter | None = None,
    ) -> Path:
        """The shortest path in the plane of x and z, with its proof; see `shortest_paths`."""
        return self.shortest_paths(
            triple(start, "start"), triple(goal, "goal"), agent_radius=agent_radius, half_extents=half_extents,
            filter=filter, threads=1,
        )[0]  # fmt: skip

    def shortest_paths(
        self,
        starts: ArrayLike,
        goals: ArrayLike,
        *,
        agent_radius: float = 0.0,
        half_extents: ArrayLike = (2, 4, 2),
        filter: Filter | None = None,
        threads: int | None = None,
    ) -> Paths:
        """The shortest paths from N starts to N goals.

        Args:
            starts: (N, 3) metres. One start serves all goals, and the other way round.
            goals: (N, 3) metres.
            agent_radius: metres, of an agent wider than the navmesh was baked for; such a path keeps its clearance.
            half_extents: metres: the box around each end in which polygons are sought.
            filter: which polygons may be entered. With area costs paths are the cheapest that A* finds, not proven to
                be so.
            threads: None is all.
        """
        a, b = same_length(as_points(starts, "starts"), as_points(goals, "goals"), "starts, goals")
        if not agent_radius >= 0:
            raise ValueError("agent_radius is a number of metres from 0 up")
        count = len(a)
        status = np.empty(count, np.uint8)
        values = [np.empty(count, np.float64) for _ in range(4)]
        corner_counts = np.empty(count, np.uint32)
        by_cost = filter is not None and bool(filter.area_costs)
        with self._lock:
            raw = _talus.navmesh_paths(
                self._navmesh, filter_tuple(filter), by_cost, float(agent_radius),
                triple(half_extents, "half_extents"), a, b, thread_count(threads), status, *values, corner_counts,
            )  # fmt: skip
        offsets = np.zeros(count + 1, np.int64)
        np.cumsum(corner_counts, out=offsets[1:])
        points = np.frombuffer(raw, np.float32).reshape(-1, 3)
        words = np.array([_STATUS.get(int(code), "none") for code in status])
        length, lower_bound, surface_length, cost = values
        return Paths(words, length, lower_bound, surface_length, cost, points, offsets)

    def reachable(
        self, start: ArrayLike, goal: ArrayLike, *, agent_radius: float = 0.0, filter: Filter | None = None
    ) -> bool:
        """Whether a path leads from start to goal."""
        return bool(self.shortest_path(start, goal, agent_radius=agent_radius, filter=filter))

    def nearest_reachable(
        self, start: ArrayLike, goal: ArrayLike, *, filter: Filter | None = None
    ) -> tuple[float, float, float]:
        """The point nearest to goal on the island of start: where to go when the goal cannot be reached."""
        ref, _ = self._place(start, "start", filter)
        with self._lock:
            _, point = _talus.navmesh_reachable_point(self._navmesh, filter_tuple(filter), ref, triple(goal, "goal"))
        x, y, z = point
        return x, y, z

    def prepare(
        self, *, table_bytes: int = 32 << 20, threads: int | None = None, progress: Progress | None = None
    ) -> str:
        """Make paths faster, with the same answers, until the navmesh is changed.

        Call it again after changes: what they do not concern is kept.

        Args:
            table_bytes: memory for a table of all distances, 6 bytes a pair of corner vertices; 0 is none.
            threads: None is all. The result does not depend on it.
            progress: called with (stage, done, total); return False to cancel.

        Returns:
            What was made: ``table``, ``graph`` or ``none``.
        """
        with self._lock:
            kind, _, _ = _talus.navmesh_prepare(self._navmesh, int(table_bytes), thread_count(threads), progress)
        return str(kind)

    # --- links ----------------------------------------------------------------------------------------------------

    def add_link(
        self,
        start: ArrayLike,
        end: ArrayLike,
        *,
        both_ways: bool = False,
        radius: float = 0.5,
        cost_factor: float = 1.0,
        fixed_cost: float = 0.0,
        flags: int = 1,
        area: int = WALKABLE_AREA,
    ) -> int:
        """Add an off-mesh link (jump, ladder, door, lift, teleporter); returns its reference.

        Each end is anchored to the polygon nearest to it within ``radius`` metres. The link costs fixed_cost +
        cost_factor * its length.
        """
        with self._lock:
            return int(
                _talus.navmesh_add_link(
                    self._navmesh, triple(start, "start"), triple(end, "end"), both_ways, float(radius),
                    float(cost_factor), float(fixed_cost), int(flags), int(area),
                )
            )  # fmt: skip

    def remove_link(self, ref: int) -> None:
        """Remove an off-mesh link. talus.Error (TL_ERR_STALE): there is no such link."""
        with self._lock:
            _talus.navmesh_remove_link(self._navmesh, int(ref))

    def links(self) -> list[Link]:
        """All off-mesh links."""
        with self._lock:
            return [Link(*item) for item in _talus.navmesh_links(self._navmesh)]

    def find_links(
        self,
        *,
        soup: Soup | None = None,
        spacing: float = 0.5,
        max_drop: float = 4.0,
        max_jump: float = 3.0,
        jump_height: float = 1.0,
        max_speed: float = 6.0,
        gravity: float = 9.81,
        max_climb: float = 1.2,
        min_gain: float = 3.0,
        add: bool = True,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> npt.NDArray[np.void]:
        """Find drops, jumps and climbs along ledges, each proven by sweeping the agent through the triangles.

        Lengths are in metres, speed in metres a second; a limit of 0 turns its kind off. Returns an array of
        `JUMP_LINK`; with ``add`` (the default) paths use them from now on, and they are saved with the navmesh.
        """
        limits = (spacing, max_drop, max_jump, jump_height, max_speed, gravity, max_climb, min_gain)
        with self._lock:
            raw = _talus.navmesh_find_links(
                self._navmesh, self._need_soup(soup)._soup, tuple(float(limit) for limit in limits), add,
                thread_count(threads), progress,
            )  # fmt: skip
        return np.frombuffer(raw, JUMP_LINK)

    def _need_soup(self, soup: Soup | None) -> Soup:
        if soup is not None:
            return soup
        if self._soup is None:
            if len(self._level[1]) == 0:
                raise ValueError("the triangles are not known: give soup=")
            self._soup = Soup(self._level[0], self._level[1])
        return self._soup

    # --- obstacles ------------------------------------------------------------------------------------------------

    def add_obstacle(self, obstacle: Obstacle, *, update: bool = True) -> int:
        """Add a temporary obstacle; returns its id. Needs ``obstacles=True`` when baked.

        With ``update`` the tiles that it touches are rebaked now; else they wait for `update_obstacles`.
        """
        return self._set_obstacle(0, obstacle, update)

    def move_obstacle(self, obstacle_id: int, obstacle: Obstacle, *, update: bool = True) -> None:
        """Move an obstacle, or change its shape."""
        self._set_obstacle(int(obstacle_id), obstacle, update)

    def _set_obstacle(self, obstacle_id: int, obstacle: Obstacle, update: bool) -> int:
        with self._lock:
            result = int(_talus.obstacle_set(self._navmesh, obstacle_id, *obstacle._fields()))
            if update:
                self.update_obstacles()
            return result

    def remove_obstacle(self, obstacle_id: int, *, update: bool = True) -> None:
        """Remove an obstacle. talus.Error (TL_ERR_STALE): there is no such obstacle."""
        with self._lock:
            _talus.obstacle_remove(self._navmesh, int(obstacle_id))
            if update:
                self.update_obstacles()

    def update_obstacles(self, max_tiles: int | None = None, *, threads: int | None = 1) -> int:
        """Rebake up to ``max_tiles`` tiles that wait; None is all. Returns how many wait still.

        Several ``threads`` are worth it where dozens of tiles wait; None is all.
        """
        most = 0x7FFFFFFF if max_tiles is None else int(max_tiles)
        with self._lock:
            return int(_talus.obstacles_update(self._navmesh, most, thread_count(threads)))

    # --- checks ---------------------------------------------------------------------------------------------------

    def audit(
        self,
        *,
        soup: Soup | None = None,
        path_count: int = 2000,
        seed: int = 1,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> Audit:
        """Check the navmesh against its triangles: is all free that it says is free, and is any floor missing?"""
        level = self._level if len(self._level[1]) else None
        with self._lock:
            findings, counts = _talus.navmesh_audit(
                self._navmesh, self._need_soup(soup)._soup, level, int(path_count), int(seed), thread_count(threads),
                progress,
            )  # fmt: skip
        return Audit([Finding(*item) for item in findings], **counts)

    def why(self, point: ArrayLike, *, progress: Progress | None = None) -> Why:
        """Why a point is not walkable: the stage and setting to blame, and the nearest value that would make it so."""
        if len(self._level[1]) == 0:
            raise ValueError("the triangles are not known: load a file that has its soup")
        with self._lock:
            walkable, floor, reasons, proven, needed, apart, island, largest = _talus.navmesh_why(
                self._navmesh, self._level, triple(point, "point"), progress
            )
        return Why(walkable, floor, [Reason(*item) for item in reasons], proven, needed, apart, island, largest)

    def __repr__(self) -> str:
        tiles, polygons, *_ = self._counts()
        return f"<talus.Navmesh: {polygons:,} polygons, {tiles:,} tiles, {self.area:,.1f} m2>"


def _take_areas(areas: ArrayLike | None, count: int) -> npt.NDArray[np.uint8] | None:
    if areas is None:
        return None
    given = np.asarray(areas)
    if given.shape != (count,):
        raise ValueError(f"areas has the shape {given.shape}; it should be ({count},)")
    if given.size and (given.min() < 0 or given.max() > 255):
        raise ValueError("an area is a number from 0 to 255")
    return np.ascontiguousarray(given, dtype=np.uint8)
