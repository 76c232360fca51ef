"""Part 1: contact distance and Jacobian.

Points: form 3, phi 9, J_n 9, J_t 9.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from tumble import drop

from tumble.grade.codec import Array, Other, as_pair, describe
from tumble.grade.judge import Case, Item, Output, Reading, Variant, shape_problem
from tumble.grade.states import CORNER_SIGNS, SEED, TURNS, angle_tags, angle_with_lowest, pose

NUMBER = 1
TITLE = "contact distance and Jacobian"
FUNCTION = "get_contacts"
MAXIMUM = 30.0


def cases(params: drop.Parameters) -> list[Case]:
    """States with every corner lowest, angles of all kinds, and the corner far above, near delta, and below ground."""
    generator = np.random.default_rng(SEED + NUMBER)
    near = 1e-6 * max(params.delta, 1e-3 * params.l)
    heights = (
        (5.0 * params.l, "the corner is above the contact threshold"),
        (params.delta + near, "the corner is above the contact threshold"),
        (params.delta - near, "the corner is below the contact threshold"),
        (-0.05 * params.l, "the corner is below the ground"),
    )
    result = []
    for corner in range(4):
        for turns in TURNS:
            for phi, tag in heights:
                theta = angle_with_lowest(corner, turns, generator)
                q = pose(phi, theta, generator.uniform(-10.0, 10.0) * params.l, params)
                J, distance = drop.get_contacts(q, params)
                result.append(Case((q,), (J, np.array(distance)), (*angle_tags(corner, theta), tag)))
    return result


def items(params: drop.Parameters) -> list[Item]:
    """The sub-points."""
    return [
        Item("distance phi", 9.0, lambda case, output: output[1], params.l),
        Item("Jacobian, column J_n", 9.0, lambda case, output: output[0][:, 1], params.l),
        Item("Jacobian, column J_t", 9.0, lambda case, output: output[0][:, 0], params.l),
    ]


def readings() -> list[Reading]:
    """J, phi as documented; in the wrong order; J transposed."""
    return [
        Reading(lambda result: _read(result, swapped=False, transposed=False)),
        Reading(
            lambda result: _read(result, swapped=True, transposed=False),
            "returns phi, J; the order must be J, phi",
            {"contacts_swapped": True},
        ),
        Reading(
            lambda result: _read(result, swapped=False, transposed=True),
            "returns J transposed, of shape (2, 3); it must be (3, 2) with the columns J_t and J_n",
            {"J_transposed": True},
        ),
        Reading(
            lambda result: _read(result, swapped=True, transposed=True),
            "returns phi, J with J of shape (2, 3); it must be J, phi with J of shape (3, 2)",
            {"contacts_swapped": True, "J_transposed": True},
        ),
    ]


def _read(result: Any, swapped: bool, transposed: bool) -> tuple[Output | None, str]:
    pair = as_pair(result) if not isinstance(result, Other) else None
    if pair is None or len(pair) < 2:
        return None, f"must return two values, J and phi; got {describe(result)}"
    J, phi = (pair[1], pair[0]) if swapped else (pair[0], pair[1])
    if transposed and isinstance(J, np.ndarray):
        J = J.T
    J, J_problem = shape_problem("J", J, (3, 2))
    phi, phi_problem = shape_problem("phi", phi, ())
    count_problem = "" if len(pair) == 2 else f"returns {len(pair)} values; it must be two, J and phi"
    problem = J_problem or phi_problem or count_problem
    return (None if J is None or phi is None else (J, phi)), problem


def _corners(q: Array, params: drop.Parameters, angle: float, half: float) -> Array:
    """Corners relative to the centre of mass in the world frame, shape (4, 2) [m]."""
    corners: Array = half * params.l * np.matmul(CORNER_SIGNS, _rotated(angle).T)
    return corners


def _jacobian(x: float, y: float) -> Array:
    return np.array([[1.0, 0.0], [0.0, 1.0], [-y, x]])


def _with_corner(
    params: drop.Parameters,
    choose: Callable[[Array], Any] = lambda r: np.argmin(r[:, 1]),
    angle: Callable[[float], float] = lambda theta: theta,
    half: float = 0.5,
) -> Callable[[Case], Output]:
    """A solution with another corner, angle or size."""

    def solve(case: Case) -> Output:
        (q,) = case.arguments
        r = _corners(q, params, angle(q[2]), half)
        x, y = r[int(choose(r))]
        return _jacobian(x, y), np.array(q[1] + y)

    return solve


def _changed(change: Callable[[Array, Array, Array], Any]) -> Callable[[Case], Output]:
    """The right solution with a changed J: `change` gets J, q and r = corner - centre of mass and returns J."""

    def solve(case: Case) -> Output:
        J, phi = case.truth
        return np.asarray(change(J.copy(), case.arguments[0], np.array([J[2, 1], -J[2, 0]]))), phi

    return solve


def _always(corner: int) -> Callable[[Array], int]:
    return lambda r: corner


def _distance(change: Callable[[float, float], float]) -> Callable[[Case], Output]:
    def solve(case: Case) -> Output:
        return case.truth[0], np.array(change(float(case.truth[1]), float(case.arguments[0][1])))

    return solve


def _rotated(theta: float) -> Array:
    cos, sin = np.cos(theta), np.sin(theta)
    return np.array([[cos, -sin], [sin, cos]])


def _in_body(J: Array, q: Array, r: Array) -> Array:
    """r in the body frame, directions in the world frame."""
    x, y = _rotated(-q[2]) @ r
    return _jacobian(x, y)


def _all_in_body(J: Array, q: Array, r: Array) -> Array:
    """Directions and r in the body frame."""
    J[:2] = _rotated(-q[2]) @ J[:2]
    return J


def _scaled(J: Array, row: int, column: int, factor: float) -> Array:
    J[row, column] *= factor
    return J


def variants(params: drop.Parameters) -> list[Variant]:
    """Wrong solutions, most likely first."""
    return [*_corner_mistakes(params), *_jacobian_mistakes(), *_distance_mistakes(params)]


def _corner_mistakes(params: drop.Parameters) -> list[Variant]:
    return [
        Variant(
            "takes the highest corner instead of the lowest",
            _with_corner(params, lambda r: np.argmax(r[:, 1])),
        ),
        Variant(
            "hands the angle to sin and cos in degrees; q[2] is in radians",
            _with_corner(params, angle=np.rad2deg),
        ),
        Variant(
            "converts the angle to radians, but q[2] is in radians already",
            _with_corner(params, angle=np.deg2rad),
        ),
        Variant("forgets to turn the corners by the angle", _with_corner(params, angle=lambda theta: 0.0)),
        Variant("takes corners at a distance l from the axes; it is l / 2", _with_corner(params, half=1.0)),
        Variant(
            "takes corners at a distance l / 4 from the axes; it is l / 2", _with_corner(params, half=0.25)
        ),
        Variant(
            "takes corners at l / sqrt(2) along the axes; that is their distance from the centre",
            _with_corner(params, half=np.sqrt(0.5)),
        ),
        *(
            Variant(
                "always takes the same corner; it must be the lowest one", _with_corner(params, _always(k))
            )
            for k in range(4)
        ),
        Variant(
            "takes the leftmost corner; it must be the lowest one",
            _with_corner(params, lambda r: np.argmin(r[:, 0])),
        ),
    ]


def _jacobian_mistakes() -> list[Variant]:
    return [
        Variant(
            "J_t has the wrong sign in its third entry: it is -r_y",
            _changed(lambda J, q, r: _scaled(J, 2, 0, -1.0)),
        ),
        # Of a square, the lowest corner for -theta is the mirror image of that for theta: only r_x differs.
        Variant(
            "J_n has the wrong sign in its third entry: it is r_x (or the corners turn the wrong way: R transposed)",
            _changed(lambda J, q, r: _scaled(J, 2, 1, -1.0)),
        ),
        Variant(
            "the columns of J are swapped: J = [J_t, J_n]",
            _changed(lambda J, q, r: J[:, ::-1]),
            {"J_columns_swapped": True},
        ),
        Variant("r is in the body frame; turn it into the world frame", _changed(_in_body)),
        Variant(
            "J is in the body frame; normal and tangent must be in the world frame", _changed(_all_in_body)
        ),
        Variant(
            "uses the position of the corner in J; r is the corner minus the centre of mass",
            _changed(lambda J, q, r: _jacobian(q[0] + r[0], q[1] + r[1])),
        ),
        Variant(
            "r points from the corner to the centre of mass; it must be the other way",
            _changed(lambda J, q, r: _jacobian(-r[0], -r[1])),
        ),
        Variant("r_x and r_y are mixed up in J", _changed(lambda J, q, r: _jacobian(r[1], r[0]))),
        Variant("r_x and r_y are mixed up in J", _changed(lambda J, q, r: _jacobian(-r[1], -r[0]))),
        Variant(
            "the whole column has the wrong sign: the normal is +y, the tangent +x",
            _changed(lambda J, q, r: -J),
        ),
        Variant(
            "the third row of J is zero: the turning of the square moves the corner too",
            _changed(lambda J, q, r: _jacobian(0.0, 0.0)),
        ),
    ]


def _distance_mistakes(params: drop.Parameters) -> list[Variant]:
    return [
        Variant("phi has the wrong sign: it is positive above the ground", _distance(lambda phi, y: -phi)),
        Variant(
            "phi must become negative below the ground; do not take its absolute value",
            _distance(lambda phi, y: abs(phi)),
        ),
        Variant(
            "phi must become negative below the ground; do not cut it off at 0",
            _distance(lambda phi, y: max(phi, 0.0)),
        ),
        Variant(
            "phi is the height of the centre of mass; it must be that of the corner",
            _distance(lambda phi, y: y),
        ),
        Variant("phi lacks the height of the centre of mass", _distance(lambda phi, y: phi - y)),
        Variant("phi subtracts r_y; it must add it", _distance(lambda phi, y: 2.0 * y - phi)),
        Variant("phi ignores the angle", _distance(lambda phi, y: y - 0.5 * params.l)),
        Variant(
            "phi takes the circle around the square instead of its corner",
            _distance(lambda phi, y: y - float(np.sqrt(0.5)) * params.l),
        ),
        Variant(
            "phi subtracts delta; the threshold belongs into step",
            _distance(lambda phi, y: phi - params.delta),
        ),
    ]
