"""Points and likely mistakes of one part, from what the student's function returned.

A part has items, the sub-points of the assignment. An item compares one quantity of the student's results with the
right one, state by state, and gives its points in proportion to the states that are right. A wrong item is then
compared with the same quantity of deliberately wrong solutions: the one that agrees in every state names the mistake.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from tumble.grade.codec import Array, Other, describe
from tumble.grade.inject import Conventions
from tumble.grade.sandbox import Observation

# Right solutions differ by round-off alone: 1e-15 of the numbers involved, 1e-12 after an inverse or an own LCP solver.
# The smallest mistake worth a name changes a result by 1e-4 of its size. Anything between separates the two.
TOLERANCE = 1e-9
# Round-off of single precision is 1e-7 of the numbers involved; angles of some turns make it 1e-5 of an item's scale.
SINGLE_TOLERANCE = 2e-5
# A result this near the right one was computed with a rounded constant.
_NEARLY = 5e-3
# Points for handing over results as documented; the rest of a part is for the values.
FORM_POINTS = 3.0

Output = tuple[Array, ...]


@dataclass(frozen=True)
class Case:
    """A state to grade in.

    Attributes
    ----------
    arguments : tuple of ndarray
        Of the student's function.
    truth : tuple of ndarray
        The right results.
    tags : tuple of str
        What is special about the state, to end the sentence "wrong only where ...".
    data : dict
        Further numbers for items and wrong solutions.
    phi : float or None
        What our `get_contacts` returns for the distance [m] instead of the true one.
    """

    arguments: tuple[Array, ...]
    truth: Output
    tags: tuple[str, ...] = ()
    data: dict[str, Any] = field(default_factory=dict)
    phi: float | None = None

    def __str__(self) -> str:
        return ", ".join(_numbers(argument) for argument in self.arguments)


@dataclass(frozen=True)
class Item:
    """A sub-point: a quantity, None where a state has no such quantity, and the size of its numbers.

    With `entrywise` each entry of the quantity earns its share of the points, else each state. `hint` words a mistake
    that no wrong solution explains; "" if there is nothing to add.
    """

    name: str
    points: float
    quantity: Callable[[Case, Output], Array | None]
    scale: float
    entrywise: bool = False
    hint: Callable[[Case, Output], str] | None = None


@dataclass(frozen=True)
class Variant:
    """A wrong solution and the words for its mistake, with the conventions that it implies for other parts."""

    message: str
    solve: Callable[[Case], Output]
    conventions: Conventions = field(default_factory=dict)


@dataclass(frozen=True)
class Reading:
    """A way to understand a result. Returns the numbers, or None, and what is wrong with the form, or "".

    The first reading of a part is the documented one; the others have a message that names the deviation.
    """

    read: Callable[[Any], tuple[Output | None, str]]
    message: str = ""
    conventions: Conventions = field(default_factory=dict)


@dataclass(frozen=True)
class ItemResult:
    """Points of an item, with the number of checks passed and made."""

    name: str
    points: float
    maximum: float
    passed: int
    total: int


@dataclass
class PartResult:
    """Points of a part with the reasons; `conventions` are those that the student's function turned out to have."""

    number: int
    title: str
    maximum: float
    items: list[ItemResult] = field(default_factory=list)
    mistakes: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    conventions: Conventions = field(default_factory=dict)
    prints: bool = False

    @property
    def points(self) -> float:
        """Points to one decimal, rounded down, so that full points mean that everything is right."""
        return math.floor(10.0 * sum(item.points for item in self.items) + 1e-6) / 10.0


@dataclass(frozen=True)
class Evidence:
    """All that is known about a student's function: one observation per case, and some cases once more."""

    cases: Sequence[Case]
    observations: Sequence[Observation]
    repeats: Sequence[tuple[int, Observation]]


def judge(
    result: PartResult,
    evidence: Evidence,
    readings: Sequence[Reading],
    items: Sequence[Item],
    variants: Sequence[Variant],
) -> PartResult:
    """Fill a part's result.

    Parameters
    ----------
    result : PartResult
        With number, title and maximum.
    evidence : Evidence
    readings : sequence of Reading
        The one that gives most points is taken.
    items : sequence of Item
    variants : sequence of Variant

    Returns
    -------
    PartResult
        The same object.
    """
    score, reading = _best_score(evidence, readings, items, TOLERANCE)
    loose, loose_reading = _best_score(evidence, readings, items, SINGLE_TOLERANCE)
    if _is_single_precision(score, loose):
        score, reading = loose, loose_reading
        result.notes.append("some numbers are right to 5 digits only, from single precision (float32) or a rounded constant")
    result.items = [_form_item(FORM_POINTS, evidence, reading, score), *score.items]
    result.conventions = dict(reading.conventions)
    result.mistakes = [
        *_form_mistakes(evidence, reading, score),
        *_errors(evidence),
        *_not_finite(evidence, score),
        *_likely_mistakes(evidence, score, items, variants, result.conventions),
    ]
    result.prints = any(observation.printed for observation in evidence.observations)
    return result


@dataclass(frozen=True)
class _Score:
    """Values read from the observations. `right[i][k]` tells if item i is right in case k; None if it has no such."""

    tolerance: float
    outputs: list[Output | None]
    problems: list[str]
    right: list[list[bool | None]]
    items: list[ItemResult]


def _best_score(
    evidence: Evidence, readings: Sequence[Reading], items: Sequence[Item], tolerance: float
) -> tuple[_Score, Reading]:
    scores = [_score(evidence, reading, items, tolerance) for reading in readings]
    best = max(range(len(readings)), key=lambda k: (sum(item.points for item in scores[k].items), -k))
    return scores[best], readings[best]


def _is_single_precision(score: _Score, loose: _Score) -> bool:
    """Whether the loose tolerance makes items right as a whole, and no item right in part: that would be a mistake."""
    gains = [item for before, item in zip(score.items, loose.items) if item.passed > before.passed]
    return bool(gains) and all(item.passed == item.total for item in gains)


def _score(evidence: Evidence, reading: Reading, items: Sequence[Item], tolerance: float) -> _Score:
    outputs: list[Output | None] = []
    problems: list[str] = []
    for observation in evidence.observations:
        output, problem = (None, "") if observation.result is None else reading.read(observation.result)
        outputs.append(output)
        problems.append(problem)
    right, results = [], []
    for item in items:
        counts = [_count_right(item, case, output, tolerance) for case, output in zip(evidence.cases, outputs)]
        passed, total = (sum(column) for column in zip(*counts))
        right.append([None if n == 0 else k == n for k, n in counts])
        points = item.points * passed / total if total else item.points
        results.append(ItemResult(item.name, points, item.points, passed, total))
    return _Score(tolerance, outputs, problems, right, results)


def _count_right(item: Item, case: Case, output: Output | None, tolerance: float) -> tuple[int, int]:
    """How many of how many are right: entries of the quantity, or the state as a whole."""
    truth = item.quantity(case, case.truth)
    if truth is None:
        return 0, 0
    value = None if output is None else item.quantity(case, output)
    if item.entrywise:
        right = 0 if value is None else int(np.sum(np.abs(value - truth) <= tolerance * item.scale))
        return right, truth.size
    return int(_agree(item, value, truth, tolerance)), 1


def _agree(item: Item, value: Array | None, truth: Array, tolerance: float = TOLERANCE) -> bool:
    return value is not None and bool(np.all(np.abs(value - truth) <= tolerance * item.scale))


def _form_item(points: float, evidence: Evidence, reading: Reading, score: _Score) -> ItemResult:
    """Three checks: shapes and order as documented, arguments left alone, the same answer when asked again."""
    checks = (
        not reading.message and not any(score.problems),
        not any(observation.changed for observation in evidence.observations),
        all(_is_repeated(evidence.observations[k], again) for k, again in evidence.repeats),
    )
    # A function that never gets a value right does not earn points for its form.
    passed = sum(checks) if any(item.passed for item in score.items) else 0
    return ItemResult("form of the results", points * passed / len(checks), points, passed, len(checks))


def _is_repeated(first: Observation, again: Observation) -> bool:
    if first.result is None or again.result is None:
        return first.error == again.error
    return _is_same(first.result, again.result)


def _is_same(a: Any, b: Any) -> bool:
    if isinstance(a, tuple):
        return isinstance(b, tuple) and len(a) == len(b) and all(_is_same(x, y) for x, y in zip(a, b))
    if isinstance(a, Other) or isinstance(b, Other):
        return bool(type(a) is type(b))
    return (
        isinstance(b, np.ndarray)
        and a.shape == b.shape
        and bool(np.allclose(a, b, rtol=TOLERANCE, atol=1e-12, equal_nan=True))
    )


def _form_mistakes(evidence: Evidence, reading: Reading, score: _Score) -> list[str]:
    mistakes = [reading.message] if reading.message else []
    mistakes += list(dict.fromkeys(problem for problem in score.problems if problem))[:2]
    changed = sorted({index for observation in evidence.observations for index in observation.changed})
    if changed:
        which = " and ".join(("first", "second", "third")[index] for index in changed)
        mistakes.append(
            f"changes its {which} argument in place; make a new array instead (q = q + ..., not q += ...)"
        )
    if not all(_is_repeated(evidence.observations[k], again) for k, again in evidence.repeats):
        mistakes.append(
            "gives another answer when called again with the same arguments: it keeps or changes global data"
        )
    return mistakes


def _errors(evidence: Evidence) -> list[str]:
    texts = [observation.error for observation in evidence.observations]
    messages = []
    for text in list(dict.fromkeys(text for text in texts if text))[:2]:
        where = [bool(other == text) for other in texts]
        count, total = sum(where), len(texts)
        if count == total:
            messages.append(f"stops in every state: {text}")
            continue
        tag = _common_tag(evidence.cases, [not hit for hit in where])
        example = evidence.cases[where.index(True)]
        place = f"exactly where {tag}" if tag else f"for example at {example}"
        messages.append(f"stops in {count} of {total} states, {place}: {text}")
    return messages


def _not_finite(evidence: Evidence, score: _Score) -> list[str]:
    cases = [
        case
        for case, output in zip(evidence.cases, score.outputs)
        if output is not None and not all(np.all(np.isfinite(array)) for array in output)
    ]
    if not cases:
        return []
    return [f"returns nan or infinity in {len(cases)} of {len(evidence.cases)} states, for example at {cases[0]}"]


def _common_tag(cases: Sequence[Case], right: Sequence[bool | None]) -> str:
    """A tag that all wrong cases have and no right one, if there are right ones."""
    wrong = [case for case, ok in zip(cases, right) if ok is False]
    good = [case for case, ok in zip(cases, right) if ok]
    if not wrong or not good:
        return ""
    tags = (tag for tag in wrong[0].tags if all(tag in case.tags for case in wrong))
    return next((tag for tag in tags if not any(tag in case.tags for case in good)), "")


def _likely_mistakes(
    evidence: Evidence,
    score: _Score,
    items: Sequence[Item],
    variants: Sequence[Variant],
    conventions: Conventions,
) -> list[str]:
    """Fewest wrong solutions that together agree with all wrong items, then a hint for each item left over."""
    cases = evidence.cases
    wrong = {i for i, row in enumerate(score.right) if _wrong_cases(row, score.outputs)}
    right = [i for i, row in enumerate(score.right) if False not in row]
    explained = [
        {i for i in wrong if _explains(variant, items[i], cases, score)} for variant in variants
    ]
    # A mistake that would spoil items that are right is less likely than one that would not.
    spoiled = [
        sum(_spoils(variants[v], items[i], cases) for i in right) if explained[v] else 0
        for v in range(len(variants))
    ]
    messages, left = [], set(wrong)
    while left and any(explains & left for explains in explained):
        v = max(range(len(variants)), key=lambda v: (len(explained[v] & left), -spoiled[v], -v))
        messages.append(variants[v].message)
        conventions.update(variants[v].conventions)
        left -= explained[v]
    messages += [_hint(items[i], score.right[i], evidence, score) for i in sorted(left)]
    return [message for message in messages if message]


def _wrong_cases(row: Sequence[bool | None], outputs: Sequence[Output | None]) -> list[int]:
    return [k for k, ok in enumerate(row) if ok is False and outputs[k] is not None]


def _explains(variant: Variant, item: Item, cases: Sequence[Case], score: _Score) -> bool:
    differs = False
    for case, output in zip(cases, score.outputs):
        truth = item.quantity(case, case.truth)
        if truth is None or output is None:
            continue
        expected = item.quantity(case, variant.solve(case))
        if expected is None or not _agree(item, item.quantity(case, output), expected, score.tolerance):
            return False
        differs = differs or not _agree(item, expected, truth)
    return differs


def _spoils(variant: Variant, item: Item, cases: Sequence[Case]) -> bool:
    for case in cases:
        truth = item.quantity(case, case.truth)
        if truth is not None and not _agree(item, item.quantity(case, variant.solve(case)), truth):
            return True
    return False


def _hint(item: Item, row: Sequence[bool | None], evidence: Evidence, score: _Score) -> str:
    tag = _common_tag(evidence.cases, row)
    if tag:
        return f"{item.name}: right, except where {tag}"
    wrong = _wrong_cases(row, score.outputs)
    case = evidence.cases[wrong[0]]
    output = score.outputs[wrong[0]]
    if item.hint is not None and output is not None:
        return item.hint(case, output)
    value = None if output is None else item.quantity(case, output)
    truth = item.quantity(case, case.truth)
    if value is None or truth is None:
        return f"{item.name}: wrong at {case}"
    if not np.all(np.isfinite(value)):
        return ""  # said for the part as a whole
    difference = f"{_numbers(value)} instead of {_numbers(truth)}"
    text = f"{item.name}: wrong in {len(wrong)} states, for example at {case}: {difference}"
    if all(_is_near(item, evidence.cases[k], score.outputs[k]) for k in wrong):
        text += "; so near that a rounded constant is likely (3.14, 9.8, 0.7)"
    return text


def _is_near(item: Item, case: Case, output: Output | None) -> bool:
    value, truth = (None if o is None else item.quantity(case, o) for o in (output, case.truth))
    return (
        value is not None
        and truth is not None
        and bool(np.all(np.abs(value - truth) <= _NEARLY * item.scale))
    )


def _numbers(values: Array) -> str:
    flat = np.ravel(values)
    text = ", ".join(f"{number:.6g}" for number in flat[:8])
    return f"({text}{', ...' if flat.size > 8 else ''})"


def shape_problem(name: str, value: Any, shape: tuple[int, ...]) -> tuple[Array | None, str]:
    """A result brought to its documented shape.

    Parameters
    ----------
    name : str
        Of the result, for the message.
    value : ndarray, Other or tuple
    shape : tuple of int

    Returns
    -------
    ndarray or None
        None if no reshaping makes sense of it.
    str
        What is wrong with the shape, or "".
    """
    wanted = f"{name} must be an array of shape {shape}" if shape else f"{name} must be a number"
    if not isinstance(value, np.ndarray):
        return None, f"{wanted}, got {describe(value)}"
    if value.shape == shape or (shape == () and value.size == 1):
        return value.reshape(shape), ""
    problem = f"wrong shape: {wanted}, got {value.shape}"
    # Lengths of 1 do not change the order of the entries, so the values can still be judged.
    if tuple(n for n in value.shape if n != 1) == shape:
        return value.reshape(shape), problem
    return None, problem
