# SPDX-License-Identifier: MIT
"""Rays from numpy arrays: talus beside what Python users have. `make bench-python` runs it.

Each peer's answers are compared with talus' before it is timed. Rates are medians of several runs, all in one process on
one thread; peers that are not installed are left out and said so.
"""

from __future__ import annotations

import argparse
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
    return np.broadcast_to(eye, directions.shape).astype(np.float32), directions.astype(np.float32)


def talus_caster(mesh: Mesh) -> Caster:
    soup = talus.Soup(*mesh)
    return lambda origins, directions: soup.cast(origins, directions, threads=1).t


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


def rate(cast: Caster, origins: np.ndarray, directions: np.ndarray, runs: int) -> float:
    """Million rays a second of processor time, the median of several runs."""
    cast(origins, directions)
    seconds = []
    for _ in range(runs):
        begin = time.process_time()
        cast(origins, directions)
        seconds.append(time.process_time() - begin)
    return len(origins) / statistics.median(seconds) / 1e6


def agreement(ours: np.ndarray, theirs: np.ndarray) -> float:
    """Share of rays with the same answer: both miss, or both hit at nearly the same t."""
    both_miss = np.isinf(ours) & np.isinf(theirs)
    with np.errstate(invalid="ignore"):
        near = np.abs(ours - theirs) <= 1e-3 * np.maximum(1, np.abs(ours))
    return float((both_miss | near).mean())


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1_000_000, help="rays in a batch")
    parser.add_argument("--runs", type=int, default=7)
    parser.add_argument("--side", type=int, nargs="*", default=[40, 300, 1000], help="sides of the levels, in vertices")
    options = parser.parse_args()
    print(f"{'level':>12} {'rays':<11} {'library':<18} {'Mray/s':>8} {'to talus':>9} {'agree':>9}")
    for side in options.side:
        mesh = terrain(side)
        for kind in ("camera", "incoherent"):
            origins, directions = rays(mesh, options.count, kind)
            ours = talus_caster(mesh)
            expected = ours(origins, directions)
            mine = rate(ours, origins, directions, options.runs)
            name = f"{len(mesh[1]):,}"
            print(f"{name:>12} {kind:<11} {'talus':<18} {mine:8.2f} {1:9.2f} {1:9.4%}")
            for peer, (module, make) in PEERS.items():
                if importlib.util.find_spec(module) is None:
                    print(f"{name:>12} {kind:<11} {peer:<18} not installed")
                    continue
                theirs = make(mesh)
                agree = agreement(expected, theirs(origins, directions))
                other = rate(theirs, origins, directions, options.runs)
                print(f"{name:>12} {kind:<11} {peer:<18} {other:8.2f} {other / mine:9.2f} {agree:9.4%}")
                if agree < 0.999:
                    print(f"{peer} disagrees: no rate of it counts", file=sys.stderr)
                    return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
