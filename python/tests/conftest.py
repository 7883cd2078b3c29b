# SPDX-License-Identifier: MIT
"""Levels that several tests share."""

from __future__ import annotations

import numpy as np
import pytest

Mesh = tuple[np.ndarray, np.ndarray]


def box_mesh(low: tuple[float, float, float], high: tuple[float, float, float]) -> Mesh:
    """A closed box, its faces outwards."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=np.float64)
    vertices = np.array(low) + corners * (np.array(high) - np.array(low))
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return vertices, np.array(faces)


def join(*meshes: Mesh) -> Mesh:
    """Several meshes as one."""
    vertices, faces, first = [], [], 0
    for v, f in meshes:
        vertices.append(v)
        faces.append(f + first)
        first += len(v)
    return np.concatenate(vertices), np.concatenate(faces)


def comb(size: float) -> Mesh:
    """A floor with walls across it, each with a gap at one end."""
    walls = [
        box_mesh((x, 0, 0 if i % 2 else 6), (x + 1, 3, size - 6 if i % 2 else size))
        for i, x in enumerate(np.arange(15.0, size - 5, 15.0))
    ]
    return join(box_mesh((0, -1, 0), (size, 0, size)), *walls)


@pytest.fixture(scope="session")
def hall() -> Mesh:
    """A floor of 40 by 40 metres with a wall across it that has a gap, two crates, and a platform out of reach."""
    return join(
        box_mesh((0, -1, 0), (40, 0, 40)),
        box_mesh((19, 0, 0), (21, 4, 30)),
        box_mesh((5, 0, 5), (7, 2, 7)),
        box_mesh((30, 0, 10), (33, 3, 12)),
        box_mesh((8, 6, 30), (16, 6.5, 38)),
    )
