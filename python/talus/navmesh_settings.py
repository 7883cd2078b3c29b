# SPDX-License-Identifier: MIT
"""What goes into a navmesh: settings, volumes, filters and obstacles."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypedDict

import numpy as np

from . import _talus
from ._arrays import ArrayLike, Floats, triple
from ._poses import pose_array
from .shapes import Shape

WALKABLE_AREA = 63
"""The area of floors that were given none."""


class Settings(TypedDict, total=False):
    """What a navmesh is baked with; names and defaults are those that users of Recast know."""

    cell_size: float
    """Metres: edge of a voxel on x and z. Default 0.3"""
    cell_height: float
    """Metres: height of a voxel. Default 0.2"""
    agent_height: float
    """Metres of free height that an agent needs. Default 2"""
    agent_radius: float
    """Metres by which walkable floor is eroded. Default 0.6"""
    agent_max_climb: float
    """Metres: highest step. Default 0.9"""
    agent_max_slope: float
    """Degrees, below 90: floors less steep are walkable. Default 45"""
    region_min_size: float
    """Cells: islands of fewer cells than its square are removed. Default 8"""
    region_merge_size: float
    """Cells: regions of fewer cells than its square are merged. Default 20"""
    edge_max_len: float
    """Metres: longest contour edge along a wall; 0 is any. Default 12"""
    edge_max_error: float
    """Cells: how far a simplified contour may leave the traced one. Default 1.3"""
    max_verts_per_poly: int
    """3 to 64. Default 6"""
    detail_sample_dist: float
    """Cells between height samples; below 0.9 none. Default 6"""
    detail_sample_max_error: float
    """Cell heights by which the surface may leave the floor. Default 1"""
    partition: str
    """``watershed`` (default), ``monotone`` or ``layers``"""
    polygon_method: str
    """``classic`` (default), ``optimal`` or ``delaunay``"""
    filter_low_hanging_obstacles: bool
    """Low obstacles can be stepped on. Default True"""
    filter_ledge_spans: bool
    """Ledges are not walkable. Default True"""
    filter_walkable_low_height_spans: bool
    """Places with too low a ceiling are not walkable. Default True"""
    tile_size: int
    """Cells; 0 (default) is one tile."""
    tile_height: float
    """Metres: floors over one another are divided into layers of this height; 0 (default) is none."""
    bounds: tuple[tuple[float, float, float], tuple[float, float, float]] | None
    """Metres: lowest and highest corner of what is baked; None (default) is all."""


def default_settings() -> Settings:
    """The defaults of all settings."""
    settings: Settings = _talus.nav_default_settings()
    return settings


@dataclass(frozen=True)
class Box:
    """A box that gives floors an area; 0 makes a hole."""

    area: int
    lowest: tuple[float, float, float]
    highest: tuple[float, float, float]


@dataclass(frozen=True)
class Cylinder:
    """An upright cylinder that gives floors an area; 0 makes a hole."""

    area: int
    base: tuple[float, float, float]
    radius: float
    height: float


@dataclass(frozen=True)
class Prism:
    """A polygon on x and z, from one height to another, that gives floors an area; 0 makes a hole."""

    area: int
    outline: tuple[tuple[float, float], ...]
    lowest: float
    highest: float


Volume = Box | Cylinder | Prism


def volume_tuple(volume: Volume) -> tuple[int, int, tuple[float, ...], bytes]:
    if not 0 <= volume.area <= 255:
        raise ValueError("an area is a number from 0 to 255")
    if isinstance(volume, Box):
        return 0, volume.area, (*triple(volume.lowest, "lowest"), *triple(volume.highest, "highest")), b""
    if isinstance(volume, Cylinder):
        return 2, volume.area, (*triple(volume.base, "base"), float(volume.radius), float(volume.height), 0.0), b""
    outline = np.asarray(volume.outline, dtype=np.float64)
    if outline.ndim != 2 or outline.shape[1] != 2 or len(outline) < 3:
        raise ValueError("an outline is at least three pairs of x and z")
    points = np.zeros((len(outline), 3), np.float32)
    points[:, [0, 2]] = outline
    heights = (0.0, float(volume.lowest), 0.0, 0.0, float(volume.highest), 0.0)
    return 1, volume.area, heights, points.tobytes()


@dataclass(frozen=True)
class Filter:
    """Which polygons paths may enter, and what a metre costs there."""

    include_flags: int = 0xFFFFFFFFFFFFFFFF
    """Polygons with one of these flags may be entered."""
    exclude_flags: int = 0
    """Polygons with one of these may not."""
    area_costs: Mapping[int, float] | None = None
    """What a metre costs in an area; areas that are not named cost 1."""
    slack: float = 0.0
    """By what share a path may be longer than the shortest one, 0 to 1; it is then found sooner."""


def filter_tuple(filter: Filter | None) -> tuple[int, int, Floats | None, float] | None:
    if filter is None:
        return None
    costs = None
    if filter.area_costs:
        costs = np.ones(256, np.float32)
        for area, cost in filter.area_costs.items():
            if not 0 <= area <= 255:
                raise ValueError(f"there is no area {area}: areas are 0 to 255")
            if not (math.isfinite(cost) and cost > 0):
                raise ValueError(f"the cost of area {area} should be finite and > 0")
            costs[area] = cost
    if not 0 <= filter.slack <= 1:
        raise ValueError("the slack should be 0 to 1")
    return filter.include_flags, filter.exclude_flags, costs, float(filter.slack)


@dataclass(frozen=True)
class Obstacle:
    """A temporary obstacle. Made by `Obstacle.cylinder`, `Obstacle.box`, `Obstacle.prism` and `Obstacle.convex`."""

    kind: int
    base: tuple[float, float, float]
    height: float
    numbers: tuple[float, float, float, float, float]
    outline: tuple[tuple[float, float], ...] = ()
    area: int = 0
    """0 is a solid body; another area marks the floors inside it."""
    shape: Shape | None = None
    """Any convex shape, at a pose; `base`, `height` and `numbers` are zero then."""
    pose: tuple[float, ...] = (0.0,) * 7

    @classmethod
    def cylinder(cls, base: ArrayLike, radius: float, height: float, *, area: int = 0) -> Obstacle:
        """An upright cylinder that stands on ``base``. Metres."""
        return cls(0, triple(base, "base"), float(height), (float(radius), 0.0, 0.0, 0.0, 0.0), (), area)

    @classmethod
    def box(
        cls, base: ArrayLike, half_x: float, half_z: float, height: float, *, angle: float = 0.0, area: int = 0
    ) -> Obstacle:
        """A box that stands on ``base``, turned about y by ``angle`` radians. Metres."""
        turn = (math.cos(angle), math.sin(angle))
        return cls(1, triple(base, "base"), float(height), (0.0, float(half_x), float(half_z), *turn), (), area)

    @classmethod
    def prism(cls, base: ArrayLike, outline: ArrayLike, height: float, *, area: int = 0) -> Obstacle:
        """An upright prism over a convex outline, (3 to 16, 2) x and z around ``base``. Metres."""
        points = np.asarray(outline, dtype=np.float64)
        if points.ndim != 2 or points.shape[1] != 2:
            raise ValueError(f"outline has the shape {points.shape}; it should be (K, 2)")
        pairs = tuple((float(x), float(z)) for x, z in points)
        return cls(2, triple(base, "base"), float(height), (0.0, 0.0, 0.0, 1.0, 0.0), pairs, area)

    @classmethod
    def convex(cls, shape: Shape, pose: ArrayLike | None = None, *, area: int = 0) -> Obstacle:
        """Any convex shape at any pose: a hull, a tilted box, a capsule, a cone. One pose, as `talus.poses` makes them.

        >>> ramp = talus.Obstacle.convex(talus.box([2, 0.1, 1]), talus.poses([10, 0.6, 10], [0, 0, 0.3, 0.954]))
        """
        rows = pose_array(pose)
        if len(rows) != 1:
            raise ValueError(f"an obstacle has one pose, not {len(rows)}")
        at = tuple(float(number) for number in rows[0])
        return cls(3, (0.0, 0.0, 0.0), 0.0, (0.0,) * 5, (), area, shape, at)

    def _fields(self) -> tuple[Any, ...]:
        points = np.zeros((len(self.outline), 3), np.float32)
        if self.outline:
            points[:, [0, 2]] = self.outline
        shape = self.shape._shape if self.shape is not None else None
        pose = np.array(self.pose, np.float32)
        return self.kind, int(self.area), self.base, self.height, self.numbers, points, shape, pose
