# SPDX-License-Identifier: MIT
"""Ctrl-C during a bake, and other threads that go on meanwhile."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time

import numpy as np
import talus


def terrain(side: int) -> tuple[np.ndarray, np.ndarray]:
    x, z = np.meshgrid(np.arange(side), np.arange(side), indexing="ij")
    y = np.sin(x * 0.3) + np.cos(z * 0.2)
    vertices = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    corner = (x[:-1, :-1] * side + z[:-1, :-1]).reshape(-1)
    faces = np.concatenate(
        [np.stack([corner, corner + 1, corner + side + 1], 1), np.stack([corner, corner + side + 1, corner + side], 1)]
    )
    return vertices, faces


def test_other_threads_go_on() -> None:
    """A thread counts while a bake runs: it could not, if the bake kept the GIL."""
    vertices, faces = terrain(300)
    counted = 0
    done = threading.Event()

    def count() -> None:
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.0005)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted
    talus.Navmesh.bake(vertices, faces, threads=1)
    during = counted - before
    done.set()
    thread.join()
    assert during > 5


CHILD = """
import signal
import sys
import numpy as np
signal.signal(signal.SIGINT, signal.default_int_handler)  # whoever runs the tests may have it ignored
sys.path[:0] = {path!r}
import talus
from test_interrupt import terrain
vertices, faces = terrain(1200)
said = False
def say(stage, done, total):
    global said
    if not said:
        print("baking", flush=True)
        said = True
try:
    talus.Navmesh.bake(vertices, faces, cell_size=0.1, tile_size=64, progress=say)
    print("finished", flush=True)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


def test_keyboard_interrupt() -> None:
    code = CHILD.format(path=[str(__import__("pathlib").Path(__file__).parent)])
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None
    assert child.stdout.readline() == "baking\n"
    child.send_signal(signal.SIGINT)
    assert child.stdout.readline() == "interrupted\n"
    assert child.wait(60) == 0
