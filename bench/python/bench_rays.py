# SPDX-License-Identifier: MIT
"""Rays from numpy arrays: talus beside what Python users have. `make bench-python` runs it.

Each peer's answers are compared with talus' before it is timed. Rates are medians of several runs, taken in turn, all in
one process on one thread; peers that are not installed are left out and said so. With `--library`, a shared library of
talus, the same rays go through tl_soup_cast_rays too: what the Python package adds to it.
"""

from __future__ import annotations

import argparse
import ctypes
import importlib.util
import statistics
import sys
import time
from collections.abc import Callable

import numpy as np
import talus

Mesh = tuple[np.ndarray, np.ndarray]
Caster = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""Origins and directions to t, infinite for a miss."""


def terrain(side: int) -> Mesh:
    """Hills of side * side vertices, a metre apart."""
    x, z = np.meshgrid(np.arange(side, dtype=np.float64), np.arange(side, dtype=np.float64), indexing="ij")
    y = 2 * np.sin(x * 0.31) * np.cos(z * 0.23) + 0.5 * np.sin(x * 1.7 + z)
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).reshape(-1)
    faces = np.concatenate(
        [np.stack([corner, corner + 1, corner + side + 1], 1), np.stack([corner, corner + side + 1, corner + side], 1)]
    )
    return np.stack([x, y, z], axis=-1).reshape(-1, 3), faces


def rays(mesh: Mesh, count: int, kind: str) -> tuple[np.ndarray, np.ndarray]:
    """Incoherent rays through the level's box, or a camera's over it."""
    low, high = mesh[0].min(axis=0), mesh[0].max(axis=0)
    rng = np.random.default_rng(1)
    if kind == "incoherent":
        origins = rng.uniform(low, high + [0, 3, 0], (count, 3))
        return origins.astype(np.float32), rng.normal(size=(count, 3)).astype(np.float32)
    side = int(np.sqrt(count))
    u, v = np.meshgrid(np.linspace(-0.6, 0.6, side), np.linspace(-0.6, 0.6, side))
    directions = np.stack([u.ravel(), np.full(side * side, -0.5) - v.ravel() * 0.6, np.ones(side * side)], axis=1)
    eye = np.array([(low[0] + high[0]) / 2, high[1] + 8, low[2]])
    origins = np.ascontiguousarray(np.broadcast_to(eye, directions.shape), dtype=np.float32)
    return origins, np.ascontiguousarray(directions, dtype=np.float32)


def talus_caster(mesh: Mesh) -> Caster:
    soup = talus.Soup(*mesh)
    return lambda origins, directions: soup.cast(origins, directions, threads=1).t


class MeshView(ctypes.Structure):
    """tl_mesh_view."""

    _fields_ = (
        ("vertices", ctypes.c_void_p),
        ("vertex_count", ctypes.c_uint32),
        ("indices", ctypes.c_void_p),
        ("triangle_count", ctypes.c_uint32),
        ("materials", ctypes.c_void_p),
    )


def batch_caster(library: str, mesh: Mesh) -> Caster:
    """tl_soup_cast_rays, with rays and hits in the library's own form; the rays are converted once and not timed."""
    talus_c = ctypes.CDLL(library)
    pointer = ctypes.c_void_p
    talus_c.tl_soup_bake.argtypes = [pointer, pointer, pointer, pointer]
    talus_c.tl_soup_cast_rays.argtypes = [pointer, pointer, ctypes.c_uint32, pointer, pointer, pointer]
    talus_c.tl_soup_cast_rays.restype = None
    vertices, faces = mesh[0].astype(np.float32), mesh[1].astype(np.uint32)
    view = MeshView(vertices.ctypes.data, len(vertices), faces.ctypes.data, len(faces), None)
    soup = pointer()
    if talus_c.tl_soup_bake(ctypes.byref(view), None, ctypes.byref(soup), None) != 0:
        raise RuntimeError("tl_soup_bake failed")
    kept: list[np.ndarray] = []

    def cast(origins: np.ndarray, directions: np.ndarray) -> np.ndarray:
        if not kept:
            limits = np.full((len(origins), 1), np.inf, np.float32)
            kept.append(np.ascontiguousarray(np.concatenate([origins, directions, limits], axis=1)))
            kept.append(np.empty((len(origins), 8), np.float32))
        rays, hits = kept
        talus_c.tl_soup_cast_rays(soup, rays.ctypes.data, len(rays), None, None, hits.ctypes.data)
        return hits[:, 0]

    return cast


def embreex_caster(mesh: Mesh) -> Caster:
    """Embree as trimesh's users have it: rays in, triangle and distance out."""
    from embreex import rtcore_scene
    from embreex.mesh_construction import TriangleMesh

    scene = rtcore_scene.EmbreeScene()
    TriangleMesh(scene, mesh[0].astype(np.float32)[mesh[1]])

    def cast(origins: np.ndarray, directions: np.ndarray) -> np.ndarray:
        found = scene.run(origins, directions, output=1)
        return np.where(found["geomID"] >= 0, found["tfar"], np.inf)

    return cast


def open3d_caster(mesh: Mesh) -> Caster:
    import open3d as o3d

    scene = o3d.t.geometry.RaycastingScene(nthreads=1)
    scene.add_triangles(
        o3d.core.Tensor(mesh[0].astype(np.float32)), o3d.core.Tensor(np.ascontiguousarray(mesh[1].astype(np.uint32)))
    )

    def cast(origins: np.ndarray, directions: np.ndarray) -> np.ndarray:
        both = np.concatenate([origins, directions], axis=1)
        return scene.cast_rays(o3d.core.Tensor(both), nthreads=1)["t_hit"].numpy()

    return cast


PEERS: dict[str, tuple[str, Callable[[Mesh], Caster]]] = {
    "embreex (trimesh)": ("embreex", embreex_caster),
    "Open3D": ("open3d", open3d_caster),
}


def rates(casters: dict[str, Caster], origins: np.ndarray, directions: np.ndarray, runs: int) -> dict[str, float]:
    """Million rays a second of processor time of each, medians of several runs taken in turn."""
    seconds: dict[str, list[float]] = {name: [] for name in casters}
    for _ in range(runs):
        for name, cast in casters.items():
            begin = time.process_time()
            cast(origins, directions)
            seconds[name].append(time.process_time() - begin)
    return {name: len(origins) / statistics.median(all_runs) / 1e6 for name, all_runs in seconds.items()}


def agreement(ours: np.ndarray, theirs: np.ndarray) -> float:
    """Share of rays with the same answer: both miss, or both hit at nearly the same t."""
    both_miss = np.isinf(ours) & np.isinf(theirs)
    with np.errstate(invalid="ignore"):
        near = np.abs(ours - theirs) <= 1e-3 * np.maximum(1, np.abs(ours))
    return float((both_miss | near).mean())


def level_casters(mesh: Mesh, library: str | None) -> dict[str, Caster]:
    """talus, and what else is here."""
    casters = {"talus": talus_caster(mesh)}
    if library is not None:
        casters["tl_soup_cast_rays"] = batch_caster(library, mesh)
    for peer, (module, make) in PEERS.items():
        if importlib.util.find_spec(module) is not None:
            casters[peer] = make(mesh)
    return casters


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1_000_000, help="rays in a batch")
    parser.add_argument("--runs", type=int, default=7)
    parser.add_argument("--side", type=int, nargs="*", default=[40, 300, 1000], help="sides of the levels, in vertices")
    parser.add_argument("--library", help="a shared library of talus, as tools/python-bench builds it")
    options = parser.parse_args()
    for peer, (module, _) in PEERS.items():
        if importlib.util.find_spec(module) is None:
            print(f"{peer} is not installed")
    print(f"{'level':>12} {'rays':<11} {'library':<18} {'Mray/s':>8} {'talus is':>9} {'agree':>9}")
    for side in options.side:
        mesh = terrain(side)
        for kind in ("camera", "incoherent"):
            origins, directions = rays(mesh, options.count, kind)
            casters = level_casters(mesh, options.library)
            expected = casters["talus"](origins, directions)
            agree = {name: agreement(expected, cast(origins, directions)) for name, cast in casters.items()}
            found = rates(casters, origins, directions, options.runs)
            for name, rate in found.items():
                times = found["talus"] / rate
                print(f"{len(mesh[1]):>12,} {kind:<11} {name:<18} {rate:8.2f} {times:9.2f} {agree[name]:9.4%}", flush=True)
                if agree[name] < (1.0 if name == "tl_soup_cast_rays" else 0.999):
                    print(f"{name} disagrees: no rate of it counts", file=sys.stderr)
                    return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
