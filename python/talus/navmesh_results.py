# SPDX-License-Identifier: MIT
"""What comes out of a navmesh: paths, polygons, places, links, findings and reasons."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ._arrays import Floats
from .navmesh_settings import Settings


@dataclass(frozen=True)
class Path:
    """A path between two points."""

    status: str
    """``complete``, ``unreachable`` (proven), ``out of nodes``, ``no navmesh at start`` or ``at goal``."""
    points: Floats
    """(K, 3) corners in metres: the start, where the path turns, the goal. Empty unless complete."""
    length: float
    """Metres in the plane of x and z; infinite unless complete."""
    lower_bound: float
    """Metres in the plane: no path is shorter. It equals the length, to rounding, where the path is proven shortest."""
    surface_length: float
    """Metres in space, straight from corner to corner."""
    cost: float
    """Metres times area costs; the length where no costs were given."""

    def __bool__(self) -> bool:
        return self.status == "complete"

    def as_trimesh(self) -> dict[str, Any]:
        """Arguments for ``trimesh.load_path``: ``trimesh.load_path(path.as_trimesh()["vertices"])``."""
        return {"vertices": self.points}


@dataclass(frozen=True)
class Paths:
    """N paths. Indexing gives a `Path`."""

    status: npt.NDArray[np.str_]
    """(N,) as in `Path`."""
    length: npt.NDArray[np.float64]
    """(N,) metres in the plane; infinite unless complete."""
    lower_bound: npt.NDArray[np.float64]
    """(N,) metres in the plane."""
    surface_length: npt.NDArray[np.float64]
    """(N,) metres in space."""
    cost: npt.NDArray[np.float64]
    """(N,) metres times area costs."""
    points: Floats
    """(sum of K, 3) the corners of all paths, one after the other."""
    offsets: npt.NDArray[np.int64]
    """(N + 1,) path i has the corners offsets[i] to offsets[i + 1]."""

    @property
    def complete(self) -> npt.NDArray[np.bool_]:
        """(N,) whether each path leads to its goal."""
        complete: npt.NDArray[np.bool_] = np.isfinite(self.length)
        return complete

    def __len__(self) -> int:
        return len(self.length)

    def __getitem__(self, index: int) -> Path:
        if not -len(self) <= index < len(self):
            raise IndexError(index)
        index %= len(self)
        return Path(
            str(self.status[index]),
            self.points[self.offsets[index] : self.offsets[index + 1]],
            float(self.length[index]),
            float(self.lower_bound[index]),
            float(self.surface_length[index]),
            float(self.cost[index]),
        )

    def __iter__(self) -> Iterator[Path]:
        return (self[i] for i in range(len(self)))


@dataclass(frozen=True)
class Polygons:
    """The polygons of a navmesh. They are convex in the plane of x and z."""

    corners: Floats
    """(C, 3) of all polygons, one after the other, counter-clockwise seen from above, metres."""
    offsets: npt.NDArray[np.uint32]
    """(P + 1,) polygon i has the corners offsets[i] to offsets[i + 1]."""
    refs: npt.NDArray[np.uint64]
    """(P,) references, as queries return them."""
    areas: npt.NDArray[np.uint8]
    """(P,) 1 to 255."""
    flags: npt.NDArray[np.uint64]
    """(P,)"""
    islands: npt.NDArray[np.uint32]
    """(P,) connected components: no path leads from one to another."""
    sizes: npt.NDArray[np.float64]
    """(P,) square metres in the plane."""

    def __len__(self) -> int:
        return len(self.refs)

    def __getitem__(self, index: int) -> Floats:
        """(K, 3) the corners of one polygon."""
        return self.corners[self.offsets[index] : self.offsets[index + 1]]


@dataclass(frozen=True)
class Places:
    """Points on the navmesh."""

    points: Floats
    """(N, 3) metres; NaN where no polygon is near."""
    refs: npt.NDArray[np.uint64]
    """(N,) the polygons; 0 where none is near."""

    @property
    def found(self) -> npt.NDArray[np.bool_]:
        """(N,) whether a polygon is near."""
        found: npt.NDArray[np.bool_] = self.refs != 0
        return found

    def __len__(self) -> int:
        return len(self.refs)


@dataclass(frozen=True)
class Walls:
    """The walls nearest to N points."""

    distance: Floats
    """(N,) metres in the plane; infinite where none is within the radius."""
    point: Floats
    """(N, 3) on the wall; NaN where there is none."""
    normal: Floats
    """(N, 3) unit, towards the walkable side."""


@dataclass(frozen=True)
class SurfaceHit:
    """Where a straight line along the surface ended."""

    hit: bool
    """Whether a wall stopped it."""
    t: float
    """Share of the way, 0 to 1."""
    point: tuple[float, float, float]
    """Metres."""
    normal: tuple[float, float, float]
    """Of the wall, unit, towards the walkable side."""


@dataclass(frozen=True)
class Link:
    """An off-mesh link: a jump, drop, ladder, door, lift or teleporter."""

    ref: int
    """Its reference, for `Navmesh.remove_link`."""
    start: tuple[float, float, float]
    end: tuple[float, float, float]
    both_ways: bool
    anchored: bool
    """Whether both ends are on the navmesh: paths use it then."""
    cost: float
    """Metres, before its area's cost."""


JUMP_LINK = np.dtype(
    [("start", "f4", 3), ("end", "f4", 3), ("apex", "f4"), ("kind", "u1"), ("both_ways", "?"), ("reserved", "u2")]
)
"""A link as `Navmesh.find_links` gives it: feet at start and end in metres, apex of a jump above its start, kind:
0 drop, 1 jump, 2 climb."""


@dataclass(frozen=True)
class Finding:
    """A place where the navmesh and the triangles contradict each other."""

    kind: str
    """``blocked``, ``step``, ``no floor`` or ``missing``."""
    triangle: int | None
    """In the soup, where one is to blame."""
    point: tuple[float, float, float]
    """On the floor, metres."""
    contact: tuple[float, float, float]
    """On the triangle, metres."""
    depth: float
    """Metres: how deep the agent overlaps, how high the step is, how deep one falls."""
    count: int
    """Places a cell apart that were merged into this one."""
    area: float
    """Square metres, of missing floor."""


@dataclass(frozen=True)
class Audit:
    """What an audit found, and what it did."""

    findings: list[Finding]
    path_count: int
    path_metres: float
    polygon_count: int
    portal_count: int
    step_count: int
    floor_samples: int
    missing_area: float

    def __bool__(self) -> bool:
        """Whether nothing was found."""
        return not self.findings


@dataclass(frozen=True)
class Reason:
    """Why a point is not walkable, and the setting that removes this reason."""

    cause: str
    """One to four words, such as ``small island``."""
    text: str
    """A sentence."""
    stage: str | None
    """The stage of the bake that took the point away."""
    setting: str | None
    """The setting to change; None where none helps."""
    value: float
    """Of the setting now."""
    needed: float
    """The nearest value with which this reason is gone."""
    measured: float
    """What was found at the point: degrees, metres or cells."""


@dataclass(frozen=True)
class Why:
    """The answer to: why is this point not walkable?"""

    walkable: bool
    floor: tuple[float, float, float]
    """The floor nearest to the point, which the answer is about."""
    reasons: list[Reason]
    """The first is why; each other one is left once those before it are removed."""
    proven: bool
    """A bake with all the needed settings was done, and the point is on its navmesh."""
    needed: Settings
    """The settings with those values."""
    apart: bool
    """Walkable, but not on the largest island."""
    island_area: float
    largest_island_area: float
