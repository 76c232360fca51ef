"""Planar contacts with friction: their LCP, their impulses, and whether their motion is unique."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tumble import _core
from tumble.lcp.solvers import STATUSES, Result, as_result, with_start

MODES = np.array(_core.MODES)


@dataclass(frozen=True, eq=False)
class Motion:
    """One motion of k contacts, the same for all solutions whose impulses move the bodies alike.

    Attributes
    ----------
    z : ndarray, shape (n,)
        One of these solutions.
    modes : list of str
        "open", "stick", "slip left" or "slip right" for each contact, as z has them.
    velocities : ndarray, shape (k, 2)
        u_n, u_t at each contact.
    """

    z: NDArray[np.float64]
    modes: list[str]
    velocities: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Motions:
    """All motions that contacts allow.

    Attributes
    ----------
    status : str
        As in `Result`.
    motions : list of Motion
        Empty if there is no solution.
    has_between : bool
        Some of the motions belong to a continuum of solutions: there are infinitely many.
    """

    status: str
    motions: list[Motion]
    has_between: bool

    @property
    def is_unique(self) -> bool:
        """True if there is exactly one motion, however many impulses cause it."""
        return len(self.motions) == 1 and not self.has_between


@dataclass(frozen=True, eq=False)
class OneContacts:
    """N contacts, each on its own; arrays of shape (N,). Where the status is not "solved", the others mean nothing.

    Attributes
    ----------
    f_n, f_t : ndarray
        Normal force or impulse, >= 0 where solved, and friction along +t.
    slip_speed : ndarray
        abs(u_t).
    mode, status : ndarray of str
        As in `ContactResult` and `Result`; the status is "solved" or "numerical".
    residual : ndarray
        As in `Result`.
    """

    f_n: NDArray[np.float64]
    f_t: NDArray[np.float64]
    slip_speed: NDArray[np.float64]
    mode: NDArray[np.str_]
    status: NDArray[np.str_]
    residual: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ContactResult:
    """The impulses of k contacts between b bodies, and the motion after them.

    Unless ``result.status`` is "solved", impulses, modes and velocities are those of the best candidate met and mean
    nothing.

    Attributes
    ----------
    normal_impulse : ndarray, shape (k,)
        [N s], >= 0 if solved.
    friction_impulse : ndarray, shape (k,)
        [N s], along +t.
    slip_speed : ndarray, shape (k,)
        [m/s]. Of a contact that presses: the speed at which it slides. Of an open one: a bound on it.
    mode : list of str
        "open", "stick", "slip left" (towards -t) or "slip right".
    velocity : ndarray, shape (3 b,)
        After the impulses, v + M^-1 J^T f: (vx, vy, omega) of each body [m/s, m/s, rad/s].
    result : Result
        Of the LCP; check its `status` first.
    motions : Motions or None
        All motions, if asked for: ``motions.is_unique`` tells whether `velocity` is the only outcome.
    """

    normal_impulse: NDArray[np.float64]
    friction_impulse: NDArray[np.float64]
    slip_speed: NDArray[np.float64]
    mode: list[str]
    velocity: NDArray[np.float64]
    result: Result
    motions: Motions | None = None


def _as_motions(fields: dict[str, Any]) -> Motions:
    motions = [Motion(*motion) for motion in fields.pop("motions")]
    return Motions(motions=motions, **fields)


def contact_problem(
    J_n: ArrayLike,
    J_t: ArrayLike,
    inverse_mass: ArrayLike,
    velocity: ArrayLike,
    friction: ArrayLike,
    offset: ArrayLike = 0.0,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """The LCP of k planar contacts with friction between b bodies [1]_.

    Its unknowns are z = (c_1 .. c_k, b+_1, b-_1, .. b+_k, b-_k, s_1 .. s_k): normal impulses, friction impulses along +t
    and -t [N s], slip speeds [m/s].

    Parameters
    ----------
    J_n, J_t : array_like, shape (k, 3 b)
        u_n = J_n v + offset is the speed at which contact i opens, u_t = J_t v that at which it slides along +t. A row
        is zero but for the three columns of each of its bodies, at most two.
    inverse_mass : array_like, shape (3 b,)
        (1/m, 1/m, 1/I) of each body [1/kg, 1/kg, 1/(kg m^2)]; 0 for what cannot move.
    velocity : array_like, shape (3 b,)
        (vx, vy, omega) of each body before the impulses [m/s, m/s, rad/s].
    friction : array_like, shape (k,) or a number
        Coefficients of friction, >= 0.
    offset : array_like, shape (k,) or a number
        Added to u_n [m/s]: gap / step size, or restitution times the approach speed.

    Returns
    -------
    M : ndarray, shape (4 k, 4 k)
    q : ndarray, shape (4 k,)
    row_sizes : ndarray, shape (4 k,)
        For `solve` and `residual`.

    Raises
    ------
    ValueError
        For shapes that do not fit, NaN or infinite entries, negative masses or friction, and for rows that touch no
        body or more than two.

    References
    ----------
    .. [1] D. E. Stewart, J. C. Trinkle: An implicit time-stepping scheme for rigid body dynamics with inelastic
       collisions and Coulomb friction, 1996.

    Examples
    --------
    A ball of mass 2 kg falls straight down on the ground; its spin makes the lowest point, 0.1 m below, move.

    >>> M, q, row_sizes = contact_problem(
    ...     [[0, 1, 0]], [[1, 0, 0.1]], inverse_mass=[0.5, 0.5, 100], velocity=[0, -1, 5], friction=0.2
    ... )
    >>> M + 0.0  # no -0
    array([[ 0.5,  0. ,  0. ,  0. ],
           [ 0. ,  1.5, -1.5,  1. ],
           [ 0. , -1.5,  1.5,  1. ],
           [ 0.2, -1. , -1. ,  0. ]])
    >>> q
    array([-1. ,  0.5, -0.5,  0. ])
    """
    return _core.contact_problem(J_n, J_t, inverse_mass, velocity, friction, offset)


def solve_contacts(
    J_n: ArrayLike,
    J_t: ArrayLike,
    inverse_mass: ArrayLike,
    velocity: ArrayLike,
    friction: ArrayLike,
    offset: ArrayLike = 0.0,
    method: str = "robust",
    *,
    start: ContactResult | Result | ArrayLike | None = None,
    motions: bool = False,
    **settings: Any,
) -> ContactResult:
    """The impulses of k planar contacts with friction between b bodies, and the motion after them.

    Better than to `solve` the `contact_problem`: where J M^-1 J^T has lost digits, as for a heavy body on a light one,
    the Jacobians themselves correct the impulses.

    Parameters
    ----------
    J_n, J_t, inverse_mass, velocity, friction, offset
        As for `contact_problem`.
    method, start, **settings
        As for `solve`. In a simulation, pass the result of the last step as `start` while the contacts stay the same.
    motions : bool
        Also find all motions, see `contact_motions`; at most 3 contacts.

    Returns
    -------
    ContactResult

    Raises
    ------
    ValueError, TypeError
        As `contact_problem` and `solve`, and for `motions` of more than 3 contacts.

    Examples
    --------
    The ball of `contact_problem`: friction of 0.2 times 2 N s, to the left, slows the spin and starts it rolling.

    >>> hit = solve_contacts(
    ...     [[0, 1, 0]], [[1, 0, 0.1]], inverse_mass=[0.5, 0.5, 100], velocity=[0, -1, 5], friction=0.2
    ... )
    >>> hit.mode, hit.normal_impulse, hit.friction_impulse.round(6)
    (['stick'], array([2.]), array([-0.333333]))
    >>> (hit.velocity + 0.0).round(6)
    array([-0.166667,  0.      ,  1.666667])

    A box lands flat on two corners. Friction at one may pull against the other, but the box stops all the same:

    >>> box = solve_contacts(
    ...     [[0, 1, -0.5], [0, 1, 0.5]],
    ...     [[1, 0, 0.25], [1, 0, 0.25]],
    ...     inverse_mass=[1, 1, 10],
    ...     velocity=[0, -1, 0],
    ...     friction=0.5,
    ...     motions=True,
    ... )
    >>> box.motions.is_unique, box.motions.motions[0].modes
    (True, ['stick', 'stick'])
    """
    first = start.result if isinstance(start, ContactResult) else start
    fields = _core.solve_contacts(
        J_n, J_t, inverse_mass, velocity, friction, offset, method, motions, with_start(method, first, settings)
    )
    result, found = as_result(fields.pop("result")), fields.pop("motions")
    return ContactResult(result=result, motions=None if found is None else _as_motions(found), **fields)


def solve_one_contacts(
    A_nn: ArrayLike, A_nt: ArrayLike, A_tt: ArrayLike, b_n: ArrayLike, b_t: ArrayLike, friction: ArrayLike
) -> OneContacts:
    """N contacts, each the only one of its body, in closed form: a few nanoseconds each.

    For each of them u = A f + b, the velocity (u_n, u_t) after the force or impulse f = (f_n, f_t).

    Parameters
    ----------
    A_nn, A_nt, A_tt : array_like, shape (N,)
        The entries of A, which is symmetric and positive definite: J_n M^-1 J_n^T, J_n M^-1 J_t^T, J_t M^-1 J_t^T.
    b_n, b_t : array_like, shape (N,)
        The velocity before; b_n is whatever must become >= 0.
    friction : array_like, shape (N,)
        Coefficients of friction, >= 0.

    Returns
    -------
    OneContacts
        A contact whose numbers break the rules above, or are not finite, gets the status "numerical".

    Raises
    ------
    ValueError
        For arrays of different lengths or that are none.

    Examples
    --------
    >>> hits = solve_one_contacts([1, 1], [0, 0], [1, 1], b_n=[-2, 1], b_t=[0.5, 3], friction=[0.5, 0.5])
    >>> hits.mode, hits.f_n
    (array(['stick', 'open'], dtype='<U10'), array([2., 0.]))
    """
    fields = _core.solve_one_contacts(A_nn, A_nt, A_tt, b_n, b_t, friction)
    mode, status = MODES[fields.pop("mode")], STATUSES[fields.pop("status")]
    return OneContacts(mode=mode, status=status, **fields)


def contact_motions(M: ArrayLike, q: ArrayLike, row_sizes: ArrayLike | None = None) -> Motions:
    """All motions of up to three contacts with friction, from all solutions of their LCP.

    Impulses are often not unique, and it seldom matters: several solutions can move the bodies in the same way. With
    much friction the motion itself may not be unique either.

    Parameters
    ----------
    M : array_like, shape (n, n)
        Of planar contacts, as `contact_problem` makes it, in any order and scale of the unknowns; n <= 12.
    q : array_like, shape (n,)
    row_sizes : array_like, shape (n,), optional
        See `residual`.

    Returns
    -------
    Motions
        Contacts in the order of their cone rows, +t along the first friction unknown, followed by normals without
        friction unknowns. Where friction is 0, cones take the normals that no cone names in their order, as in
        `contact_problem`.

    Raises
    ------
    ValueError
        As `solve`, for n > 12, and if M is not that of contacts, one of them with a friction cone.

    Examples
    --------
    A rod leans so that pushing it pulls its tip into the ground. It may jam, slide on, or lift off:

    >>> M = [[2.08, -2.88, 2.88, 0], [-2.88, 8.68, -8.68, 1], [2.88, -8.68, 8.68, 1], [3, -1, -1, 0]]
    >>> found = contact_motions(M, [0.01, -1, 1, 0])
    >>> found.is_unique, sorted(motion.modes[0] for motion in found.motions)
    (False, ['open', 'slip left', 'stick'])
    """
    return _as_motions(_core.contact_motions(M, q, row_sizes))
