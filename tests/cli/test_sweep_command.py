"""`tumble sweep` as a user meets it: a spec in, columns out, whatever happens on the way."""

import json
import os
import random
import shutil
import signal
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import h5py
import numpy as np
import pytest
import tumble as tumble_package
from program import PROGRAM, refuse, succeed, tumble
from tumble import drop

SPEC = """
sweep = 1
seed = 7
samples = 200
chunk = 300
[start]
x = { uniform = [-1, 1] }
y = 1.4
theta = { uniform = ["0 deg", "360 deg"] }
omega = { normal = [0, 2] }
[parameters]
mu = { range = [0, 1, 5] }
eps = { normal = [0.8, 0.2] }
m = { log_uniform = [0.1, 10] }
l = { list = [0.1, 0.2] }
steps = 99
[measures]
rest_speed = 0.3
region = [-1, 1]
"""
NUM_CHUNKS = 7
RESULTS = ["chunks", "columns.npz", "spec.toml", "summary.csv", "summary.json", "overview.png"]
# Takes seconds on any machine, in many chunks.
LONG = SPEC.replace("samples = 200", "samples = 6000").replace("chunk = 300", "chunk = 2000").replace("99", "1500")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "drops.toml").write_text(SPEC)
    return tmp_path


def chunks_in(folder: Path) -> list[Path]:
    return sorted((folder / "chunks").glob("*.chunk"))


def test_columns_are_the_drops_of_the_spec(folder: Path) -> None:
    text = succeed("sweep", "drops.toml", cwd=folder)
    data = np.load(folder / "drops.sweep/columns.npz")
    assert "2 000 instances, " in text and text.startswith("x: -1 to 1 m, uniform\n")
    assert text.endswith("overview.png\n") and "wrote drops.sweep/columns.npz, drops.sweep/summary.csv, " in text
    assert str(data["spec"]) == SPEC and list(data["axes"]) == ["mu", "l"]
    assert np.array_equal(data["mu"], np.repeat([0, 0.25, 0.5, 0.75, 1], 400))
    assert np.array_equal(data["l"], np.tile(np.repeat([0.1, 0.2], 200), 5))
    assert float(data["y"]) == 1.4 and int(data["steps"]) == 99

    is_invalid = (data["eps"] < 0) | (data["eps"] > 1)
    assert 0 < is_invalid.sum() < 1000 and np.array_equal(data["status"] == 2, is_invalid)
    assert np.isnan(data["final_x"][is_invalid]).all() and (data["face"][is_invalid] == -1).all()
    assert json.loads((folder / "drops.sweep/summary.json").read_text())["invalid"] == is_invalid.sum()

    for i in np.flatnonzero(~is_invalid)[::97]:
        parameters = {name: float(data[name][i]) for name in ("mu", "eps", "m", "l")}
        parameters = drop.Parameters(columns=100, **parameters)
        q, v = drop.simulate([data["x"][i], 1.4, data["theta"][i]], [0, -0.2, data["omega"][i]], parameters)
        assert [data[f"final_{name}"][i] for name in ("x", "y", "theta")] == list(q[:, -1])
        outside = np.flatnonzero((q[0] < -1) | (q[0] > 1))
        assert data["escape_time"][i] == outside[0] * 0.01 if len(outside) else np.isnan(data["escape_time"][i])


def test_draws_are_those_of_numpys_philox(folder: Path) -> None:
    succeed("sweep", "drops.toml", "-o", "a.npz", cwd=folder)
    data = np.load(folder / "a.npz")
    for name, number, low, high in [("x", 0, -1.0, 1.0), ("theta", 2, 0.0, 2 * np.pi)]:
        words = [np.random.Philox(counter=[0, i, 0, 0], key=7).random_raw(number + 1)[number] for i in range(2000)]
        expected = low + (np.array(words) >> np.uint64(11)) * 2.0**-53 * (high - low)
        assert np.array_equal(data[name], expected)
    assert abs(data["omega"].mean()) < 4 * 2 / 2000**0.5
    assert data["m"].min() >= 0.1 and data["m"].max() <= 10


def test_h5_holds_the_same(folder: Path) -> None:
    report = json.loads(succeed("sweep", "drops.toml", "-o", "a.h5", "--json", cwd=folder))
    succeed("sweep", "drops.toml", "-o", "a.npz", "--quiet", cwd=folder)
    assert not (folder / "a.h5.chunks").exists() and sorted(os.listdir(folder)) == ["a.h5", "a.npz", "drops.toml"]
    archive = np.load(folder / "a.npz")
    assert report["solved"] == (archive["status"] == 0).sum() and report["files"] == ["a.h5"]
    with h5py.File(folder / "a.h5") as file:
        assert set(file) == set(archive) and file["max_impulse"].attrs["units"] == b"N s"
        for name in archive:
            if archive[name].dtype.kind in "fi":
                assert file[name].dtype == archive[name].dtype
                assert np.array_equal(file[name][()], archive[name], equal_nan=True)


@pytest.mark.parametrize("ending", ["npz", "h5"])
def test_shards_merge_to_the_file_of_the_single_run(folder: Path, ending: str) -> None:
    succeed("sweep", "drops.toml", "-o", f"single.{ending}", "--threads", 1, cwd=folder)
    for shard in (3, 1, 2):
        succeed("sweep", "drops.toml", "-o", "shared", "--shard", f"{shard}/3", cwd=folder)
        succeed("sweep", "drops.toml", "-o", f"own{shard}", "--shard", f"{shard}/3", "--threads", 3, cwd=folder)
        assert len(chunks_in(folder / f"own{shard}")) == {1: 3, 2: 2, 3: 2}[shard]
    succeed("sweep", "merge", "shared", "-o", f"a.{ending}", cwd=folder)
    succeed("sweep", "merge", "own2", "own3", "own1", "-o", f"b.{ending}", cwd=folder)
    expected = (folder / f"single.{ending}").read_bytes()
    assert (folder / f"a.{ending}").read_bytes() == expected
    assert (folder / f"b.{ending}").read_bytes() == expected


def test_merge_says_what_is_missing(folder: Path) -> None:
    succeed("sweep", "drops.toml", "-o", "own1", "--shard", "1/3", cwd=folder)
    succeed("sweep", "drops.toml", "-o", "own2", "--shard", "2/3", cwd=folder)
    error = refuse("sweep", "merge", "own1", "own2", "-o", "a.npz", cwd=folder)
    assert error == "tumble: own1: the sweep is not finished: of 7 chunks, 2 are missing: 2, 5\n"
    assert not (folder / "a.npz").exists()
    (folder / "drops.toml").write_text(SPEC.replace("seed = 7", "seed = 8"))
    succeed("sweep", "drops.toml", "-o", "own3", "--shard", "3/3", cwd=folder)
    assert refuse("sweep", "merge", "own1", "own2", "own3", cwd=folder) == "tumble: own3: holds another sweep than own1\n"
    assert refuse("sweep", "merge", ".", cwd=folder) == "tumble: .: is no folder of a sweep: it has no spec.toml\n"


def test_merge_replaces_only_results_of_its_sweep(folder: Path) -> None:
    succeed("sweep", "drops.toml", "-o", "own1", "--shard", "1/2", cwd=folder)
    refuse("sweep", "merge", "own1", "-o", "all", cwd=folder)
    assert not (folder / "all").exists()
    succeed("sweep", "drops.toml", "-o", "own2", "--shard", "2/2", cwd=folder)
    (folder / "mine").mkdir()
    (folder / "mine/summary.csv").write_text("mine")
    error = refuse("sweep", "merge", "own1", "own2", "-o", "mine", cwd=folder)
    assert error == "tumble: mine/summary.csv: already exists; --force replaces it\n"
    assert os.listdir(folder / "mine") == ["summary.csv"] and (folder / "mine/summary.csv").read_text() == "mine"
    succeed("sweep", "merge", "own1", "own2", "-o", "mine", "--force", cwd=folder)
    for _ in range(2):
        succeed("sweep", "merge", "own1", "own2", cwd=folder)
        succeed("sweep", "merge", "own1", "own2", "-o", "./own2/", cwd=folder)
    assert (folder / "mine/summary.csv").read_bytes() == (folder / "own2/summary.csv").read_bytes()


def test_a_rerun_computes_only_what_is_missing_or_damaged(folder: Path) -> None:
    succeed("sweep", "drops.toml", cwd=folder)
    results = folder / "drops.sweep/columns.npz"
    expected = results.read_bytes()
    files = chunks_in(folder / "drops.sweep")
    assert len(files) == NUM_CHUNKS
    damaged = bytearray(files[4].read_bytes())
    damaged[-9] ^= 1
    files[4].write_bytes(damaged)
    files[1].write_bytes(files[1].read_bytes()[:-1])
    files[5].unlink()
    results.unlink()
    before = {file: file.stat().st_mtime_ns for file in files if file.exists()}
    error = refuse("sweep", "merge", "drops.sweep", cwd=folder)
    assert "000001.chunk: is cut off, or too long; run the sweep or its shard again" in error

    run = tumble("sweep", "drops.toml", cwd=folder)
    assert run.returncode == 0
    assert run.stderr.splitlines() == [
        "tumble: drops.sweep/chunks/000001.chunk: is cut off, or too long; computed again",
        "tumble: drops.sweep/chunks/000004.chunk: is damaged: part 18 has another checksum; computed again",
    ]
    assert results.read_bytes() == expected
    changed = {file for file in files if before.get(file) != file.stat().st_mtime_ns}
    assert changed == {files[1], files[4], files[5]}


def test_another_sweep_in_the_folder_is_refused(folder: Path) -> None:
    succeed("sweep", "drops.toml", cwd=folder)
    before = (folder / "drops.sweep/columns.npz").read_bytes()
    (folder / "drops.toml").write_text("# A comment changes nothing.\n" + SPEC)
    succeed("sweep", "drops.toml", cwd=folder)
    (folder / "drops.toml").write_text(SPEC.replace("seed = 7", "seed = 8"))
    error = refuse("sweep", "drops.toml", cwd=folder)
    assert error == (
        "tumble: drops.sweep: holds another sweep: its spec.toml gives other results; --force replaces it\n"
    )
    (folder / "drops.sweep/letter.txt").write_text("Dear")
    succeed("sweep", "drops.toml", "--force", cwd=folder)
    assert (folder / "drops.sweep/columns.npz").read_bytes() != before
    assert sorted(os.listdir(folder / "drops.sweep")) == sorted([*RESULTS, "letter.txt"])
    (folder / "other").mkdir()
    (folder / "other/letter.txt").write_text("Dear")
    error = refuse("sweep", "drops.toml", "-o", "other", "--force", cwd=folder)
    assert error == "tumble: other: is a folder with other things than a sweep in it\n"
    assert os.listdir(folder / "other") == ["letter.txt"]


def test_bad_input_leaves_nothing_behind(folder: Path) -> None:
    (folder / "bad.toml").write_text(SPEC.replace("[0, 1, 5]", "[-1, 1, 5]"))
    assert refuse("sweep", "bad.toml", cwd=folder) == (
        "tumble: bad.toml:12:17: parameters.mu.range[0]: must be in [0, 1000000], got -1\n"
    )
    for word in ("0/3", "4/3", "1", "a/b", "1/0"):
        error = refuse("sweep", "drops.toml", "--shard", word, cwd=folder)
        assert error == f"tumble: --shard: must be I/N, 1 <= I <= N, got '{word}'\n"
    (folder / "a.npz").write_text("mine")
    assert "already exists; --force replaces it" in refuse("sweep", "drops.toml", "-o", "a.npz", cwd=folder)
    assert "folder" in refuse("sweep", "drops.toml", "-o", "b.npz", "--shard", "1/2", cwd=folder)
    assert refuse("sweep", "drops.toml", "--threads", "-1", cwd=folder).startswith("tumble: --threads: must be in [0, ")
    assert "spec" in refuse("sweep", cwd=folder)
    assert sorted(os.listdir(folder)) == ["a.npz", "bad.toml", "drops.toml"]


def start(folder: Path, *words: object) -> subprocess.Popen[str]:
    command = [str(PROGRAM), "sweep", "drops.toml", *(str(word) for word in words)]
    return subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def test_killed_at_any_moment_it_goes_on(folder: Path) -> None:
    (folder / "drops.toml").write_text(LONG)
    begin = time.monotonic()
    succeed("sweep", "drops.toml", "-o", "whole.npz", cwd=folder)
    duration = time.monotonic() - begin
    moments = random.Random(1)
    kept: dict[Path, int] = {}
    for _ in range(12):
        run = start(folder, "-o", "part")
        time.sleep(moments.uniform(0, 0.3 * duration))
        run.kill()
        run.communicate()
        now = {file: file.stat().st_mtime_ns for file in chunks_in(folder / "part")}
        assert kept.items() <= now.items()  # nothing that was finished is computed again
        kept = now
    assert kept
    succeed("sweep", "drops.toml", "-o", "part", cwd=folder)
    assert kept.items() <= {file: file.stat().st_mtime_ns for file in chunks_in(folder / "part")}.items()
    assert (folder / "part/columns.npz").read_bytes() == (folder / "whole.npz").read_bytes()
    assert sorted(os.listdir(folder / "part")) == sorted(RESULTS)


def test_ctrl_c_ends_it_and_leaves_a_folder_to_go_on_with(folder: Path) -> None:
    (folder / "drops.toml").write_text(LONG)
    run = start(folder, "-o", "part")
    while not chunks_in(folder / "part"):
        time.sleep(0.01)
    run.send_signal(signal.SIGINT)
    begin = time.monotonic()
    out, error = run.communicate(timeout=60)
    assert time.monotonic() - begin < 5
    assert run.returncode == 130 and out == ""
    assert error == "tumble: interrupted; the same call goes on with what is in part\n"
    kept = {file: file.stat().st_mtime_ns for file in chunks_in(folder / "part")}
    assert kept
    succeed("sweep", "drops.toml", "-o", "part", cwd=folder)
    assert kept.items() <= {file: file.stat().st_mtime_ns for file in chunks_in(folder / "part")}.items()


@contextmanager
def paused_run(folder: Path, target: str, chunks: str) -> Iterator[subprocess.Popen[str]]:
    """A run that stands still in the middle of its work during the block, and goes on then, unless it was killed."""
    run = start(folder, "-o", target)
    while not chunks_in(folder / chunks):
        assert run.poll() is None
        time.sleep(0.01)
    run.send_signal(signal.SIGSTOP)
    try:
        yield run
    finally:
        run.send_signal(signal.SIGCONT)


@pytest.mark.parametrize("ending", ["npz", "h5"])
def test_a_file_is_made_by_one_process_at_a_time(folder: Path, ending: str) -> None:
    (folder / "drops.toml").write_text(LONG)
    target = f"a.{ending}"
    with paused_run(folder, target, f"{target}.chunks") as run:
        busy = f"tumble: {target}.chunks: another process is at work in this folder\n"
        assert refuse("sweep", "drops.toml", "-o", target, cwd=folder) == busy
        assert refuse("sweep", "drops.toml", "-o", target, "--force", cwd=folder) == busy
        assert refuse("sweep", "merge", f"{target}.chunks", cwd=folder) == busy
    _, error = run.communicate(timeout=120)
    assert run.returncode == 0 and error == ""
    assert sorted(os.listdir(folder)) == sorted([target, "drops.toml"])

    (folder / target).unlink()
    with paused_run(folder, target, f"{target}.chunks") as run:
        run.kill()
        run.communicate()
    succeed("sweep", "drops.toml", "-o", target, cwd=folder)  # the lock has gone with its process
    assert sorted(os.listdir(folder)) == sorted([target, "drops.toml"])


def test_a_sweep_is_not_replaced_while_a_process_is_at_work_in_it(folder: Path) -> None:
    (folder / "other.toml").write_text(SPEC)
    (folder / "drops.toml").write_text(LONG)
    succeed("sweep", "drops.toml", "-o", "whole.npz", cwd=folder)
    with paused_run(folder, "part", "part") as run:
        error = refuse("sweep", "other.toml", "-o", "part", "--force", cwd=folder)
        assert error == "tumble: part: another process is at work in this folder\n"
        succeed("sweep", "drops.toml", "-o", "part", "--shard", "2/3", cwd=folder)  # the same sweep may be helped with
    _, error = run.communicate(timeout=120)
    assert run.returncode == 0 and error == ""
    assert (folder / "part/columns.npz").read_bytes() == (folder / "whole.npz").read_bytes()
    succeed("sweep", "other.toml", "-o", "part", "--force", cwd=folder)


def test_shards_replace_a_sweep_together(folder: Path) -> None:
    succeed("sweep", "drops.toml", "-o", "shared", cwd=folder)
    (folder / "drops.toml").write_text(SPEC.replace("seed = 7", "seed = 8"))
    succeed("sweep", "drops.toml", "-o", "whole.npz", cwd=folder)
    runs = [start(folder, "-o", "shared", "--force", "--shard", f"{shard}/6") for shard in range(1, 7)]
    for run in runs:
        assert run.communicate(timeout=120)[1] == "" and run.returncode == 0
    succeed("sweep", "merge", "shared", cwd=folder)
    assert (folder / "shared/columns.npz").read_bytes() == (folder / "whole.npz").read_bytes()


@pytest.mark.skipif(shutil.which("unshare") is None or os.geteuid() != 0, reason="needs a file system of its own")
def test_a_full_disk_is_reported_and_repaired(folder: Path) -> None:
    (folder / "drops.toml").write_text(LONG)
    succeed("sweep", "drops.toml", "-o", "whole.npz", cwd=folder)
    (folder / "disk").mkdir()
    script = (
        f"mount -t tmpfs -o size=1m none disk && {PROGRAM} sweep drops.toml -o disk/part; code=$?;"
        "ls disk/part/chunks | wc -l; mount -o remount,size=1g disk && "
        f"{PROGRAM} sweep drops.toml -o disk/part --quiet && cmp disk/part/columns.npz whole.npz && exit $code"
    )
    run = subprocess.run(["unshare", "-m", "sh", "-c", script], cwd=folder, capture_output=True, text=True, timeout=120)
    if "mount" in run.stderr:
        pytest.skip("may not mount")
    assert run.returncode == 2, run.stderr
    assert run.stderr.startswith("tumble: cannot write disk/part/chunks/0000")
    assert run.stderr.endswith("No space left on device\n") and run.stderr.count("\n") == 1
    assert int(run.stdout) >= 1


def test_statistics_alone_are_those_of_the_columns(folder: Path) -> None:
    succeed("sweep", "drops.toml", cwd=folder)
    (folder / "few.toml").write_text(SPEC.replace("seed = 7", 'seed = 7\nkeep = "statistics"'))
    text = succeed("sweep", "few.toml", cwd=folder)
    assert sorted(os.listdir(folder / "few.sweep")) == sorted([*RESULTS[2:], "chunks", "statistics.npz"])
    for name in ("summary.csv", "summary.json"):
        assert (folder / "few.sweep" / name).read_text() == (folder / "drops.sweep" / name).read_text()
    data = np.load(folder / "drops.sweep/columns.npz")
    statistics = np.load(folder / "few.sweep/statistics.npz")
    is_solved = data["status"] == 0
    rests = np.bincount(data["face"][is_solved & ~np.isnan(data["rest_time"])], minlength=4)
    assert statistics["statistics_outcomes"][:4].tolist() == rests.tolist()
    assert statistics["statistics_outcomes"].sum() == 2000 and "2 000 instances" in text
    assert statistics["statistics_mean"][0] == pytest.approx(data["final_x"][is_solved].mean(), rel=1e-12)

    for shard in (2, 1):
        succeed("sweep", "few.toml", "--shard", f"{shard}/2", "-o", f"few{shard}", "--threads", shard, cwd=folder)
    succeed("sweep", "merge", "few2", "few1", "-o", "all", cwd=folder)
    for name in sorted(os.listdir(folder / "all")):
        assert (folder / "all" / name).read_bytes() == (folder / "few.sweep" / name).read_bytes(), name


def test_the_memory_of_statistics_does_not_grow_with_the_sweep(folder: Path) -> None:
    def peak(samples: int) -> int:
        spec = SPEC.replace("samples = 200", f'samples = {samples}\nkeep = "statistics"').replace("chunk = 300\n", "")
        (folder / "drops.toml").write_text(spec.replace("steps = 99", "steps = 1"))
        code = (
            "import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True);"
            "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
        )
        command = ["/usr/bin/python3", "-c", code, str(PROGRAM), "sweep", "drops.toml", "-o", f"{samples}"]
        command += ["--threads", "1", "--quiet"]
        return int(subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True).stdout)

    assert peak(160_000) < peak(20_000) + 20_000  # kB; a column of the 1 400 000 more has 11 MB


BOX = """
tumble = 1
step_size = 0.005
duration = 0.8
[materials.wood]
[[bodies]]
name = "floor"
kind = "fixed"
shape = { half_plane = [0, 1] }
material = "wood"
[[bodies]]
shape = { disc = 0.1 }
mass = 0.1
position = [0.5, 0.3]
material = "wood"
[[bodies]]
name = "box"
shape = { square = 0.2 }
mass = 0.3
position = [0, 0.7]
velocity = [0.1, -0.2]
material = "wood"
"""
SCENE_SPEC = """
sweep = 1
scene = "box.toml"
samples = 100
chunk = 30
[bodies.box]
theta = { uniform = ["0 deg", "360 deg"] }
mass = { list = [0.2, 0.4] }
[bodies.body1]
vx = -1
[materials.wood]
friction = { uniform = [0, 1] }
restitution = { normal = [0.7, 0.3] }
[measures]
body = "box"
region = [-1, 0.5]
"""


def test_a_scene_is_swept_as_rollout_does(folder: Path) -> None:
    (folder / "boxes").mkdir()
    (folder / "boxes/box.toml").write_text(BOX)
    (folder / "boxes/boxes.toml").write_text(SCENE_SPEC)
    succeed("sweep", "boxes/boxes.toml", "-o", "all", cwd=folder)
    data = np.load(folder / "all/columns.npz")
    assert list(data["bodies.box.mass"]) == [0.2] * 100 + [0.4] * 100
    scene = tumble_package.Scene.parse(BOX)
    theta = data["bodies.box.theta"]
    poses = np.column_stack([np.zeros(200), np.full(200, 0.7), theta])
    result = tumble_package.rollout(
        scene, {"box": poses}, {1: (-1, 0, 0)}, mass={"box": data["bodies.box.mass"]},
        friction={"wood": data["materials.wood.friction"]}, restitution={"wood": data["materials.wood.restitution"]},
        region=(-1, 0.5), rest_speed=1e-3,
    )
    is_invalid = result.status == "bad_input"
    assert 0 < is_invalid.sum() < 100 and np.array_equal(data["status"] == 2, is_invalid)
    assert np.array_equal(data["final_x"], np.where(is_invalid, np.nan, result["box"].x), equal_nan=True)
    assert np.array_equal(data["escape_time"], result.escape_time, equal_nan=True)
    assert np.array_equal(data["impacts"][~is_invalid], result.impacts[~is_invalid])
    turns = np.round(result["box"].angle[~is_invalid] / (np.pi / 2)).astype(int) % 4
    assert np.array_equal(data["face"][~is_invalid], turns)

    for shard in (2, 1):
        succeed("sweep", "boxes/boxes.toml", "--shard", f"{shard}/2", "-o", f"part{shard}", cwd=folder)
    succeed("sweep", "merge", "part1", "part2", "-o", "merged", cwd=folder)
    for name in ("columns.npz", "summary.csv", "overview.png"):
        assert (folder / "merged" / name).read_bytes() == (folder / "all" / name).read_bytes()
    (folder / "boxes/box.toml").write_text(BOX.replace("0.005", "0.004"))
    assert "holds another sweep" in refuse("sweep", "boxes/boxes.toml", "-o", "all", cwd=folder)


@pytest.mark.parametrize(
    ("before", "after", "error"),
    [
        ("bodies.box]", "bodies.bx]", "boxes.toml:6:1: bodies.bx: must be a body of the scene that moves, got 'bx'; did you mean 'box'?"),
        ("bodies.box]", "bodies.floor]", "boxes.toml:6:1: bodies.floor: must be a body of the scene that moves, got 'floor'; allowed are body1, box"),
        ("materials.wood", "materials.woud", "boxes.toml:11:1: materials.woud: must be a material of the scene, got 'woud'; did you mean 'wood'?"),
        ("theta =", "angle =", "boxes.toml:7:1: bodies.box.'angle': unknown key; allowed are x, y, theta, vx, vy, omega, mass, moment_of_inertia"),
        ("mass = { list = [0.2,", "mass = { list = [0,", "boxes.toml:8:18: bodies.box.mass.list[0]: must be in [1e-60, 1e+60] kg, got 0"),
        ('body = "box"', 'body = "boxy"', "boxes.toml:15:8: measures.body: must be a body of the scene that moves, got 'boxy'; did you mean 'box'?"),
        ("[bodies.box]", "[start]", "boxes.toml:6:2: 'start': unknown key; allowed are sweep, title, seed, samples, chunk, keep, measures, scene, bodies, materials, gravity"),
        ('"box.toml"', '"none.toml"', "cannot read none.toml: No such file or directory"),
    ],
)  # fmt: skip
def test_errors_in_the_sweep_of_a_scene(folder: Path, before: str, after: str, error: str) -> None:
    (folder / "box.toml").write_text(BOX)
    (folder / "boxes.toml").write_text(SCENE_SPEC.replace(before, after))
    assert refuse("sweep", "boxes.toml", cwd=folder) == f"tumble: {error}\n"
    assert not (folder / "boxes.sweep").exists()


MPI_ENVIRONMENT = {
    **os.environ,
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
}


def mpirun(program: Path, *words: object, cwd: Path) -> subprocess.CompletedProcess[str]:
    command = ["mpirun", "-n", "3", str(program), "sweep", *(str(word) for word in words)]
    return subprocess.run(command, cwd=cwd, env=MPI_ENVIRONMENT, capture_output=True, text=True, timeout=120)


def test_a_program_without_mpi_says_so_under_mpirun(folder: Path) -> None:
    run = mpirun(PROGRAM, "drops.toml", "-o", "many", cwd=folder)
    assert run.returncode != 0 and "tumble: this build has no MPI: build with -DTUMBLE_MPI=ON" in run.stderr
    assert not (folder / "many").exists()


def test_mpirun_hands_chunks_out(folder: Path) -> None:
    program = PROGRAM.with_name("tumble_mpi")
    run = mpirun(program, "drops.toml", "-o", "many", cwd=folder)
    assert run.returncode == 0, run.stderr
    succeed("sweep", "drops.toml", "-o", "one", cwd=folder)
    assert len(chunks_in(folder / "many")) == NUM_CHUNKS
    for name in RESULTS[1:]:
        assert (folder / "many" / name).read_bytes() == (folder / "one" / name).read_bytes()
    assert mpirun(program, "drops.toml", "-o", "many.npz", cwd=folder).returncode == 0  # one lock for all processes
    assert (folder / "many.npz").read_bytes() == (folder / "one/columns.npz").read_bytes()
    chunks_in(folder / "many")[3].unlink()
    run = mpirun(program, "drops.toml", "-o", "many", "--quiet", cwd=folder)
    assert run.returncode == 0 and run.stdout == "" and len(chunks_in(folder / "many")) == NUM_CHUNKS

    (folder / "drops.toml").write_text(SPEC.replace("seed = 7", "seed = 8"))
    run = mpirun(program, "drops.toml", "-o", "many", cwd=folder)
    error = "tumble: many: holds another sweep: its spec.toml gives other results; --force replaces it\n"
    assert run.returncode != 0 and error in run.stderr
    (folder / "drops.toml").write_text(LONG)
    process = subprocess.Popen(["mpirun", "-n", "3", str(program), "sweep", "drops.toml", "-o", "part"], cwd=folder, env=MPI_ENVIRONMENT)
    while not chunks_in(folder / "part"):
        time.sleep(0.01)
    process.kill()
    process.wait()
    succeed("sweep", "drops.toml", "-o", "part", cwd=folder)
    succeed("sweep", "drops.toml", "-o", "whole", cwd=folder)
    assert (folder / "part/columns.npz").read_bytes() == (folder / "whole/columns.npz").read_bytes()
