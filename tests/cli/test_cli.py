"""The program `tumble` as a user meets it: output, files, errors, exit codes."""

import json
import os
import resource
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest
from PIL import Image
from program import PROGRAM, ROOT, refuse, rows_of, succeed, tumble
from tumble import drop, lcp

COURSE_START = ([0.0, 1.5, np.deg2rad(30.0)], [0.0, -0.2, 0.0])


def test_drop_prints_each_impact_and_the_final_pose(tmp_path: Path) -> None:
    text = succeed("drop", cwd=tmp_path)
    record = drop.record(*COURSE_START)
    touching = np.flatnonzero(record.f_n[:-1] > 0)
    rows = [line.split() for line in text.splitlines() if line.strip().startswith(("0.", "1."))]
    assert len(rows) == len(touching) > 3
    for row, k in zip(rows, touching):
        assert float(row[0]) == pytest.approx(k * 0.01)
        assert float(row[-3]) == pytest.approx(record.f_n[k] * 0.01, abs=1e-5)
        assert float(row[-2]) == pytest.approx((record.f_t2 - record.f_t1)[k] * 0.01, abs=1e-5)
        lost = (record.kinetic + record.potential)[k] - (record.kinetic + record.potential)[k + 1]
        assert float(row[-1]) == pytest.approx(lost, abs=1e-5)
    assert "after 1.49 s: x 1.39497 m, y 0.140347 m" in text


def test_json_is_complete_and_to_the_bit(tmp_path: Path) -> None:
    report = json.loads(succeed("drop", "--json", "--side", "0.4", "--steps", "99", cwd=tmp_path))
    params = drop.Parameters(l=0.4, columns=100)
    q, v = drop.simulate(*COURSE_START, params=params)
    assert report["parameters"] == params.asdict()
    assert report["final"]["q"] == list(q[:, -1]) and report["final"]["v"] == list(v[:, -1])
    assert report["status"] == "solved" and len(report["impacts"]) > 0


def test_quiet_prints_nothing(tmp_path: Path) -> None:
    assert succeed("drop", "--quiet", "-o", "a.csv", cwd=tmp_path) == ""
    assert (tmp_path / "a.csv").exists()


def test_json_survives_a_file_name_that_is_not_utf8(tmp_path: Path) -> None:
    csv_name, text_name = os.fsdecode(b"a\xff.csv"), os.fsdecode(b"a\xff.txt")
    dropped = json.loads(succeed("drop", "--json", "-o", csv_name, cwd=tmp_path))
    rendered = json.loads(succeed("render", "--json", csv_name, "-o", csv_name, "--force", cwd=tmp_path))
    assert dropped["files"] == rendered["files"] == ["a\N{REPLACEMENT CHARACTER}.csv"]
    (tmp_path / text_name).write_text("M\n1\nq\n-1\n")
    reports = json.loads(succeed("lcp", "--json", text_name, text_name, cwd=tmp_path))
    assert [report["file"] for report in reports] == ["a\N{REPLACEMENT CHARACTER}.txt"] * 2


def test_one_step_is_a_step(tmp_path: Path) -> None:
    assert "; 1 step of 0.01 s\n" in succeed("drop", "--steps", "1", cwd=tmp_path)
    assert "; 2 steps of 0.01 s\n" in succeed("drop", "--steps", "2", cwd=tmp_path)


def test_angles_are_radians_or_degrees(tmp_path: Path) -> None:
    by_degrees = json.loads(succeed("drop", "--json", "--q0", "0,1.5,30deg", "--v0", "0,0,90deg", cwd=tmp_path))
    by_radians = json.loads(succeed("drop", "--json", "--q0=0,1.5,0.5235987755982988", "--v0=0,0,1.5707963267948966", cwd=tmp_path))
    assert by_degrees["final"] == by_radians["final"]


def test_every_parameter_reaches_the_simulation(tmp_path: Path) -> None:
    words = "--side 0.3 --mass 0.7 --friction 0.6 --restitution 0.2 --step 0.005 --steps 200 --gravity 5 --delta 0.002"
    report = json.loads(succeed("drop", "--json", *words.split(), "--q0", "1,0.5,-0.3", "--v0", "-1,0,4", cwd=tmp_path))
    params = drop.Parameters(l=0.3, m=0.7, mu=0.6, eps=0.2, dt=0.005, columns=201, g=5.0, delta=0.002)
    q, _ = drop.simulate([1, 0.5, -0.3], [-1, 0, 4], params=params)
    assert report["final"]["q"] == list(q[:, -1])


def test_csv_npz_and_h5_hold_the_record_to_the_bit(tmp_path: Path) -> None:
    succeed("drop", "-o", "a.csv", "-o", "a.npz", "-o", "a.h5", cwd=tmp_path)
    record = drop.record(*COURSE_START)
    rows = rows_of(tmp_path / "a.csv")
    for name, values in [("x [m]", record.q[0]), ("omega [rad/s]", record.v[2]), ("gap [m]", record.gap),
                         ("f_n [N]", record.f_n), ("lambda [m/s]", record.slip_speed), ("kinetic [J]", record.kinetic)]:
        assert [float(row[name]) for row in rows] == list(values)
    assert [row["mode"] for row in rows] == record.mode
    arrays = np.load(tmp_path / "a.npz")
    assert np.array_equal(arrays["q"], record.q) and np.array_equal(arrays["v"], record.v)
    with h5py.File(tmp_path / "a.h5") as file:
        assert np.array_equal(file["q"][:], record.q) and np.array_equal(file["gap"][:], record.gap)


def test_render_converts_without_loss(tmp_path: Path) -> None:
    succeed("drop", "-o", "a.csv", cwd=tmp_path)
    for source, target in [("a.csv", "b.npz"), ("b.npz", "c.h5"), ("c.h5", "d.csv")]:
        succeed("render", source, "-o", target, cwd=tmp_path)
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "d.csv").read_bytes()


def test_pictures_are_pictures(tmp_path: Path) -> None:
    succeed("drop", "-o", "a.png", "-o", "a.svg", "-o", "a.gif", "-o", "a.mp4", cwd=tmp_path)
    picture = Image.open(tmp_path / "a.png").convert("RGB")
    assert picture.width > 600 and len(picture.getcolors(10**7) or []) > 50
    assert (tmp_path / "a.svg").read_text().rstrip().endswith("</svg>")
    film = Image.open(tmp_path / "a.gif")
    durations = []
    for frame in range(film.n_frames):
        film.seek(frame)
        durations.append(film.info["duration"])
    assert min(durations) >= 20  # browsers slow shorter frames down
    assert sum(durations[:-1]) == pytest.approx(1490, abs=20)  # real time, up to the hold on the last frame
    probe = ["ffprobe", "-v", "error", "-show_entries", "format=duration", "-of", "csv=p=0", str(tmp_path / "a.mp4")]
    seconds = float(subprocess.run(probe, check=True, capture_output=True, text=True).stdout)
    assert 1.4 < seconds < 3.0


def test_speed_stretches_the_animation(tmp_path: Path) -> None:
    succeed("drop", "-o", "a.gif", cwd=tmp_path)
    succeed("drop", "--speed", "0.5", "-o", "b.gif", cwd=tmp_path)
    assert Image.open(tmp_path / "b.gif").n_frames > 1.8 * Image.open(tmp_path / "a.gif").n_frames


def test_an_unknown_command_is_named(tmp_path: Path) -> None:
    assert "there is no command 'fall'; there are drop, run, check, render, sweep, lcp and doctor" in refuse("fall", cwd=tmp_path)
    assert "there is no command 'a?b'" in refuse("a\nb", cwd=tmp_path)


def test_a_named_pipe_is_refused(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.gif")
    assert "pipe.gif: is a named pipe" in refuse("drop", "--force", "-o", "pipe.gif", cwd=tmp_path)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--mass", "-1"], "--mass: must be finite and > 0, got -1 kg"),
        (["--mass", "heavy"], "--mass: must be a finite number, got 'heavy'"),
        (["--side", "nan"], "--side: must be a finite number, got 'nan'"),
        (["--restitution", "1.1"], "--restitution: must be in [0, 1], got 1.1"),
        (["--step", "0"], "--step: must be finite and > 0, got 0 s"),
        (["--friction", "-0.1"], "--friction: must be finite and >= 0, got -0.1"),
        (["--delta", "-1"], "--delta: must be finite and >= 0, got -1 m"),
        (["--gravity", "inf"], "--gravity: must be a finite number, got 'inf'"),
        (["--steps", "0"], "--steps: must be in [1, 9999999], got 0"),
        (["--steps", "-1"], "--steps: must be in [1, 9999999], got -1"),
        (["--steps", "10000000"], "--steps: must be in [1, 9999999], got 10000000"),
        (["--steps", "1.5"], "--steps: must be a whole number, got '1.5'"),
        (["--q0", "1,2"], "--q0: must be three numbers a,b,c"),
        (["--q0", "1,2,3,4"], "--q0: must be three numbers a,b,c"),
        (["--q0", "1,2,3grad"], "--q0: must be a finite angle like 0.5 (rad) or 30deg, got '3grad'"),
        (["--v0", "1,inf,3"], "--v0: must be a finite number, got 'inf'"),
        (["--colour", "red"], "--colour"),
        (["-o", "a.bmp"], "a.bmp: the name must end in"),
        (["-o", "a"], "a: the name must end in"),
        (["-o", "missing/a.csv"], "missing"),
        (["--speed", "0", "-o", "a.gif"], "--speed: must be finite and > 0, got 0"),
        (["--width", "7", "-o", "a.png"], "--width: must be in [160, 4096] px, got 7"),
        (["--width", "0", "-o", "a.png"], "--width: must be in [160, 4096] px, got 0"),
        (["--height", "4097", "-o", "a.png"], "--height: must be in [160, 4096] px, got 4097"),
    ],
)
def test_bad_options_are_one_line_and_write_nothing(tmp_path: Path, words: list[str], message: str) -> None:
    assert message in refuse("drop", *words, cwd=tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_a_command_is_needed_and_help_is_everywhere(tmp_path: Path) -> None:
    refuse(cwd=tmp_path)
    refuse("fly", cwd=tmp_path)
    assert succeed("--version", cwd=tmp_path).startswith("tumble 0.")
    for words in (["--help"], ["drop", "--help"], ["run", "--help"], ["check", "--help"], ["render", "--help"], ["lcp", "--help"]):
        assert "Usage" in succeed(*words, cwd=tmp_path)


def test_existing_files_are_replaced_only_by_force(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("precious")
    assert "already exists; --force" in refuse("drop", "-o", "b.csv", "-o", "a.csv", cwd=tmp_path)
    assert (tmp_path / "a.csv").read_text() == "precious" and not (tmp_path / "b.csv").exists()
    succeed("drop", "--force", "-o", "a.csv", cwd=tmp_path)
    assert (tmp_path / "a.csv").read_text().startswith("# tumble drop 1")


def test_a_file_named_twice_is_refused_before_anything_is_written(tmp_path: Path) -> None:
    assert "./a.csv is named twice" in refuse("drop", "-o", "a.csv", "-o", "./a.csv", cwd=tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_a_damaged_h5_is_refused(tmp_path: Path) -> None:
    """The HDF5 library itself dies of a damaged type."""
    succeed("drop", "-o", "a.h5", cwd=tmp_path)
    whole = (tmp_path / "a.h5").read_bytes()
    for place in range(96, 4000, 61):
        damaged = bytearray(whole)
        damaged[place] ^= 0xFF
        (tmp_path / "b.h5").write_bytes(damaged)
        run = tumble("render", "b.h5", "-o", "b.csv", "--force", cwd=tmp_path)
        assert run.returncode in (0, 2) and run.stderr.count("\n") <= 1, (place, run.returncode, run.stderr)


@pytest.mark.parametrize("name", ["a.csv", "a.npz", "a.h5", "a.png", "a.svg", "a.gif", "a.mp4"])
def test_a_disk_that_fills_up_costs_nothing(tmp_path: Path, name: str) -> None:
    """A limit on the file size stands for the full disk: the write fails halfway."""
    (tmp_path / name).write_text("precious")

    def small_files() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))

    run = tumble("drop", "--force", "-o", name, cwd=tmp_path, preexec_fn=small_files)
    assert run.returncode != 0
    assert (tmp_path / name).read_text() == "precious"


@pytest.mark.parametrize("word", ["drop", "--help", "--version"])
def test_output_that_cannot_be_printed_is_an_error(tmp_path: Path, word: str) -> None:
    with open("/dev/full", "w") as full:
        run = subprocess.run([str(PROGRAM), word], stdout=full, stderr=subprocess.PIPE, text=True, cwd=tmp_path)
    assert run.returncode == 2 and "could not be written" in run.stderr


@pytest.mark.parametrize("ending", [".csv", ".npz", ".h5"])
def test_truncated_and_foreign_files_are_refused_by_name(tmp_path: Path, ending: str) -> None:
    good = tmp_path / f"good{ending}"
    succeed("drop", "-o", good, cwd=tmp_path)
    bad = tmp_path / f"bad{ending}"
    for content in (b"", b"hello\n", good.read_bytes()[:-100], good.read_bytes()[: good.stat().st_size // 2]):
        bad.write_bytes(content)
        assert f"bad{ending}" in refuse("render", bad, "-o", "out.png", cwd=tmp_path)
    assert not (tmp_path / "out.png").exists()
    refuse("render", "nowhere" + ending, "-o", "out.png", cwd=tmp_path)


def test_a_run_beyond_double_is_a_numerical_failure(tmp_path: Path) -> None:
    run = tumble("drop", "--v0", "1e150,0,0", "--step", "1e158", "--gravity", "0", cwd=tmp_path)
    assert run.returncode == 3 and "step 2 of 149" in run.stdout and "nan" not in run.stdout
    run = tumble("drop", "--v0", "1e150,0,0", "--step", "1e158", "--gravity", "0", "--quiet", cwd=tmp_path)
    assert run.returncode == 3 and run.stdout == "" and "step 2 of 149 left the range of double" in run.stderr


def test_lcp_solves_text(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("# example\nM\n2 1\n1 2\nq\n-5 -6\n")
    text = succeed("lcp", "a.txt", cwd=tmp_path)
    assert "status            solved" in text and "z                 1.333333333333333" in text and "basis             z1 z2" in text
    for word in ("w  ", "residual ", "w >= 0: ", "z >= 0: ", "w.z = 0: ", "pivots ", "refactorisations ", "rung "):
        assert word in text


@pytest.mark.parametrize("method", lcp.METHODS)
def test_lcp_json_is_the_result_of_the_library(tmp_path: Path, method: str) -> None:
    text = "M\n2 1\n1 2\nq\n-5 -6\n"
    report = json.loads(succeed("lcp", "-", "--json", "--method", method, cwd=tmp_path, stdin=text))
    result = lcp.solve(*lcp.parse(text), method)
    assert report == {
        **vars(result),
        "z": list(result.z),
        "w": list(result.w),
        "parts": vars(result.parts),
        "basis": list(result.basis),
    }
    assert json.loads(succeed("lcp", "-", "--json", cwd=tmp_path, stdin=text))["status"] == "solved"


def test_lcp_help_lists_every_method_and_setting(tmp_path: Path) -> None:
    text = succeed("lcp", "--help", cwd=tmp_path)
    for method, summary in lcp.METHODS.items():
        assert f"  {method:<10} {summary}\n" in text
        assert all(f"{name}=" in text for name in lcp.default_settings(method))


def test_lcp_takes_settings_of_the_method(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("M\n2 1\n1 2\nq\n-5 -6\n")
    run = tumble("lcp", "a.txt", "--method", "lemke", "--set", "max_pivots=1", "--set", "pivot_tolerance=1e-6", cwd=tmp_path)
    assert run.returncode == 3 and "iteration_limit" in run.stdout
    text = succeed("lcp", "a.txt", "--method", "lemke_lu", "--set", "precision=quad", "--set", "start_basis=1,1", cwd=tmp_path)
    assert "lemke_quad" in text and "pivots            0" in text


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--method", "simplex"], "--method: must be one of robust, lemke, "),
        (["--set", "max_pivots=3"], "max_pivots: is not a setting of this method, which has accepted_residual, start_basis"),
        (["--method", "lemke", "--set", "max_pivots=x"], "max_pivots: must be a number, got 'x'"),
        (["--method", "lemke", "--set", "max_pivots=-1"], "max_pivots: must be >= 0, got -1"),
        (["--set", "accepted_residual"], "--set: must be NAME=VALUE, got 'accepted_residual'"),
        (["--set", "="], "--set: must be NAME=VALUE, got '='"),
        (["--set", "start_basis=0,2"], "start_basis: must be zeros and ones, got 2"),
        (["--set", "start_basis=1"], "start_basis: must be empty or have 2 entries, got 1"),
        (["--all", "--method", "lemke"], "--all: belongs to the method enumerate, got --method lemke"),
        (["--trace", "--method", "robust"], "--trace: belongs to the method lemke, got --method robust"),
        (["--trace", "--all"], "--trace"),
        (["--trace", "--json"], "--trace"),
        (["--exact", "--trace"], "--trace"),
        (["--exact", "--set", "ridge=0"], "--set"),
        (["--exact", "a.txt"], "--exact: takes one file, got 2"),
        (["--trace", "a.txt"], "--trace: takes one file, got 2"),
        (["-", "-"], "standard input can be read once only, got '-' several times"),
    ],
)
def test_lcp_refuses_bad_options(tmp_path: Path, words: list[str], message: str) -> None:
    (tmp_path / "a.txt").write_text("M\n2 1\n1 2\nq\n-5 -6\n")
    assert message in refuse("lcp", "a.txt", *words, cwd=tmp_path)


def test_lcp_of_several_files_is_a_table_and_the_worst_exit_code(tmp_path: Path) -> None:
    (tmp_path / "good.txt").write_text("M\n2 1\n1 2\nq\n-5 -6\n")
    (tmp_path / "none.txt").write_text("M\n-1\nq\n-1\n")
    (tmp_path / "bad.txt").write_text("M\n1\n")
    rows = succeed("lcp", "good.txt", "-", cwd=tmp_path, stdin="M\n1\nq\n1\n").splitlines()
    assert rows[0].split() == ["file", "n", "status", "residual", "pivots", "rung"]
    assert rows[1].split()[:3] == ["good.txt", "2", "solved"] and rows[2].startswith("standard input") and rows[2].split()[-1] == "none"
    assert rows[3] == "2 of 2 solved"

    run = tumble("lcp", "bad.txt", "good.txt", cwd=tmp_path)
    assert run.returncode == 2 and "bad.txt:2:1" in run.stderr and "1 of 2 files not solved" in run.stderr
    run = tumble("lcp", "none.txt", "bad.txt", "good.txt", cwd=tmp_path)
    assert run.returncode == 3 and "1 of 3 solved" in run.stdout
    assert [line.split()[0] for line in run.stdout.splitlines()[1:-1]] == ["none.txt", "bad.txt", "good.txt"]
    run = tumble("lcp", "none.txt", "good.txt", "bad.txt", "--json", cwd=tmp_path)
    reports = json.loads(run.stdout)
    assert [report["file"] for report in reports] == ["none.txt", "good.txt", "bad.txt"]
    assert [report["status"] for report in reports] == ["infeasible", "solved", "bad_input"]
    run = tumble("lcp", "none.txt", "good.txt", "--all", cwd=tmp_path)
    assert run.returncode == 3 and run.stdout.splitlines()[2].split()[-2:] == ["1", "enumerate"]
    assert tumble("lcp", "none.txt", "good.txt", "--quiet", cwd=tmp_path).stdout == ""


CONTACT = "M\n1 0 0 0\n0 1 -1 1\n0 -1 1 1\n1/2 -1 -1 0\nq\n-2 1 -1 0\n"


def test_lcp_trace_shows_each_pivot(tmp_path: Path) -> None:
    text = succeed("lcp", "-", "--trace", cwd=tmp_path, stdin=CONTACT)
    assert "Start: all w are basic." in text and "status            solved" in text
    pivots = [line for line in text.splitlines() if line.startswith("Pivot ")]
    assert len(pivots) == json.loads(succeed("lcp", "-", "--json", "--method", "lemke", cwd=tmp_path, stdin=CONTACT))["pivots"]
    leaving = None
    for k, line in enumerate(pivots):
        words = line.replace(",", " ").replace(".", " ").replace(":", " ").split()
        assert words[:2] == ["Pivot", str(k + 1)] and words[3] == "enters"
        assert words[2] == ("z0" if leaving is None else ("z" if leaving[0] == "w" else "w") + leaving[1:])
        leaving = words[words.index("leaves") - 1]
    assert leaving == "z0"
    # The last tableau holds the solution in its column of values, and the basis is complementary.
    values = {row.split()[0]: float(row.split()[-1]) for row in text.split("\n\n")[-3].splitlines()[2:]}
    solution = [values.get(f"z{i}", 0.0) for i in range(1, 5)]
    assert solution == [2, 0, 1, 0] and sorted(name[1] for name in values) == ["1", "2", "3", "4"]


@pytest.mark.parametrize("n", range(1, 9))
def test_lcp_trace_fits_on_a_line_and_ends_with_the_solution(tmp_path: Path, n: int) -> None:
    random = np.random.default_rng(n)
    root = random.standard_normal((n, n))
    rows = [" ".join(map(repr, row.tolist())) for row in root @ root.T + 0.1 * np.eye(n)]
    text = succeed("lcp", "-", "--trace", cwd=tmp_path, stdin="\n".join(["M", *rows, "q", *map(repr, (-random.random(n)).tolist())]) + "\n")
    assert max(map(len, text.split("status")[0].splitlines())) <= 120
    assert "z0 has left" in text and "nan" not in text


def test_lcp_trace_of_other_ends(tmp_path: Path) -> None:
    run = tumble("lcp", "-", "--trace", cwd=tmp_path, stdin="M\n-1\nq\n-1\n")
    assert run.returncode == 3 and "z1 enters, the complement of w1. No row limits it: a ray" in run.stdout
    assert "certificate " in run.stdout and "(direction of the ray)" in run.stdout
    run = tumble("lcp", "-", "--trace", "--set", "max_pivots=2", cwd=tmp_path, stdin=CONTACT)
    assert run.returncode == 3 and "Stopped at the allowed number of pivots." in run.stdout and "Pivot 3" not in run.stdout
    assert "no pivot is needed" in succeed("lcp", "-", "--trace", cwd=tmp_path, stdin="M\n1\nq\n1\n")
    nine = "M\n" + "\n".join(" ".join("1" if i == j else "0" for j in range(9)) for i in range(9)) + "\nq\n" + "-1 " * 9 + "\n"
    assert "--trace: takes problems of at most 8 unknowns, got 9" in refuse("lcp", "-", "--trace", cwd=tmp_path, stdin=nine)


def test_lcp_lists_all_solutions(tmp_path: Path) -> None:
    report = json.loads(succeed("lcp", "-", "--all", "--json", cwd=tmp_path, stdin="M\n-2 -1\n-1 -2\nq\n1 1\n"))
    assert report["n"] == 2 and len(report["solutions"]) == 4
    assert "4 vertex solutions" in succeed("lcp", "-", "--all", cwd=tmp_path, stdin="M\n-2 -1\n-1 -2\nq\n1 1\n")


def test_lcp_without_solution_exits_with_3(tmp_path: Path) -> None:
    run = tumble("lcp", "-", cwd=tmp_path, stdin="M\n-1\nq\n-1\n")
    assert run.returncode == 3 and "infeasible" in run.stdout and "(y: M'y <= 0, y >= 0, q'y < 0)" in run.stdout
    run = tumble("lcp", "-", "--method", "lemke", cwd=tmp_path, stdin="M\n-1\nq\n-1\n")
    assert run.returncode == 3 and "ray_unproven" in run.stdout
    run = tumble("lcp", "-", "--method", "enumerate", cwd=tmp_path, stdin="M\n-1\nq\n-1\n")
    assert run.returncode == 3 and "no_solution_proved" in run.stdout
    run = tumble("lcp", "-", "--all", cwd=tmp_path, stdin="M\n-1\nq\n-1\n")
    assert run.returncode == 3 and "0 vertex solutions" in run.stdout and "no_solution_proved" in run.stderr


def test_lcp_exact_prints_fractions(tmp_path: Path) -> None:
    text = succeed("lcp", "-", "--exact", cwd=tmp_path, stdin="M\n0.3\nq\n-0.1\n")
    assert "z                 1/3\n                  0.3333333333333333\n" in text and "w                 0\n" in text
    report = json.loads(succeed("lcp", "-", "--exact", "--json", cwd=tmp_path, stdin="M\n0.3\nq\n-0.1\n"))
    assert report["z"] == ["1/3"] and report["z_decimal"] == [1 / 3] and report["status"] == "solved"


def test_lcp_exact_lists_vertices_rays_and_faces(tmp_path: Path) -> None:
    half_line = "M\n1 -1\n-1 1\nq\n1 -1\n"
    text = succeed("lcp", "-", "--exact", "--all", cwd=tmp_path, stdin=half_line)
    assert "1 vertex solution, 1 ray, 1 face" in text and "face              0: vertices 0, rays 0" in text
    report = json.loads(succeed("lcp", "-", "--exact", "--all", "--json", cwd=tmp_path, stdin=half_line))
    assert report["rays"] == [["1", "1"]] and report["faces"] == [{"vertices": [0], "rays": [0]}]


def test_lcp_exact_proves_that_there_is_no_solution(tmp_path: Path) -> None:
    for flags in ([], ["--all"]):
        run = tumble("lcp", "-", "--exact", *flags, cwd=tmp_path, stdin="M\n1 -1\n-1 1\nq\n-1 -1\n")
        assert run.returncode == 3 and "infeasible" in run.stdout and "y                 1 1\n" in run.stdout
        run = tumble("lcp", "-", "--exact", "--json", *flags, cwd=tmp_path, stdin="M\n0 1\n0 0\nq\n-1 1\n")
        assert run.returncode == 3 and json.loads(run.stdout)["status"] == "no_solution_proved"


def test_lcp_exact_finds_what_lemke_misses(tmp_path: Path) -> None:
    game = "M\n0 0 10 30\n0 0 20 15\n10 30 0 0\n20 15 0 0\nq\n-1 -1 -1 -1\n"
    assert "1/10 0 1/10 0" in succeed("lcp", "-", "--exact", cwd=tmp_path, stdin=game)


def test_lcp_exact_names_its_limits(tmp_path: Path) -> None:
    def zeros(n: int) -> str:
        return "M\n" + ("0 " * n + "\n") * n + "q\n" + "1 " * n

    assert "at most 40 columns" in refuse("lcp", "-", "--exact", cwd=tmp_path, stdin=zeros(41))
    assert "at most 12 entries" in refuse("lcp", "-", "--exact", "--all", cwd=tmp_path, stdin=zeros(13))
    assert "exponent within +-1000" in refuse("lcp", "-", "--exact", cwd=tmp_path, stdin="M\n1e999999\nq\n1\n")
    assert "--method" in refuse("lcp", "-", "--exact", "--method", "lemke", cwd=tmp_path, stdin="M\n1\nq\n1\n")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "standard input:1:1: empty"),
        ("M\n1 2\n3\nq\n1 1\n", "standard input:3:1: M: row 2 must have 2 entries"),
        ("M\n1\nq\nx\n", "standard input:4:1: expected a number"),
        ("M\nnan\nq\n1\n", "standard input:2:1: must be finite"),
    ],
)
def test_lcp_refuses_bad_text_with_its_place(tmp_path: Path, text: str, message: str) -> None:
    assert message in refuse("lcp", "-", cwd=tmp_path, stdin=text)
    assert "at most 12" in refuse("lcp", "-", "--all", cwd=tmp_path, stdin="M\n" + ("0 " * 13 + "\n") * 13 + "q\n" + "1 " * 13)
