# SPDX-License-Identifier: MIT
"""Crowds: agents that walk a navmesh to their goals, avoid one another, and never leave it."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _talus
from ._arrays import ArrayLike, Floats, points as as_points, thread_count
from .navmesh import Navmesh
from .navmesh_settings import Filter, filter_tuple

Agents = npt.NDArray[np.uint64]
"""(N,) names of agents. A name is not used again before 2^32 other agents had its place."""

_AGENT = np.dtype(
    [
        ("position", "f4", 3),
        ("reach", "f4"),
        ("radius", "f4"),
        ("height", "f4"),
        ("max_speed", "f4"),
        ("max_acceleration", "f4"),
        ("arrive_distance", "f4"),
        ("priority", "f4"),
        ("filter", "u4"),
        ("fixed", "u4"),
    ]
)
_STATE = np.dtype(
    [
        ("polygon", "u8"),
        ("link", "u8"),
        ("position", "f4", 3),
        ("velocity", "f4", 3),
        ("wanted", "f4", 3),
        ("goal", "f4", 3),
        ("radius", "f4"),
        ("height", "f4"),
        ("status", "u4"),
        ("reserved", "u4"),
    ]
)
_STATUS = np.array(_talus.crowd_status_names())


@dataclass(frozen=True)
class AgentStates:
    """N agents as they are after the last step: arrays of their own, which later steps do not change."""

    agent: Agents
    """(N,) whose state it is."""
    status: npt.NDArray[np.str_]
    """(N,) ``idle``, ``waiting`` (for its path), ``walking``, ``arrived``, ``unreachable``, ``queued`` (at a link),
    ``on link``, ``off mesh``, ``gave up`` (max_nodes are too few), or ``fixed``."""
    position: Floats
    """(N, 3) metres, on the surface."""
    velocity: Floats
    """(N, 3) metres a second, as it moved in the last step."""
    wanted: Floats
    """(N, 3) metres a second: what it would do if it were alone."""
    goal: Floats
    """(N, 3) metres; its position where it has no goal."""
    polygon: npt.NDArray[np.uint64]
    """(N,) reference of the polygon under it; 0 for fixed agents."""
    link: npt.NDArray[np.uint64]
    """(N,) the off-mesh link that it is on, or 0."""
    radius: Floats
    """(N,) metres."""
    height: Floats
    """(N,) metres."""

    def __len__(self) -> int:
        return len(self.agent)


@dataclass(frozen=True)
class CrowdReport:
    """What the steps of one call did: agents by their status after the last of them."""

    searched: int
    """Paths that were searched, in all steps."""
    waiting: int
    """Paths that are still to be searched."""
    walking: int
    arrived: int
    unreachable: int
    on_link: int
    """Those that queue not counted."""
    off_mesh: int
    shared: int
    """Paths that were taken from the search of a shared goal, in all steps."""


class Crowd:
    """A crowd on a navmesh.

    >>> crowd = Crowd(navmesh)
    >>> agents = crowd.add([[1, 0, 1], [1, 0, 3]], radius=0.3, max_speed=[1.2, 1.6])
    >>> crowd.set_goals(agents, [9, 0, 9])
    >>> while crowd.step(1 / 20).arrived < len(agents):
    ...     draw(crowd.positions)

    The same calls give the same bytes on every machine and for any number of threads. What the properties and
    `states` give are copies: the crowd's own memory is not seen from outside. The navmesh may change between steps
    (links, obstacles): agents notice. Methods take turns where several threads call them.
    """

    navmesh: Navmesh
    """The navmesh that they walk."""
    _crowd: Any
    _lock: threading.RLock

    def __init__(
        self,
        navmesh: Navmesh,
        *,
        max_agents: int = 1024,
        max_path: int = 20,
        max_neighbors: int = 10,
        paths_per_step: int = 64,
        max_nodes: int = 4096,
        neighbor_distance: float = 4.0,
        agent_horizon: float = 2.0,
        wall_horizon: float = 0.25,
        max_shared_goals: int = 4,
        filters: Sequence[Filter] = (),
        threads: int | None = 1,
    ) -> None:
        """An empty crowd; all memory that steps use is taken now.

        Args:
            navmesh: where they walk.
            max_agents: 1 to 2^20.
            max_path: polygons of its path that an agent keeps, 4 to 1024; it asks for more in time.
            max_neighbors: that an agent avoids, the nearest ones, 1 to 32.
            paths_per_step: searches of one step, from 1 up; the others wait.
            max_nodes: of one search: 1 MB for 4096, for each thread. Agents that would need more give up.
            neighbor_distance: metres, > 0: agents whose rims are farther apart ignore one another.
            agent_horizon: seconds, > 0: so far ahead collisions with agents are avoided.
            wall_horizon: seconds, > 0: walls are approached so that they are not reached sooner.
            max_shared_goals: goals whose paths are found by one search for all that walk there, 0 to 8: those that most
                agents have. 0: each agent searches its own path.
            filters: up to 16, which agents choose by index; without any, one that passes all.
            threads: of a step. One is enough for some hundreds of agents; None is all.

        Raises:
            talus.Error: a number out of its range, by its name.
        """
        if len(filters) > 16:
            raise ValueError(f"there are {len(filters)} filters; a crowd has 16 at most")
        self.navmesh = navmesh
        self._lock = threading.RLock()
        self._crowd = _talus.crowd_create(
            (int(max_agents), int(max_path), int(max_neighbors), int(paths_per_step), int(max_nodes),
             float(neighbor_distance), float(agent_horizon), float(wall_horizon), int(max_shared_goals)),
            thread_count(threads),
        )  # fmt: skip
        for place, filter in enumerate(filters):
            _talus.crowd_set_filter(self._crowd, place, filter_tuple(filter))

    # --- agents -------------------------------------------------------------------------------------------------------

    def add(
        self,
        positions: ArrayLike,
        *,
        radius: ArrayLike = 0.3,
        height: ArrayLike = 1.8,
        max_speed: ArrayLike = 1.4,
        max_acceleration: ArrayLike = 8.0,
        arrive_distance: ArrayLike = 0.1,
        priority: ArrayLike = 0.5,
        reach: ArrayLike = 2.0,
        filter: ArrayLike = 0,
        fixed: ArrayLike = False,
    ) -> Agents:
        """Add N agents without goals. Returns (N,) their names; 0 where no navmesh is within reach.

        Each argument but the first is one number for all, or (N,).

        Args:
            positions: (N, 3) metres; moved to the nearest point of the navmesh.
            radius: metres, 0 to 1000. One above the navmesh's own keeps the difference from walls.
            height: metres; agents whose heights do not overlap ignore one another.
            max_speed: metres a second.
            max_acceleration: metres a second squared; to avoid others an agent may exceed it.
            arrive_distance: metres: so near to its goal an agent has arrived.
            priority: 0 to 1: of two agents the one with more evades less.
            reach: metres: half the edge of the box in which the navmesh is sought.
            filter: index into the crowd's ``filters``.
            fixed: their motion is the caller's (`set_motion`): players, vehicles. They need not stand on the navmesh.

        Raises:
            talus.Error: a number out of its range, or more than ``max_agents`` (TL_ERR_LIMIT); then none is added.
        """
        given = as_points(positions, "positions")
        rows = np.zeros(len(given), _AGENT)
        rows["position"] = given
        values = {
            "radius": radius, "height": height, "max_speed": max_speed, "max_acceleration": max_acceleration,
            "arrive_distance": arrive_distance, "priority": priority, "reach": reach, "filter": filter, "fixed": fixed,
        }  # fmt: skip
        for name, value in values.items():
            array = np.asarray(value)
            if array.shape not in ((), (len(rows),)):
                raise ValueError(f"{name} has the shape {array.shape}; it should be one number, or ({len(rows)},)")
            if name == "filter" and array.size and (array.min() < 0 or array.max() > 15):
                raise ValueError("a filter is an index from 0 to 15")
            rows[name] = array
        agents = np.zeros(len(rows), np.uint64)
        with self._lock, self.navmesh._lock:
            _talus.crowd_add(self._crowd, self.navmesh._navmesh, rows, agents)
        return agents

    def remove(self, agents: ArrayLike) -> None:
        """Remove (N,) agents. talus.Error (TL_ERR_STALE): one that is not in the crowd; then none is removed."""
        given = np.unique(_names(agents))
        with self._lock:
            _talus.crowd_check(self._crowd, given)
            _talus.crowd_remove(self._crowd, given)

    def set_goals(
        self, agents: ArrayLike, goals: ArrayLike, *, half_extents: ArrayLike = (2, 4, 2), filter: Filter | None = None
    ) -> npt.NDArray[np.bool_]:
        """Send (N,) agents to the points of the navmesh nearest to (N, 3) goals, or to one goal.

        The navmesh is sought in a box of these half extents (metres) around each goal, on polygons that the filter
        passes. Returns (N,) whether it was found: an agent without such a point keeps the goal that it had.

        Raises:
            talus.Error: an agent that is not in the crowd (TL_ERR_STALE); then none is sent.
            ValueError: an agent that is fixed; the same.
        """
        given = _names(agents)
        wanted = as_points(goals, "goals")
        if len(wanted) not in (1, len(given)):
            raise ValueError(f"there are {len(wanted)} goals for {len(given)} agents")
        places = self.navmesh.nearest(wanted, half_extents=half_extents, filter=filter)
        refs = np.ascontiguousarray(np.broadcast_to(places.refs, given.shape))
        points = np.ascontiguousarray(np.broadcast_to(places.points, (len(given), 3)))
        with self._lock:
            if (self.states(given).status == "fixed").any():
                raise ValueError("a fixed agent has no goal: its motion is the caller's")
            _talus.crowd_set_goals(self._crowd, given, refs, points)
        return np.asarray(refs != 0)

    def stop(self, agents: ArrayLike) -> None:
        """Let (N,) agents stop where they are, without a goal."""
        with self._lock:
            _talus.crowd_set_goals(self._crowd, _names(agents), None, None)

    def set_motion(self, agents: ArrayLike, positions: ArrayLike, velocities: ArrayLike) -> None:
        """Say where (N,) fixed agents are now, (N, 3) metres, and how fast they move, (N, 3) metres a second.

        Raises:
            talus.Error: an agent that is not fixed (TL_ERR_ARGUMENT), not in the crowd, or a number that is not finite.
        """
        given = _names(agents)
        at, speed = as_points(positions, "positions"), as_points(velocities, "velocities")
        if len(at) != len(given) or len(speed) != len(given):
            raise ValueError(f"{len(at)} positions and {len(speed)} velocities are given for {len(given)} agents")
        with self._lock:
            _talus.crowd_set_motion(self._crowd, given, at, speed)

    # --- steps --------------------------------------------------------------------------------------------------------

    def step(self, dt: float, count: int = 1) -> CrowdReport:
        """Move all agents by ``dt`` seconds, above 0 and at most 1, ``count`` times. Releases the GIL."""
        if count < 1:
            raise ValueError("count is a number of steps from 1 up")
        with self._lock, self.navmesh._lock:
            return CrowdReport(*_talus.crowd_step(self._crowd, self.navmesh._navmesh, float(dt), int(count)))

    @property
    def agents(self) -> Agents:
        """(N,) all agents, in an order that adding and removing others does not change."""
        with self._lock:
            return np.frombuffer(_talus.crowd_agents(self._crowd), np.uint64)

    def states(self, agents: ArrayLike | None = None) -> AgentStates:
        """What (N,) agents do; None is all, in the order of `agents`.

        Raises:
            talus.Error: an agent that is not in the crowd (TL_ERR_STALE).
        """
        with self._lock:
            given = self.agents if agents is None else _names(agents)
            rows = self._rows(given)
        fields = {name: np.ascontiguousarray(rows[name]) for name in rows.dtype.names or () if name != "reserved"}
        fields["status"] = _STATUS[fields["status"]]
        return AgentStates(given, **fields)

    @property
    def positions(self) -> Floats:
        """(N, 3) metres, in the order of `agents`. A copy."""
        return self._all("position")

    @property
    def velocities(self) -> Floats:
        """(N, 3) metres a second, in the order of `agents`. A copy."""
        return self._all("velocity")

    def _all(self, name: str) -> Floats:
        with self._lock:
            return np.ascontiguousarray(self._rows(self.agents)[name])

    def _rows(self, agents: Agents) -> npt.NDArray[np.void]:
        rows = np.empty(len(agents), _STATE)
        _talus.crowd_states(self._crowd, agents, rows)
        return rows

    def corners(self, agent: int) -> Floats:
        """(K, 3) the corners of an agent's path from its position on, metres, as far as it keeps it."""
        with self._lock, self.navmesh._lock:
            raw = _talus.crowd_corners(self._crowd, self.navmesh._navmesh, int(agent))
        return np.frombuffer(raw, np.float32).reshape(-1, 3)

    # --- the state ----------------------------------------------------------------------------------------------------

    def save(self) -> bytes:
        """The state as bytes: the same for the same state on every machine. Filters are not part of it."""
        with self._lock:
            return bytes(_talus.crowd_save(self._crowd))

    def restore(self, state: bytes) -> None:
        """Go back to a state that was saved, by this crowd or one with the same max_agents and max_path.

        Raises:
            talus.Error: bytes that are no such state; the crowd is as it was.
        """
        with self._lock:
            _talus.crowd_restore(self._crowd, state)

    def hash(self) -> int:
        """A number of 64 bits of what `save` would give, to be compared between machines."""
        with self._lock:
            return int(_talus.crowd_hash(self._crowd))

    def __len__(self) -> int:
        return len(self.agents)

    def __repr__(self) -> str:
        return f"<talus.Crowd: {len(self):,} agents>"


def _names(agents: ArrayLike) -> Agents:
    given = np.asarray(agents)
    if given.size == 0:
        return np.zeros(0, np.uint64)
    if given.dtype.kind not in "iu" or given.ndim > 1:
        raise ValueError(
            f"agents holds {given.dtype} of the shape {given.shape}; give the (N,) names that `add` returned"
        )
    return np.ascontiguousarray(given.reshape(-1), dtype=np.uint64)


__all__ = ["AgentStates", "Agents", "Crowd", "CrowdReport"]
