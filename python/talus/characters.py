# SPDX-License-Identifier: MIT
"""Characters: capsules that walk over the triangles of a soup."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _talus
from ._arrays import ArrayLike, Floats, material_bits, points as as_points, thread_count
from .soup import Soup

CHARACTER = np.dtype(
    [
        ("position", "f4", 3),
        ("velocity", "f4", 3),
        ("ground_normal", "f4", 3),
        ("ground_point", "f4", 3),
        ("grounded", "u4"),
        ("ground_triangle", "u4"),
        ("ground_instance", "u4"),
        ("ground_pose", "f4", 7),
    ]
)
"""A character's whole state: position of its feet (metres), velocity (metres a second), the ground under it."""

CHARACTER_HIT = np.dtype(
    [("point", "f4", 3), ("normal", "f4", 3), ("triangle", "i4"), ("surface", "u4"), ("material", "u4")]
)
"""Something that a character touched: point in metres, unit normal towards the character, triangle (-1: none), surface:
0 ground, 1 a slope too steep, 2 a wall, 3 a ceiling."""

_MOVE = np.dtype(
    [
        ("landed", "u4"),
        ("left_ground", "u4"),
        ("blocked", "u4"),
        ("hit_ceiling", "u4"),
        ("stuck", "u4"),
        ("stepped_up", "f4"),
        ("pushed", "f4"),
        ("hit_count", "u4"),
        ("hits", CHARACTER_HIT, 8),
    ]
)


@dataclass(frozen=True)
class Moves:
    """What one move did to N characters."""

    landed: npt.NDArray[np.bool_]
    """(N,) it came from the air to the ground."""
    left_ground: npt.NDArray[np.bool_]
    """(N,) the other way: a jump, a ledge, a slope too steep."""
    blocked: npt.NDArray[np.bool_]
    """(N,) a wall or a steep slope took a part of the motion."""
    hit_ceiling: npt.NDArray[np.bool_]
    """(N,) something above stopped it."""
    stuck: npt.NDArray[np.bool_]
    """(N,) it overlaps the level at its end, and no small motion parts them."""
    stepped_up: Floats
    """(N,) metres climbed over steps."""
    pushed: Floats
    """(N,) metres that it was pushed out of what it overlapped at its start."""
    hit_count: npt.NDArray[np.uint32]
    """(N,) things met, each triangle once."""
    hits: npt.NDArray[np.void]
    """(N, 8) of `CHARACTER_HIT`: the first of them."""

    def __len__(self) -> int:
        return len(self.landed)


class Characters:
    """N characters of one size over a soup: upright capsules that slide along walls, climb steps and follow slopes.

    >>> walkers = Characters(soup, [[1, 0, 1], [2, 0, 1]], radius=0.3, height=1.8)
    >>> walkers.move([[1.4, 0, 0], [0, 0, 1.4]], 1 / 60)
    >>> walkers.positions

    The capsule keeps a gap to every triangle, however fast it moves: nothing is tunnelled through. There is no gravity:
    who is in the air falls by the velocity that it is given. Each character moves alone; they do not see one another.

    Moves take turns where several threads ask for them.

    The whole state is `states`, an array that can be read, written, copied and put back.
    """

    soup: Soup
    """What they walk on."""
    states: npt.NDArray[np.void]
    """(N,) of `CHARACTER`: the characters' own memory, not a copy. ``states.copy()`` keeps a moment, and
    ``states[...] = kept`` goes back to it."""
    _movers: Any
    _ignored: int
    _lock: threading.Lock

    def __init__(
        self,
        soup: Soup,
        positions: ArrayLike,
        *,
        radius: float = 0.3,
        height: float = 1.8,
        step_height: float = 0.4,
        max_slope: float = 45.0,
        gap: float = 0.002,
        max_triangles: int = 1024,
        ignored_materials: Sequence[int] = (),
        threads: int | None = 1,
    ) -> None:
        """Place N characters, in the air until they are moved.

        Args:
            soup: the level.
            positions: (N, 3) metres, of their feet: the lowest point of the capsule. One is (3,).
            radius: metres, > 0.
            height: metres, at least 2 radius; from the feet to the top.
            step_height: metres: the highest step that they climb, and follow down.
            max_slope: degrees, 0 to 85: steeper ground is a wall.
            gap: metres, > 0, at most radius / 4: kept free around the capsule.
            max_triangles: near a character at one time, 16 or more; each takes 340 bytes, for each thread.
            ignored_materials: of the soup, as in `Soup.cast`.
            threads: of `move`; None is all.

        Raises:
            talus.Error: a number out of its range, by its name.
        """
        given = as_points(positions, "positions")
        self.soup = soup
        self.states = np.zeros(len(given), CHARACTER)
        self.states["position"] = given
        self._ignored = material_bits(ignored_materials)
        self._lock = threading.Lock()
        self._movers = _talus.movers_create(
            (float(radius), float(height), float(step_height), float(max_slope), float(gap), int(max_triangles)),
            thread_count(threads),
        )

    def move(self, velocities: ArrayLike, seconds: float, *, leave_ground: ArrayLike = False) -> Moves:
        """Move all characters for one step. Releases the GIL.

        Args:
            velocities: (N, 3) metres a second, or one for all. On the ground only x and z count, and the ground is
                followed.
            seconds: >= 0; velocity times seconds is 1000 metres at most.
            leave_ground: (N,) or one: it jumps; then y counts on the ground too.

        Raises:
            talus.Error: what is refused, and the character's index; then none has moved.
        """
        wanted = as_points(velocities, "velocities")
        count = len(self.states)
        if len(wanted) not in (1, count):
            raise ValueError(f"there are {len(wanted)} velocities for {count} characters")
        leaves = np.asarray(leave_ground, dtype=np.bool_)
        if leaves.shape not in ((), (count,)):
            raise ValueError(f"leave_ground has the shape {leaves.shape}; it should be one value, or ({count},)")
        rows = np.empty(count, _MOVE)
        with self._lock:
            moved = self.states.copy()
            _talus.movers_move(
                self._movers, self.soup._soup, self._ignored, moved,
                np.ascontiguousarray(np.broadcast_to(wanted, (count, 3))),
                np.ascontiguousarray(np.broadcast_to(leaves, (count,))), float(seconds), rows,
            )  # fmt: skip
            self.states[...] = moved
        flags = {name: rows[name] != 0 for name in ("landed", "left_ground", "blocked", "hit_ceiling", "stuck")}
        numbers = {name: rows[name].copy() for name in ("stepped_up", "pushed", "hit_count", "hits")}
        return Moves(**flags, **numbers)

    @property
    def positions(self) -> Floats:
        """(N, 3) metres, of their feet. A view: writing to it moves them there."""
        return np.asarray(self.states["position"])

    @property
    def velocities(self) -> Floats:
        """(N, 3) metres a second that the contacts of the last move left. A view."""
        return np.asarray(self.states["velocity"])

    @property
    def grounded(self) -> npt.NDArray[np.bool_]:
        """(N,) whether they stand on something that can be walked on."""
        return np.asarray(self.states["grounded"] != 0)

    def __len__(self) -> int:
        return len(self.states)

    def __repr__(self) -> str:
        return f"<talus.Characters: {len(self):,}, {int(self.grounded.sum()):,} on the ground>"


__all__ = ["CHARACTER", "CHARACTER_HIT", "Characters", "Moves"]
