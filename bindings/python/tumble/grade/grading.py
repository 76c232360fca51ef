"""Grade a submission, or a folder of them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from types import ModuleType
from typing import Any

from tumble import drop
from tumble.course import FILES
from tumble.grade.checks import part_1, part_2, part_3, part_4
from tumble.grade.inject import Conventions, to_student_J
from tumble.grade.judge import Case, Evidence, PartResult, judge
from tumble.grade.parameters import DEFAULTS
from tumble.grade.sandbox import Job, Observation, StudentProcess, scratch_folder, temporary_folder

PARTS = (part_1, part_2, part_3, part_4)
MAXIMUM = sum(part.MAXIMUM for part in PARTS)
SECONDS = 10.0

_LARGEST_SUBMISSION = 1_000_000
_SUBMISSION = "assignment_3.py"
_OUR_FILES = {name for name in FILES if name != _SUBMISSION}
# Functions that must be right for a part to be judged on its own.
_REPLACED: dict[int, tuple[str, ...]] = {
    1: (),
    2: ("get_contacts", "solve_LCP"),
    3: ("get_contacts", "form_lcp", "solve_LCP"),
    4: ("get_contacts", "form_lcp", "solve_LCP", "step"),
}
# Calls made a second time, to see whether the answers depend on what was called before.
_REPEATS = 3


@dataclass
class Grade:
    """The result of one submission.

    Attributes
    ----------
    name : str
        File name, or the folder's for submissions in folders of their own.
    parts : list of PartResult
    parameters : dict
        For each parameter "value" and "name", see `tumble.grade.parameters.read_parameters`.
    problem : str
        Why the submission could not be loaded, or "".
    notes : list of str
        Remarks that cost nothing.
    doubts : list of str
        Reasons for the teacher not to take the points as they are.
    """

    name: str
    parts: list[PartResult] = field(default_factory=list)
    parameters: dict[str, dict[str, Any]] = field(default_factory=dict)
    problem: str = ""
    notes: list[str] = field(default_factory=list)
    doubts: list[str] = field(default_factory=list)

    @property
    def points(self) -> float:
        """Out of `MAXIMUM`."""
        return round(sum(part.points for part in self.parts), 1)


def grade_file(path: str | os.PathLike[str], seconds: float = SECONDS) -> Grade:
    """Grade one submission.

    Parameters
    ----------
    path : path
        The student's file.
    seconds : float
        Time for each part [s].

    Returns
    -------
    Grade
        Also for a file that is broken in any way: its `problem` says how.

    Raises
    ------
    OSError
        If the file cannot be read.
    SandboxError
        If no process for student code can be started.
    """
    with temporary_folder() as cache:
        return _grade(Path(path), Path(path).name, cache, seconds)


def grade_folder(path: str | os.PathLike[str], seconds: float = SECONDS) -> list[Grade]:
    """Grade every submission in a folder: its Python files, and assignment_3.py in each of its folders.

    Parameters
    ----------
    path : path
    seconds : float
        Time for each part of each submission [s].

    Returns
    -------
    list of Grade
        In the order of their names. A folder without a submission has a grade too, with a `problem`.

    Raises
    ------
    OSError
        If the folder cannot be read.
    SandboxError
        If no process for student code can be started.
    """
    submissions = find_submissions(Path(path))

    def grade(submission: tuple[str, Path | None], cache: Path) -> Grade:
        name, file = submission
        if file is None:
            return Grade(name, _empty_parts(), problem=f"no {_SUBMISSION} in this folder")
        try:
            return _grade(file, name, cache, seconds)
        except OSError as error:
            return Grade(name, _empty_parts(), problem=f"cannot be read: {error.strerror}")

    with temporary_folder() as cache, ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
        return list(pool.map(lambda submission: grade(submission, cache), submissions))


def find_submissions(folder: Path) -> list[tuple[str, Path | None]]:
    """The submissions in a folder as names and files; None where a folder holds none or several."""
    found: list[tuple[str, Path | None]] = []
    for entry in sorted(folder.iterdir()):
        if entry.name.startswith((".", "__")):
            continue
        if entry.is_dir():
            # Course systems rename files on a second upload: assignment_3-1.py.
            named = (
                [entry / _SUBMISSION]
                if (entry / _SUBMISSION).is_file()
                else sorted(entry.glob("assignment_3*.py"))
            )
            named = [file for file in named if file.name not in _OUR_FILES and file.is_file()]
            found.append((entry.name, named[0] if len(named) == 1 else None))
        elif entry.suffix == ".py" and entry.is_file() and entry.name not in _OUR_FILES:
            found.append((entry.name, entry))
    return found


def _grade(path: Path, name: str, cache: Path, seconds: float) -> Grade:
    with path.open("rb") as file:
        source = file.read(_LARGEST_SUBMISSION + 1)
    grade = Grade(name, _empty_parts())
    grade.problem = _problem_of_source(source)
    if grade.problem:
        return grade
    conventions: Conventions = {}
    for index, part in enumerate(PARTS):
        # A folder of its own for each part: code may delete or change what it finds.
        with scratch_folder(source) as scratch, StudentProcess(scratch, cache, seconds) as process:
            module = process.load()
            if module is None:
                return _not_loaded(grade, index, process.end)
            grade.parameters = module["parameters"]
            if index == 0:
                grade.notes, grade.doubts = module["notes"], module["doubts"]
            grade.parts[index] = _grade_part(part, process, module, conventions)
            conventions.update(grade.parts[index].conventions)
    grade.doubts += _hidden_by_parameters(grade.parameters)
    if printing := [part.FUNCTION for part, result in zip(PARTS, grade.parts) if result.prints]:
        grade.notes.append(
            f"{', '.join(printing)}: prints; that costs nothing, but remove it before you hand in"
        )
    return grade


def _problem_of_source(source: bytes) -> str:
    if not source.strip():
        return "the file is empty"
    if len(source) > _LARGEST_SUBMISSION:
        return f"the file is larger than {_LARGEST_SUBMISSION} bytes"
    if b"\0" in source:
        return "the file is not Python source: it holds bytes that are no text"
    if source.lstrip().startswith(b"{") and b'"cells"' in source:
        return "the file is a Jupyter notebook; save it as a Python script"
    return ""


def _hidden_by_parameters(parameters: dict[str, dict[str, Any]]) -> list[str]:
    """What a parameter of 0 keeps the checks from seeing; the submission is graded with its own values."""
    hidden = {"mu": "friction", "eps": "restitution", "delta": "the lift"}
    return [
        f"{key} = 0 in this file: mistakes about {what} cannot be seen, the points say nothing about it"
        for key, what in hidden.items()
        if parameters.get(key, {}).get("value") == 0.0
    ]


def _not_loaded(grade: Grade, index: int, reason: str) -> Grade:
    if index == 0:
        grade.problem = f"the file cannot be imported: {reason}"
    else:
        for part in grade.parts[index:]:
            part.mistakes.append(f"the file could not be imported again: {reason}")
    return grade


def _empty_part(part: ModuleType) -> PartResult:
    return PartResult(part.NUMBER, part.TITLE, part.MAXIMUM)


def _empty_parts() -> list[PartResult]:
    return [_empty_part(part) for part in PARTS]


def _grade_part(
    part: ModuleType, process: StudentProcess, module: dict[str, Any], conventions: Conventions
) -> PartResult:
    result = _empty_part(part)
    function = module["functions"].get(part.FUNCTION)
    if function is None:
        similar = module["similar"].get(part.FUNCTION)
        hint = f"; is {similar} the one? Rename it" if similar else ""
        result.mistakes.append(f"there is no function {part.FUNCTION}{hint}")
        return result
    values = {key: module["parameters"][key]["value"] for key in DEFAULTS}
    call = _Caller(part, process, function, values)
    best = call.judge(_REPLACED[part.NUMBER], {})
    if best.points < part.MAXIMUM and conventions and part.NUMBER > 1:
        best = _better(
            best, call.judge(_REPLACED[part.NUMBER], conventions), "taking over the form of your other parts"
        )
    if best.points < part.MAXIMUM and part.NUMBER > 2:
        best = _better(best, call.judge((), {}), "together with your own other functions")
    return best


def _better(first: PartResult, second: PartResult, words: str) -> PartResult:
    """The one with more points: a deviation that other parts make up for must not cost points twice."""
    if second.points <= first.points:
        return first
    second.notes.append(f"judged {words}, which gives more points")
    return second


@lru_cache(maxsize=16)
def _cases(part: ModuleType, values: tuple[tuple[str, float], ...]) -> list[Case]:
    """The states of a part. Most submissions of a course have the same parameters, and finding states takes time."""
    cases: list[Case] = part.cases(drop.Parameters(**dict(values)))  # type: ignore[arg-type]
    return cases


class _Caller:
    """Calls the function of a part under different circumstances and judges the results."""

    def __init__(
        self, part: ModuleType, process: StudentProcess, function: str, values: dict[str, float]
    ) -> None:
        self.part = part
        self.process = process
        self.function = function
        self.values = values
        self.params = drop.Parameters(**values)  # type: ignore[arg-type]
        self.cases = _cases(part, tuple(values.items()))
        self.injected: list[Observation] = []

    def judge(self, replaced: tuple[str, ...], conventions: Conventions) -> PartResult:
        """The result with some of the student's functions replaced by ours in these conventions."""
        jobs = [Job(self._arguments(case, conventions), case.phi) for case in self.cases]
        count = len(jobs)
        observations = self.process.call(
            self.function, jobs + jobs[:_REPEATS], self.values, replaced, conventions
        )
        repeats = [] if self.process.end else list(enumerate(observations[count:]))
        observations = observations[:count]
        if replaced:
            self.injected = observations
        evidence = self._evidence(observations, repeats)
        return judge(
            _empty_part(self.part),
            evidence,
            self.part.readings(),
            self.part.items(self.params),
            self.part.variants(self.params),
        )

    def _arguments(self, case: Case, conventions: Conventions) -> tuple[Any, ...]:
        if self.part is not part_2:
            return case.arguments
        return (to_student_J(case.arguments[0], conventions), *case.arguments[1:])

    def _evidence(
        self, observations: Sequence[Observation], repeats: list[tuple[int, Observation]]
    ) -> Evidence:
        """Cases with a distance of ours say something only if the student's function asked our get_contacts for it."""
        kept = [
            (case, observation if case.phi is None else injected)
            for case, observation, injected in zip(self.cases, observations, self.injected or observations)
            if case.phi is None or "get_contacts" in injected.used or injected.error
        ]
        return Evidence([case for case, _ in kept], [observation for _, observation in kept], repeats)
