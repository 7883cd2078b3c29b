# SPDX-License-Identifier: MIT
"""Convex shapes and pairs of them: how far apart, how deep, when do they touch, where do they rest on each other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _talus
from ._arrays import ArrayLike, Floats, points as as_points, triple
from ._poses import pose_array
from .hull import Hull

_STATUS = np.array(["converged", "iterations", "degenerate", "not finite"])


class Shape:
    """A convex shape in its own frame, rounded by a radius. Made by `sphere`, `box`, `capsule` and their like."""

    def __init__(self, kind: str, points: ArrayLike, disc_radius: float, radius: float, hull: Hull | None) -> None:
        given = as_points(points, "points") if np.size(points) else np.zeros((0, 3), np.float32)
        if not np.isfinite(given).all():
            raise ValueError("a coordinate of the shape is NaN or infinite")
        if not (radius >= 0 and disc_radius >= 0):
            raise ValueError("a radius is a number of metres from 0 up")
        self._kind = kind
        self._shape = _talus.shape(
            kind, given, float(disc_radius), float(radius), hull._hull if hull is not None else None
        )

    def bounds(self, pose: ArrayLike | None = None) -> Floats:
        """(2, 3) lowest and highest corner of the shape's box at a pose, metres."""
        return np.array(_talus.shape_bounds(self._shape, pose_array(pose)), dtype=np.float32)

    def __repr__(self) -> str:
        return f"<talus.Shape: {self._kind}>"


def sphere(radius: float, center: ArrayLike = (0, 0, 0)) -> Shape:
    """A ball; with radius 0 a point. Metres."""
    return Shape("sphere", triple(center, "center"), 0, radius, None)


def capsule(start: ArrayLike, end: ArrayLike, radius: float) -> Shape:
    """A segment grown by a radius. Metres."""
    return Shape("capsule", [triple(start, "start"), triple(end, "end")], 0, radius, None)


def box(half_extents: ArrayLike, center: ArrayLike = (0, 0, 0), *, radius: float = 0.0) -> Shape:
    """A box along the axes of its frame, grown by a radius. Metres."""
    half = triple(half_extents, "half_extents")
    if min(half) < 0:
        raise ValueError("half extents are numbers of metres from 0 up")
    return Shape("box", [triple(center, "center"), half], 0, radius, None)


def triangle(a: ArrayLike, b: ArrayLike, c: ArrayLike, *, radius: float = 0.0) -> Shape:
    """A triangle grown by a radius. Metres."""
    return Shape("triangle", [triple(a, "a"), triple(b, "b"), triple(c, "c")], 0, radius, None)


def cylinder(start: ArrayLike, end: ArrayLike, disc_radius: float, *, radius: float = 0.0) -> Shape:
    """A cylinder by the middles of its two discs, grown by a radius. Metres."""
    return Shape("cylinder", [triple(start, "start"), triple(end, "end")], disc_radius, radius, None)


def cone(base: ArrayLike, apex: ArrayLike, disc_radius: float, *, radius: float = 0.0) -> Shape:
    """A cone by the middle of its base disc and its apex, grown by a radius. Metres."""
    return Shape("cone", [triple(base, "base"), triple(apex, "apex")], disc_radius, radius, None)


def convex(shape: Hull | ArrayLike, *, radius: float = 0.0) -> Shape:
    """A baked hull, or the convex hull of (N, 3) points, grown by a radius. From some 16 points on bake a `Hull`."""
    if isinstance(shape, Hull):
        return Shape("hull", np.zeros((0, 3), np.float32), 0, radius, shape)
    return Shape("points", shape, 0, radius, None)


@dataclass(frozen=True)
class Separations:
    """Distance and nearest points of N pairs."""

    distance: Floats
    """(N,) metres; 0 where they overlap."""
    lower_bound: Floats
    """(N,) metres; the true distance is not less."""
    overlap: npt.NDArray[np.bool_]
    """(N,) whether they share a point."""
    point_a: Floats
    """(N, 3) on A's surface, world."""
    point_b: Floats
    """(N, 3) on B's surface, world."""
    normal: Floats
    """(N, 3) unit, from A to B; zero where they overlap."""
    status: npt.NDArray[np.str_]
    """(N,) ``converged``, or why the answer is only within its bounds."""


@dataclass(frozen=True)
class Penetrations:
    """How deep N pairs overlap."""

    depth: Floats
    """(N,) metres: moving B this far along the normal separates them; 0 where they are apart."""
    lower_bound: Floats
    """(N,) metres; no shorter motion separates them."""
    overlap: npt.NDArray[np.bool_]
    """(N,) whether they overlap."""
    point_a: Floats
    """(N, 3) A's point deepest in B, world."""
    point_b: Floats
    """(N, 3) B's point deepest in A, world."""
    normal: Floats
    """(N, 3) unit, from A to B; zero where they are apart."""
    status: npt.NDArray[np.str_]
    """(N,) ``converged``, or why the answer is only within its bounds."""


@dataclass(frozen=True)
class CastHits:
    """When N moving shapes first touch another."""

    t: Floats
    """(N,) share of the motion, 0 to 1; infinite where they do not touch."""
    gap: Floats
    """(N,) metres that are still between the shapes at t."""
    hit: npt.NDArray[np.bool_]
    """(N,) whether they touch."""
    point: Floats
    """(N, 3) on A's surface, world."""
    normal: Floats
    """(N, 3) unit, from A to B; zero where they overlap at the start."""
    status: npt.NDArray[np.str_]
    """(N,) ``converged``, or why the answer is not proven."""


@dataclass(frozen=True)
class Contacts:
    """Where two shapes rest on each other: up to four pairs of points along one normal."""

    point_a: Floats
    """(K, 3) on A's surface, world."""
    point_b: Floats
    """(K, 3) on B's surface, world."""
    separation: Floats
    """(K,) metres; negative is this deep."""
    normal: Floats
    """(3,) unit, from A to B."""

    def __len__(self) -> int:
        return len(self.separation)


def _pairs(
    kind: int, a: Shape, b: Shape, pose_a: ArrayLike | None, pose_b: ArrayLike | None, motion: ArrayLike | None
) -> tuple[Any, ...]:
    at_a, at_b = pose_array(pose_a), pose_array(pose_b)
    moves = None if motion is None else as_points(motion, "motion")
    count = max(len(at_a), len(at_b), 1 if moves is None else len(moves))
    arrays: list[Floats | None] = []
    for name, array in (("pose_a", at_a), ("pose_b", at_b), ("motion", moves)):
        if array is not None and len(array) not in (1, count):
            raise ValueError(f"{name} has {len(array)} rows where others have {count}")
        if array is not None and len(array) != count:
            array = np.ascontiguousarray(np.broadcast_to(array, (count, array.shape[1])))
        arrays.append(array)
    out = (
        np.empty(count, np.float32),
        np.empty(count, np.float32),
        np.empty(count, np.bool_),
        np.empty((count, 3), np.float32),
        np.empty((count, 3), np.float32),
        np.empty((count, 3), np.float32),
        np.empty(count, np.uint8),
    )
    _talus.shape_pairs(kind, a._shape, arrays[0], b._shape, arrays[1], arrays[2], *out)
    return (*out[:6], _STATUS[out[6]])


def distance(a: Shape, b: Shape, pose_a: ArrayLike | None = None, pose_b: ArrayLike | None = None) -> Separations:
    """Distance and nearest points of two shapes, at one or N pairs of poses.

    >>> talus.distance(talus.sphere(1), talus.box([1, 1, 1]), pose_b=[4, 0, 0]).distance
    array([2.], dtype=float32)
    """
    return Separations(*_pairs(0, a, b, pose_a, pose_b, None))


def penetration(a: Shape, b: Shape, pose_a: ArrayLike | None = None, pose_b: ArrayLike | None = None) -> Penetrations:
    """The shortest translation that separates two shapes, at one or N pairs of poses."""
    return Penetrations(*_pairs(1, a, b, pose_a, pose_b, None))


def cast(
    a: Shape, b: Shape, motion: ArrayLike, pose_a: ArrayLike | None = None, pose_b: ArrayLike | None = None
) -> CastHits:
    """Move B by ``motion`` without turning it, and find when it first touches A; one or N pairs of poses."""
    t, gap, hit, point, _, normal, status = _pairs(2, a, b, pose_a, pose_b, motion)
    return CastHits(t, gap, hit, point, normal, status)


_CONTACT = np.dtype(
    [("point_a", "f4", 3), ("point_b", "f4", 3), ("separation", "f4"), ("features", "u4", 2), ("previous", "u4")]
)
_MANIFOLD = np.dtype(
    [("count", "u4"), ("contacts", _CONTACT, 5), ("normal", "f4", 3), ("separation", "f4"), ("status", "i4")]
)


def contacts(
    a: Shape,
    b: Shape,
    pose_a: ArrayLike | None = None,
    pose_b: ArrayLike | None = None,
    *,
    margin: float = 0.01,
    tolerance: float = 0.01,
) -> Contacts:
    """Where two shapes rest on each other.

    Args:
        margin: metres; shapes that are farther apart have no contacts.
        tolerance: metres; a corner of the common patch may be so much less deep than the deepest point.
    """
    raw = _talus.shape_contacts(
        a._shape, pose_array(pose_a), b._shape, pose_array(pose_b), float(margin), float(tolerance)
    )
    manifold = np.frombuffer(raw, _MANIFOLD)[0]
    some = manifold["contacts"][: manifold["count"]]
    return Contacts(
        some["point_a"].copy(), some["point_b"].copy(), some["separation"].copy(), manifold["normal"].copy()
    )
