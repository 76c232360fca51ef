"""`tumble run` as a user meets it: a scene in, a summary and tables out."""

import json
import os
import pty
import re
import signal
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest
import tumble as tumble_package
from PIL import Image
from program import PROGRAM, ROOT, refuse, rows_of, succeed, tumble

BALL = """
tumble = 1
title = "A ball, falling"
duration = 0.5
materials.default.restitution = 0.5
[[bodies]]
name = "floor"
kind = "fixed"
shape = { half_plane = [0, 1] }
[[bodies]]
name = "ball, red"
shape = { disc = 0.1 }
mass = 2
position = [0, 0.6]
velocity = [1, 0]
"""
FLIGHT = BALL.replace("[0, 0.6]", "[0, 600]").replace("duration = 0.5", "duration = 1e6")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "ball.toml").write_text(BALL)
    (tmp_path / "flight.toml").write_text(FLIGHT)
    return tmp_path


def column(path: Path, name: str) -> np.ndarray:
    return np.array([float(row[name]) for row in rows_of(path)])


def test_the_tables_hold_the_motion(folder: Path) -> None:
    text = succeed("run", "ball.toml", "-o", "a.csv", "-o", "a.contacts.csv", cwd=folder)
    assert text.startswith("A ball, falling\n2 bodies, 1 of them moved by forces; 500 steps of 0.001 s\n")
    assert text.endswith("wrote a.csv, a.contacts.csv\n")
    samples = folder / "a.csv"
    t, y = column(samples, "t [s]"), column(samples, "ball, red.y [m]")
    assert len(t) == 501 and t[-1] == 0.5
    flying = t < 0.3  # the impact is at sqrt(2 * 0.5 / 9.81) = 0.319 s
    assert y[flying] == pytest.approx(0.6 - 9.81 * t[flying] ** 2 / 2, abs=1e-12)
    energy = column(samples, "kinetic [J]") + column(samples, "potential [J]")
    loss = column(samples, "friction_loss [J]") + column(samples, "impact_loss [J]") - column(samples, "stabilisation_work [J]")
    assert energy[0] == pytest.approx(2 * 9.81 * 0.6 + 1.0) and energy[0] - energy[-1] == pytest.approx(loss.sum())
    contacts = rows_of(folder / "a.contacts.csv")
    assert {(row["body_a"], row["body_b"], row["law_restitution"]) for row in contacts} == {("floor", "ball, red", "0.5")}
    impulse = column(folder / "a.contacts.csv", "normal_impulse [N s]").sum()
    vy = column(samples, "ball, red.vy [m/s]")
    assert impulse == pytest.approx(2 * (vy[-1] - vy[0] + 9.81 * 0.5), rel=1e-12)


def read_h5(path: Path) -> dict[str, np.ndarray]:
    with h5py.File(path) as file:
        texts = {name for name in file if h5py.check_string_dtype(file[name].dtype)}
        assert file["pose"].attrs["units"] == b"m, m, rad" and file["contact_gap"].attrs["units"] == b"m"
        return {name: np.array(file[name].asstr()[()] if name in texts else file[name][()]) for name in file}


@pytest.mark.parametrize("scene", ["drop", "compound", "tilting_table", "conveyor"])
def test_npz_and_h5_hold_the_trajectory_to_the_bit(folder: Path, scene: str) -> None:
    file = ROOT / "scenes" / f"{scene}.toml"
    words = ["--duration", "0.7", "--sample-every", "3"]
    succeed("run", file, *words, "-o", "a.npz", "-o", "a.h5", cwd=folder)
    expected = tumble_package.simulate(tumble_package.Scene.load(file), duration=0.7, sample_every=3)
    archive = np.load(folder / "a.npz")
    for arrays in ({name: archive[name] for name in archive.files}, read_h5(folder / "a.h5")):
        assert arrays["format_version"] == 1 and arrays["step_size"] == expected.step_size
        assert arrays["num_steps"] == expected.num_steps and arrays["is_complete"] == 1
        assert arrays["status"] == "solved" and arrays["residual"] == expected.residual
        for name in ("time", "pose", "velocity"):
            assert np.array_equal(arrays[name], getattr(expected, name))
        for name in expected.energy.dtype.names:
            assert np.array_equal(arrays[name], expected.energy[name])
        rows = expected.contacts
        assert len(rows) > 0
        for name in set(rows.dtype.names) - {"time", "mode"}:
            assert np.array_equal(arrays[f"contact_{name}"], rows[name]), name
        assert np.array_equal(arrays["mode_names"][arrays["contact_mode"]], rows["mode"])
        offsets = arrays["contact_offsets"]
        assert len(offsets) == expected.num_steps + 1
        k = int(rows["step"][-1])
        assert np.all(arrays["contact_step"][offsets[k - 1] : offsets[k]] == k) and offsets[k] > offsets[k - 1]
        again = tumble_package.Scene.parse(str(arrays["scene"]))
        assert list(arrays["body_names"]) == [body.name for body in again]
        assert np.array_equal(tumble_package.simulate(again, duration=0.7, sample_every=3).pose, expected.pose)


def test_contacts_can_be_left_out_of_files(folder: Path) -> None:
    succeed("run", "ball.toml", "--no-contacts", "-o", "a.npz", "-o", "a.h5", cwd=folder)
    for arrays in (np.load(folder / "a.npz"), read_h5(folder / "a.h5")):
        assert arrays["contact_gap"].shape == (0,) and arrays["contact_normal"].shape == (0, 2)
        assert not arrays["contact_offsets"].any() and len(arrays["time"]) == 501


def test_names_and_titles_may_hold_any_letters(folder: Path) -> None:
    (folder / "b.toml").write_text(BALL.replace("ball, red", "Kügelchen 球 🎱").replace("A ball, falling", "Fällt"))
    succeed("run", "b.toml", "-o", "a.npz", "-o", "a.h5", "-o", "a.png", "-o", "a.csv", cwd=folder)
    for arrays in (np.load(folder / "a.npz"), read_h5(folder / "a.h5")):
        assert list(arrays["body_names"]) == ["floor", "Kügelchen 球 🎱"] and "Fällt" in str(arrays["scene"])
    assert "Kügelchen 球 🎱.x [m]" in rows_of(folder / "a.csv")[0]


def test_pictures_show_the_scene(folder: Path) -> None:
    names = ["a.png", "a.svg", "a.gif", "a.mp4"]
    succeed("run", "ball.toml", "--width", "480", "--height", "320", *[w for n in names for w in ("-o", n)], cwd=folder)
    for name in ("a.png", "a.gif"):
        assert Image.open(folder / name).size == (480, 320)
    svg = (folder / "a.svg").read_text()
    assert svg.rstrip().endswith("</svg>") and len(svg) > 10_000
    film = Image.open(folder / "a.gif")
    assert 20 < film.n_frames <= 26  # 0.5 s and the start, 50 pictures a second
    assert (folder / "a.mp4").stat().st_size > 5000
    succeed("run", "ball.toml", "--speed", "0.25", "-o", "slow.gif", cwd=folder)
    assert 90 < Image.open(folder / "slow.gif").n_frames <= 101


def test_a_film_that_would_be_too_long_is_refused_before_the_run(folder: Path) -> None:
    message = refuse("run", "flight.toml", "-o", "a.gif", cwd=folder)
    assert "animation: at most 60 s of film are made, this run needs 1e+06 s" in message


def test_options_set_steps_and_samples(folder: Path) -> None:
    words = ["--step-size", "0.01", "--duration", "0.2", "--sample-every", "7", "--solver", "fast"]
    assert "20 steps of 0.01 s" in succeed("run", "ball.toml", *words, "-o", "a.csv", cwd=folder)
    assert column(folder / "a.csv", "t [s]") == pytest.approx([0, 0.07, 0.14, 0.2])


def test_the_scene_may_come_from_standard_input(folder: Path) -> None:
    from_file = succeed("run", "ball.toml", cwd=folder)
    assert succeed("run", "-", cwd=folder, stdin=BALL) == from_file


def test_tables_can_be_piped(folder: Path) -> None:
    text = succeed("run", "ball.toml", "--quiet", "--format", "contacts.csv", "-o", "/dev/stdout", cwd=folder)
    assert text.startswith("# tumble contacts 1\n") and text.count("\n") == 10  # nine lines of header, one bounce


def test_json_is_the_summary_in_full(folder: Path) -> None:
    report = json.loads(succeed("run", "ball.toml", "--json", "-o", "a.csv", cwd=folder))
    last = rows_of(folder / "a.csv")[-1]
    (ball,) = report["bodies"]
    assert ball["name"] == "ball, red" and ball["position"][1] == float(last["ball, red.y [m]"])
    assert ball["angular_velocity"] == float(last["ball, red.omega [rad/s]"])
    assert report["status"] == "solved" and report["residual"] < 1e-10 and report["complete"]
    assert report["steps"] == 500 and not report["at_rest"] and report["at_rest_since"] is None
    assert report["energy"]["creating_steps"] == 0 and report["energy"]["first_creation"] is None
    assert report["energy"]["impact_loss"] == column(folder / "a.csv", "impact_loss [J]").sum()
    assert report["files"] == ["a.csv"]


def test_rest_is_noticed(folder: Path) -> None:
    text = succeed("run", ROOT / "scenes/drop.toml", cwd=folder)
    since = float(text.split("at rest since ")[1].split(" ")[0])
    report = json.loads(succeed("run", ROOT / "scenes/drop.toml", "--json", cwd=folder))
    assert report["at_rest"] and report["at_rest_since"] == pytest.approx(since) and 0.5 < since < 4  # after the first impact
    assert "at rest all the time" in succeed("run", ROOT / "scenes/stack.toml", "--duration", "0.1", cwd=folder)


def test_created_energy_is_flagged_with_its_time(folder: Path) -> None:
    """Newton's restitution with friction: a rod whose end is stopped from slipping leaves with more than it came with."""
    (folder / "rod.toml").write_text("""
        tumble = 1
        gravity = [0, 0]
        duration = 0.5
        materials.default = { friction = 0.8, restitution = 1 }
        bodies = [
          { kind = "fixed", shape = { half_plane = [0, 1] } },
          { shape = { rectangle = [2, 0.02] }, mass = 1, position = [0, 1.1], angle = 1, velocity = [1, -1] },
        ]
    """)
    report = json.loads(succeed("run", "rod.toml", "--json", cwd=folder))["energy"]
    gain = sum(report["end"].values()) - sum(report["start"].values())
    assert gain > 0.01 and report["created"] == pytest.approx(gain) and report["creating_steps"] == 1
    text = succeed("run", "rod.toml", cwd=folder)
    assert f"CREATED from nothing: {report['created']:.6g} J in 1 step, first at {report['first_creation']:.6g} s" in text


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["none.toml"], "cannot read none.toml: No such file or directory"),
        (["."], "cannot read .: Is a directory"),
        (["ball.toml", "-o", "a.txt"], "a.txt: the name must end in .contacts.csv, .csv, .npz, .h5, .gif, .mp4, .png, .svg or .html"),
        (["ball.toml", "-o", "none/a.csv"], "none/a.csv: the folder none cannot be used"),
        (["ball.toml", "-o", "old.csv"], "old.csv: already exists; --force replaces it"),
        (["ball.toml", "-o", "a.csv", "-o", "./a.csv"], "--output: ./a.csv is named twice"),
        (["ball.toml", "--step-size", "0"], "--step-size: must be > 0, got 0"),
        (["ball.toml", "--step-size", "fine"], "--step-size: must be a finite number, got 'fine'"),
        (["ball.toml", "--step-size", "1e-12"], "--duration: must be at most 1e+09 steps of 1e-12 s, got 0.5 s"),
        (["ball.toml", "--duration", "-1"], "--duration: must be > 0, got -1"),
        (["ball.toml", "--sample-every", "0"], "--sample-every: must be >= 1, got 0"),
        (["ball.toml", "--solver", "magic"], "--solver: must be exact or fast, got 'magic'"),
        (["ball.toml", "--no-contacts", "-o", "a.contacts.csv"], "--no-contacts: a.contacts.csv holds nothing else"),
        ([], "scene is required"),
    ],
)
def test_bad_calls_are_one_line_and_write_nothing(folder: Path, words: list[str], message: str) -> None:
    (folder / "old.csv").write_text("precious")
    before = sorted(folder.iterdir())
    assert message in refuse("run", *words, cwd=folder)
    assert sorted(folder.iterdir()) == before and (folder / "old.csv").read_text() == "precious"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("mass = 2", "mass = -2", "tumble: bad.toml:13:8: bodies[1].mass: must be in [1e-60, 1e+60] kg, got -2"),
        ("mass = 2", "mas = 2", "tumble: bad.toml:13:1: bodies[1].'mas': unknown key; did you mean 'mass'?"),
        ("disc = 0.1", "disk = 0.1", "tumble: bad.toml:12:11: bodies[1].shape.'disk': unknown key; did you mean 'disc'?"),
        ("tumble = 1", "tumble 1", "tumble: bad.toml:2:"),
    ],
)
def test_faults_of_a_scene_have_their_place(folder: Path, old: str, new: str, message: str) -> None:
    (folder / "bad.toml").write_text(BALL.replace(old, new))
    assert refuse("run", "bad.toml", "-o", "a.csv", cwd=folder).startswith(message)
    assert not (folder / "a.csv").exists()


@pytest.mark.parametrize("ending", ["csv", "contacts.csv", "npz", "h5", "png", "gif"])
def test_a_disk_that_is_full_costs_one_file(folder: Path, ending: str) -> None:
    (folder / f"full.{ending}").symlink_to("/dev/full")
    run = tumble("run", "ball.toml", "-o", f"full.{ending}", "-o", "a.csv", cwd=folder)
    assert run.returncode == 2 and run.stderr.count("\n") == 1
    assert run.stderr.startswith("tumble: ") and f"full.{ending}: No space left on device" in run.stderr
    assert run.stdout.endswith("wrote a.csv\n") and len(rows_of(folder / "a.csv")) == 501


def start(words: list[str], folder: Path, stderr: int) -> subprocess.Popen[bytes]:
    def hear_interrupts() -> None:  # a shell may have switched them off for what it runs in the background
        signal.signal(signal.SIGINT, signal.SIG_DFL)

    return subprocess.Popen([str(PROGRAM), *words], cwd=folder, stdout=subprocess.PIPE, stderr=stderr, preexec_fn=hear_interrupts)


def test_ctrl_c_keeps_what_was_computed(folder: Path) -> None:
    """The terminal is a pseudo-terminal: its progress line tells when the run is under way."""
    ours, theirs = pty.openpty()
    process = start(["run", "flight.toml", "--sample-every", "1000", "-o", "a.csv"], folder, theirs)
    shown = b""
    while b" left; Ctrl-C ends it" not in shown:
        shown += os.read(ours, 1000)
    process.send_signal(signal.SIGINT)
    printed, _ = process.communicate(timeout=60)
    shown += os.read(ours, 1000)
    os.close(theirs), os.close(ours)
    assert process.returncode == 130
    assert b"tumble: interrupted at " in shown and b" s of 1e+06 s" in shown and b"wrote a.csv" in printed
    text = (folder / "a.csv").read_text()
    assert "# complete = no\n" in text and text.endswith("\n")
    t = column(folder / "a.csv", "t [s]")
    assert t[-1] > 1 and f"# steps = {round(t[-1] * 1000)}\n" in text
    y = column(folder / "a.csv", "ball, red.y [m]")
    early = t < 11
    assert y[early] == pytest.approx(600 - 9.81 * t[early] ** 2 / 2, abs=1e-6)


def test_no_progress_where_there_is_no_terminal(folder: Path) -> None:
    process = start(["run", "flight.toml", "--sample-every", "1000000"], folder, subprocess.PIPE)
    with pytest.raises(subprocess.TimeoutExpired):
        process.communicate(timeout=2)
    process.send_signal(signal.SIGINT)
    printed, said = process.communicate(timeout=60)
    assert process.returncode == 130 and said.startswith(b"tumble: interrupted at ") and said.count(b"\n") == 1
    assert b"\nend      moving; fastest is ball, red " in printed


def test_the_scenes_that_make_run_names_can_be_run(folder: Path) -> None:
    commands = re.findall(r'@echo "  \$\(BUILD\)/bin/tumble (run .*)"', (ROOT / "Makefile").read_text())
    assert len(commands) == 3
    (folder / "scenes").symlink_to(ROOT / "scenes")
    (folder / "out").mkdir()
    for command in commands:
        text = succeed(*command.split(), "--duration", "0.5", cwd=folder)
        target = command.split()[-1]
        assert text.endswith(f"wrote {target}\n") and Image.open(folder / target).n_frames > 10


def test_the_summary_of_every_named_scene(tmp_path: Path) -> None:
    """No scene fails to be solved; each says so in its own words."""
    for scene in sorted((ROOT / "scenes").glob("*.toml")):
        run = tumble("run", scene, "--duration", "0.05", cwd=tmp_path)
        assert run.returncode == 0 and "status   solved" in run.stdout, (scene.name, run.stdout, run.stderr)
