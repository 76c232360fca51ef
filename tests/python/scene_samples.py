"""What the tests of scenes share."""

import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import pytest
import tumble
from tumble import Scene

ROOT = Path(__file__).resolve().parents[2]

# A test run in the background ignores Ctrl-C, and so would its children.
HEEDS_CTRL_C = "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"


def load(name: str) -> Scene:
    return Scene.load(ROOT / f"scenes/{name}.toml")


def box_on_floor(**law: float) -> Scene:
    scene = Scene()
    scene.add_material("wood", **{"friction": 0.5, **law})
    scene.add_fixed(tumble.half_plane(), name="floor", material="wood")
    scene.add_body(tumble.square(0.25), mass=2, name="box", position=(0, 0.125), material="wood")
    return scene


def refuse_in_one_line(call: Callable[[], object], error: type[Exception], message: str) -> None:
    with pytest.raises(error) as caught:
        call()
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def run_python(code: str, **more: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, **more)  # type: ignore[call-overload]


def shown_on_a_terminal(code: str) -> bytes:
    """What the code writes to standard error where that is a terminal; it must write nothing where it is none."""
    assert run_python(code).stderr == ""
    ours, theirs = os.openpty()
    child = subprocess.Popen([sys.executable, "-c", code], stderr=theirs)
    os.close(theirs)
    shown = b""
    try:
        while piece := os.read(ours, 4096):
            shown += piece
    except OSError:  # the other end is closed
        pass
    os.close(ours)
    assert child.wait(timeout=60) == 0
    return shown


def ticks_during(call: Callable[[], object]) -> tuple[int, float]:
    """How often another thread, which wants to wake every 5 ms, did so while the call ran, and how long that took [s]."""
    ticks: list[float] = []
    is_over = threading.Event()

    def tick() -> None:
        while not is_over.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.005)

    thread = threading.Thread(target=tick)
    thread.start()
    try:
        start = time.monotonic()
        call()
        end = time.monotonic()
    finally:
        is_over.set()
        thread.join()
    return sum(start < t < end for t in ticks), end - start
