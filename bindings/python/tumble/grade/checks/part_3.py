"""Part 3: one step.

Points: form 3, velocity in free flight 4, position in free flight 4, velocity in contact 10, position in contact 6,
the decision at phi = delta 3. Positions are judged with the student's own new velocity, so that a wrong velocity does
not cost the points of the position too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from tumble import drop

from tumble.grade.codec import Array, Other, as_pair, describe
from tumble.grade.judge import TOLERANCE, Case, Item, Output, Reading, Variant, shape_problem
from tumble.grade.states import SEED, TURNS, angle_tags, angle_with_lowest, pose, velocity_with_mode

NUMBER = 3
TITLE = "one step"
FUNCTION = "step"
MAXIMUM = 30.0

_MODES = ("sticks", "slides left", "slides right", "opens")
_CONTACT = "the square is in contact"
_FREE = "the square is in free flight"


def cases(params: drop.Parameters) -> list[Case]:
    """Free flight, every corner in every contact mode above and below the ground, and phi around delta."""
    generator = np.random.default_rng(SEED + NUMBER)
    return [
        *_free_cases(params, generator),
        *_decision_cases(params, generator),
        *_contact_cases(params, generator),
    ]


def _free_cases(params: drop.Parameters, generator: np.random.Generator) -> list[Case]:
    result = []
    for k in range(8):
        corner, turns = k % 4, TURNS[k % len(TURNS)]
        theta = angle_with_lowest(corner, turns, generator)
        q = pose(params.delta + params.l * generator.uniform(0.1, 5.0), theta, params.l, params)
        v = generator.normal(size=3) * np.array([1.0, 1.0, 1.0 / params.l]) * np.sqrt(params.l * params.g)
        result.append(_case(q, v, (_FREE, *angle_tags(corner, theta)), "free", params))
    return result


def _contact_cases(params: drop.Parameters, generator: np.random.Generator) -> list[Case]:
    result = []
    for corner in range(4):
        for k, mode in enumerate(_MODES):
            for sunk in (False, True):
                theta = angle_with_lowest(corner, TURNS[(corner + k + sunk) % len(TURNS)], generator)
                phi = (
                    -0.05 * params.l if sunk else params.delta * generator.uniform(0.1, 0.9) - 1e-9 * params.l
                )
                q = pose(phi, theta, -params.l, params)
                v = velocity_with_mode(q, mode, params, generator)
                height = (
                    "the corner is below the ground" if sunk else "the corner is between the ground and delta"
                )
                tags = (_CONTACT, *angle_tags(corner, theta), f"the corner {mode}", height)
                result.append(_case(q, v, tags, "contact", params))
    return result


def _decision_cases(params: drop.Parameters, generator: np.random.Generator) -> list[Case]:
    near = 1e-6 * max(params.delta, 1e-3 * params.l)
    result = []
    for k, offset in enumerate((near, -near, 0.5 * params.l, -0.02 * params.l, near, -near)):
        theta = angle_with_lowest(k % 4, 0, generator)
        q = pose(params.delta + offset, theta, 0.0, params)
        v = velocity_with_mode(q, "sticks", params, generator)
        side = "below delta" if offset < 0 else "above delta"
        result.append(_case(q, v, (f"phi is {side}",), "decision", params))
    for corner in range(3):
        q = pose(params.delta, angle_with_lowest(corner, 0, generator), 0.0, params)
        v = velocity_with_mode(q, "sticks", params, generator)
        # The pose has a round-off of its own; our get_contacts hands over delta without one.
        result.append(_case(q, v, ("phi is equal to delta",), "decision", params, phi=params.delta))
    return result


def _case(
    q: Array, v: Array, tags: tuple[str, ...], kind: str, params: drop.Parameters, phi: float | None = None
) -> Case:
    J, distance = drop.get_contacts(q, params)
    V, p = drop.form_lcp(J, v, params)
    forces = drop.solve_LCP(V, p)
    data: dict[str, Any] = {"kind": kind, "J": J, "forces": forces}
    in_contact = (distance if phi is None else phi) < params.delta
    case = Case((q, v), (), tags, data, phi)
    data["velocity if free"] = _Formula(params).solve(case, in_contact=False)[1]
    data["velocity if in contact"] = _Formula(params).solve(case, in_contact=True)[1]
    data["in contact"] = in_contact
    return replace(case, truth=_truth(case, params))


def _truth(case: Case, params: drop.Parameters) -> Output:
    if case.phi is None:
        return drop.step(case.arguments[0], case.arguments[1], params)
    return _Formula(params).solve(case, in_contact=case.data["in contact"])


def _speed(params: drop.Parameters) -> float:
    """Size of the velocities in the cases [m/s]."""
    return float(params.dt * params.g + np.sqrt(params.l * params.g))


def items(params: drop.Parameters) -> list[Item]:
    """The sub-points."""
    speed = _speed(params)

    def velocity(kind: str) -> Callable[[Case, Output], Array | None]:
        return lambda case, output: output[1] if case.data["kind"] == kind else None

    def shift(kind: str) -> Callable[[Case, Output], Array | None]:
        def quantity(case: Case, output: Output) -> Array | None:
            if case.data["kind"] != kind:
                return None
            return output[0] - case.arguments[0] - params.dt * output[1]

        return quantity

    def decision(case: Case, output: Output) -> Array | None:
        if case.data["kind"] != "decision":
            return None
        is_finite = all(np.all(np.isfinite(array)) for array in output)
        return np.array([float(_is_contact(case, output, params)) if is_finite else np.nan])

    return [
        Item("velocity in free flight", 4.0, velocity("free"), speed),
        Item("position in free flight (q' - q - dt v')", 4.0, shift("free"), params.l),
        Item("velocity in contact", 10.0, velocity("contact"), speed),
        Item("position in contact (q' - q - dt v')", 6.0, shift("contact"), params.l),
        Item("contact if and only if phi < delta", 3.0, decision, 1.0),
    ]


def _is_contact(case: Case, output: Output, params: drop.Parameters) -> bool:
    """Whether the student's step took the square for in contact, also if its forces or its gravity are wrong."""
    q, v = output
    free, contact = case.data["velocity if free"], case.data["velocity if in contact"]
    if np.allclose(v, free, rtol=0.0, atol=TOLERANCE * _speed(params)):
        return False
    lift = (q - case.arguments[0] - params.dt * v)[1]
    if abs(lift - params.delta) < TOLERANCE * params.l < params.delta:
        return True
    return bool(np.max(np.abs(v - contact)) < np.max(np.abs(v - free)))


def readings() -> list[Reading]:
    """q, v as documented; in the wrong order."""
    return [
        Reading(lambda result: _read(result, swapped=False)),
        Reading(
            lambda result: _read(result, swapped=True),
            "returns v, q; the order must be q, v",
            {"step_swapped": True},
        ),
    ]


def _read(result: Any, swapped: bool) -> tuple[Output | None, str]:
    pair = as_pair(result) if not isinstance(result, Other) else None
    if pair is None or len(pair) != 2:
        return None, f"must return two values, q and v; got {describe(result)}"
    q, q_problem = shape_problem("q", pair[swapped], (3,))
    v, v_problem = shape_problem("v", pair[not swapped], (3,))
    return (None if q is None or v is None else (q, v)), q_problem or v_problem


class _Formula:
    """The step with its pieces open to change.

    Attributes
    ----------
    gravity, contact_gravity : ndarray, shape (3,)
        What gravity adds to v in free flight and in contact.
    factor : ndarray, shape (3,)
        dt M^-1 before the contact forces.
    signs : tuple of three numbers
        Of J_n f_n, J_t f_t1, J_t f_t2.
    lift, free_lift : ndarray, shape (3,)
        What is added to q in contact and in free flight.
    """

    def __init__(self, params: drop.Parameters) -> None:
        self.params = params
        self.mass = params.m * np.array([1.0, 1.0, params.l**2 / 6.0])
        self.gravity = params.dt * np.array([0.0, -params.g, 0.0])
        self.contact_gravity = self.gravity
        self.factor = params.dt / self.mass
        self.signs = (1.0, -1.0, 1.0)
        self.lift = np.array([0.0, params.delta, 0.0])
        self.free_lift = np.zeros(3)
        self.columns = (0, 1)

    def solve(self, case: Case, in_contact: bool | None = None) -> Output:
        q, v = case.arguments
        v_next = self.new_velocity(case, case.data["in contact"] if in_contact is None else in_contact)
        lift = (
            self.lift if (case.data["in contact"] if in_contact is None else in_contact) else self.free_lift
        )
        return self.new_position(q, v, v_next) + lift, v_next

    def new_velocity(self, case: Case, in_contact: bool) -> Array:
        v = case.arguments[1]
        if not in_contact:
            return v + self.gravity
        t, n = self.columns
        J, forces = case.data["J"], case.data["forces"]
        push = self.signs[0] * J[:, n] * forces[0] + J[:, t] * (
            self.signs[1] * forces[1] + self.signs[2] * forces[2]
        )
        return np.asarray(v + self.contact_gravity + self.factor * push)

    def new_position(self, q: Array, v: Array, v_next: Array) -> Array:
        return q + self.params.dt * v_next


def _with(params: drop.Parameters, **changes: Any) -> Callable[[Case], Output]:
    formula = _Formula(params)
    for name, value in changes.items():
        setattr(formula, name, value)
    return formula.solve


def variants(params: drop.Parameters) -> list[Variant]:
    """Wrong solutions, most likely first."""
    return [
        *_decision_mistakes(params),
        *_lift_mistakes(params),
        *_motion_mistakes(params),
        *_force_mistakes(params),
        *_gravity_mistakes(params),
    ]


def _decision_mistakes(params: drop.Parameters) -> list[Variant]:
    right = _Formula(params)

    def decide(rule: Callable[[float], bool]) -> Callable[[Case], Output]:
        def solve(case: Case) -> Output:
            phi = drop.get_contacts(case.arguments[0], params)[1] if case.phi is None else case.phi
            return right.solve(case, in_contact=rule(phi))

        return solve

    return [
        Variant(
            "phi == delta is not contact: the test is phi < delta, not <=",
            decide(lambda phi: phi <= params.delta),
        ),
        Variant("contact begins at phi < delta, not at phi < 0", decide(lambda phi: phi < 0.0)),
        Variant("contact begins at phi < delta, not at phi <= 0", decide(lambda phi: phi <= 0.0)),
        Variant(
            "contact begins at phi < delta; the test is the wrong way round",
            decide(lambda phi: phi > params.delta),
        ),
        Variant(
            "the test takes the size of phi: a corner deep below the ground is in contact too",
            decide(lambda phi: abs(phi) < params.delta),
        ),
        Variant("treats every state as contact; phi < delta decides", decide(lambda phi: True)),
        Variant("treats no state as contact; phi < delta decides", decide(lambda phi: False)),
    ]


def _lift_mistakes(params: drop.Parameters) -> list[Variant]:
    dt, delta = params.dt, params.delta
    up = np.array([0.0, delta, 0.0])

    def lift_if(rule: Callable[[Case, Output], bool]) -> Callable[[Case], Output]:
        right = _Formula(params)

        def solve(case: Case) -> Output:
            q, v = right.solve(case)
            lifted = case.data["in contact"] and not rule(case, (q, v))
            return (q - up if lifted else q), v

        return solve

    def lift_to_ground(case: Case) -> Output:
        q, v = _Formula(params).solve(case)
        if case.data["in contact"]:
            q = q - up - np.array([0.0, drop.get_contacts(case.arguments[0], params)[1], 0.0])
        return q, v

    return [
        Variant("the lift is missing: q gets + (0, delta, 0) in contact", _with(params, lift=np.zeros(3))),
        Variant(
            "the lift (0, delta, 0) belongs to contact only, not to free flight", _with(params, free_lift=up)
        ),
        Variant(
            "the lift is added only where the corner is pushed; it belongs to every step in contact",
            lift_if(lambda case, state: bool(case.data["forces"][0] > 0.0)),
        ),
        Variant(
            "the lift is added only below the ground; it belongs to every step in contact",
            lift_if(lambda case, state: bool(drop.get_contacts(case.arguments[0], params)[1] < 0.0)),
        ),
        Variant("the lift points down; it is + (0, delta, 0)", _with(params, lift=-up)),
        Variant("the lift is multiplied by dt; it is (0, delta, 0)", _with(params, lift=dt * up)),
        Variant("the lift goes to all of q; it is (0, delta, 0)", _with(params, lift=np.full(3, delta))),
        Variant("the lift goes to x; it is (0, delta, 0)", _with(params, lift=np.array([delta, 0.0, 0.0]))),
        Variant(
            "the lift goes to the angle; it is (0, delta, 0)", _with(params, lift=np.array([0.0, 0.0, delta]))
        ),
        Variant("the lift is -phi; it is (0, delta, 0)", lift_to_ground),
    ]


def _motion_mistakes(params: drop.Parameters) -> list[Variant]:
    dt = params.dt
    half_fall = 0.5 * dt**2 * np.array([0.0, -params.g, 0.0])
    return [
        Variant(
            "q moves with the old velocity; it must move with the new one",
            _with(params, new_position=lambda q, v, v_next: q + dt * v),
        ),
        Variant(
            "q moves with the mean of the old and the new velocity; it must move with the new one",
            _with(params, new_position=lambda q, v, v_next: q + 0.5 * dt * (v + v_next)),
        ),
        Variant(
            "q gets an extra g dt^2 / 2; it must move with the new velocity only",
            _with(params, new_position=lambda q, v, v_next: q + dt * v_next + half_fall),
        ),
        Variant(
            "dt is missing where q moves: q' = q + dt v'",
            _with(params, new_position=lambda q, v, v_next: q + v_next),
        ),
        Variant("the angle is wrapped into one turn; it must go on counting", _wrapped(params, 0.0)),
        Variant("the angle is wrapped into one turn; it must go on counting", _wrapped(params, np.pi)),
        Variant("q does not move", _with(params, new_position=lambda q, v, v_next: q)),
    ]


def _wrapped(params: drop.Parameters, below: float) -> Callable[[Case], Output]:
    """The angle taken into the turn that begins at -below [rad]."""

    def solve(case: Case) -> Output:
        q, v = _Formula(params).solve(case)
        q[2] = (q[2] + below) % (2 * np.pi) - below
        return q, v

    return solve


def _force_mistakes(params: drop.Parameters) -> list[Variant]:
    right = _Formula(params)
    m, l, dt = params.m, params.l, params.dt
    inertias = {
        "m l^2": m * l**2,
        "m l^2 / 12": m * l**2 / 12,
        "m l^2 / 3": m * l**2 / 3,
        "l^2 / 6, without m": l**2 / 6,
        "m": m,
        "1": 1.0,
        "m l / sqrt(6), with r_g instead of r_g^2": m * l / np.sqrt(6.0),
    }
    return [
        Variant(
            "f_t1 and f_t2 have the wrong signs: - J_t f_t1 + J_t f_t2", _with(params, signs=(1.0, 1.0, -1.0))
        ),
        Variant("friction is missing: - J_t f_t1 + J_t f_t2", _with(params, signs=(1.0, 0.0, 0.0))),
        Variant("f_t1 must be subtracted: - J_t f_t1 + J_t f_t2", _with(params, signs=(1.0, 1.0, 1.0))),
        Variant("f_t1 is missing: - J_t f_t1 + J_t f_t2", _with(params, signs=(1.0, 0.0, 1.0))),
        Variant("f_t2 is missing: - J_t f_t1 + J_t f_t2", _with(params, signs=(1.0, -1.0, 0.0))),
        Variant("f_t2 must be added: - J_t f_t1 + J_t f_t2", _with(params, signs=(1.0, -1.0, -1.0))),
        Variant("the normal force has the wrong sign", _with(params, signs=(-1.0, -1.0, 1.0))),
        Variant("the normal force is missing", _with(params, signs=(0.0, -1.0, 1.0))),
        Variant("all contact forces have the wrong sign", _with(params, signs=(-1.0, 1.0, -1.0))),
        Variant("J_t and J_n are swapped: J = [J_t, J_n]", _with(params, columns=(1, 0))),
        Variant(
            "dt is missing before the contact forces: they are forces, not impulses",
            _with(params, factor=1.0 / right.mass),
        ),
        Variant("dt is squared before the contact forces", _with(params, factor=dt**2 / right.mass)),
        Variant("M^-1 is missing before the contact forces", _with(params, factor=np.full(3, dt))),
        Variant(
            "M stands where M^-1 belongs before the contact forces", _with(params, factor=dt * right.mass)
        ),
        Variant("contact forces are added twice", _with(params, factor=2.0 * right.factor)),
        *(
            Variant(
                f"the moment of inertia is {words}; it is m l^2 / 6",
                _with(params, factor=dt / np.array([m, m, value])),
            )
            for words, value in inertias.items()
        ),
    ]


def _gravity_mistakes(params: drop.Parameters) -> list[Variant]:
    right = _Formula(params)
    fall = right.gravity
    changes = {
        "gravity is missing": np.zeros(3),
        "gravity points the wrong way": -fall,
        "dt is missing before gravity: v' = v + dt M^-1 f_e": fall / params.dt,
        "dt is squared before gravity: v' = v + dt M^-1 f_e": fall * params.dt,
        "f_e is a force: f_e = M g, not g (v gets M^-1 g where g belongs)": fall / right.mass,
        "M^-1 is missing before f_e": fall * right.mass,
        "gravity is added twice": 2.0 * fall,
    }
    return [
        *(
            Variant(words, _with(params, gravity=change, contact_gravity=change))
            for words, change in changes.items()
        ),
        Variant("restitution is applied once more in step; the LCP has it already", _bounced_again(params)),
    ]


def _bounced_again(params: drop.Parameters) -> Callable[[Case], Output]:
    def solve(case: Case) -> Output:
        q, v = _Formula(params).solve(case)
        if not case.data["in contact"]:
            return q, v
        v = (1.0 + params.eps) * v
        return case.arguments[0] + params.dt * v + np.array([0.0, params.delta, 0.0]), v

    return solve
