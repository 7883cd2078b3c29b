# SPDX-License-Identifier: MIT
"""Convex parts of a mesh."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _talus
from ._arrays import ArrayLike, Floats, Progress, mesh_of, thread_count
from .hull import Hull

_SOLIDS = ("enclosed", "surface")


@dataclass(frozen=True)
class Decomposition:
    """Convex parts that stand for a mesh. They may overlap. Those of largest volume come first."""

    hulls: list[Hull]
    """The P parts."""
    concavities: npt.NDArray[np.float64]
    """(P,) metres: no point of the part is farther from the body. Proven bounds, not samples."""
    outsides: npt.NDArray[np.float64]
    """(P,) metres: no point of the mesh that the part covers is farther outside of it."""
    tolerance: float
    """Metres: what was asked for."""
    cell: float
    """Metres: the side of the cells of the grid that guided the cuts."""
    degenerate_triangles: int
    """Triangles without area, which were left out."""
    parts_over_tolerance: int
    """Parts that ``max_parts`` merged beyond the tolerance, or that could not be cut any finer."""

    @property
    def concavity(self) -> float:
        """Metres: no point of the union is farther from the body."""
        return float(self.concavities.max())

    @property
    def max_outside(self) -> float:
        """Metres: no point of the mesh is farther from the union."""
        return float(self.outsides.max())

    @property
    def volumes(self) -> npt.NDArray[np.float64]:
        """(P,) cubic metres."""
        return np.array([hull.volume for hull in self.hulls])

    def mesh(self) -> tuple[Floats, npt.NDArray[np.uint32], npt.NDArray[np.uint32]]:
        """All parts as one mesh: (V, 3) vertices, (T, 3) faces, and the part of each face, (T,)."""
        faces = [hull.triangles for hull in self.hulls]
        first = np.cumsum([0] + [len(hull.vertices) for hull in self.hulls[:-1]])
        return (
            np.concatenate([hull.vertices for hull in self.hulls]),
            np.concatenate([part + start for part, start in zip(faces, first, strict=True)]).astype(np.uint32),
            np.repeat(np.arange(len(faces), dtype=np.uint32), [len(part) for part in faces]),
        )

    def __len__(self) -> int:
        return len(self.hulls)

    def __repr__(self) -> str:
        return f"<talus.Decomposition: {len(self)} parts, concavity {self.concavity:.3g} m>"


def decompose(
    vertices: Any,
    faces: ArrayLike | None = None,
    *,
    tolerance: float = 0.0,
    relative_tolerance: float = 0.025,
    max_parts: int = 0,
    max_vertices: int = 256,
    thickness: float = 0.0,
    solid: Literal["enclosed", "surface"] = "enclosed",
    max_cells: int = 1 << 20,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Decomposition:
    """Divide a mesh into convex parts, none of which reaches farther from the body than a tolerance.

    The mesh may be open, intersect itself, repeat triangles or be loose triangles. The same parts with any number of
    threads.

    >>> len(decompose([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]))
    1

    Args:
        vertices: (V, 3) positions in metres; or a mesh object of trimesh, meshio or Open3D, without ``faces``.
        faces: (T, 3) indices into vertices.
        tolerance: metres; the concavity that a part may have. 0: as ``relative_tolerance`` says.
        relative_tolerance: share of the longest side of the mesh's box, above 0 and up to 1.
        max_parts: 0 is no limit; else parts are merged beyond the tolerance until there are no more.
        max_vertices: of a part's hull, 0 (no limit) or at least 4. The mesh may then reach out of the hulls.
        thickness: metres, at most the tolerance, of the hull of a flat part; 0: a sixteenth of the tolerance.
        solid: ``enclosed``: what cannot be reached from outside is solid; ``surface``: rooms of a level stay open.
        max_cells: 4,096 to 67,108,864 cells of the grid that guides the cuts. Fewer cost more parts, but no truth.
        threads: None is all.
        progress: called with stage, steps done and steps in all; returning False cancels.

    Raises:
        talus.Error: a field is out of its range (TL_ERR_ARGUMENT), no triangle has area, an index is out of range, a
            coordinate is NaN or beyond 1e9, or there would be more than 65,536 parts (TL_ERR_LIMIT).
    """
    points, triangles = mesh_of(vertices, faces)
    if solid not in _SOLIDS:
        raise ValueError(f"solid is {solid!r}; it should be 'enclosed' or 'surface'")
    for name, value in (("max_parts", max_parts), ("max_vertices", max_vertices), ("max_cells", max_cells)):
        if not 0 <= value <= 0xFFFFFFFF:
            raise ValueError(f"{name} is {value}; it should be a number from 0 up")
    parts, used, cell, degenerate, over = _talus.decompose(
        points,
        triangles,
        float(tolerance),
        float(relative_tolerance),
        int(max_parts),
        int(max_vertices),
        float(thickness),
        _SOLIDS.index(solid),
        int(max_cells),
        thread_count(threads),
        progress,
    )
    return Decomposition(
        [Hull._of(capsule) for capsule, _, _ in parts],
        np.array([concavity for _, concavity, _ in parts]),
        np.array([outside for _, _, outside in parts]),
        used,
        cell,
        degenerate,
        over,
    )
