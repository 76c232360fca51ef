"""The autograder of the assignment: ``python3 -m tumble.grade assignment_3.py``.

Every part is judged on its own: while one function of the student runs, the others are replaced by correct ones with
the student's parameters. The points of each part are split in `tumble.grade.checks`. Student code runs in processes of
its own with limits on time, memory and files; that guards against accidents, not against malice.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tumble.grade.grading import MAXIMUM, SECONDS, Grade, grade_file, grade_folder

__all__ = ["MAXIMUM", "SECONDS", "Grade", "grade_file", "grade_folder"]


def __getattr__(name: str) -> Any:
    # Loaded on demand, because the processes that run student code start often and need none of it.
    if name in __all__:
        from tumble.grade import grading

        return getattr(grading, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
