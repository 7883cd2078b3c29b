# SPDX-License-Identifier: MIT
"""Convex parts of meshes."""

from __future__ import annotations

import numpy as np
import pytest
import talus

from conftest import Mesh, box_mesh, join


def dumbbell() -> Mesh:
    return join(
        box_mesh((-1, -1, -1), (1, 1, 1)),
        box_mesh((5, -1, -1), (7, 1, 1)),
        box_mesh((0.5, -0.2, -0.2), (5.5, 0.2, 0.2)),
    )


def test_parts_of_a_dumbbell() -> None:
    vertices, faces = dumbbell()
    body = talus.decompose(vertices, faces, tolerance=0.2)
    assert len(body) == 3
    assert body.concavity <= 0.2
    assert body.max_outside < 1e-4
    assert body.concavities.shape == body.outsides.shape == body.volumes.shape == (3,)
    assert (np.diff(body.volumes) <= 1e-6).all()
    assert body.parts_over_tolerance == 0
    heights = [(vertices @ hull.planes[:, :3].T - hull.planes[:, 3]).max(axis=1) for hull in body.hulls]
    assert (np.min(heights, axis=0) <= body.max_outside + 1e-6).all()
    assert not any(hull.contains([[3, 0.9, 0]])[0] for hull in body.hulls)


def test_the_mesh_of_all_parts() -> None:
    body = talus.decompose(*dumbbell(), tolerance=0.2)
    vertices, faces, part = body.mesh()
    assert faces.shape == (len(part), 3)
    assert part.max() == 2
    corners = vertices[faces].astype(np.float64)
    sixfold = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
    np.testing.assert_allclose(np.bincount(part, sixfold) / 6, body.volumes, rtol=1e-5)


def test_limits() -> None:
    one = talus.decompose(*dumbbell(), tolerance=0.2, max_parts=1)
    assert len(one) == one.parts_over_tolerance == 1
    assert one.concavity > 0.2
    few = talus.decompose(*dumbbell(), tolerance=0.2, max_vertices=4)
    assert max(len(hull) for hull in few.hulls) == 4
    assert few.max_outside > 0.1


def test_rooms_stay_open() -> None:
    """A closed box within a larger one: solid, or a room with two surfaces."""
    room = join(box_mesh((0, 0, 0), (10, 10, 10)), box_mesh((4, 4, 4), (6, 6, 6)))
    assert len(talus.decompose(*room, tolerance=0.5)) == 1
    assert len(talus.decompose(*room, tolerance=0.5, solid="surface")) > 6


def test_threads_give_the_same_parts() -> None:
    one, two = (talus.decompose(*dumbbell(), threads=threads) for threads in (1, 2))
    for a, b in zip(one.mesh(), two.mesh(), strict=True):
        np.testing.assert_array_equal(a, b)
    np.testing.assert_array_equal(one.concavities, two.concavities)


def test_errors() -> None:
    vertices, faces = dumbbell()
    with pytest.raises(talus.Error) as caught:
        talus.decompose(vertices, faces, max_vertices=3)
    assert caught.value.field == "max_vertices"
    with pytest.raises(ValueError, match="solid"):
        talus.decompose(vertices, faces, solid="rooms")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="max_parts"):
        talus.decompose(vertices, faces, max_parts=-1)
    with pytest.raises(talus.Error) as caught:
        talus.decompose(vertices * np.nan, faces)
    assert caught.value.result == "TL_ERR_NOT_FINITE"
    with pytest.raises(talus.Error) as caught:
        talus.decompose(vertices, faces, progress=lambda stage, done, total: False)
    assert caught.value.result == "TL_ERR_CANCELLED"
