# SPDX-License-Identifier: MIT
"""Arrays as the C library wants them: float32, contiguous, of a known shape. What has that form is not copied."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import Any, Literal, Union, cast

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float32]
"""float32 array; its shape is said where it is used."""

ArrayLike = npt.ArrayLike
"""Anything that numpy makes an array of."""

Point = Union[Sequence[float], Floats, npt.NDArray[np.float64]]
"""Three numbers: x, y, z in metres; y is up."""

Progress = Callable[[str, int, int], Union[bool, None]]
"""Called with the stage's name, the steps done and the steps in all; returning False cancels."""

Cull = Literal["none", "back", "front"]
"""Which side of a triangle a query ignores. The front is where the corners run counter-clockwise."""

_CULL = {"none": 0, "back": 1, "front": 2}

Doubles = npt.NDArray[np.float64]
"""float64 array; its shape is said where it is used."""

Reals = npt.NDArray[np.float32] | npt.NDArray[np.float64]
"""float32 or float64 array."""


def point_rows(array: ArrayLike, name: str) -> Reals:
    """An (N, 3) float32 or float64 array of any strides; a single point becomes one row. An array is not copied."""
    result = np.asarray(array)
    if result.dtype != np.float32 and result.dtype != np.float64:
        result = np.asarray(result, dtype=np.float32)
    if result.ndim == 1 and result.shape[0] == 3:
        result = result.reshape(1, 3)
    if result.ndim == 2 and result.shape == (0, 0):
        result = result.reshape(0, 3)
    if result.ndim != 2 or result.shape[1] != 3:
        raise ValueError(f"{name} has the shape {result.shape}; it should be (N, 3)")
    return result


def points(array: ArrayLike, name: str) -> Floats:
    """An (N, 3) float32 array of any (N, 3) array; a single point becomes one row."""
    return np.ascontiguousarray(point_rows(array, name), dtype=np.float32)


def double_points(array: ArrayLike, name: str) -> Doubles:
    """An (N, 3) float64 array of any (N, 3) array; a single point becomes one row."""
    result = np.ascontiguousarray(array, dtype=np.float64)
    if result.shape == (3,):
        result = result.reshape(1, 3)
    if result.ndim != 2 or result.shape[1] != 3:
        raise ValueError(f"{name} has the shape {result.shape}; it should be (N, 3)")
    return result


def row_pairs(a: ArrayLike, b: ArrayLike, names: tuple[str, str]) -> tuple[Reals, Reals]:
    """Two arrays of points of one length, of which one is repeated, without a copy, where it has a single row."""
    first, second = point_rows(a, names[0]), point_rows(b, names[1])
    if len(first) == len(second):
        return first, second
    if len(first) == 1:
        return cast(Reals, np.broadcast_to(first, second.shape)), second
    if len(second) == 1:
        return first, cast(Reals, np.broadcast_to(second, first.shape))
    raise ValueError(f"{names[0]}, {names[1]} have {len(first)} and {len(second)} rows")


def faces(array: ArrayLike) -> npt.NDArray[np.uint32]:
    """A (T, 3) uint32 array of vertex indices; negative and huge ones are refused rather than wrapped around."""
    given = np.asarray(array)
    if given.size == 0:
        return np.zeros((0, 3), np.uint32)
    if given.ndim != 2 or given.shape[1] != 3:
        raise ValueError(f"faces has the shape {given.shape}; it should be (T, 3): triangulate polygons first")
    if given.dtype.kind not in "iu":
        raise ValueError(f"faces holds {given.dtype}; it should hold whole numbers")
    if given.dtype != np.uint32 and (given.min() < 0 or given.max() > 0xFFFFFFFF):
        raise ValueError("faces holds an index that is negative or too large")
    return np.ascontiguousarray(given, dtype=np.uint32)


def triple(point: ArrayLike, name: str) -> tuple[float, float, float]:
    """Three floats of a point."""
    values = np.asarray(point, dtype=np.float64).reshape(-1)
    if values.shape != (3,):
        raise ValueError(f"{name} should be three numbers: x, y, z")
    return float(values[0]), float(values[1]), float(values[2])


def same_length(a: Floats, b: Floats, names: str) -> tuple[Floats, Floats]:
    """Two arrays of points, one repeated where it has a single row."""
    if len(a) == len(b):
        return a, b
    if len(a) == 1:
        return np.ascontiguousarray(np.broadcast_to(a, b.shape)), b
    if len(b) == 1:
        return a, np.ascontiguousarray(np.broadcast_to(b, a.shape))
    raise ValueError(f"{names} have {len(a)} and {len(b)} rows")


def cull_code(cull: Cull) -> int:
    if cull not in _CULL:
        raise ValueError(f"cull is {cull!r}; it should be 'none', 'back' or 'front'")
    return _CULL[cull]


def material_bits(ignored: Sequence[int]) -> int:
    """The bit set of materials that a query ignores; bit 63 stands for all from 63 up."""
    bits = 0
    for material in ignored:
        if material < 0:
            raise ValueError("a material is a number from 0 up")
        bits |= 1 << min(int(material), 63)
    return bits


def thread_count(threads: int | None) -> int:
    """Threads to use: None is as many as this process may run on."""
    if threads is None:
        if hasattr(os, "sched_getaffinity"):
            return max(1, len(os.sched_getaffinity(0)))
        return os.cpu_count() or 1
    if threads < 1:
        raise ValueError("threads is a number from 1 up, or None for all")
    return int(threads)


def mesh_of(vertices: Any, triangles: Any) -> tuple[Floats, npt.NDArray[np.uint32]]:
    """Vertices and triangles, also of mesh objects of trimesh, meshio and Open3D."""
    if triangles is None:
        mesh = vertices
        if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
            vertices, triangles = mesh.vertices, mesh.faces
        elif hasattr(mesh, "points") and hasattr(mesh, "cells_dict"):
            cells = mesh.cells_dict
            parts = [np.asarray(cells["triangle"])] if "triangle" in cells else []
            if "quad" in cells:
                quads = np.asarray(cells["quad"])
                parts += [quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]
            other = [kind for kind in cells if kind not in ("triangle", "quad", "vertex", "line")]
            if other or not parts:
                raise ValueError(f"a mesh of {', '.join(cells) or 'nothing'} has no triangles: convert it first")
            vertices, triangles = mesh.points, np.concatenate(parts)
        elif hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):
            vertices, triangles = mesh.vertices, mesh.triangles  # Open3D
        else:
            raise TypeError("give vertices and faces, or a mesh object of trimesh, meshio or Open3D")
    return points(vertices, "vertices"), faces(triangles)
