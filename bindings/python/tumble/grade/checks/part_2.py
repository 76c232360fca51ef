"""Part 2: the LCP.

Points: form 3, V row 1 (normal) 5, V rows 2 and 3 (tangential) 6, row 4 of V and p (friction) 2, p row 1 (normal) 8,
p rows 2 and 3 (tangential) 6.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from tumble import drop

from tumble.grade.codec import Array, Other, as_pair, describe
from tumble.grade.judge import Case, Item, Output, Reading, Variant, shape_problem
from tumble.grade.states import SEED, TURNS, angle_tags, angle_with_lowest, pose, velocity_with_mode

NUMBER = 2
TITLE = "LCP"
FUNCTION = "form_lcp"
MAXIMUM = 30.0

_MODES = ("opens", "sticks", "slides left", "slides right")


def cases(params: drop.Parameters) -> list[Case]:
    """Every corner opening, sticking and sliding both ways, and one at rest."""
    generator = np.random.default_rng(SEED + NUMBER)
    result = []
    for corner in range(4):
        for k, mode in enumerate(_MODES):
            theta = angle_with_lowest(corner, TURNS[k % len(TURNS)], generator)
            q = pose(0.0, theta, 0.0, params)
            v = velocity_with_mode(q, mode, params, generator)
            result.append(_case(q, v, (*angle_tags(corner, theta), f"the corner {mode}"), params))
    theta = angle_with_lowest(0, 0, generator)
    result.append(_case(pose(0.0, theta, 0.0, params), np.zeros(3), ("the velocity is zero",), params))
    return result


def _case(q: Array, v: Array, tags: tuple[str, ...], params: drop.Parameters) -> Case:
    J, _ = drop.get_contacts(q, params)
    V, p = drop.form_lcp(J, v, params)
    return Case((J, v), (V, p), tags)


def items(params: drop.Parameters) -> list[Item]:
    """The sub-points."""
    block = params.dt / params.m
    speed = params.dt * params.g + np.sqrt(params.l * params.g)
    return [
        Item("V, row 1 (normal)", 5.0, lambda case, output: np.asarray(output[0][0]), block),
        Item("V, rows 2 and 3 (tangential)", 6.0, lambda case, output: output[0][1:3], block),
        Item(
            "row 4 of V and p (friction)",
            2.0,
            lambda case, output: np.append(output[0][3], output[1][3]),
            1.0,
        ),
        Item("p, row 1 (normal)", 8.0, lambda case, output: output[1][:1], speed),
        Item("p, rows 2 and 3 (tangential)", 6.0, lambda case, output: output[1][1:3], speed),
    ]


def readings() -> list[Reading]:
    """V, p as documented; in the wrong order."""
    return [
        Reading(lambda result: _read(result, swapped=False)),
        Reading(
            lambda result: _read(result, swapped=True),
            "returns p, V; the order must be V, p",
            {"lcp_swapped": True},
        ),
    ]


def _read(result: Any, swapped: bool) -> tuple[Output | None, str]:
    pair = as_pair(result) if not isinstance(result, Other) else None
    if pair is None or len(pair) != 2:
        return None, f"must return two values, V and p; got {describe(result)}"
    V, V_problem = shape_problem("V", pair[swapped], (4, 4))
    p, p_problem = shape_problem("p", pair[not swapped], (4,))
    return (None if V is None or p is None else (V, p)), V_problem or p_problem


class _Formula:
    """The formula of V and p with its pieces open to change.

    Attributes
    ----------
    inverse_mass : ndarray, shape (3,)
        Diagonal of M^-1.
    dt : float
        Factor of the 3 x 3 block of V [s].
    fall : ndarray, shape (3,)
        What gravity adds to v in a step.
    """

    def __init__(self, params: drop.Parameters) -> None:
        self.mass = params.m * np.array([1.0, 1.0, params.l**2 / 6.0])
        self.inverse_mass = 1.0 / self.mass
        self.dt = params.dt
        self.fall = params.dt * np.array([0.0, -params.g, 0.0])
        self.mu = params.mu
        self.eps = params.eps

    def directions(self, J: Array) -> Array:
        """Rows J_n, -J_t, J_t."""
        return np.stack([J[:, 1], -J[:, 0], J[:, 0]])

    def velocity(self, v: Array) -> Array:
        """What the normal row of p multiplies, shape (3,)."""
        return (1.0 + self.eps) * v + self.fall

    def tangential_velocity(self, v: Array) -> Array:
        """What the tangential rows of p multiply, shape (3,)."""
        return v + self.fall

    def solve(self, case: Case) -> Output:
        J, v = case.arguments
        D = self.directions(J)
        V = np.zeros((4, 4))
        V[:3, :3] = self.dt * D @ np.diag(self.inverse_mass) @ D.T
        V[1:3, 3] = 1.0
        V[3, :3] = self.mu, -1.0, -1.0
        normal, tangential = D[0] @ self.velocity(v), D[1:] @ self.tangential_velocity(v)
        return V, np.array([normal, *tangential, 0.0])


def _with(params: drop.Parameters, **changes: Any) -> Callable[[Case], Output]:
    formula = _Formula(params)
    for name, value in changes.items():
        setattr(formula, name, value)
    return formula.solve


def _after(params: drop.Parameters, change: Callable[[Array, Array], Any]) -> Callable[[Case], Output]:
    """The right V and p, changed in place afterwards."""

    def solve(case: Case) -> Output:
        V, p = (array.copy() for array in _Formula(params).solve(case))
        change(V, p)
        return V, p

    return solve


def _swap_f_t(V: Array, p: Array) -> None:
    order = [0, 2, 1, 3]
    V[:], p[:] = V[order][:, order], p[order]


def _set(array: Array, index: Any, value: Any) -> None:
    array[index] = value


def _scale(array: Array, index: Any, factor: Any) -> None:
    array[index] *= factor


def variants(params: drop.Parameters) -> list[Variant]:
    """Wrong solutions, most likely first."""
    return [*_mass_mistakes(params), *_matrix_mistakes(params), *_vector_mistakes(params)]


def _mass_mistakes(params: drop.Parameters) -> list[Variant]:
    m, l = params.m, params.l
    inertias = {
        "m l^2": m * l**2,
        "m l^2 / 12": m * l**2 / 12,
        "m l^2 / 3": m * l**2 / 3,
        "l^2 / 6, without m": l**2 / 6,
        "m": m,
        "1": 1.0,
        "m l / sqrt(6), with r_g instead of r_g^2": m * l / np.sqrt(6.0),
        "m l^4 / 36, with r_g^2 squared once more": m * l**4 / 36,
    }
    mass = _Formula(params).mass
    return [
        *(
            Variant(
                f"the moment of inertia is {words}; it is m l^2 / 6",
                _with(params, inverse_mass=1 / np.array([m, m, value])),
            )
            for words, value in inertias.items()
        ),
        Variant("V multiplies by M where M^-1 belongs", _with(params, inverse_mass=mass)),
        Variant("V lacks M^-1", _with(params, inverse_mass=np.ones(3))),
    ]


def _matrix_mistakes(params: drop.Parameters) -> list[Variant]:
    dt = params.dt
    return [
        Variant("dt is missing in V: each entry of its 3 x 3 block carries one dt", _with(params, dt=1.0)),
        Variant(
            "dt is squared in V: each entry of its 3 x 3 block carries one dt", _with(params, dt=dt**2)
        ),
        Variant("f_t1 and f_t2 are swapped: the order is J_n, -J_t, J_t", _after(params, _swap_f_t)),
        Variant(
            "J_t and J_n are swapped: J = [J_t, J_n]",
            _with(params, directions=lambda J: np.stack([J[:, 0], -J[:, 1], J[:, 1]])),
        ),
        Variant(
            "the minus signs of J_t are missing: the order is J_n, -J_t, J_t",
            _with(params, directions=lambda J: np.stack([J[:, 1], J[:, 0], J[:, 0]])),
        ),
        Variant(
            "the ones in the last column of V are missing (rows 2 and 3)",
            _after(params, lambda V, p: _set(V, (slice(1, 3), 3), 0.0)),
        ),
        Variant(
            "the ones in the last column of V carry a dt; they are plain ones",
            _after(params, lambda V, p: _set(V, (slice(1, 3), 3), dt)),
        ),
        Variant(
            "the ones in the last column of V are negative",
            _after(params, lambda V, p: _set(V, (slice(1, 3), 3), -1.0)),
        ),
        Variant(
            "the last column of V has a one in row 1 too; it is 0, 1, 1, 0",
            _after(params, lambda V, p: _set(V, (slice(0, 3), 3), 1.0)),
        ),
        Variant(
            "the last row of V must be mu, -1, -1, 0: signs", _after(params, lambda V, p: _scale(V, 3, -1.0))
        ),
        Variant(
            "the last row of V must be mu, -1, -1, 0: signs",
            _after(params, lambda V, p: _set(V, 3, [params.mu, 1.0, 1.0, 0.0])),
        ),
        Variant(
            "the last row of V must be mu, -1, -1, 0: it is missing",
            _after(params, lambda V, p: _set(V, 3, 0.0)),
        ),
        Variant(
            "the last row of V must be mu, -1, -1, 0: it carries a dt",
            _after(params, lambda V, p: _scale(V, 3, dt)),
        ),
        Variant(
            "the last row of V must be mu, -1, -1, 0: its last entry is not 0",
            _after(params, lambda V, p: _set(V, (3, 3), 1.0)),
        ),
        Variant(
            "the last row of V must be mu, -1, -1, 0: mu stands in the wrong place",
            _after(params, lambda V, p: _set(V, 3, [1.0, -params.mu, -params.mu, 0.0])),
        ),
        Variant("V is transposed", _after(params, lambda V, p: _set(V, slice(None), V.T.copy()))),
    ]


def _vector_mistakes(params: drop.Parameters) -> list[Variant]:
    right = _Formula(params)
    eps, fall, inverse_mass = params.eps, right.fall, right.inverse_mass

    def normal(velocity: Callable[[Array], Array]) -> Callable[[Case], Output]:
        return _with(params, velocity=velocity)

    def both(fall: Array) -> Callable[[Case], Output]:
        return _with(params, fall=fall)

    return [
        Variant("(1 + eps) is missing in the first row of p", normal(lambda v: v + fall)),
        Variant(
            "restitution multiplies gravity too: (1 + eps) belongs to v alone",
            normal(lambda v: (1 + eps) * (v + fall)),
        ),
        Variant("the first row of p has eps v where (1 + eps) v belongs", normal(lambda v: eps * v + fall)),
        Variant(
            "the first row of p has (1 - eps) v where (1 + eps) v belongs",
            normal(lambda v: (1 - eps) * v + fall),
        ),
        Variant(
            "restitution belongs to the first row of p only",
            _with(params, tangential_velocity=lambda v: (1 + eps) * v + fall),
        ),
        Variant(
            "restitution belongs to the first row of p only, and there to v alone",
            _with(params, tangential_velocity=lambda v: (1 + eps) * (v + fall)),
        ),
        Variant("dt is missing in p: gravity adds dt M^-1 f_e to v", both(fall / params.dt)),
        Variant("dt is squared in p: gravity adds dt M^-1 f_e to v", both(fall * params.dt)),
        Variant("f_e is a force: f_e = M g, not g (p has M^-1 g where g belongs)", both(inverse_mass * fall)),
        Variant("M^-1 is missing before f_e in p", both(right.mass * fall)),
        Variant("gravity points the wrong way in p", both(-fall)),
        Variant("gravity is missing in p", both(np.zeros(3))),
        Variant("all signs of p are wrong", _after(params, lambda V, p: _scale(p, slice(None), -1.0))),
        Variant(
            "the rows 2 and 3 of p are swapped: -J_t comes first",
            _after(params, lambda V, p: _scale(p, slice(1, 3), -1.0)),
        ),
        Variant(
            "p carries a dt that does not belong there",
            _after(params, lambda V, p: _scale(p, slice(None), params.dt)),
        ),
        Variant("the last entry of p must be 0", _after(params, lambda V, p: _set(p, 3, params.mu))),
        Variant("the last entry of p must be 0", _after(params, lambda V, p: _set(p, 3, 1.0))),
    ]
