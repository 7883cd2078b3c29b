# SPDX-License-Identifier: MIT
"""A navmesh that changes while it is read."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from . import _talus
from .navmesh import Navmesh


@dataclass(frozen=True)
class NavVersionsState:
    """What there is of versions, and memory that waits."""

    version_count: int
    """The newest, and older ones that are held."""
    newest: int
    """Its number, which each edit raises by 1."""
    oldest: int
    """Number of the oldest that is held."""
    waiting_bytes: int
    """Of what older versions alone have: freed once nobody holds them."""


class NavVersions:
    """A navmesh in versions: any number of threads read it while one changes it.

    >>> versions = NavVersions(navmesh)
    >>> with versions.acquire() as navmesh:  # any thread; never waits, and nothing in here changes
    ...     path = navmesh.shortest_path(start, goal)
    >>> with versions.edit() as draft:  # one thread at a time; readers go on meanwhile
    ...     draft.add_link(start, end)
    ...     draft.add_obstacle(crate)  # who acquires after this block sees both

    Versions share all that an edit leaves alone, so an edit costs about what it costs on a navmesh that is alone.
    A crowd goes from version to version: ``with versions.acquire() as crowd.navmesh: crowd.step(1 / 20)``.
    """

    _versions: Any
    _source: Navmesh
    _writer: threading.RLock

    def __init__(self, navmesh: Navmesh) -> None:
        """The first version has the navmesh's tiles and links, whose references are new, and its obstacles.

        Args:
            navmesh: it is given away: it can still be asked, and is changed by `edit` alone from now on.

        Raises:
            ValueError: it is in versions already.
        """
        self._source = navmesh
        self._writer = threading.RLock()
        with navmesh._lock:
            self._versions = _talus.versions_create(navmesh._navmesh)

    @contextmanager
    def acquire(self) -> Iterator[Navmesh]:
        """The newest version, for a ``with`` block: it stays as it is, whatever is published meanwhile.

        Each block has an object of its own, so that threads do not wait for one another. Any number of blocks may be
        open. After its block a version is given back, and refuses to be used.
        """
        version = self._wrap(_talus.versions_acquire(self._versions))
        try:
            yield version
        finally:
            with version._lock:
                _talus.versions_leave(version._navmesh)

    @contextmanager
    def edit(self) -> Iterator[Navmesh]:
        """The draft, for a ``with`` block: the newest version, to be changed. Its end makes it the newest version.

        Another thread's block waits until this one has ended. Where the block ends by an exception nothing is
        published: the draft stays as it is, and the next block goes on with it.

        Raises:
            talus.Error: 1024 versions are held by readers (TL_ERR_LIMIT).
            MemoryError: there is no memory for a draft; a later call may succeed.
        """
        with self._writer:
            draft = self._wrap(_talus.versions_edit(self._versions))
            try:
                yield draft
                with draft._lock:
                    _talus.versions_publish(self._versions)
            finally:
                with draft._lock:
                    _talus.versions_leave(draft._navmesh)

    @property
    def state(self) -> NavVersionsState:
        """What there is, after what nobody holds any more was freed. Waits for an edit that is under way."""
        with self._writer:
            return NavVersionsState(*_talus.versions_state(self._versions))

    def _wrap(self, capsule: Any) -> Navmesh:
        source = self._source
        made = Navmesh._of(capsule, source._settings, source._level, source._report)
        made._soup = source._soup
        return made

    def __repr__(self) -> str:
        state = self.state
        return f"<talus.NavVersions: {state.version_count} versions, the newest {state.newest}>"


__all__ = ["NavVersions", "NavVersionsState"]
