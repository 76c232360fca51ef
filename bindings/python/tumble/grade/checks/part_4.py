"""Part 4: the trajectory.

Points: form 3, column 0 is the initial state 3, the share of right steps 2, all steps right 2. Each column is compared
with one right step from the student's column before it, so a difference of 1e-16 cannot grow over the bounces.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from tumble import drop

from tumble.grade.codec import Array, Other, as_pair, describe
from tumble.grade.judge import SINGLE_TOLERANCE, TOLERANCE, Case, Item, Output, Reading, Variant
from tumble.grade.states import SEED

NUMBER = 4
TITLE = "trajectory"
FUNCTION = "simulate"
MAXIMUM = 10.0

COLUMNS = 150
# Around a tie of two corners, or of phi and delta, round-off decides what happens; both outcomes are right.
_TIE = 1e-9
# The deviation of a step that is not there or holds nan, far above that of any step that is.
_MISSING = 1e300


def cases(params: drop.Parameters) -> list[Case]:
    """The course's start, one with spin, one that begins in contact."""
    generator = np.random.default_rng(SEED + NUMBER)
    speed = np.sqrt(params.l * params.g)
    starts = [
        (np.array([0.0, 1.5, np.pi / 6]), np.array([0.0, -0.2, 0.0]), "usual"),
        (
            np.array([0.3, 4.0 * params.l, 2.0]),
            np.array([speed, -0.3 * speed, 0.5 * speed / params.l]),
            "spinning",
        ),
        (
            np.array([-0.1, 0.65 * params.l, -0.6]),
            np.array([-0.5, -0.1, 1.0]) * generator.uniform(0.5, 1.0),
            "low",
        ),
    ]
    return [
        Case((q, v), drop.simulate(q, v, params), (f"the start is the {name} one",)) for q, v, name in starts
    ]


def items(params: drop.Parameters) -> list[Item]:
    """The sub-points."""

    def steps(case: Case, output: Output) -> Array:
        return _deviations(case, output, params)

    def hint(case: Case, output: Output) -> str:
        return _first_wrong_step(case, output, params)

    return [
        Item("column 0 is the initial state", 3.0, _first_column, 1.0),
        Item("steps from one column to the next", 2.0, steps, 1.0, entrywise=True, hint=hint),
        Item("whole trajectories", 2.0, steps, 1.0, hint=lambda case, output: ""),
    ]


def _first_column(case: Case, output: Output) -> Array | None:
    return np.array([values[:, 0] for values in output]).ravel()


def _deviations(case: Case, output: Output, params: drop.Parameters) -> Array:
    """For each step its relative difference from the right one, `_MISSING` if there is none, shape (COLUMNS - 1,)."""
    q, v = (values[:, :COLUMNS] for values in output)
    steps = q.shape[1] - 1
    right = np.full((6, steps), np.nan)
    numbers = np.flatnonzero(np.all(np.isfinite(np.vstack([q, v])), axis=0)[:-1])
    for k in numbers:
        right[:, k] = np.concatenate(drop.step(q[:, k], v[:, k], params))
    differences = np.abs(np.vstack([q, v])[:, 1:] - right) / (1.0 + np.max(np.abs(right), axis=0))
    deviations = np.full(COLUMNS - 1, _MISSING)
    deviations[:steps] = np.nan_to_num(np.max(differences, axis=0), nan=_MISSING, posinf=_MISSING)
    for k in numbers[deviations[numbers] > TOLERANCE]:
        if _is_tie(q[:, k], params):
            deviations[k] = 0.0
    return deviations


def _first_wrong_step(case: Case, output: Output, params: drop.Parameters) -> str:
    deviations = _deviations(case, output, params)
    deviations[deviations == _MISSING] = 0.0
    # Where there are clear mistakes, round-off of single precision is none of them.
    clear = SINGLE_TOLERANCE if np.max(deviations) > SINGLE_TOLERANCE else TOLERANCE
    steps = np.flatnonzero(deviations > clear)
    if steps.size == 0:
        return ""
    k = int(steps[0])
    return (
        f"column {k + 1} (counted from 0) is not one step after column {k}; "
        f"{steps.size} of {COLUMNS - 1} steps are wrong, starting from {case}"
    )


def _is_tie(q: Array, params: drop.Parameters) -> bool:
    heights = np.sort(drop.corner_positions(q, params)[:, 1])
    near_delta = abs(heights[0] - params.delta) < _TIE * params.l
    level = heights[0] < params.delta and heights[1] - heights[0] < _TIE * params.l
    return bool(near_delta or level)


def readings() -> list[Reading]:
    """q, v of shape (3, 150) as documented; in the wrong order; transposed."""
    return [
        Reading(lambda result: _read(result, swapped=False, transposed=False)),
        Reading(
            lambda result: _read(result, swapped=True, transposed=False),
            "returns v, q; the order must be q, v",
        ),
        Reading(
            lambda result: _read(result, swapped=False, transposed=True),
            f"returns arrays with one row per step; they must be transposed, of shape (3, {COLUMNS})",
        ),
        Reading(
            lambda result: _read(result, swapped=True, transposed=True),
            f"returns v, q with one row per step; it must be q, v of shape (3, {COLUMNS})",
        ),
    ]


def _read(result: Any, swapped: bool, transposed: bool) -> tuple[Output | None, str]:
    pair = as_pair(result) if not isinstance(result, Other) else None
    if pair is None or len(pair) != 2:
        return None, f"must return two values, q and v; got {describe(result)}"
    arrays, problems = [], []
    for name, value in (("q", pair[swapped]), ("v", pair[not swapped])):
        array, problem = _matrix(name, value, transposed)
        arrays.append(array)
        problems.append(problem)
    problem = next(filter(None, problems), "")
    if arrays[0] is None or arrays[1] is None or arrays[0].shape != arrays[1].shape:
        return None, problem or "q and v must have the same shape"
    return (arrays[0], arrays[1]), problem


def _matrix(name: str, value: Any, transposed: bool) -> tuple[Array | None, str]:
    wanted = f"{name} must be an array of shape (3, {COLUMNS})"
    if not isinstance(value, np.ndarray):
        return None, f"{wanted}, got {describe(value)}"
    array, problem = value, ""
    if value.ndim == 3:
        # A list of columns of shape (3, 1); lengths of 1 do not change the order of the entries.
        array = value.reshape([n for n in value.shape if n != 1])
        problem = f"wrong shape: {wanted}, got {value.shape}"
    if transposed:
        array = array.T
    if array.ndim != 2 or array.shape[0] != 3 or array.shape[1] == 0:
        return None, f"wrong shape: {wanted}, got {value.shape}"
    if array.shape[1] != COLUMNS:
        count = array.shape[1]
        problem = (
            f"{name} has {count} columns; it must have {COLUMNS}, the initial state and {COLUMNS - 1} steps"
        )
    return array, problem


def variants(params: drop.Parameters) -> list[Variant]:
    """Wrong solutions, most likely first."""

    def changed(change: Callable[[Array], Array]) -> Callable[[Case], Output]:
        return lambda case: (change(case.truth[0]), change(case.truth[1]))

    def one_step_late(case: Case) -> Output:
        more = drop.Parameters(**{**params.asdict(), "columns": COLUMNS + 1})
        q, v = drop.simulate(case.arguments[0], case.arguments[1], more)
        return q[:, 1:], v[:, 1:]

    def last_missing(values: Array) -> Array:
        values = values.copy()
        values[:, -1] = 0.0
        return values

    def shifted(values: Array) -> Array:
        return np.column_stack([np.zeros(3), values[:, :-1]])

    return [
        Variant("column 0 is the state after the first step; it must be the initial state", one_step_late),
        Variant("column 0 is not the initial state: it was left at zero", changed(shifted)),
        Variant(
            "column 0 is not the initial state: it was left at zero",
            changed(lambda values: np.column_stack([np.zeros(3), values[:, 1:]])),
        ),
        Variant("the last column was left at zero: the loop ends one step early", changed(last_missing)),
        Variant(
            "all columns are the initial state: each step must start from the column before",
            changed(lambda values: np.repeat(values[:, :1], COLUMNS, axis=1)),
        ),
        Variant(
            "every step starts from the initial state; it must start from the column before",
            changed(
                lambda values: np.column_stack(
                    [values[:, :1], np.repeat(values[:, 1:2], COLUMNS - 1, axis=1)]
                )
            ),
        ),
        Variant(
            "all columns but the first are zero",
            changed(lambda values: np.column_stack([values[:, 0], np.zeros((3, COLUMNS - 1))])),
        ),
    ]
