"""tumble.drop.render without a display: files, and what it says."""

import subprocess
import sys
import types
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from tumble import drop
from tumble.drop import Parameters, render, simulate

Q, _ = simulate([0.0, 1.5, 0.5], [0.0, -0.2, 0.0], params=Parameters(columns=80))


def test_gif_moves_and_plays_in_real_time(tmp_path: Path) -> None:
    path = render(Q, save=tmp_path / "drop.gif")
    picture = Image.open(path)
    assert picture.n_frames == 21  # 0.79 s at 25 frames per second, and the start
    assert picture.info["duration"] == 40 and picture.info["loop"] == 0
    first = np.asarray(picture.convert("RGB"))
    picture.seek(10)
    assert (np.asarray(picture.convert("RGB")) != first).any()


@pytest.mark.parametrize("name", ["drop.png", "drop.svg", "drop.pdf", "drop.mp4"])
def test_other_files_are_written(tmp_path: Path, name: str) -> None:
    path = render(Q, save=str(tmp_path / name))
    assert path == tmp_path / name and path.stat().st_size > 1000
    assert [p.name for p in tmp_path.iterdir()] == [name]
    assert path.stat().st_mode & 0o777 == 0o666 & ~current_umask()


def current_umask() -> int:
    import os

    umask = os.umask(0)
    os.umask(umask)
    return umask


def test_a_file_is_replaced_only_by_a_complete_one(tmp_path: Path) -> None:
    old = tmp_path / "drop.png"
    old.write_bytes(b"old")
    with pytest.raises(ValueError, match=r"q\[0\]\[0\]"):
        render(np.full((3, 4), np.nan), save=old)
    assert old.read_bytes() == b"old"
    render(Q, save=old)
    assert old.read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize(
    ("q", "save", "message"),
    [
        (np.zeros((2, 5)), None, r"q: must have shape \(3, T\) with T >= 1, got \(2, 5\)"),
        (np.zeros((3, 0)), None, "q: must have shape"),
        ([["a"], ["b"], ["c"]], None, "q: must be an array of real numbers"),
        (Q, "drop.bmp", "save: must end in .gif, .mp4, .png, .svg, .pdf, got 'drop.bmp'"),
        (Q, "drop", "save: must end in"),
    ],
)
def test_bad_input_is_a_value_error(q, save, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        render(q, save=save)


def test_a_folder_that_is_not_there_is_an_error_and_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"save: cannot write '.*missing/drop.png': No such file or directory"):
        render(Q, save=tmp_path / "missing" / "drop.png")
    assert list(tmp_path.iterdir()) == []


def test_without_a_display_the_user_gets_a_file_and_is_told(tmp_path: Path) -> None:
    code = "from tumble.drop import *\nq, v = simulate([0, 1, 0.5], [0, 0, 0], params=Parameters(columns=20))\nrender(q)\nrender(q)\n"
    environment = {"PYTHONPATH": str(Path(drop.__file__).parents[1]), "PATH": "/usr/bin:/bin", "HOME": str(tmp_path / "home")}
    run = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    assert "no window to show it in: the animation was saved as render.gif" in run.stdout and "render-2.gif" in run.stdout
    assert (tmp_path / "render.gif").stat().st_size > 1000


def test_a_notebook_gets_an_inline_animation(monkeypatch: pytest.MonkeyPatch) -> None:
    class ZMQInteractiveShell:
        """Named as IPython names the shell of a notebook."""

    class HTML:
        def __init__(self, data: str) -> None:
            self.data = data

    ipython, display = types.ModuleType("IPython"), types.ModuleType("IPython.display")
    ipython.get_ipython = lambda: ZMQInteractiveShell()
    display.HTML = HTML
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    shown = render(Q[:, :10])
    assert "<script" in shown.data and "data:image/png" in shown.data


def test_importing_tumble_does_not_import_matplotlib() -> None:
    code = "import sys, tumble, tumble.drop; assert 'matplotlib' not in sys.modules"
    environment = {"PYTHONPATH": str(Path(drop.__file__).parents[1])}
    assert subprocess.run([sys.executable, "-c", code], env=environment).returncode == 0
