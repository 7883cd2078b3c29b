# SPDX-License-Identifier: MIT
"""Pictures, drawn by the `talus` command, so that they look the same wherever they are made."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from ._arrays import ArrayLike, triple

if TYPE_CHECKING:
    from .level import Level


class Picture:
    """A PNG. A notebook shows it by itself."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        """The file's bytes."""

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the PNG."""
        Path(path).write_bytes(self.data)

    def _repr_png_(self) -> bytes:
        return self.data

    def __repr__(self) -> str:
        return f"<talus.Picture: {len(self.data):,} bytes of PNG>"


def _command() -> str:
    command = os.environ.get("TALUS_COMMAND") or shutil.which("talus")
    if command is None:
        raise FileNotFoundError(
            "pictures are drawn by the talus command, which is not on the PATH: install it (make install), or set "
            "TALUS_COMMAND to where it is"
        )
    return command


def draw(
    level: Level,
    stage: str,
    start: ArrayLike | None,
    goal: ArrayLike | None,
    agent_radius: float,
    view: Literal["both", "top", "oblique"],
    size: int,
) -> Picture:
    """See `Level.plot`."""
    words = ["--stage", stage, "--view", view, "--size", str(int(size))]
    for option, point in (("--from", start), ("--to", goal)):
        if point is not None:
            words += [option, ",".join(repr(value) for value in triple(point, option))]
    if agent_radius > 0:
        words += ["--radius", repr(float(agent_radius))]
    with tempfile.TemporaryDirectory(prefix="talus-") as folder:
        baked, picture = Path(folder, "level.talus"), Path(folder, "picture.png")
        baked.write_bytes(level.to_bytes())
        done = subprocess.run(
            [_command(), "draw", str(baked), "-o", str(picture), *words], capture_output=True, text=True, check=False
        )
        if done.returncode != 0 or not picture.exists():
            said = done.stderr.strip().replace(f"{baked}: ", "")
            raise ValueError(f"the talus command could not draw it: {said}")
        return Picture(picture.read_bytes())
