# SPDX-License-Identifier: MIT
"""Convex hulls."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _talus
from ._arrays import ArrayLike, Floats, Progress, points as as_points, triple
from ._poses import pose_array

_PLANE = np.dtype([("normal", "f8", 3), ("offset", "f8")])
_MASS = np.dtype([("volume", "f8"), ("area", "f8"), ("center", "f8", 3), ("inertia", "f8", 6)])


class Hull:
    """The convex hull of points, its faces merged to polygons. Which side of a face a point lies on is decided exactly.

    >>> Hull([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]).volume
    0.16666666666666666
    """

    def __init__(
        self,
        points: ArrayLike,
        *,
        max_vertices: int = 0,
        tolerance: float = 0.0,
        thickness: float = 0.0,
        flatness: float = 8.0,
        weld_distance: float = 0.0,
        merge_distance: float = 0.0,
        progress: Progress | None = None,
    ) -> None:
        """Bake the hull of (N, 3) points in metres.

        Args:
            max_vertices: 0 is no limit; else at least 4. The farthest points come first, so those that matter are kept.
            tolerance: metres; points may lie this far outside, for fewer vertices. 0: none does.
            thickness: metres; input without volume is made this thick instead of being refused.
            flatness: input counts as flat when it is thinner than this many roundings of its largest coordinate.
            weld_distance: metres; corners this close to an earlier one are left out.
            merge_distance: metres; faces whose corners lie within this of one plane are one. 0: exactly flat ones.
            progress: called with stage, steps done and steps in all; returning False cancels.

        Raises:
            talus.Error: no points, points without volume (TL_ERR_COPLANAR ...), or a NaN.
        """
        self._hull, self._left_out, self._max_outside = _talus.hull_bake(
            as_points(points, "points"),
            int(max_vertices),
            float(tolerance),
            float(thickness),
            float(flatness),
            float(weld_distance),
            float(merge_distance),
            progress,
        )
        self._read()

    @classmethod
    def _of(cls, capsule: Any) -> Hull:
        hull = cls.__new__(cls)
        hull._hull, hull._left_out, hull._max_outside = capsule, 0, 0.0
        hull._read()
        return hull

    def _read(self) -> None:
        parts = _talus.hull_parts(self._hull)
        self._vertices = np.frombuffer(parts["vertices"], np.float32).reshape(-1, 3)
        self._sources = np.frombuffer(parts["sources"], np.uint32)
        self._corners = np.frombuffer(parts["origins"], np.uint32)
        self._faces = np.frombuffer(parts["faces"], np.uint32).reshape(-1, 2)
        self._planes = np.frombuffer(parts["planes"], _PLANE)
        self._mass = np.frombuffer(parts["mass"], _MASS)[0]

    @property
    def vertices(self) -> Floats:
        """(V, 3) corners in metres, in the order of the points they are."""
        return self._vertices

    @property
    def sources(self) -> npt.NDArray[np.uint32]:
        """(V,) the index of each corner among the points."""
        return self._sources

    @property
    def polygons(self) -> list[npt.NDArray[np.uint32]]:
        """The faces as loops of vertex indices, counter-clockwise seen from outside."""
        return [self._corners[first : first + count] for first, count in self._faces]

    @property
    def triangles(self) -> npt.NDArray[np.uint32]:
        """(T, 3) the faces as fans of triangles, counter-clockwise seen from outside."""
        fans = [np.stack([np.repeat(loop[0], len(loop) - 2), loop[1:-1], loop[2:]], axis=1) for loop in self.polygons]
        return np.concatenate(fans).astype(np.uint32)

    @property
    def planes(self) -> npt.NDArray[np.float64]:
        """(F, 4) outward unit normal and offset of each face: points p with normal . p <= offset are inside."""
        return np.concatenate([self._planes["normal"], self._planes["offset"][:, None]], axis=1)

    @property
    def volume(self) -> float:
        """Cubic metres."""
        return float(self._mass["volume"])

    @property
    def area(self) -> float:
        """Square metres of the surface."""
        return float(self._mass["area"])

    @property
    def center(self) -> npt.NDArray[np.float64]:
        """(3,) centre of mass, metres."""
        return np.array(self._mass["center"])

    @property
    def inertia(self) -> npt.NDArray[np.float64]:
        """(3, 3) inertia tensor about the centre of mass, for density 1."""
        xx, yy, zz, xy, xz, yz = (float(value) for value in self._mass["inertia"])
        return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])

    @property
    def points_left_out(self) -> int:
        """Points that lie outside because ``max_vertices`` was reached or for the ``tolerance``."""
        return int(self._left_out)

    @property
    def max_outside(self) -> float:
        """Metres: no point lies farther outside of the hull."""
        return float(self._max_outside)

    def contains(self, points: ArrayLike) -> npt.NDArray[np.bool_]:
        """(N,) whether each point lies in the closed hull, exactly."""
        given = as_points(points, "points")
        result = np.empty(len(given), np.bool_)
        _talus.hull_contains(self._hull, given, result)
        return result

    def support(self, directions: ArrayLike) -> npt.NDArray[np.uint32]:
        """(N,) the vertex farthest along each direction; of several the lowest index. Directions must be finite."""
        given = as_points(directions, "directions")
        if not np.isfinite(given).all():
            raise ValueError("a direction is NaN or infinite")
        result = np.empty(len(given), np.uint32)
        _talus.hull_support(self._hull, given, result)
        return result

    def transform(self, pose: ArrayLike | None = None, *, scale: ArrayLike = (1, 1, 1)) -> Hull:
        """A copy, scaled along its own axes, then turned and moved by a pose (see `talus.poses`)."""
        at = pose_array(pose)
        if len(at) != 1:
            raise ValueError("a hull is transformed by one pose")
        return Hull._of(_talus.hull_transform(self._hull, triple(scale, "scale"), at))

    def __len__(self) -> int:
        return len(self._vertices)

    def __repr__(self) -> str:
        return f"<talus.Hull: {len(self._vertices)} vertices, {len(self._faces)} faces>"
