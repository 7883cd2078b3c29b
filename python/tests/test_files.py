# SPDX-License-Identifier: MIT
"""Baked files: written, opened, and the same bytes as the command's, where the command is at hand (TALUS_COMMAND)."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
import talus

from conftest import Mesh


def test_round_trip(hall: Mesh, tmp_path: Path) -> None:
    soup = talus.Soup(*hall)
    marked = [talus.Box(7, (1, 0, 1), (4, 2, 4)), talus.Prism(9, ((30, 30), (30, 36), (36, 36)), -1, 2)]
    navmesh = talus.Navmesh.bake(*hall, volumes=marked, tile_size=48)
    navmesh.find_links(soup=soup, max_drop=7)
    file = tmp_path / "hall.talus"
    kept = talus.Navmesh.bake(*hall, reachable_from=[[5, 0, 20]])
    again = talus.load(talus.Level(soup=soup, navmesh=kept).to_bytes()).navmesh
    assert again is not None
    assert again.why([12, 6.5, 34]) == kept.why([12, 6.5, 34])
    level = talus.Level(soup=soup, navmesh=navmesh, hull=talus.Hull(hall[0]), name="hall")
    level.save(file)
    assert [entry.name for entry in tmp_path.iterdir()] == ["hall.talus"]
    opened = talus.load(file)
    assert opened.name == "hall"
    assert opened.soup is not None
    assert opened.navmesh is not None
    assert opened.hull is not None
    origins = np.random.default_rng(0).uniform(0, 40, (200, 3))
    assert (opened.soup.cast(origins, [0, -1, 0]).triangle == soup.cast(origins, [0, -1, 0]).triangle).all()
    assert opened.navmesh.area == navmesh.area
    assert opened.navmesh.settings == {**navmesh.settings, "bounds": opened.navmesh.settings["bounds"]}
    assert len(opened.navmesh.links()) == len(navmesh.links()) > 0
    assert opened.navmesh.audit(path_count=50) == navmesh.audit(path_count=50)
    assert not opened.navmesh.why([18.9, 0, 20]).walkable
    assert opened.hull.volume == level.hull.volume  # type: ignore[union-attr]
    assert opened.to_bytes() == file.read_bytes()
    path = navmesh.shortest_path([5, 0, 20], [35, 0, 20])
    assert opened.navmesh.shortest_path([5, 0, 20], [35, 0, 20]).length == path.length


def test_links_set_by_hand_are_saved(hall: Mesh) -> None:
    soup = talus.Soup(*hall)
    navmesh = talus.Navmesh.bake(*hall)
    found = len(navmesh.find_links(soup=soup, max_drop=7))
    navmesh.add_link([3, 0, 3], [12, 6.5, 34], both_ways=True, fixed_cost=2)
    gone = navmesh.add_link([3, 0, 5], [12, 6.5, 34])
    navmesh.remove_link(gone)
    assert found > 0
    data = talus.Level(soup=soup, navmesh=navmesh).to_bytes()
    level = talus.load(data)
    assert level.navmesh is not None
    assert sorted((link.start, link.end, link.both_ways, link.cost) for link in level.navmesh.links()) == sorted(
        (link.start, link.end, link.both_ways, link.cost) for link in navmesh.links()
    )
    assert level.to_bytes() == data
    # Those of the file can be removed, and stay away.
    for link in level.navmesh.links():
        if link.both_ways and link.start == (3, 0, 3):
            level.navmesh.remove_link(link.ref)
    again = talus.load(level.to_bytes()).navmesh
    assert again is not None
    assert len(again.links()) == found
    # So can those that were found; the others keep their kinds.
    first, *others = again.links()
    again.remove_link(first.ref)
    fewer = talus.load(talus.Level(soup=soup, navmesh=again).to_bytes()).navmesh
    assert fewer is not None
    assert sorted((link.start, link.end) for link in fewer.links()) == sorted((link.start, link.end) for link in others)
    for link in fewer.links():
        fewer.remove_link(link.ref)
    data = talus.Level(soup=soup, navmesh=fewer).to_bytes()
    assert b"LINK" not in data
    assert talus.load(data).navmesh.links() == []  # type: ignore[union-attr]


def test_damage_is_named(hall: Mesh, tmp_path: Path) -> None:
    data = talus.Level(soup=talus.Soup(*hall)).to_bytes()
    for bad, result in (
        (b"", "TL_ERR_TRUNCATED"),
        (b"no talus file, and long enough to hold a head" * 9, "TL_ERR_MAGIC"),
        (data[:-64], "TL_ERR_TRUNCATED"),
        (data[:300] + bytes([data[300] ^ 1]) + data[301:], "TL_ERR_HASH"),
    ):
        with pytest.raises(talus.Error) as caught:
            talus.load(bad)
        assert caught.value.result == result
    with pytest.raises(FileNotFoundError):
        talus.load(tmp_path / "none.talus")
    with pytest.raises(ValueError):
        talus.Level().to_bytes()


@pytest.mark.skipif("TALUS_COMMAND" not in os.environ, reason="the talus command is not at hand (TALUS_COMMAND)")
@pytest.mark.parametrize("sample", ["courtyard", "dungeon"])
@pytest.mark.parametrize("pruned", [False, True])
def test_same_bytes_as_the_command(sample: str, pruned: bool, tmp_path: Path) -> None:
    command = os.environ["TALUS_COMMAND"]
    obj = tmp_path / f"{sample}.obj"
    subprocess.run([command, "sample", sample, "-o", obj], check=True, capture_output=True)
    baked = tmp_path / f"{sample}.talus"
    words = ["--island-min-area", "20", "--drop-inside-solids"] if pruned else []
    subprocess.run([command, "bake", obj, "-o", baked, "--tile-size", "64", *words], check=True, capture_output=True)
    vertices, faces, materials, names = [], [], [], [""]
    material = 0
    for line in obj.read_text().splitlines():
        parts = line.split()
        if parts[:1] == ["v"]:
            vertices.append([float(part) for part in parts[1:4]])
        elif parts[:1] == ["usemtl"]:
            if parts[1] not in names:
                names.append(parts[1])
            material = names.index(parts[1])
        elif parts[:1] == ["f"]:
            loop = [int(part.split("/")[0]) - 1 for part in parts[1:]]
            assert len(loop) == 3
            faces.append(loop)
            materials.append(material)
    soup = talus.Soup(vertices, faces, materials=materials)
    rules = {"island_min_area": 20, "drop_inside_solids": True} if pruned else {}
    navmesh = talus.Navmesh.bake(vertices, faces, tile_size=64, **rules)
    mine = talus.Level(soup=soup, navmesh=navmesh, name=obj.name).to_bytes()
    assert mine == baked.read_bytes()


@pytest.mark.skipif("TALUS_COMMAND" not in os.environ, reason="the talus command is not at hand (TALUS_COMMAND)")
def test_what_has_no_object_is_kept(tmp_path: Path) -> None:
    command = os.environ["TALUS_COMMAND"]
    obj, baked = tmp_path / "yard.obj", tmp_path / "yard.talus"
    subprocess.run([command, "sample", "courtyard", "-o", obj], check=True, capture_output=True)
    words = ["--up", "z-left", "--origin", "1,-2,3", "--area", "*=9", "--link", "3,18,3,21,18,8"]
    subprocess.run([command, "bake", obj, "-o", baked, *words], check=True, capture_output=True)
    data = baked.read_bytes()
    assert all(kind in data for kind in (b"FRAM", b"OFFM", b"AREA"))
    assert talus.load(baked).to_bytes() == data
    turned = tmp_path / "turned.talus"
    subprocess.run([command, "bake", obj, "-o", turned, "--up", "z"], check=True, capture_output=True)
    assert talus.load(turned).to_bytes() == turned.read_bytes()


def test_adapters(hall: Mesh) -> None:
    class Trimesh:
        vertices, faces = hall

    class Meshio:
        points = hall[0]
        cells_dict = {"triangle": hall[1][:6], "quad": np.array([[0, 1, 3, 2]])}

    class Open3d:
        vertices, triangles = hall

    whole = talus.Soup(*hall)
    assert talus.Soup(Trimesh()).bounds.tolist() == whole.bounds.tolist()
    assert len(talus.Soup(Open3d())) == len(whole)
    assert talus.Soup(Meshio()).stats.source_triangle_count == 8
    assert talus.Navmesh.bake(Trimesh()).area > 0
    with pytest.raises(TypeError):
        talus.Soup(object())
    Meshio.cells_dict = {"tetra": np.zeros((1, 4), int)}
    with pytest.raises(ValueError, match="tetra"):
        talus.Soup(Meshio())


def test_to_trimesh_and_meshio(hall: Mesh) -> None:
    navmesh = talus.Navmesh.bake(*hall)
    trimesh = pytest.importorskip("trimesh")
    assert abs(trimesh.Trimesh(**navmesh.as_trimesh()).area / navmesh.area - 1) < 0.01
    meshio = pytest.importorskip("meshio")
    assert "polygon" in meshio.Mesh(**navmesh.as_meshio()).cell_data


@pytest.mark.skipif("TALUS_COMMAND" not in os.environ, reason="the talus command is not at hand (TALUS_COMMAND)")
def test_plot(hall: Mesh, tmp_path: Path) -> None:
    level = talus.Level(soup=talus.Soup(*hall), navmesh=talus.Navmesh.bake(*hall))
    plain = level.plot(view="top", size=400)
    path = level.plot("path", start=[5, 0, 20], goal=[35, 0, 20], view="top", size=400)
    for picture in (plain, path):
        assert picture.data[:8] == b"\x89PNG\r\n\x1a\n"
        assert picture._repr_png_() == picture.data
    assert plain.data != path.data
    plain.save(tmp_path / "plain.png")
    with pytest.raises(ValueError, match="could not draw"):
        level.plot("carrots")


def test_plot_without_command(hall: Mesh, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("TALUS_COMMAND", raising=False)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(FileNotFoundError, match="TALUS_COMMAND"):
        talus.Level(soup=talus.Soup(*hall)).plot("soup")
