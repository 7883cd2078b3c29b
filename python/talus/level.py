# SPDX-License-Identifier: MIT
"""Baked files: what `talus bake` writes, in Python, and the other way round."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np

from . import _talus
from ._arrays import ArrayLike
from .hull import Hull
from .navmesh import Navmesh
from .picture import Picture, draw
from .soup import Soup


@dataclass
class Level:
    """What a baked file holds."""

    soup: Soup | None = None
    navmesh: Navmesh | None = None
    hull: Hull | None = None
    name: str = ""
    """The source's name."""
    up: str = "y"
    """``y``, or ``z`` where the source was z-up: what is baked is y-up, a point (x, y, z) was turned to (x, z, -y)."""
    source_vertices: int = field(default=0, repr=False)
    source_triangles: int = field(default=0, repr=False)
    _kept: list[tuple[int, int, bytes]] = field(default_factory=list, repr=False)
    """Chunks of the file read that stand for nothing here, for the next file: the level's own coordinates, links set by
    hand (which are in the navmesh too), areas by materials, and users' own."""

    def to_bytes(self) -> bytes:
        """The file's bytes. The same parts give the same bytes as ``talus bake``."""
        level: Any = None
        if self.navmesh is not None:
            level = self.navmesh._level
            points, triangles = level[0], level[1]
            level = level if len(triangles) and level[3] else None
        elif self.soup is not None:
            points, triangles = self.soup.vertices, self.soup.faces
        elif self.hull is not None:
            points, triangles = self.hull.vertices, self.hull.triangles
        else:
            raise ValueError("a level without soup, navmesh and hull is no file")
        if len(triangles) == 0 and self.soup is not None:
            points, triangles = self.soup.vertices, self.soup.faces
        if len(triangles):
            used = points[np.unique(triangles)]
            bounds = (tuple(used.min(axis=0).tolist()), tuple(used.max(axis=0).tolist()))
        else:
            bounds = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        return bytes(
            _talus.pack_write(
                self.name,
                self.up,
                self.source_vertices or len(points),
                self.source_triangles or len(triangles),
                bounds,
                self.soup._soup if self.soup is not None else None,
                self.hull._hull if self.hull is not None else None,
                self.navmesh._navmesh if self.navmesh is not None else None,
                level,
                self._kept,
            )
        )

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the file: beside its place first, then renamed over it, so that it is whole or absent."""
        target = Path(path)
        aside = target.with_name(f".{target.name}.{os.getpid()}.part")
        try:
            with open(aside, "wb") as file:
                file.write(self.to_bytes())
                file.flush()
                os.fsync(file.fileno())
            os.replace(aside, target)
        except BaseException:
            aside.unlink(missing_ok=True)
            raise

    def plot(
        self,
        stage: str = "navmesh",
        *,
        start: ArrayLike | None = None,
        goal: ArrayLike | None = None,
        agent_radius: float = 0.0,
        view: Literal["both", "top", "oblique"] = "both",
        size: int = 900,
    ) -> Picture:
        """A picture of the level and a stage over it, which a notebook shows.

        Args:
            stage: soup, spans, areas, distance, regions, contours, triangulation, merging, triangles, polygons, detail,
                navmesh, or path. All but the first and the last two bake the stage from the soup's triangles.
            start: (3,) of a path; by default it leads across the level.
            goal: (3,)
            agent_radius: metres, of an agent wider than the navmesh's own, for a path.
            view: from above, obliquely, or both side by side.
            size: pixels of the longer side of each view.

        Raises:
            FileNotFoundError: the `talus` command, which draws, is neither on the PATH nor named by TALUS_COMMAND.
        """
        return draw(self, stage, start, goal, agent_radius, view, size)


def load(source: str | os.PathLike[str] | bytes) -> Level:
    """Open a baked file, or its bytes. Everything is checked before it is used.

    Raises:
        talus.Error: not a talus file (TL_ERR_MAGIC), cut off (TL_ERR_TRUNCATED) or altered (TL_ERR_HASH).
    """
    data = source if isinstance(source, bytes) else Path(source).read_bytes()
    pack = _talus.pack_open(data)
    level = Level()
    meta = _talus.pack_meta(pack)
    if meta is not None:
        level.name, level.source_vertices, level.source_triangles, _, level.up = meta
    level._kept = _talus.pack_kept(pack)
    soup = _talus.pack_blob(pack, "soup")
    hull = _talus.pack_blob(pack, "hull")
    navmesh = _talus.pack_navmesh(pack)
    if soup is not None:
        level.soup = Soup._of(soup)
    if hull is not None:
        level.hull = Hull._of(hull)
    if navmesh is not None:
        vertices, faces = np.zeros((0, 3), np.float32), np.zeros((0, 3), np.uint32)
        if level.soup is not None:
            vertices, faces = level.soup.vertices, level.soup.faces
        capsule, settings = navmesh
        level.navmesh = Navmesh._of(capsule, settings, (vertices, faces, None, _talus.pack_volumes(pack)), {})
        level.navmesh._soup = level.soup
    return level
