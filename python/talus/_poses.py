# SPDX-License-Identifier: MIT
"""Where things are: a rotation and a position, as users pass them."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ._arrays import ArrayLike, Floats, points as as_points


def poses(positions: ArrayLike | None = None, rotations: ArrayLike | None = None) -> Floats:
    """Poses as an (N, 7) float32 array: unit quaternion x, y, z, w, then position in metres.

    Args:
        positions: (3,) or (N, 3); None is the origin.
        rotations: quaternions x, y, z, w, (4,) or (N, 4); or matrices, (3, 3) or (N, 3, 3). None is no rotation.
    """
    at = np.zeros((1, 3), np.float32) if positions is None else as_points(positions, "positions")
    if rotations is None:
        turn = np.zeros((1, 4), np.float32)
    else:
        given = np.asarray(rotations, dtype=np.float64)
        if given.shape[-2:] == (3, 3):
            turn = _quaternions(given.reshape(-1, 3, 3))
        else:
            turn = given.reshape(-1, given.shape[-1] if given.ndim else 1).astype(np.float32)
        if turn.ndim != 2 or turn.shape[1] != 4:
            raise ValueError(f"rotations has the shape {given.shape}; it should be (N, 4) or (N, 3, 3)")
    count = max(len(at), len(turn))
    if len(at) not in (1, count) or len(turn) not in (1, count):
        raise ValueError(f"there are {len(at)} positions and {len(turn)} rotations")
    result = np.empty((count, 7), np.float32)
    result[:, :4] = turn
    result[:, 4:] = at
    return result


def _quaternions(matrices: npt.NDArray[np.float64]) -> Floats:
    """Unit quaternions of rotation matrices, by the largest of their components (Shepperd's method)."""
    m = matrices
    trace = np.trace(m, axis1=1, axis2=2)
    four = np.stack([m[:, 0, 0] * 2 - trace, m[:, 1, 1] * 2 - trace, m[:, 2, 2] * 2 - trace, trace], axis=1)
    largest = np.argmax(four, axis=1)
    result = np.empty((len(m), 4))
    for k in range(3):
        rows = largest == k
        i, j = (k + 1) % 3, (k + 2) % 3
        result[rows, k] = 1 + four[rows, k]
        result[rows, i] = m[rows, i, k] + m[rows, k, i]
        result[rows, j] = m[rows, j, k] + m[rows, k, j]
        result[rows, 3] = m[rows, j, i] - m[rows, i, j]
    rows = largest == 3
    result[rows, 0] = m[rows, 2, 1] - m[rows, 1, 2]
    result[rows, 1] = m[rows, 0, 2] - m[rows, 2, 0]
    result[rows, 2] = m[rows, 1, 0] - m[rows, 0, 1]
    result[rows, 3] = 1 + trace[rows]
    norms = np.linalg.norm(result, axis=1, keepdims=True)
    return np.asarray(result / norms, dtype=np.float32)


def pose_array(given: ArrayLike | None) -> Floats:
    """(N, 7) poses of what users pass: None, (3,) or (N, 3) positions, (7,) or (N, 7) poses, (4, 4) matrices."""
    if given is None:
        return poses()
    array = np.asarray(given)
    if array.shape[-2:] == (4, 4):
        matrices = array.reshape(-1, 4, 4)
        return poses(matrices[:, :3, 3], matrices[:, :3, :3])
    if array.shape[-1:] == (3,):
        return poses(array)
    if array.shape[-1:] == (7,):
        return np.ascontiguousarray(array.reshape(-1, 7), dtype=np.float32)
    raise ValueError(f"a pose has the shape {array.shape}; give (N, 3), (N, 7) of talus.poses, or (N, 4, 4)")
