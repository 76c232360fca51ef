"""Trajectory.save. What is in the files: tests/output and docs/formats.md."""

from pathlib import Path

import numpy as np
import pytest
from scene_samples import load
from tumble import Scene, simulate

NAN = float("nan")


def test_a_trajectory_is_saved_as_tables(tmp_path: Path) -> None:
    scene = load("drop")
    trajectory = simulate(scene, duration=0.6, sample_every=10)
    assert trajectory.save(tmp_path / "run.csv") == tmp_path / "run.csv"
    trajectory.save(str(tmp_path / "run.csv"))  # an existing file is replaced
    table = np.genfromtxt(tmp_path / "run.csv", delimiter=",", names=True, skip_header=sum(
        line.startswith("#") for line in (tmp_path / "run.csv").read_text().splitlines()), deletechars="")  # fmt: skip
    columns = table.dtype.names
    assert np.array_equal(table[columns[0]], trajectory.time)
    square = np.array([table[name] for name in columns if name.startswith("square.")]).T
    assert np.array_equal(square, np.hstack([trajectory["square"].pose, trajectory["square"].velocity]))
    trajectory.save(tmp_path / "run.contacts.csv")
    rows = [line for line in (tmp_path / "run.contacts.csv").read_text().splitlines() if not line.startswith("#")]
    assert len(rows) == 1 + len(trajectory.contacts) > 1


def test_a_trajectory_is_saved_as_arrays(tmp_path: Path) -> None:
    trajectory = simulate(load("dominoes"), duration=0.3, sample_every=10)
    trajectory.save(tmp_path / "run.npz")
    arrays = np.load(tmp_path / "run.npz")
    for name in ("time", "pose", "velocity"):
        assert np.array_equal(arrays[name], getattr(trajectory, name))
    for name in trajectory.energy.dtype.names:
        assert np.array_equal(arrays[name], trajectory.energy[name])
    contacts = trajectory.contacts
    for name in set(contacts.dtype.names) - {"time", "mode"}:
        assert np.array_equal(arrays[f"contact_{name}"], contacts[name]), name
    assert np.array_equal(arrays["mode_names"][arrays["contact_mode"]], contacts["mode"])
    assert Scene.parse(str(arrays["scene"])) == trajectory.scene


@pytest.mark.parametrize(
    ("name", "start"), [("run.png", b"\x89PNG"), ("run.svg", b"<?xml"), ("run.gif", b"GIF89a"), ("run.mp4", b"\0\0\0"), ("run.h5", b"\x89HDF")]
)
def test_a_trajectory_is_saved_by_its_ending(tmp_path: Path, name: str, start: bytes) -> None:
    trajectory = simulate(load("dominoes"), duration=0.3, contacts=False)
    trajectory.save(tmp_path / name, width=320, height=200, speed=0.5)
    assert (tmp_path / name).read_bytes().startswith(start)
    trajectory.save(tmp_path / "other", format=name.removeprefix("run."), width=320, height=200, speed=0.5)
    assert (tmp_path / "other").read_bytes() == (tmp_path / name).read_bytes()


@pytest.mark.parametrize(
    ("name", "settings", "error", "message"),
    [
        ("run.xyz", {}, ValueError, "run.xyz: the name must end in ."),
        ("run", {}, ValueError, "run: the name must end in ."),
        ("run.csv", {"format": "doc"}, ValueError, "format: must be "),
        ("none/run.csv", {}, ValueError, "none"),
        ("run.csv", {"width": 3}, ValueError, "width: must be 0 (chosen for you) or in [160, 4096] px, got 3"),
        ("run.csv", {"height": 10**30}, ValueError, "height: must be 0 (chosen for you) or in [160, 4096] px, got 1000000"),
        ("run.csv", {"width": 3.5}, TypeError, "width: must be a whole number, got 3.5"),
        ("run.csv", {"speed": 0}, ValueError, "speed: must be"),
        ("run.csv", {"speed": NAN}, ValueError, "speed: must be"),
        ("run.csv", {"speed": "fast"}, TypeError, "speed: must be a number, got 'fast'"),
        ("run.contacts.csv", {}, ValueError, "contacts: were not kept; simulate with contacts=True"),
        (3, {}, TypeError, ""),
    ],
)
def test_what_cannot_be_saved_is_said_in_one_line(tmp_path: Path, name: str, settings: dict, error: type[Exception], message: str) -> None:
    trajectory = simulate(load("drop"), duration=0.01, contacts=False)
    with pytest.raises(error) as caught:
        trajectory.save(tmp_path / name if isinstance(name, str) else name, **settings)
    assert message in str(caught.value) and "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []
