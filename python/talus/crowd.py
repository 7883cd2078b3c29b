# SPDX-License-Identifier: MIT
"""Crowds: agents that walk a navmesh to their goals, avoid one another, and never leave it."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

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
_FORMATIONS: tuple[str, ...] = _talus.crowd_formation_names()

Formation = Literal["loose", "line", "column", "wedge", "ring", "slots"]
"""How the others stand about their leader: wherever they are, but near to it; abreast, the leader in the middle; one
behind the other; in two rows behind it at 45 degrees; on a circle around it; as ``slots`` say."""


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


@dataclass(frozen=True)
class GroupState:
    """A group as it is after the last step."""

    formation: str
    """How the others stand about their leader."""
    agents: Agents
    """(N,) its agents by their slots; the first one leads."""
    in_place: int
    """Those no farther than half the spacing from their slots; the leader is."""
    on_trail: int
    """Those who follow on the leader's trail, since a wall cuts off their slots."""
    lag: float
    """Metres: of those who are waited for, the largest distance to a slot."""
    speed: float
    """Metres a second: what the leader may walk."""
    heading: tuple[float, float, float]
    """Unit, in the plane: where the formation faces."""

    def __len__(self) -> int:
        return len(self.agents)


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
        max_groups: int = 32,
        max_members: int = 256,
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
            max_groups: groups at a time, 0 to 2^20.
            max_members: agents of all groups together, 0 to 2^20.
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
             float(neighbor_distance), float(agent_horizon), float(wall_horizon), int(max_shared_goals),
             int(max_groups), int(max_members)),
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
            ValueError: an agent that is fixed, or follows in a group; the same.
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
            self._refuse_followers(given)
            _talus.crowd_set_goals(self._crowd, given, refs, points)
        return np.asarray(refs != 0)

    def stop(self, agents: ArrayLike) -> None:
        """Let (N,) agents stop where they are, without a goal.

        Raises:
            talus.Error: an agent that is not in the crowd (TL_ERR_STALE); those before it have stopped.
            ValueError: an agent that follows in a group; then none stops.
        """
        given = _names(agents)
        with self._lock:
            self._refuse_followers(given)
            _talus.crowd_set_goals(self._crowd, given, None, None)

    def _refuse_followers(self, agents: Agents) -> None:
        groups, follows = np.empty(len(agents), np.uint64), np.empty(len(agents), np.bool_)
        _talus.crowd_groups_of(self._crowd, agents, groups, follows)
        if follows.any():
            raise ValueError("an agent that follows in a group has no goal of its own: the leader's is the group's")

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

    # --- groups -------------------------------------------------------------------------------------------------------

    def add_group(
        self,
        agents: ArrayLike,
        formation: Formation = "loose",
        *,
        spacing: float = 1.2,
        wait_distance: float = 4.0,
        lost_distance: float = 30.0,
        slots: ArrayLike | None = None,
        keep_order: bool = False,
    ) -> int:
        """Make a group of (N,) agents, of which the first leads; the others follow it, and lose their goals.

        The leader walks to a goal of its own, no faster than the slowest and slower while somebody is behind; or it is
        fixed, a player. Where a wall cuts a slot off, as in a doorway, the agent follows on the leader's trail, so the
        formation becomes a column until it has room again. Returns the group's name.

        Args:
            agents: (N,) that are in no group; none but the leader may be fixed.
            formation: how the others stand about their leader.
            spacing: metres, 0 to 1000: between neighbours.
            wait_distance: metres, > 0: the leader stands while somebody is so far from its slot.
            lost_distance: metres, > 0: who is farther from its slot is not waited for, nor who is held up for ten
                seconds.
            slots: (N - 1, 2) metres forward and left of the leader, for the formation ``slots``.
            keep_order: agent k takes slot k. False: slots are dealt so that ways there are short and do not cross, and
                anew when the leader gets a goal to the side or behind.

        Raises:
            talus.Error: a number out of its range; an agent that is in a group already (TL_ERR_ARGUMENT) or not in the
                crowd (TL_ERR_STALE); more than max_groups or max_members (TL_ERR_LIMIT).
            ValueError: a formation that is none, or slots of another shape.
        """
        given = _names(agents)
        plan = _plan(formation, spacing, wait_distance, lost_distance, slots, keep_order)
        with self._lock:
            return int(_talus.crowd_add_group(self._crowd, given, plan))

    def set_formation(
        self,
        group: int,
        formation: Formation = "loose",
        *,
        spacing: float = 1.2,
        wait_distance: float = 4.0,
        lost_distance: float = 30.0,
        slots: ArrayLike | None = None,
        keep_order: bool = False,
    ) -> None:
        """Change how a group walks; its agents and their leader remain. Arguments and errors as in `add_group`."""
        plan = _plan(formation, spacing, wait_distance, lost_distance, slots, keep_order)
        with self._lock:
            _talus.crowd_set_formation(self._crowd, int(group), plan)

    def remove_group(self, group: int) -> None:
        """Let the agents of a group go: the leader keeps its goal, the others stop.

        Raises:
            talus.Error: a group that is none (TL_ERR_STALE).
        """
        with self._lock:
            _talus.crowd_remove_group(self._crowd, int(group))

    def group(self, group: int) -> GroupState:
        """A group as it is after the last step.

        Raises:
            talus.Error: a group that is none (TL_ERR_STALE).
        """
        with self._lock:
            formation, *numbers, raw = _talus.crowd_group(self._crowd, int(group))
        return GroupState(_FORMATIONS[formation], np.frombuffer(raw, np.uint64), *numbers)

    def groups_of(self, agents: ArrayLike | None = None) -> npt.NDArray[np.uint64]:
        """(N,) the groups that (N,) agents are in, 0 for those in none; None is all, in the order of `agents`."""
        with self._lock:
            given = self.agents if agents is None else _names(agents)
            groups, follows = np.empty(len(given), np.uint64), np.empty(len(given), np.bool_)
            _talus.crowd_groups_of(self._crowd, given, groups, follows)
        return groups

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


def _plan(
    formation: str, spacing: float, wait: float, lost: float, slots: ArrayLike | None, keep_order: bool
) -> tuple[int, float, float, float, Floats, bool]:
    if formation not in _FORMATIONS:
        raise ValueError(f"formation is {formation!r}; it should be one of {', '.join(_FORMATIONS)}")
    places = np.ascontiguousarray(np.zeros((0, 2)) if slots is None else slots, dtype=np.float32)
    if places.size and (places.ndim != 2 or places.shape[1] != 2):
        raise ValueError(f"slots has the shape {places.shape}; it should be (N - 1, 2): forward and left of the leader")
    return _FORMATIONS.index(formation), float(spacing), float(wait), float(lost), places, bool(keep_order)


def _names(agents: ArrayLike) -> Agents:
    given = np.asarray(agents)
    if given.size == 0:
        return np.zeros(0, np.uint64)
    if given.dtype.kind not in "iu" or given.ndim > 1:
        raise ValueError(
            f"agents holds {given.dtype} of the shape {given.shape}; give the (N,) names that `add` returned"
        )
    return np.ascontiguousarray(given.reshape(-1), dtype=np.uint64)


__all__ = ["AgentStates", "Agents", "Crowd", "CrowdReport", "Formation", "GroupState"]
