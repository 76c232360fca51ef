"""`tumble doctor`: versions, and whether numbers come out as everywhere."""

import json
import os

import pytest

from program import ROOT, tumble

GOLDEN = dict(line.split() for line in (ROOT / "tests/determinism/golden.txt").read_text().splitlines())


def test_text() -> None:
    run = tumble("doctor", cwd=ROOT)
    assert run.returncode == 0 and run.stderr == ""
    words = [line.split() for line in run.stdout.splitlines()]
    assert ["tumble", "0.1.0"] in words and ["zlib", "cairo", "giflib", "HDF5"] == [line[0] for line in words[2:6]]
    hashes = [line[2] for line in words if line[:2] == ["reference", "run"]]
    assert len(hashes) >= 2 and set(hashes) == {GOLDEN["batches"]}


def test_json() -> None:
    report = json.loads(tumble("doctor", "--json", cwd=ROOT).stdout)
    assert report["version"] == "0.1.0" and report["cores"] >= 1
    assert report["reference_hash"] == GOLDEN["batches"]
    assert set(report["hashes"].values()) == {GOLDEN["batches"]} and "scalar" in report["hashes"]
    assert report["instruction_set"] in report["hashes"]


@pytest.mark.parametrize("name", ["scalar", "sse2"])
def test_the_environment_picks_the_instruction_set(name: str) -> None:
    report = json.loads(tumble("doctor", "--json", cwd=ROOT, env={**os.environ, "TUMBLE_INSTRUCTION_SET": name}).stdout)
    assert report["instruction_set"] == name


def test_an_instruction_set_that_is_not_there() -> None:
    run = tumble("doctor", cwd=ROOT, env={**os.environ, "TUMBLE_INSTRUCTION_SET": "avx9000"})
    assert run.returncode == 2 and run.stdout == ""
    assert run.stderr.startswith("tumble: TUMBLE_INSTRUCTION_SET: must be one of scalar, ") and run.stderr.count("\n") == 1
