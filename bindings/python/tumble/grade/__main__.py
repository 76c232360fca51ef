"""The command line of `tumble.grade`. Exit codes: 0 graded, 1 the grader cannot work, 2 bad input."""

from __future__ import annotations

import argparse
import json
import os
import sys
from pathlib import Path

from tumble.grade.grading import SECONDS, Grade, grade_file, grade_folder
from tumble.grade.report import as_csv, as_json, as_table, as_text
from tumble.grade.sandbox import SandboxError

_MOST_SECONDS = 3600.0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python3 -m tumble.grade",
        description="Grades solutions of the assignment: points out of 100, with the likely mistakes.",
        epilog="Exit codes: 0 graded, whatever the points; 1 the grader itself cannot work; 2 bad input.",
    )
    parser.add_argument(
        "path", metavar="PATH", help="a solution, or a folder: files *.py, folders with assignment_3.py"
    )
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    parser.add_argument("--csv", metavar="FILE", help="write a table for a spreadsheet too")
    parser.add_argument(
        "--seconds",
        type=float,
        default=SECONDS,
        help="time for each of the four parts [s], > 0 (default %(default)g)",
    )
    return parser


def _grades(options: argparse.Namespace) -> list[Grade]:
    if not 0.0 < options.seconds <= _MOST_SECONDS:
        raise ValueError(f"--seconds: must be a number > 0 and at most {_MOST_SECONDS:g}, got {options.seconds}")
    path = Path(options.path)
    if not path.exists():
        raise ValueError(f"{path}: no such file or folder")
    if path.is_dir():
        grades = grade_folder(path, options.seconds)
        if not grades:
            raise ValueError(f"{path}: holds no submission, neither *.py nor folders")
        return grades
    if not path.is_file():
        raise ValueError(f"{path}: is neither a file nor a folder")
    return [grade_file(path, options.seconds)]


def _write_csv(path: Path, text: str) -> None:
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        part.write_text(text, encoding="utf-8", errors="backslashreplace")  # file names may hold any byte
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def main(arguments: list[str] | None = None) -> int:
    """Run the command line; returns the exit code."""
    options = _parser().parse_args(arguments)
    try:
        grades = _grades(options)
        if options.csv:
            _write_csv(Path(options.csv), as_csv(grades))
    except (ValueError, OSError) as error:
        print(f"tumble.grade: {error}", file=sys.stderr)
        return 2
    except SandboxError as error:
        print(f"tumble.grade: {error}", file=sys.stderr)
        return 1
    is_folder = Path(options.path).is_dir()
    if options.json:
        report = {"submissions": [as_json(grade) for grade in grades]} if is_folder else as_json(grades[0])
        text = json.dumps(report, indent=2)
    else:
        text = as_table(grades) if is_folder else as_text(grades[0])
    try:
        sys.stdout.buffer.write((text + "\n").encode(sys.stdout.encoding or "utf-8", errors="backslashreplace"))
        sys.stdout.flush()
    except OSError as error:
        print(f"tumble.grade: standard output could not be written: {error.strerror}", file=sys.stderr)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # or the interpreter complains once more at its end
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
