"""Seeded states that cover what can happen to the square."""

from __future__ import annotations

import numpy as np
from tumble import drop

from tumble.grade.codec import Array

SEED = 20201018

CORNER_NAMES = ("(-,-)", "(+,-)", "(+,+)", "(-,+)")
# Signs of the corners' coordinates in the body frame, and the angle that turns each of them straight down.
CORNER_SIGNS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
_ANGLE_OF_CORNER = (np.pi / 4, -np.pi / 4, -3 * np.pi / 4, 3 * np.pi / 4)
# Keeps this far [rad] from level faces, where two corners are equally low and the document leaves the choice open.
_FROM_LEVEL = 0.05
TURNS = (0, -1, 3)
_MOST_TRIES = 2000


def angle_with_lowest(corner: int, turns: int, generator: np.random.Generator) -> float:
    """An angle [rad] at which a corner is the lowest.

    Parameters
    ----------
    corner : int
        Index into `CORNER_NAMES`.
    turns : int
        Whole turns to add.
    generator : numpy.random.Generator
    """
    spread = np.pi / 4 - _FROM_LEVEL
    return _ANGLE_OF_CORNER[corner] + 2 * np.pi * turns + generator.uniform(-spread, spread)


def pose(phi: float, theta: float, x: float, params: drop.Parameters) -> Array:
    """The pose q, shape (3,), at which the lowest corner is phi [m] above the ground."""
    _, height = drop.get_contacts(np.array([x, 0.0, theta]), params)
    return np.array([x, phi - height, theta])


def angle_tags(corner: int, theta: float) -> tuple[str, ...]:
    """Tags of `Case` for an angle."""
    tags = [f"corner {CORNER_NAMES[corner]} of the body is the lowest"]
    if theta < 0.0:
        tags.append("the angle is negative")
    if abs(theta) > 2 * np.pi:
        tags.append("the angle is more than one turn")
    return tuple(tags)


def contact_mode(q: Array, v: Array, params: drop.Parameters) -> str:
    """What the corner does if it is in contact: "opens", "sticks", "slides left", "slides right"."""
    J, _ = drop.get_contacts(q, params)
    V, p = drop.form_lcp(J, v, params)
    f_n, f_t1, f_t2 = drop.solve_LCP(V, p)
    if f_n <= 0.0:
        return "opens"
    friction = f_t2 - f_t1
    if abs(friction) < params.mu * f_n * (1.0 - 1e-9):
        return "sticks"
    return "slides left" if friction > 0.0 else "slides right"


def velocity_with_mode(q: Array, mode: str, params: drop.Parameters, generator: np.random.Generator) -> Array:
    """A velocity, shape (3,), that makes the corner do what is asked, if the parameters allow it."""
    J, _ = drop.get_contacts(q, params)
    speed = params.dt * params.g + np.sqrt(params.l * params.g)
    v = np.zeros(3)
    for _ in range(_MOST_TRIES):
        normal = generator.uniform(0.2, 1.0) if mode == "opens" else -generator.uniform(0.2, 1.0)
        sideways = {"slides left": -2.0, "slides right": 2.0}.get(mode, 0.2)
        omega = generator.normal() * speed / params.l
        # The corner moves with (J_t . v, J_n . v); the centre of mass follows from that and from omega.
        corner = speed * np.array([sideways * generator.uniform(0.5, 1.5), normal])
        v = np.array([corner[0] - J[2, 0] * omega, corner[1] - J[2, 1] * omega, omega])
        if contact_mode(q, v, params) == mode and _is_unique(J, mode, params):
            return v
    return v


def _is_unique(J: Array, mode: str, params: drop.Parameters) -> bool:
    """Beyond this friction an opening contact can have a second solution; own LCP solvers may find that one."""
    inverse_mass = 1.0 / (params.m * np.array([1.0, 1.0, params.l**2 / 6.0]))
    normal = J[:, 1] @ (inverse_mass * J[:, 1])
    mixed = abs(J[:, 1] @ (inverse_mass * J[:, 0]))
    return bool(mode != "opens" or params.mu * mixed < 0.9 * normal)
