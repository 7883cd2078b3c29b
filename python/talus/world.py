# SPDX-License-Identifier: MIT
"""Worlds larger than memory: a baked file whose tiles come and go around points of interest."""

from __future__ import annotations

import os
import threading
from dataclasses import dataclass
from types import TracebackType
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _talus
from ._arrays import ArrayLike, Doubles, double_points, triple
from .navmesh_settings import Filter, Settings, filter_tuple

_ALL = 0xFFFFFFFF
_PATH_STATUS = {
    1: "complete",
    2: "unreachable",
    3: "out of nodes",
    4: "not loaded",
    250: "no navmesh at start",
    251: "no navmesh at goal",
    252: "not loaded",
    253: "not loaded",
}
_ROUTE_POINT = np.dtype([("point", "f8", 3), ("length", "f8"), ("tile", "i4", 2)])


@dataclass(frozen=True)
class WorldState:
    """Which tiles are in memory, and what they take. A place is a square of the grid, with the tiles of its layers."""

    places: int
    """Places of the file that have tiles."""
    loaded: int
    """In memory, as queries see them."""
    loading: int
    """Begun and not read yet."""
    ready: int
    """Read; the next update takes them in."""
    missing: int
    """Wanted, neither loaded nor on their way: what the budget has no room for, too."""
    failed: int
    """Wanted, and could not be loaded."""
    frames: int
    """Local frames so far: 1 at the first update."""
    bytes: int
    """Of the budget, now."""
    peak_bytes: int
    """The most so far."""
    index_bytes: int
    """Of the file's index, which the budget does not count."""
    read_bytes: int
    """Read of the file for tiles, so far."""


@dataclass(frozen=True)
class WorldPlaces:
    """Points on a world's navmesh."""

    points: Doubles
    """(N, 3) metres; NaN where nothing was found."""
    found: npt.NDArray[np.bool_]
    """(N,) whether a polygon is near, among the tiles in memory."""
    loaded: npt.NDArray[np.bool_]
    """(N,) whether that is the answer of the whole world; else a tile that is not in memory may have a nearer one."""

    def __len__(self) -> int:
        return len(self.found)


@dataclass(frozen=True)
class WorldPath:
    """A path over the tiles in memory."""

    status: str
    """``complete``, ``unreachable``, ``not loaded`` (none over what is in memory), ``no navmesh at start`` or ``at
    goal``, ``out of nodes``."""
    proven: bool
    """Whether that is the answer of the whole world. A path that is not proven can be walked, but tiles that are not in
    memory may hold a shorter one."""
    points: Doubles
    """(K, 3) corners in metres: the start, where the path turns, the goal. Empty unless complete."""
    length: float
    """Metres in the plane of x and z; infinite unless complete."""
    lower_bound: float
    """Metres in the plane: no path of the whole world is shorter."""
    surface_length: float
    """Metres in space, straight from corner to corner."""

    def __bool__(self) -> bool:
        return self.status == "complete"


@dataclass(frozen=True)
class WorldRay:
    """Where a straight line along the surface ended."""

    hit: bool
    """Whether a wall stopped it."""
    loaded: bool
    """False: it ended at the rim of what is in memory, and may go on there."""
    t: float
    """Share of the way in the plane, 0 to 1."""
    point: tuple[float, float, float]
    """Metres; NaN where the start is not in memory."""
    normal: tuple[float, float, float]
    """Of the wall, unit, towards the walkable side."""


@dataclass(frozen=True)
class Route:
    """A way over the whole world, in memory or not."""

    status: str
    """``complete``, ``unreachable`` (proven), ``not loaded`` (the tiles of an end), ``no navmesh at start`` or ``at
    goal``."""
    length: float
    """Metres in the plane: the route's, so that no shortest path is longer; infinite unless complete."""
    lower_bound: float
    """Metres in the plane: no path is shorter."""
    points: Doubles
    """(K, 3) metres: the start, the middles of the gates between tiles that it goes through, the goal."""
    lengths: Doubles
    """(K,) metres in the plane, of the route up to each point."""
    tiles: npt.NDArray[np.int32]
    """(K, 2) the place in the grid, x and z, that the route goes on in: what to load next."""

    def __bool__(self) -> bool:
        return self.status == "complete"


class WorldLoad:
    """The tiles of one place, to be read: made by `World.begin_load`, run on any thread."""

    _load: Any
    tile: tuple[int, int]
    """Place in the grid: x and z."""

    def __init__(self) -> None:
        raise TypeError("use World.begin_load")

    @classmethod
    def _of(cls, capsule: Any) -> WorldLoad:
        load = cls.__new__(cls)
        load._load = capsule
        load.tile = _talus.load_place(capsule)
        return load

    def run(self) -> None:
        """Read the tiles and check them, without the GIL, beside queries, updates and other loads.

        The world's next `World.update` takes them in. A load that is dropped without this is begun anew later.

        Raises:
            talus.Error: the file could not be read (TL_ERR_IO, TL_ERR_TRUNCATED), or a tile is damaged; it is tried
                again when the interests move.
            ValueError: it ran already.
        """
        _talus.load_run(self._load)

    def __repr__(self) -> str:
        return f"<talus.WorldLoad: tile {self.tile[0]},{self.tile[1]}>"


class World:
    """The navmesh of a world that is larger than memory: a file of tiles, opened by its index.

    >>> with World("land.talus", budget=64 << 20) as world:
    ...     world.stream([[100, 0, 100]], radius=150)  # around a player, or several
    ...     path = world.shortest_path([100, 0, 100], [180, 0, 160])
    ...     if path.status == "not loaded":
    ...         ...  # it depends on tiles that are not there

    `stream` waits for what is wanted. A game calls `update` each frame instead, and runs what `begin_load` gives on
    threads of its own.

    Points are in the level's own coordinates, in double, however far from the origin. An answer that depends on a tile
    that is not in memory says so, and is never "nothing there". Methods take turns where several threads call them.
    """

    path: str
    """The file."""
    budget: int
    """Bytes that tiles may take, which they never exceed."""
    _world: Any
    _about: tuple[Settings, Any]
    _lock: threading.RLock

    def __init__(self, path: str | os.PathLike[str], *, budget: int = 64 << 20, frame_reach: float = 4096.0) -> None:
        """Open a file that `talus world merge` wrote, or `Level.save` with a tiled navmesh. No tile is loaded yet.

        Args:
            path: the file; it stays open, and must not change meanwhile.
            budget: bytes that tiles and their navmesh may take together, 65536 or more.
            frame_reach: metres, > 0: tiles are in metres from a local origin, which follows an interest farther away.

        Raises:
            talus.Error: no such file of ours (TL_ERR_MAGIC), damage, or one with links, which need all tiles at once
                (TL_ERR_UNSUPPORTED): open it by `talus.load`.
            ValueError: the file holds no navmesh.
            OSError: it cannot be opened.
        """
        self.path = os.fspath(path)
        self.budget = int(budget)
        self._lock = threading.RLock()
        # Closed when the last load that reads it is gone.
        file = open(self.path, "rb")  # noqa: SIM115
        self._world = _talus.world_open(file, file.fileno(), self.budget, float(frame_reach))
        self._about = _talus.world_about(self._world)

    def close(self) -> None:
        """Free all tiles, and close the file once no load reads it any more."""
        with self._lock:
            self._world = None

    def __enter__(self) -> World:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    @property
    def _open(self) -> Any:
        if self._world is None:
            raise ValueError("the world is closed")
        return self._world

    @property
    def settings(self) -> Settings:
        """The settings that it was baked with; ``bounds`` are those of the file's own frame."""
        return self._about[0]

    @property
    def bounds(self) -> Doubles:
        """(2, 3) lowest and highest corner of what was baked, metres."""
        return np.array(self._about[1], dtype=np.float64)

    @property
    def state(self) -> WorldState:
        """Which tiles are in memory, and what they take."""
        with self._lock:
            return WorldState(*_talus.world_state(self._open))

    # --- tiles in and out -------------------------------------------------------------------------------------------

    def stream(self, points: ArrayLike, radius: ArrayLike = 150.0) -> WorldState:
        """Load all tiles that are wanted and fit the budget, the nearest first, and wait until they are there.

        Args:
            points: (N, 3) metres, around which tiles are wanted.
            radius: metres in the plane, one number or (N,): tiles that come nearer than this are wanted.

        Raises:
            talus.Error: a tile could not be read, or is damaged; calling it again goes on with the others.
        """
        while True:
            changed = self.update(points, radius)
            if self.load() == 0 and not changed:
                return self.state

    def update(self, points: ArrayLike, radius: ArrayLike = 150.0, *, max_changes: int | None = None) -> bool:
        """Say where tiles are wanted, take in those that were read, and make room by taking out the farthest.

        Args:
            points: (N, 3) metres.
            radius: metres in the plane, one number or (N,).
            max_changes: tiles that come in, and that go out, at most; None is all. A game gives 1 or 2 for each frame,
                some 100 us each.

        Returns:
            Whether a tile came or went. Tiles that nobody wants stay until their room is needed.

        Raises:
            talus.Error: a number that is not finite, or a negative radius.
        """
        at = double_points(points, "points")
        reach = np.asarray(radius, dtype=np.float64)
        if reach.shape not in ((), (len(at),)):
            raise ValueError(f"radius has the shape {reach.shape}; it should be one number, or ({len(at)},)")
        interests = np.empty((len(at), 4))
        interests[:, :3] = at
        interests[:, 3] = reach
        changes = _ALL if max_changes is None else int(max_changes)
        with self._lock:
            return bool(_talus.world_update(self._open, interests, changes))

    def begin_load(self) -> WorldLoad | None:
        """The next place to be loaded, the nearest that is wanted and fits the budget; None: there is none now.

        Its `WorldLoad.run` may be called on any thread: ``executor.submit(load.run)``.
        """
        with self._lock:
            load = _talus.world_begin_load(self._open)
        return None if load is None else WorldLoad._of(load)

    def load(self, max_loads: int | None = None) -> int:
        """Read up to so many places that are wanted, here and now; None is all. Returns how many.

        `update` takes them in.

        Raises:
            talus.Error: as in `WorldLoad.run`.
        """
        count = 0
        while max_loads is None or count < max_loads:
            load = self.begin_load()
            if load is None:
                break
            load.run()
            count += 1
        return count

    def covers(self, center: ArrayLike, radius: float) -> bool:
        """Whether all tiles that a circle in the plane touches are in memory. Metres."""
        with self._lock:
            return bool(_talus.world_covers(self._open, triple(center, "center"), float(radius)))

    # --- queries ----------------------------------------------------------------------------------------------------

    def nearest(
        self, points: ArrayLike, *, half_extents: ArrayLike = (2, 4, 2), filter: Filter | None = None
    ) -> WorldPlaces:
        """The points of the navmesh nearest to (N, 3) points, in a box of these half extents (metres) around each."""
        given = double_points(points, "points")
        count = len(given)
        result = WorldPlaces(np.empty((count, 3)), np.empty(count, np.bool_), np.empty(count, np.bool_))
        with self._lock:
            _talus.world_nearest(
                self._open, filter_tuple(filter), given, triple(half_extents, "half_extents"), result.found,
                result.loaded, result.points,
            )  # fmt: skip
        return result

    def shortest_path(
        self,
        start: ArrayLike,
        goal: ArrayLike,
        *,
        half_extents: ArrayLike = (2, 4, 2),
        filter: Filter | None = None,
    ) -> WorldPath:
        """The shortest path in the plane over the tiles in memory, and whether it is that of the whole world.

        Args:
            start: (3,) metres.
            goal: (3,) metres.
            half_extents: metres: the box around each end in which polygons are sought.
            filter: which polygons may be entered; area costs do not count.
        """
        with self._lock:
            status, proven, length, lower_bound, surface_length, raw = _talus.world_path(
                self._open, filter_tuple(filter), triple(start, "start"), triple(goal, "goal"),
                triple(half_extents, "half_extents"),
            )  # fmt: skip
        points = np.frombuffer(raw, np.float64).reshape(-1, 3)
        return WorldPath(_PATH_STATUS[status], proven, points, length, lower_bound, surface_length)

    def raycast(
        self,
        start: ArrayLike,
        end: ArrayLike,
        *,
        half_extents: ArrayLike = (2, 4, 2),
        filter: Filter | None = None,
    ) -> WorldRay:
        """A straight line along the surface from start towards end, until a wall stops it, or the rim of what is in
        memory, where ``loaded`` is False.

        Raises:
            ValueError: there is no navmesh near start.
        """
        with self._lock:
            status, hit, loaded, t, point, normal = _talus.world_raycast(
                self._open, filter_tuple(filter), triple(start, "start"), triple(end, "end"),
                triple(half_extents, "half_extents"),
            )  # fmt: skip
        if _PATH_STATUS.get(status) == "no navmesh at start":
            raise ValueError("no navmesh is near start")
        return WorldRay(hit, loaded, t, point, normal)

    def route(self, start: ArrayLike, goal: ArrayLike, *, half_extents: ArrayLike = (2, 4, 2)) -> Route:
        """A route over the whole world, of which the tiles of both ends alone need to be in memory.

        It is there at once, over any distance, and bounds the shortest path's length from both sides. The command
        ``talus world routes FILE`` puts what it needs into the file.

        Raises:
            ValueError: the file has no routes.
        """
        with self._lock:
            status, length, lower_bound, raw = _talus.world_route(
                self._open, None, triple(start, "start"), triple(goal, "goal"), triple(half_extents, "half_extents")
            )
        rows = np.frombuffer(raw, _ROUTE_POINT)
        parts = (np.ascontiguousarray(rows[name]) for name in ("point", "length", "tile"))
        return Route(_PATH_STATUS[status], length, lower_bound, *parts)

    # --- for drawing ------------------------------------------------------------------------------------------------

    def surface(self) -> tuple[Doubles, npt.NDArray[np.uint32]]:
        """What is in memory of the walkable surface, as (V, 3) vertices in metres and (T, 3) faces."""
        with self._lock:
            view = _talus.world_view(self._open)
            _, _, _, vertices, triangles, *_ = _talus.navmesh_counts(view)
            local = np.empty((vertices, 3), np.float32)
            faces = np.empty((triangles, 3), np.uint32)
            used, count = _talus.navmesh_surface(view, local, faces, np.empty(triangles, np.uint32))
            points = np.empty((used, 3))
            _talus.world_place_out(self._open, local[:used], points)
        return points, faces[:count]

    def __repr__(self) -> str:
        if self._world is None:
            return f"<talus.World: {self.path}, closed>"
        state = self.state
        return f"<talus.World: {state.loaded:,} of {state.places:,} places, {state.bytes:,} of {self.budget:,} bytes>"


__all__ = ["Route", "World", "WorldLoad", "WorldPath", "WorldPlaces", "WorldRay", "WorldState"]
