"""The document's model: a square falls on the line y = 0 and touches it with its lowest corner.

Names, argument order, shapes and meaning are the document's. SI units, radians, y up, counter-clockwise positive:
q = (x, y, theta) is the pose of the centre of mass, v = (vx, vy, omega) its velocity; the ground's normal is +y, its
tangent +x. Every function also takes ``params=``.

>>> import numpy as np
>>> from tumble.drop import Parameters, simulate
>>> q, v = simulate([0, 1.5, np.deg2rad(30)], [0, -0.2, 0])
>>> q.shape
(3, 150)
>>> q, v = simulate([0, 1.5, np.deg2rad(30)], [0, -0.2, 0], params=Parameters(l=0.4, mu=0.5))
"""

from __future__ import annotations

import io
import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tumble import _core
from tumble._batch import Batch, simulate_batch
from tumble._core import NoSolution, Parameters
from tumble._files import as_target, output_module
from tumble._render import render
from tumble._view import Page, view

__all__ = [
    "Batch",
    "NoSolution",
    "Parameters",
    "Record",
    "corner_positions",
    "form_lcp",
    "get_contacts",
    "record",
    "render",
    "simulate",
    "simulate_batch",
    "solve_LCP",
    "step",
]

Parameters.__doc__ = """The document's parameters, checked once and then constant; keywords only.

Parameters
----------
l : float, default 0.2
    Side of the square [m], > 0.
m : float, default 0.3
    Mass [kg], > 0. The moment of inertia is m l^2 / 6.
mu : float, default 0.3
    Coefficient of friction [-], >= 0.
eps : float, default 0.5
    Coefficient of restitution [-], in [0, 1].
dt : float, default 0.01
    Time step [s], > 0.
delta : float, default 0.001
    Contact threshold and lift [m], >= 0.
g : float, default 9.81
    Gravitational acceleration, downwards [m/s^2].
columns : int, default 150
    Columns of a trajectory, the initial state included, 2 to 10 000 000.

Raises
------
ValueError
    Naming the field, its value and the allowed range.
"""

NoSolution.__doc__ = """An LCP has no solution, or a step left the range of double arithmetic; the text has the status."""

_DEFAULTS = Parameters()


def get_contacts(q: ArrayLike, params: Parameters = _DEFAULTS) -> tuple[NDArray[np.float64], float]:
    """Contact Jacobian and distance of the lowest corner (part 1).

    Parameters
    ----------
    q : array_like, shape (3,)
        Pose (x, y, theta) [m, m, rad].
    params : Parameters
        Uses l.

    Returns
    -------
    J : ndarray, shape (3, 2)
        Columns [J_t, J_n]. With r = corner - centre of mass in the world frame, J_t = (1, 0, -r_y),
        J_n = (0, 1, r_x).
    phi : float
        Distance of the corner from the ground [m]; negative is penetration.

    Raises
    ------
    ValueError
        For a wrong shape, NaN, infinity or a masked entry.

    Notes
    -----
    Of corners at the same height the first in the order (-,-), (+,-), (+,+), (-,+) of the body frame counts.
    """
    return _core.get_contacts(q, params)


def form_lcp(
    J: ArrayLike, v: ArrayLike, params: Parameters = _DEFAULTS
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The LCP of the contact (part 2): w = V z + p >= 0, z >= 0, w . z = 0 for z = (f_n, f_t1, f_t2, lambda).

    Parameters
    ----------
    J : array_like, shape (3, 2)
        Columns [J_t, J_n], as `get_contacts` returns them.
    v : array_like, shape (3,)
        Velocity (vx, vy, omega) [m/s, m/s, rad/s].
    params : Parameters
        Uses l, m, mu, eps, dt, g.

    Returns
    -------
    V : ndarray, shape (4, 4)
    p : ndarray, shape (4,)
        [J_n.((1 + eps) v + dt M^-1 f_e), -J_t.(v + dt M^-1 f_e), J_t.(v + dt M^-1 f_e), 0] [m/s]. The unknowns are
        forces [N] and a sliding speed [m/s].

    Raises
    ------
    ValueError
        For a wrong shape, NaN, infinity or a masked entry.
    """
    return _core.form_lcp(J, v, params)


def solve_LCP(V: ArrayLike, p: ArrayLike, params: Parameters = _DEFAULTS) -> NDArray[np.float64]:
    """The contact forces of any 4 x 4 LCP, not only of those from `form_lcp`.

    Parameters
    ----------
    V : array_like, shape (4, 4)
    p : array_like, shape (4,)
    params : Parameters
        Taken for uniformity; V and p say everything.

    Returns
    -------
    f_c : ndarray, shape (3,)
        (f_n, f_t1, f_t2) [N]; the tangential force along +x is f_t2 - f_t1. Of several solutions, one.

    Raises
    ------
    ValueError
        For a wrong shape, NaN, infinity or a masked entry.
    NoSolution
        (a RuntimeError) with the status, if the LCP has no solution.
    """
    return _core.solve_LCP(V, p)


def step(
    q: ArrayLike, v: ArrayLike, params: Parameters = _DEFAULTS
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The state one time step later (part 3).

    In contact, that is for phi < delta: v' = v + dt M^-1 (f_e + J_n f_n - J_t f_t1 + J_t f_t2) and
    q' = q + dt v' + (0, delta, 0). Else v' = v + dt M^-1 f_e and q' = q + dt v'.

    Parameters
    ----------
    q : array_like, shape (3,)
        Pose (x, y, theta) [m, m, rad].
    v : array_like, shape (3,)
        Velocity (vx, vy, omega) [m/s, m/s, rad/s].
    params : Parameters

    Returns
    -------
    q, v : ndarray, shape (3,)

    Raises
    ------
    ValueError
        For a wrong shape, NaN, infinity or a masked entry.
    NoSolution
        If the numbers leave the range of double arithmetic.
    """
    return _core.step(q, v, params)


def simulate(
    q0: ArrayLike, v0: ArrayLike, params: Parameters = _DEFAULTS
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The trajectory from an initial state (part 4).

    Parameters
    ----------
    q0 : array_like, shape (3,)
        Pose (x, y, theta) [m, m, rad].
    v0 : array_like, shape (3,)
        Velocity (vx, vy, omega) [m/s, m/s, rad/s].
    params : Parameters
        `columns` is the length of the trajectory, 150 unless given.

    Returns
    -------
    q, v : ndarray, shape (3, columns)
        Column 0 is the initial state, each further column one step later.

    Raises
    ------
    ValueError
        For a wrong shape, NaN, infinity or a masked entry.
    NoSolution
        If the numbers leave the range of double arithmetic; the text says at which step.
    """
    return _core.simulate(q0, v0, params)


@dataclass(frozen=True, eq=False)
class Record:
    """A trajectory with everything that happened on the way; T = columns.

    Attributes
    ----------
    params : Parameters
    t : ndarray, shape (T,)
        Time [s].
    q, v : ndarray, shape (3, T)
        As `simulate` returns them.
    gap : ndarray, shape (T,)
        phi before the step from column k on [m].
    corner : ndarray of int, shape (T,)
        Lowest corner: 0 (-,-), 1 (+,-), 2 (+,+), 3 (-,+), signs of its coordinates in the body frame.
    f_n, f_t1, f_t2 : ndarray, shape (T,)
        Contact forces during the step [N]; the tangential force along +x is f_t2 - f_t1.
    slip_speed : ndarray, shape (T,)
        lambda of the LCP [m/s].
    mode : list of str, length T
        "open", "stick", "slip left" or "slip right".
    status : list of str, length T
        "solved", or "numerical" for the step that ended the run.
    residual : ndarray, shape (T,)
        Of the LCP [-].
    kinetic, potential : ndarray, shape (T,)
        Energies [J]; the potential energy is 0 at y = 0.
    """

    params: Parameters
    t: NDArray[np.float64]
    q: NDArray[np.float64]
    v: NDArray[np.float64]
    gap: NDArray[np.float64]
    corner: NDArray[np.int32]
    f_n: NDArray[np.float64]
    f_t1: NDArray[np.float64]
    f_t2: NDArray[np.float64]
    slip_speed: NDArray[np.float64]
    mode: list[str]
    status: list[str]
    residual: NDArray[np.float64]
    kinetic: NDArray[np.float64]
    potential: NDArray[np.float64]

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        format: str = "",
        width: int = 0,
        height: int = 0,
        speed: float = 1.0,
    ) -> Path:
        """Write a file; an existing one is replaced, once the new one is complete. docs/formats.md says what is in it.

        Parameters
        ----------
        path : path
            Its ending says what: ``.csv``, ``.npz`` and ``.h5`` (with HDF5) the record, as ``tumble render`` reads it;
            ``.gif`` and ``.mp4`` (with ffmpeg) a film in real time, ``.png`` and ``.svg`` poses in one picture;
            ``.html`` a page that plays the drop in a browser (see `view`).
        format, width, height, speed
            As of `tumble.Trajectory.save`, which also says what is raised.

        Returns
        -------
        Path
        """
        output_module().save_record(_npz_of(self), *as_target(path, format, width, height, speed))
        return Path(os.fsdecode(path))

    def view(self, path: str | os.PathLike[str] | None = None) -> Path | Page:
        """Play the drop in a browser, or in the notebook, as `tumble.Trajectory.view` does with runs of scenes."""
        return view(self.save, path)


def _npz_of(record: Record) -> bytes:
    """The record as the array file of docs/formats.md, which C++ checks and reads."""
    output, params = output_module(), record.params
    statuses = [output.status_names.index(status) for status in record.status]
    file = io.BytesIO()
    np.savez(
        file, q=record.q, v=record.v, gap=record.gap, corner=record.corner, residual=record.residual,
        z=np.array([record.f_n, record.f_t1, record.f_t2, record.slip_speed]),
        mode=[output.mode_names.index(mode) for mode in record.mode], status=statuses,
        columns=params.columns, trajectory_status=statuses[-1],
        l=params.l, m=params.m, mu=params.mu, eps=params.eps, dt=params.dt, delta=params.delta, g=params.g,
    )  # fmt: skip
    return file.getvalue()


def record(q0: ArrayLike, v0: ArrayLike, params: Parameters = _DEFAULTS) -> Record:
    """As `simulate`, with contact, forces, modes, solver status and energies of every step.

    Parameters
    ----------
    q0, v0 : array_like, shape (3,)
        Pose [m, m, rad] and velocity [m/s, m/s, rad/s].
    params : Parameters

    Returns
    -------
    Record
        Row k belongs to the step from column k on; of the last column it says what the next step would do. A run whose
        numbers or energies leave the range of double ends early, its last status being "numerical".

    Raises
    ------
    ValueError
        For a wrong shape, NaN, infinity or a masked entry, or a start whose energy is not finite.
    """
    return Record(params=params, **_core.simulate_with_record(q0, v0, params))


def corner_positions(q: ArrayLike, params: Parameters = _DEFAULTS) -> NDArray[np.float64]:
    """The four corners of the square in the world frame.

    Parameters
    ----------
    q : array_like, shape (3,)
        Pose (x, y, theta) [m, m, rad].
    params : Parameters
        Uses l.

    Returns
    -------
    ndarray, shape (4, 2)
        (x, y) [m] of the corners (-,-), (+,-), (+,+), (-,+).

    Raises
    ------
    ValueError
        For a wrong shape, NaN, infinity or a masked entry.
    """
    return _core.corner_positions(q, params)
