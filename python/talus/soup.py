# SPDX-License-Identifier: MIT
"""Triangle soups: what does a ray hit, what is nearest, what is inside, what does a moving shape touch."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _talus
from ._arrays import (
    ArrayLike,
    Cull,
    Floats,
    Progress,
    Reals,
    cull_code,
    material_bits,
    mesh_of,
    points as as_points,
    row_pairs,
    thread_count,
    triple,
)
from ._poses import pose_array
from .shapes import Shape

_HIT = np.dtype(
    [("t", "f4"), ("triangle", "u4"), ("u", "f4"), ("v", "f4"), ("normal", "f4", 3), ("material", "u2"), ("back", "?")],
    align=True,
)


@dataclass(frozen=True)
class RayHits:
    """The closest hits of N rays or segments."""

    t: Floats
    """(N,) where along the ray, in units of its direction's length; infinite where nothing was hit."""
    triangle: npt.NDArray[np.int32]
    """(N,) index of the triangle in ``faces``; -1 where nothing was hit."""
    barycentric: Floats
    """(N, 2) u and v: the point is corner0 * (1 - u - v) + corner1 * u + corner2 * v."""
    normal: Floats
    """(N, 3) unit normal of the triangle's front; zero where nothing was hit."""
    material: npt.NDArray[np.uint16]
    """(N,) the triangle's material."""
    back: npt.NDArray[np.bool_]
    """(N,) whether the ray came from behind."""
    origins: Reals = field(repr=False)
    """(N, 3) the rays' origins: the array that was given, where it was one of float32 or float64. Not a copy."""
    directions: Reals = field(repr=False)
    """(N, 3) the rays' directions, in the same way; of segments, end - start in a new array."""

    @property
    def hit(self) -> npt.NDArray[np.bool_]:
        """(N,) whether anything was hit."""
        return self.triangle >= 0

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """(N, 3) where, in metres; NaN where nothing was hit."""
        t = np.where(self.hit, self.t, np.nan).astype(np.float64)
        # The rays that were cast are of float32.
        origins, directions = self.origins.astype(np.float32), self.directions.astype(np.float32)
        return np.asarray(origins + t[:, None] * directions, dtype=np.float64)

    def __len__(self) -> int:
        return len(self.t)


@dataclass(frozen=True)
class AllHits:
    """All hits of one ray, the nearest first."""

    t: Floats
    """(K,) where along the ray, in units of its direction's length."""
    triangle: npt.NDArray[np.int32]
    """(K,) indices in ``faces``."""
    barycentric: Floats
    """(K, 2) u and v."""
    normal: Floats
    """(K, 3) unit normals of the triangles' fronts."""
    material: npt.NDArray[np.uint16]
    """(K,)"""
    back: npt.NDArray[np.bool_]
    """(K,) whether the ray came from behind."""

    def __len__(self) -> int:
        return len(self.t)


@dataclass(frozen=True)
class NearestPoints:
    """The points of a soup that are nearest to N points."""

    point: Floats
    """(N, 3) metres; NaN where nothing is within the distance asked for."""
    distance: Floats
    """(N,) metres; infinite where there is none."""
    triangle: npt.NDArray[np.int32]
    """(N,) index in ``faces``; -1 where there is none."""
    normal: Floats
    """(N, 3) unit normal of the triangle's front."""
    feature: npt.NDArray[np.uint8]
    """(N,) what part of the triangle: 0 the face, 1 to 3 its edges, 4 to 6 its corners."""
    back: npt.NDArray[np.bool_]
    """(N,) whether the point lies behind the triangle."""

    def __len__(self) -> int:
        return len(self.distance)


@dataclass(frozen=True)
class Locations:
    """Where N points lie with respect to a closed soup."""

    side: npt.NDArray[np.int8]
    """(N,) 1 inside, 0 on the surface, -1 outside."""
    winding: npt.NDArray[np.int32]
    """(N,) how often the surface winds around the point."""

    @property
    def inside(self) -> npt.NDArray[np.bool_]:
        """(N,) inside, or on the surface."""
        return self.side >= 0


@dataclass(frozen=True)
class SweepHits:
    """What N moving shapes hit first."""

    t: Floats
    """(N,) share of the motion, 0 to 1; infinite where the way is free."""
    triangle: npt.NDArray[np.int32]
    """(N,) index in ``faces``; -1 where the way is free."""
    point: Floats
    """(N, 3) on the triangle, metres."""
    normal: Floats
    """(N, 3) unit, from the triangle to the shape."""
    depth: Floats
    """(N,) metres, of an overlap at the start: moving this far along the normal ends it."""

    @property
    def hit(self) -> npt.NDArray[np.bool_]:
        """(N,) whether anything was hit."""
        return self.triangle >= 0


@dataclass(frozen=True)
class SoupStats:
    """What a soup holds."""

    size: int
    """Bytes in all."""
    source_triangle_count: int
    """Triangles that it was baked from."""
    triangle_count: int
    """Triangles stored: those without area are dropped, since no ray can hit them."""
    pair_count: int
    """Pairs of triangles that share an edge."""
    single_count: int
    """Triangles without a partner."""
    coincident_count: int
    """Triangles with the same three corners as one in a pair or a single, which stands for them."""
    node_count: int
    """Nodes of the BVH."""
    layout: str
    """``fast`` or ``compact``."""
    depth: int
    """Nodes from the root to the deepest leaf."""


_LAYOUTS = ("fast", "compact")


class Soup:
    """A triangle soup: triangles in any order, loose, open or intersecting, under a wide BVH.

    >>> floor = Soup([[0, 0, 0], [0, 0, 9], [9, 0, 9], [9, 0, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> hits = floor.cast([[1, 5, 1], [20, 5, 1]], [0, -1, 0])
    >>> hits.t
    array([ 5., inf], dtype=float32)

    What a ray hits is decided exactly: no ray slips through between two triangles that share an edge. A soup does not
    change, but for `refit`, and any number of threads may query it at once; batches release the GIL.
    """

    _soup: Any
    _degenerate: int
    _vertices: Floats
    _faces: npt.NDArray[np.uint32]
    _materials: npt.NDArray[np.uint16] | None

    def __init__(
        self,
        vertices: Any,
        faces: ArrayLike | None = None,
        *,
        materials: ArrayLike | None = None,
        layout: Literal["fast", "compact"] = "fast",
        split_budget: float = 0.0,
        pair_triangles: bool = True,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> None:
        """Bake a soup.

        Args:
            vertices: (V, 3) positions in metres; or a mesh object of trimesh, meshio or Open3D, without ``faces``.
            faces: (T, 3) indices into vertices, counter-clockwise seen from the front.
            materials: (T,) numbers from 0 to 65535 that queries can ignore and return.
            layout: ``compact`` takes half the memory of ``fast``, gives the same answers, and cannot be refitted.
            split_budget: share of extra references, 0 to 1, that spatial splits add; 0: up to a fifth, where they pay.
            pair_triangles: False keeps triangles single, to measure what pairs are worth.
            threads: threads of the bake; None is all.
            progress: called with stage, steps done and steps in all; returning False cancels.

        Raises:
            talus.Error: no triangle with area, an index out of range, or a coordinate that is NaN or beyond 1e12.
        """
        points, triangles = mesh_of(vertices, faces)
        self._vertices = points
        self._faces = triangles
        self._materials = None
        if materials is not None:
            given = np.asarray(materials)
            if given.shape != (len(triangles),):
                raise ValueError(f"materials has the shape {given.shape}; it should be ({len(triangles)},)")
            if given.size and (given.min() < 0 or given.max() > 0xFFFF):
                raise ValueError("a material is a number from 0 to 65535")
            self._materials = np.ascontiguousarray(given, dtype=np.uint16)
        if layout not in _LAYOUTS:
            raise ValueError(f"layout is {layout!r}; it should be 'fast' or 'compact'")
        self._soup, self._degenerate = _talus.soup_bake(
            points,
            triangles,
            self._materials,
            _LAYOUTS.index(layout),
            float(split_budget),
            pair_triangles,
            thread_count(threads),
            progress,
        )

    @classmethod
    def _of(cls, capsule: Any) -> Soup:
        soup = cls.__new__(cls)
        soup._soup = capsule
        soup._degenerate = 0
        soup._materials = None
        corners, numbers, _ = soup._stored()
        soup._vertices = corners.reshape(-1, 3)
        # Faces keep their numbers; those that were dropped when the soup was baked are three times vertex 0.
        soup._faces = np.zeros((soup.stats.source_triangle_count, 3), np.uint32)
        soup._faces[numbers] = np.arange(len(soup._vertices), dtype=np.uint32).reshape(-1, 3)
        return soup

    def _stored(self) -> tuple[Floats, npt.NDArray[np.uint32], npt.NDArray[np.uint16]]:
        count = self.stats.triangle_count
        corners = np.empty((count, 3, 3), np.float32)
        numbers = np.empty(count, np.uint32)
        materials = np.empty(count, np.uint16)
        _talus.soup_triangles(self._soup, corners, numbers, materials)
        return corners, numbers, materials

    @property
    def vertices(self) -> Floats:
        """(V, 3) positions. Of a loaded soup each triangle has corners of its own."""
        return self._vertices

    @property
    def faces(self) -> npt.NDArray[np.uint32]:
        """(T, 3) indices into `vertices`."""
        return self._faces

    @property
    def degenerate_triangles(self) -> int:
        """Triangles that were dropped because their area is exactly zero."""
        return int(self._degenerate)

    @property
    def bounds(self) -> Floats:
        """(2, 3) lowest and highest corner of all triangles, metres."""
        return np.array(_talus.soup_stats(self._soup)["bounds"], dtype=np.float32)

    @property
    def stats(self) -> SoupStats:
        """Counts and bytes."""
        stats = dict(_talus.soup_stats(self._soup))
        del stats["bounds"]
        stats["layout"] = _LAYOUTS[stats["layout"]]
        return SoupStats(**stats)

    def refit(self, vertices: ArrayLike) -> None:
        """Move the triangles to where their vertices are now, in place: O(triangles), and no new memory.

        Answers are as if the soup had been baked anew; queries slow down as triangles move apart from their neighbours.
        No query may run meanwhile. Vertices that had equal positions must still have equal positions.
        """
        moved = as_points(vertices, "vertices")
        if len(moved) != len(self._vertices):
            raise ValueError(f"vertices has {len(moved)} rows; the soup was baked from {len(self._vertices)}")
        _talus.soup_refit(self._soup, moved, self._faces, self._materials)
        self._vertices = moved

    # --- rays -----------------------------------------------------------------------------------------------------

    def cast(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        *,
        max_distance: float | ArrayLike = math.inf,
        cull: Cull = "none",
        ignored_materials: Sequence[int] = (),
        threads: int | None = None,
    ) -> RayHits:
        """The closest hit of each ray.

        Args:
            origins: (N, 3) metres. One origin serves all directions, and the other way round. Arrays of float32 and
                float64 are read where they lie, whatever their strides; the rays are of float32.
            directions: (N, 3) of any length but zero.
            max_distance: number or (N,): how far, in units of the direction's length.
            cull: ignore triangles seen from the ``back`` or ``front``.
            ignored_materials: materials that rays pass through, 0 to 62; 63 stands for all from there up.
            threads: None is all.

        A ray with a NaN or infinite coordinate or a zero direction hits nothing.
        """
        a, b = row_pairs(origins, directions, ("origins", "directions"))
        return self._cast(0, a, b, max_distance, cull, ignored_materials, threads)

    def cast_segments(
        self,
        starts: ArrayLike,
        ends: ArrayLike,
        *,
        cull: Cull = "none",
        ignored_materials: Sequence[int] = (),
        threads: int | None = None,
    ) -> RayHits:
        """The hit of each segment that is closest to its start; ``t`` runs from 0 to 1. Both ends are exact."""
        a, b = row_pairs(starts, ends, ("starts", "ends"))
        hits = self._cast(2, a, b, math.inf, cull, ignored_materials, threads)
        return RayHits(hits.t, hits.triangle, hits.barycentric, hits.normal, hits.material, hits.back, a, b - a)

    def _cast(
        self,
        kind: int,
        a: Reals,
        b: Reals,
        max_distance: float | ArrayLike,
        cull: Cull,
        ignored: Sequence[int],
        threads: int | None,
    ) -> RayHits:
        count = len(a)
        t = np.empty(count, np.float32)
        triangle = np.empty(count, np.int32)
        barycentric = np.empty((count, 2), np.float32)
        normal = np.empty((count, 3), np.float32)
        material = np.empty(count, np.uint16)
        back = np.empty(count, np.bool_)
        _talus.cast(
            self._soup, kind, a, b, _limits(max_distance, count), cull_code(cull), material_bits(ignored),
            thread_count(threads), t, triangle, barycentric, normal, material, back, None,
        )  # fmt: skip
        return RayHits(t, triangle, barycentric, normal, material, back, a, b)

    def any_hit(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        *,
        max_distance: float | ArrayLike = math.inf,
        cull: Cull = "none",
        ignored_materials: Sequence[int] = (),
        threads: int | None = None,
    ) -> npt.NDArray[np.bool_]:
        """(N,) whether each ray hits anything; arguments as in `cast`, and faster."""
        a, b = row_pairs(origins, directions, ("origins", "directions"))
        return self._test(1, a, b, max_distance, cull, ignored_materials, threads)

    def line_of_sight(
        self,
        starts: ArrayLike,
        ends: ArrayLike,
        *,
        ignored_materials: Sequence[int] = (),
        threads: int | None = None,
    ) -> npt.NDArray[np.bool_]:
        """(N,) whether no triangle meets the segment from each start to its end. The same from the end to the start."""
        a, b = row_pairs(starts, ends, ("starts", "ends"))
        return self._test(3, a, b, math.inf, "none", ignored_materials, threads)

    def _test(
        self,
        kind: int,
        a: Reals,
        b: Reals,
        max_distance: float | ArrayLike,
        cull: Cull,
        ignored: Sequence[int],
        threads: int | None,
    ) -> npt.NDArray[np.bool_]:
        tests = np.empty(len(a), np.bool_)
        _talus.cast(
            self._soup, kind, a, b, _limits(max_distance, len(a)), cull_code(cull), material_bits(ignored),
            thread_count(threads), None, None, None, None, None, None, tests,
        )  # fmt: skip
        return tests

    def all_hits(
        self,
        origin: ArrayLike,
        direction: ArrayLike,
        *,
        max_distance: float = math.inf,
        rule: Literal["touched", "crossed"] = "touched",
        cull: Cull = "none",
        ignored_materials: Sequence[int] = (),
    ) -> AllHits:
        """All hits of one ray, the nearest first.

        With the rule ``touched`` every triangle that the ray touches counts, at an edge both. With ``crossed`` every
        passage through a surface counts once: a ray crosses a closed surface an even number of times.
        """
        if rule not in ("touched", "crossed"):
            raise ValueError(f"rule is {rule!r}; it should be 'touched' or 'crossed'")
        raw = _talus.cast_all(
            self._soup, triple(origin, "origin"), triple(direction, "direction"), float(max_distance),
            rule == "crossed", cull_code(cull), material_bits(ignored_materials),
        )  # fmt: skip
        hits = np.frombuffer(raw, _HIT)
        return AllHits(
            hits["t"].copy(),
            hits["triangle"].astype(np.int32),
            np.stack([hits["u"], hits["v"]], axis=1),
            hits["normal"].copy(),
            hits["material"].copy(),
            hits["back"].copy(),
        )

    # --- points ---------------------------------------------------------------------------------------------------

    def nearest(
        self,
        points: ArrayLike,
        *,
        max_distance: float = math.inf,
        ignored_materials: Sequence[int] = (),
        threads: int | None = None,
    ) -> NearestPoints:
        """The point of the soup nearest to each of N points, at most ``max_distance`` metres away."""
        given = as_points(points, "points")
        if math.isnan(max_distance) or max_distance < 0:
            raise ValueError("max_distance is a number of metres from 0 up")
        count = len(given)
        result = NearestPoints(
            np.empty((count, 3), np.float32),
            np.empty(count, np.float32),
            np.empty(count, np.int32),
            np.empty((count, 3), np.float32),
            np.empty(count, np.uint8),
            np.empty(count, np.bool_),
        )
        _talus.soup_nearest(
            self._soup, given, float(max_distance), material_bits(ignored_materials), thread_count(threads),
            result.point, result.distance, result.triangle, result.normal, result.feature, result.back,
        )  # fmt: skip
        return result

    def locate(self, points: ArrayLike, *, threads: int | None = None) -> Locations:
        """On which side of a closed soup each of N points lies, exactly.

        Raises:
            talus.Error: the surface has a hole (TL_ERR_NOT_CLOSED) or neighbours of opposite winding (TL_ERR_WINDING).
        """
        given = as_points(points, "points")
        result = Locations(np.empty(len(given), np.int8), np.empty(len(given), np.int32))
        _talus.soup_locate(self._soup, given, thread_count(threads), result.side, result.winding)
        return result

    def contains(self, points: ArrayLike, *, threads: int | None = None) -> npt.NDArray[np.bool_]:
        """(N,) whether each point lies inside the closed soup, or on it. Errors as in `locate`."""
        return self.locate(points, threads=threads).inside

    def check_closed(self) -> None:
        """Raise a talus.Error that names a triangle, unless the triangles enclose a volume."""
        _talus.soup_check_closed(self._soup)

    # --- shapes ---------------------------------------------------------------------------------------------------

    def overlaps(
        self,
        shape: Shape,
        poses: ArrayLike | None = None,
        *,
        ignored_materials: Sequence[int] = (),
        threads: int | None = None,
    ) -> npt.NDArray[np.bool_]:
        """(N,) whether the shape touches any triangle, at each of N poses (see `talus.poses`)."""
        given = pose_array(poses)
        result = np.empty(len(given), np.bool_)
        _talus.soup_overlaps(
            self._soup, shape._shape, given, material_bits(ignored_materials), thread_count(threads), result
        )
        return result

    def find_overlaps(
        self, shape: Shape, pose: ArrayLike | None = None, *, ignored_materials: Sequence[int] = ()
    ) -> npt.NDArray[np.uint32]:
        """(K,) the triangles that the shape touches at one pose, in rising order."""
        raw = _talus.soup_find_overlaps(self._soup, shape._shape, pose_array(pose), material_bits(ignored_materials))
        return np.sort(np.frombuffer(raw, np.uint32))

    def sweep(
        self,
        shape: Shape,
        motions: ArrayLike,
        poses: ArrayLike | None = None,
        *,
        ignored_materials: Sequence[int] = (),
        threads: int | None = None,
    ) -> SweepHits:
        """Move the shape by each of N motions, without rotation, and find what it hits first.

        A shape passes a triangle that it merely touches: it slides along the floor that it stands on.
        """
        motion = as_points(motions, "motions")
        given = pose_array(poses)
        if len(given) == 1 and len(motion) != 1:
            given = np.ascontiguousarray(np.broadcast_to(given, (len(motion), 7)))
        elif len(motion) == 1 and len(given) != 1:
            motion = np.ascontiguousarray(np.broadcast_to(motion, (len(given), 3)))
        elif len(motion) != len(given):
            raise ValueError(f"there are {len(motion)} motions and {len(given)} poses")
        count = len(motion)
        result = SweepHits(
            np.empty(count, np.float32),
            np.empty(count, np.int32),
            np.empty((count, 3), np.float32),
            np.empty((count, 3), np.float32),
            np.empty(count, np.float32),
        )
        _talus.soup_sweep(
            self._soup, shape._shape, given, motion, material_bits(ignored_materials), thread_count(threads),
            result.t, result.triangle, result.point, result.normal, result.depth,
        )  # fmt: skip
        return result

    def __len__(self) -> int:
        return self.stats.triangle_count

    def __repr__(self) -> str:
        stats = self.stats
        return f"<talus.Soup: {stats.triangle_count:,} triangles, {stats.size:,} bytes, {stats.layout}>"


def _limits(max_distance: float | ArrayLike, count: int) -> Floats:
    limits = np.ascontiguousarray(max_distance, dtype=np.float32).reshape(-1)
    if len(limits) not in (1, count):
        raise ValueError(f"max_distance has {len(limits)} values for {count} rays")
    return limits


__all__ = ["AllHits", "Locations", "NearestPoints", "RayHits", "Soup", "SoupStats", "SweepHits"]
