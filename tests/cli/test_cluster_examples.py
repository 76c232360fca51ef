"""The examples for clusters, without a cluster: they give the files of a single run."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from program import PROGRAM, ROOT, succeed

CLUSTER = ROOT / "examples/cluster"
RESULTS = ["columns.npz", "summary.csv", "summary.json", "overview.png"]
ENVIRONMENT = {**os.environ, "PATH": f"{PROGRAM.parent}:{os.environ['PATH']}"}


@pytest.fixture(scope="module")
def single(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a single run of the spec that the examples share."""
    folder = tmp_path_factory.mktemp("single")
    succeed("sweep", CLUSTER / "faces.toml", "-o", "one", "--quiet", cwd=folder)
    return folder / "one"


def assert_same_results(folder: Path, single: Path) -> None:
    for name in RESULTS:
        assert (folder / name).read_bytes() == (single / name).read_bytes(), name


def directives() -> dict[str, str]:
    """What the script asks of Slurm: {"array": "1-4", ...}."""
    lines = (CLUSTER / "sweep.slurm").read_text().splitlines()
    words = [line.removeprefix("#SBATCH --") for line in lines if line.startswith("#SBATCH ")]
    return dict(word.partition("=")[::2] for word in words)


@pytest.mark.parametrize("name", ["sweep.slurm", "sweep_mpi.sh"])
def test_scripts_are_valid(name: str) -> None:
    subprocess.run(["bash", "-n", str(CLUSTER / name)], check=True, timeout=60)


def test_slurm_tasks_are_the_shards(tmp_path: Path, single: Path) -> None:
    first, _, last = directives()["array"].partition("-")
    assert first == "1" and int(last) > 1
    for task in reversed(range(1, int(last) + 1)):
        slurm = {
            "SLURM_ARRAY_TASK_ID": str(task),
            "SLURM_ARRAY_TASK_COUNT": last,
            "SLURM_CPUS_PER_TASK": directives()["cpus-per-task"],
            "SPEC": str(CLUSTER / "faces.toml"),
            "FOLDER": "shared",
        }
        command = ["bash", str(CLUSTER / "sweep.slurm")]
        run = subprocess.run(
            command, cwd=tmp_path, env={**ENVIRONMENT, **slurm}, capture_output=True, text=True, timeout=60
        )
        assert run.returncode == 0 and run.stdout.startswith(f"shard {task} of {last}: "), run.stdout + run.stderr
    assert not (tmp_path / "shared/columns.npz").exists()
    succeed("sweep", "merge", "shared", "--quiet", cwd=tmp_path)
    assert_same_results(tmp_path / "shared", single)


def test_mpi_script_calls_mpirun(tmp_path: Path) -> None:
    """With an mpirun that only prints its words: whether MPI works is the matter of the test of `mpirun tumble sweep`."""
    mpirun = tmp_path / "mpirun"
    mpirun.write_text('#!/bin/sh\nprintf "%s\\n" "$*"\n')
    mpirun.chmod(0o755)
    environment = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}", "FOLDER": "out"}
    command = ["sh", str(CLUSTER / "sweep_mpi.sh")]
    run = subprocess.run([*command, "3", "--oversubscribe"], env=environment, capture_output=True, text=True, timeout=60)
    assert run.stdout == "-n 3 --bind-to none --oversubscribe tumble sweep faces.toml -o out\n", run.stderr
    run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60)
    assert run.returncode != 0 and run.stdout == "" and "how many processes" in run.stderr


def test_dask_processes_give_the_single_run(tmp_path: Path, single: Path) -> None:
    pytest.importorskip("distributed")
    command = [sys.executable, str(CLUSTER / "sweep_dask.py"), str(CLUSTER / "faces.toml"), "--folder", "shared"]
    run = subprocess.run(command, cwd=tmp_path, env=ENVIRONMENT, capture_output=True, text=True, timeout=60)
    assert run.returncode == 0 and "100 000 instances, 100 000 solved" in run.stdout, run.stderr
    succeed("sweep", "merge", "shared", "--quiet", cwd=tmp_path)
    assert_same_results(tmp_path / "shared", single)
