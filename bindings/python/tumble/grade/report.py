"""Grades as text, JSON and CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from typing import Any

from tumble.grade.grading import MAXIMUM, Grade
from tumble.grade.judge import PartResult
from tumble.grade.parameters import DEFAULTS


def as_text(grade: Grade) -> str:
    """A report for people.

    Parameters
    ----------
    grade : Grade

    Returns
    -------
    str
        Several lines, without a newline at the end.
    """
    lines = [f"{grade.name}: {grade.points:g} of {MAXIMUM:g} points"]
    if grade.problem:
        return "\n".join([*lines, f"  {grade.problem}"])
    lines.append(f"  {_parameter_line(grade)}")
    lines += [f"  doubt: {doubt}" for doubt in grade.doubts]
    lines += [f"  note: {note}" for note in grade.notes]
    for part in grade.parts:
        lines += _part_lines(part)
    return "\n".join(lines)


def _parameter_line(grade: Grade) -> str:
    found = ", ".join(f"{key} = {entry['value']:g}" for key, entry in grade.parameters.items())
    missing = [key for key, entry in grade.parameters.items() if entry["name"] is None]
    changed = [key for key, entry in grade.parameters.items() if entry["value"] != DEFAULTS[key]]
    line = f"parameters: {found}"
    if missing:
        line += f"; not found in the file, so the document's: {', '.join(missing)}"
    if changed:
        line += f"; other than the document's: {', '.join(changed)}"
    return line


def _part_lines(part: PartResult) -> list[str]:
    lines = ["", f"  Part {part.number}, {part.title}: {part.points:g} of {part.maximum:g}"]
    if 0.0 < part.points < part.maximum:
        for item in part.items:
            lines.append(
                f"    {item.points:5.1f} of {item.maximum:<3g} {item.name} ({item.passed} of {item.total} checks)"
            )
    lines += ["    most likely:"] if part.mistakes else []
    lines += [f"    - {mistake}" for mistake in part.mistakes]
    lines += [f"    note: {note}" for note in part.notes]
    return lines


def as_json(grade: Grade) -> dict[str, Any]:
    """A report for programs.

    Parameters
    ----------
    grade : Grade

    Returns
    -------
    dict
        name, points, maximum, problem (None if the file could be imported), parameters, doubts, notes, and parts with
        their number, title, points, maximum, items, mistakes and notes.
    """
    return {
        "name": grade.name,
        "points": grade.points,
        "maximum": MAXIMUM,
        "problem": grade.problem or None,
        "parameters": grade.parameters,
        "doubts": grade.doubts,
        "notes": grade.notes,
        "parts": [_part_as_json(part) for part in grade.parts],
    }


def _part_as_json(part: PartResult) -> dict[str, Any]:
    return {
        "number": part.number,
        "title": part.title,
        "points": part.points,
        "maximum": part.maximum,
        "items": [
            {
                "name": item.name,
                "points": round(item.points, 3),
                "maximum": item.maximum,
                "passed": item.passed,
                "total": item.total,
            }
            for item in part.items
        ],
        "mistakes": part.mistakes,
        "notes": part.notes,
    }


def as_table(grades: Sequence[Grade]) -> str:
    """One row per submission, with its points and the first thing to look at.

    Parameters
    ----------
    grades : sequence of Grade

    Returns
    -------
    str
        Lines of text, without a newline at the end.
    """
    width = max((len(grade.name) for grade in grades), default=0)
    header = f"{'submission':<{max(width, 10)}}  points  part 1  part 2  part 3  part 4  doubt or first mistake"
    rows = [
        f"{grade.name:<{max(width, 10)}}  {grade.points:6.1f}"
        + "".join(f"  {part.points:6.1f}" for part in grade.parts)
        + f"  {_first_remark(grade)}"
        for grade in grades
    ]
    return "\n".join(row.rstrip() for row in [header, *rows])


def as_csv(grades: Sequence[Grade]) -> str:
    """The table for a spreadsheet: name, points, points of the parts, all mistakes, all doubts.

    Parameters
    ----------
    grades : sequence of Grade

    Returns
    -------
    str
        With a newline at the end.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["name", "points", "part_1", "part_2", "part_3", "part_4", "mistakes", "doubts"])
    for grade in grades:
        points = [grade.points, *(part.points for part in grade.parts)]
        writer.writerow([grade.name, *points, "; ".join(_mistakes(grade)), "; ".join(grade.doubts)])
    return text.getvalue()


def _mistakes(grade: Grade) -> list[str]:
    if grade.problem:
        return [grade.problem]
    return [f"part {part.number}: {mistake}" for part in grade.parts for mistake in part.mistakes]


def _first_remark(grade: Grade) -> str:
    return next(iter([*(f"doubt: {doubt}" for doubt in grade.doubts), *_mistakes(grade)]), "")
