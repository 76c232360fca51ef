"""Examples print the same from C++ and Python; the checks of includes and documentation find no fault."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("TUMBLE_BUILD", ROOT / "build")).resolve()
NAMES = sorted(file.stem for file in (ROOT / "examples").glob("*.cpp"))


def run(command: list[str]) -> str:
    environment = {**os.environ, "PYTHONPATH": str(BUILD / "python")}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_every_example_has_a_twin() -> None:
    assert NAMES and NAMES == sorted(file.stem for file in (ROOT / "examples").glob("*.py"))


@pytest.mark.parametrize("name", NAMES)
def test_twins_print_the_same(name: str) -> None:
    printed = run([str(BUILD / "examples" / name)])
    assert printed and printed == run([sys.executable, str(ROOT / "examples" / f"{name}.py")])


@pytest.mark.parametrize("script", ["check_includes.py", "check_docs.py"])
def test_check_finds_no_fault(script: str) -> None:
    run([sys.executable, str(ROOT / "scripts" / script)])
