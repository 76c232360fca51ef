"""Calls the program `tumble` and reads what it wrote."""

import csv
import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("TUMBLE_BUILD", ROOT / "build")).resolve() / "bin/tumble"


def tumble(*words: object, cwd: Path, stdin: str = "", **options: object) -> subprocess.CompletedProcess[str]:
    command = [str(PROGRAM), *(str(word) for word in words)]
    return subprocess.run(command, cwd=cwd, input=stdin, capture_output=True, text=True, timeout=120, **options)


def succeed(*words: object, cwd: Path, stdin: str = "") -> str:
    run = tumble(*words, cwd=cwd, stdin=stdin)
    assert run.returncode == 0 and run.stderr == "", run.stderr
    return run.stdout


def refuse(*words: object, cwd: Path, stdin: str = "", code: int = 2) -> str:
    """The error text of a call that must fail: one line on standard error, nothing on standard output."""
    run = tumble(*words, cwd=cwd, stdin=stdin)
    assert run.returncode == code, run.stdout + run.stderr
    assert run.stdout == "" and run.stderr.count("\n") == 1 and run.stderr.startswith("tumble: "), run.stderr
    return run.stderr


def rows_of(path: Path) -> list[dict[str, str]]:
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))
