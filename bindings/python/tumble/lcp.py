"""Linear complementarity problems: find z with w = M z + q >= 0, z >= 0, z . w = 0.

In each pair (z_i, w_i) one number is zero. Which one is the whole difficulty: once it is known, the rest is linear. For
a contact, z_i is an impulse and w_i a velocity: either the bodies press, or they separate.

>>> from tumble import lcp
>>> result = lcp.solve([[2.0, 1.0], [1.0, 2.0]], [-5.0, -6.0])
>>> result.status, result.z
('solved', array([1.33333333, 2.33333333]))

`solve` for one problem, `solve_batch` for many of one size, `solve_contacts` for bodies in contact, `solve_one_contacts`
for many single contacts. `all_solutions` for every solution of a small problem, `contact_motions` for every motion,
`exact` for fractions in place of rounded numbers. `METHODS` says what each method does. Theory: docs/theory/lcp.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tumble import _core

__all__ = [
    "METHODS",
    "BatchResult",
    "ContactResult",
    "ExactResult",
    "Motion",
    "Motions",
    "OneContacts",
    "Residual",
    "Result",
    "all_solutions",
    "contact_motions",
    "contact_problem",
    "default_settings",
    "exact",
    "parse",
    "residual",
    "solve",
    "solve_batch",
    "solve_contacts",
    "solve_one_contacts",
]

METHODS: Mapping[str, str] = MappingProxyType(_core.methods())
"""The methods by name, each with one line on what it does and when it can be relied on."""

_STATUSES = np.array(_core.STATUSES)
_RUNGS = np.array(_core.RUNGS)
_MODES = np.array(_core.MODES)


@dataclass(frozen=True)
class Residual:
    """The three ways to miss a solution, each >= 0 and without unit; 1e-16 is round-off, 1 is nonsense."""

    negative_w: float
    negative_z: float
    complementarity: float

    @property
    def largest(self) -> float:
        """The largest of the three."""
        return max(self.negative_w, self.negative_z, self.complementarity)


@dataclass(frozen=True)
class Result:
    """What a solver returns.

    Attributes
    ----------
    status : str
        - "solved": z is a solution, up to the accepted residual;
        - "infeasible": no z >= 0 has M z + q >= 0, and `certificate` is the proof;
        - "no_solution_proved": every complementary basis was tried and failed clearly;
        - "ray_unproven": the pivots ended on a ray; no solution was found, but none is excluded;
        - "iteration_limit": the allowed number of pivots or sweeps was used up;
        - "numerical": the residual is above the accepted bound.
    z, w : ndarray, shape (n,)
        The solution and M z + q; if the status is not "solved", the best candidate met, or 0.
    residual : float
        How far z is from solving the problem, without unit: see `residual`. Computed from M and q, not from the tables
        of the method.
    parts : Residual
        The three parts of it; `residual` is the largest.
    pivots : int
        Pivots made, bases tried, or sweeps.
    refactorisations : int
        LU factorisations of a basis.
    rung : str
        The method that found z, or the last one tried. "robust" tries several; "none" is z = 0, where q >= 0.
    basis : ndarray of bool, shape (n,)
        True where z_i is basic, so that w_i = 0; elsewhere z_i = 0.
    certificate : ndarray, shape (n,), or None
        For "infeasible": y with M' y <= 0, y >= 0, q . y < 0. For "ray_unproven": the direction of the ray in z.
    """

    status: str
    z: NDArray[np.float64]
    w: NDArray[np.float64]
    residual: float
    parts: Residual
    pivots: int
    refactorisations: int
    rung: str
    basis: NDArray[np.bool_]
    certificate: NDArray[np.float64] | None


@dataclass(frozen=True)
class BatchResult:
    """The results of N problems of size n; ``batch[i]`` is the `Result` of problem i.

    Attributes
    ----------
    status, rung : ndarray of str, shape (N,)
        As in `Result`. "bad_input" marks a problem with NaN or infinite entries; its z and w are 0, its residual is inf.
    z, w, certificate : ndarray, shape (N, n)
        A problem without a certificate has a row of 0.
    residual : ndarray, shape (N,)
    parts : ndarray, shape (N, 3)
        negative_w, negative_z, complementarity.
    pivots, refactorisations : ndarray of int, shape (N,)
    basis : ndarray of bool, shape (N, n)
    """

    status: NDArray[np.str_]
    z: NDArray[np.float64]
    w: NDArray[np.float64]
    residual: NDArray[np.float64]
    parts: NDArray[np.float64]
    pivots: NDArray[np.int32]
    refactorisations: NDArray[np.int32]
    rung: NDArray[np.str_]
    basis: NDArray[np.bool_]
    certificate: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.status)

    def __getitem__(self, i: int) -> Result:
        return Result(
            status=str(self.status[i]),
            z=self.z[i],
            w=self.w[i],
            residual=float(self.residual[i]),
            parts=Residual(*map(float, self.parts[i])),
            pivots=int(self.pivots[i]),
            refactorisations=int(self.refactorisations[i]),
            rung=str(self.rung[i]),
            basis=self.basis[i],
            certificate=self.certificate[i] if self.certificate[i].any() else None,
        )

    def __iter__(self) -> Iterator[Result]:
        return (self[i] for i in range(len(self)))


@dataclass(frozen=True)
class ExactResult:
    """What rational arithmetic says of a problem: nothing is rounded.

    Attributes
    ----------
    status : str
        As in `Result`. "solved", "infeasible" and "no_solution_proved" are proofs here; the last one, where a basis was
        given, speaks of that basis alone.
    z, w : list of Fraction
        n entries, or none if there is no solution to show.
    basis : ndarray of bool, shape (n,)
        True where w_i = 0 by choice, False where z_i = 0.
    certificate : list of Fraction, or None
        As in `Result`.
    pivots : int
    """

    status: str
    z: list[Fraction]
    w: list[Fraction]
    basis: NDArray[np.bool_]
    certificate: list[Fraction] | None
    pivots: int


@dataclass(frozen=True)
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


@dataclass(frozen=True)
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


@dataclass(frozen=True)
class OneContacts:
    """N contacts, each on its own; arrays of shape (N,).

    Attributes
    ----------
    f_n, f_t : ndarray
        Normal force or impulse, >= 0, and friction along +t.
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


@dataclass(frozen=True)
class ContactResult:
    """The impulses of k contacts between b bodies, and the motion after them.

    Attributes
    ----------
    normal_impulse : ndarray, shape (k,)
        [N s], >= 0.
    friction_impulse : ndarray, shape (k,)
        [N s], along +t.
    slip_speed : ndarray, shape (k,)
        [m/s]. Of a contact that presses: the speed at which it slides. Of an open one: a bound on it.
    mode : list of str
        "open", "stick", "slip left" (towards -t) or "slip right".
    velocity : ndarray, shape (3 b,)
        After the impulses, v + M^-1 J^T f: (vx, vy, omega) of each body [m/s, m/s, rad/s].
    result : Result
        Of the LCP; check its `status`.
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


def _as_result(fields: dict[str, Any]) -> Result:
    parts = Residual(*fields.pop("parts"))
    return Result(parts=parts, **fields)


def _as_motions(fields: dict[str, Any]) -> Motions:
    motions = [Motion(*motion) for motion in fields.pop("motions")]
    return Motions(motions=motions, **fields)


def _start_name(method: str) -> str:
    """The setting that takes a start: the methods that sweep begin at a z, the others at a basis."""
    return "start_z" if "start_z" in default_settings(method) else "start_basis"


def _with_start(method: str, start: Result | ArrayLike | None, settings: dict[str, Any]) -> dict[str, Any]:
    if start is None:
        return settings
    name = _start_name(method)
    if isinstance(start, Result):
        start = start.z if name == "start_z" else start.basis
    return {**settings, name: start}


def solve(
    M: ArrayLike,
    q: ArrayLike,
    method: str = "robust",
    *,
    row_sizes: ArrayLike | None = None,
    start: Result | ArrayLike | None = None,
    **settings: Any,
) -> Result:
    """One solution of the LCP (M, q).

    Parameters
    ----------
    M : array_like, shape (n, n)
    q : array_like, shape (n,)
    method : str
        One of `METHODS`. "robust", the default, is a ladder: fast methods first, then slower and surer ones, until an
        answer is right when judged by M and q themselves. The others are its rungs and methods for comparison:

        - "lemke": complementary pivoting on a tableau [1]_, about n pivots of n^2 operations. But for round-off
          it finds a solution of contact problems, unless overlap is to be corrected, and of every feasible problem with
          a copositive-plus M; a "no" from it proves nothing.
        - "lemke_lu": the same pivots, on LU factors of the basis: less rounding is carried on, and zeros are left out.
        - "enumerate": all 2^n bases, n <= 12; a "no" from it is a proof.
        - "murty", "dantzig": principal pivots, for matrices without friction: P-matrices, and for "dantzig" semidefinite
          ones, where its "no" is a proof. Each pivot factors its basis.
        - "newton": semismooth Newton on min(w, z) = 0; a few iterations of n^3 / 3 operations for P-matrices.
        - "pgs", "nlgs": sweeps over the unknowns, or over whole contacts with friction: cheap each, but the error only
          shrinks by some factor. For many contacts with a good `start` and a loose accepted_residual.
    row_sizes : array_like, shape (n,), optional
        The typical size of each w_i, see `residual`. `contact_problem` gives them.
    start : Result or array_like, shape (n,), optional
        The result of a problem like this one, or its basis. It is tried first; if it still fits, no pivot is made.
        Methods with the setting start_basis take it, and those with start_z, which want a z in place of a basis.
    **settings
        Settings of the method, by name; `default_settings` lists them.

    Returns
    -------
    Result
        Check `status`: a problem without a solution is an outcome, not an error.

    Raises
    ------
    ValueError
        For an unknown method, a matrix that does not fit q, NaN, infinite or masked entries, or a setting out of range.
    TypeError
        For a setting that the method does not have.

    References
    ----------
    .. [1] R. W. Cottle, J.-S. Pang, R. E. Stone: The Linear Complementarity Problem, 1992, algorithm 4.4.1.

    Examples
    --------
    A block slides at 1 m/s and hits the ground at 2 m/s; friction 0.5, mass 1. z is (normal impulse, friction impulse
    to the right, to the left, slip speed): friction of 1 N s to the left just stops it.

    >>> M = [[1, 0, 0, 0], [0, 1, -1, 1], [0, -1, 1, 1], [0.5, -1, -1, 0]]
    >>> first = solve(M, [-2, 1, -1, 0])
    >>> first.status, first.z
    ('solved', array([2., 0., 1., 0.]))

    A bit slower next time, from there:

    >>> second = solve(M, [-2, 0.9, -0.9, 0], start=first)
    >>> second.z, second.rung, second.pivots
    (array([2. , 0. , 0.9, 0. ]), 'closed_form', 0)

    No z fits -z - 1 >= 0:

    >>> solve([[-1]], [-1]).status
    'infeasible'
    """
    return _as_result(_core.solve(M, q, method, row_sizes, _with_start(method, start, settings)))


def solve_batch(
    M: ArrayLike,
    q: ArrayLike,
    method: str = "robust",
    *,
    row_sizes: ArrayLike | None = None,
    start: BatchResult | ArrayLike | None = None,
    threads: int = 1,
    **settings: Any,
) -> BatchResult:
    """One solution of each of N problems of size n, in one call.

    Bit for bit what `solve` gives one by one, whatever the number of threads. A problem with NaN or infinite entries
    gets the status "bad_input" and touches no other.

    Parameters
    ----------
    M : array_like, shape (N, n, n) or (n, n)
        A matrix for each problem, or one for all.
    q : array_like, shape (N, n)
    method : str
        One of `METHODS`.
    row_sizes : array_like, shape (N, n) or (n,), optional
        The typical size of each w_i, see `residual`.
    start : BatchResult or array_like, shape (N, n) or (n,), optional
        Where to start, see `solve`.
    threads : int
        0 takes one for each processor. The interpreter is free while they work.
    **settings
        Settings of the method, by name; `default_settings` lists them.

    Returns
    -------
    BatchResult

    Raises
    ------
    ValueError
        For an unknown method, shapes that do not fit, or a setting out of range.
    TypeError
        For a setting that the method does not have.

    Examples
    --------
    >>> batch = solve_batch([[2, 1], [1, 2]], [[-5, -6], [1, 1], [np.nan, 0]])
    >>> batch.status
    array(['solved', 'solved', 'bad_input'], dtype='<U18')
    >>> batch[0].z
    array([1.33333333, 2.33333333])
    """
    if isinstance(start, BatchResult):
        start = start.z if _start_name(method) == "start_z" else start.basis
    fields = _core.solve_batch(M, q, method, row_sizes, start, threads, settings)
    status, rung = _STATUSES[fields.pop("status")], _RUNGS[fields.pop("rung")]
    return BatchResult(status=status, rung=rung, **fields)


def default_settings(method: str = "robust") -> dict[str, Any]:
    """The settings that a method takes, with their defaults.

    Parameters
    ----------
    method : str
        One of `METHODS`.

    Returns
    -------
    dict
        - max_pivots: 0 stands for a number that grows with n; max_iterations, max_sweeps: >= 1;
        - max_exchanges: pivots between two factorisations;
        - relaxation: of each step of a sweep, in (0, 2);
        - pivot_tolerance: the smallest pivot, relative to the largest entry of its column, in [0, 1);
        - accepted_residual: "solved" means a residual no larger than this, in (0, 0.01];
        - cover: 0 for the cover of ones, any other number for a pseudo-random one, and with it another path;
        - precision: "double" (53 bits) or "quad" (113 bits, some 50 times slower);
        - cover: 0 for a cover of ones, other whole numbers for pseudo-random ones, which lead along another path;
        - ridge: added to the diagonal of the scaled M; the answer is judged without, in [0, 1e-6];
        - start_basis, start_z: see `start` of `solve`.

    Raises
    ------
    ValueError
        For an unknown method.

    Examples
    --------
    >>> default_settings("lemke")
    {'max_pivots': 0, 'pivot_tolerance': 1e-08, 'accepted_residual': 1e-08}
    """
    return _core.settings_of(method)


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
        J_n, J_t, inverse_mass, velocity, friction, offset, method, motions, _with_start(method, first, settings)
    )
    result, found = _as_result(fields.pop("result")), fields.pop("motions")
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
    mode, status = _MODES[fields.pop("mode")], _STATUSES[fields.pop("status")]
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
        friction.

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


def all_solutions(M: ArrayLike, q: ArrayLike, accepted_residual: float = 1e-9) -> list[Result]:
    """Every vertex solution of the LCP (M, q), n <= 12, in the order of their bases.

    All 2^n bases are tried, each with a linear solve.

    Parameters
    ----------
    M : array_like, shape (n, n)
    q : array_like, shape (n,)
    accepted_residual : float
        A basis counts as a solution up to this residual, in (0, 0.01].

    Returns
    -------
    list of Result
        Empty if there is no solution. A solution set that is not a point is the hull of its vertices, plus rays.

    Raises
    ------
    ValueError
        As `solve`, and for n > 12.

    Examples
    --------
    >>> [s.z.round(3).tolist() for s in all_solutions([[-2, -1], [-1, -2]], [1, 1])]
    [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5], [0.333, 0.333]]
    """
    return [_as_result(fields) for fields in _core.all_solutions(M, q, accepted_residual)]


_Number = Union[int, float, str, Fraction]


def _as_texts(numbers: Iterable[Any], name: str) -> list[str]:
    """Each number as a fraction in text: a float is the fraction it stores, a text means what it says."""
    texts = []
    for i, item in enumerate(numbers):
        number = item.item() if isinstance(item, np.generic) else item
        try:
            texts.append(number if isinstance(number, str) else str(Fraction(number)))
        except (TypeError, ValueError, OverflowError):
            raise ValueError(f"{name}[{i}]: must be a finite number, got {number!r}") from None
    return texts


def exact(
    M: Sequence[Sequence[_Number]] | NDArray[Any],
    q: Sequence[_Number] | NDArray[Any],
    basis: Result | ExactResult | ArrayLike | None = None,
) -> ExactResult:
    """One solution of the LCP (M, q) in rational arithmetic, or a proof that there is none.

    Parameters
    ----------
    M : array_like, shape (n, n)
        n <= 40. Entries are numbers, fractions or text: "1/3" and "0.1" mean just that, while the float 0.1 means
        3602879701896397/36028797018963968, which is what it stores.
    q : array_like, shape (n,)
    basis : Result, ExactResult or array_like of 0 and 1, shape (n,), optional
        Solve for this basis: 1 where w_i = 0, 0 where z_i = 0. With a `Result` it is proved right, or refuted. Left
        out, Lemke's method with a lexicographic rule [1]_ looks for one.

    Returns
    -------
    ExactResult

    Raises
    ------
    ValueError
        For shapes that do not fit, NaN, infinity, text that is no number, n > 40, and numbers that are too long.

    References
    ----------
    .. [1] R. W. Cottle, J.-S. Pang, R. E. Stone: The Linear Complementarity Problem, 1992, section 4.9.

    Examples
    --------
    >>> M, q = [["2", "1"], ["1", "2"]], ["-5", "-6.1"]
    >>> [str(z) for z in exact(M, q).z]
    ['13/10', '12/5']
    >>> exact([[2, 1], [1, 2]], [-5, -6], solve([[2, 1], [1, 2]], [-5, -6])).z
    [Fraction(4, 3), Fraction(7, 3)]
    """
    rows, length = list(M), len(q)
    if len(rows) != length or any(isinstance(row, str) or len(row) != length for row in rows):
        raise ValueError(f"M: must have shape ({length}, {length}) for q of length {length}")
    entries = [text for i, row in enumerate(rows) for text in _as_texts(row, f"M[{i}]")]
    if isinstance(basis, (Result, ExactResult)):
        basis = basis.basis
    fields = _core.exact(entries, _as_texts(q, "q"), basis)
    z, w, certificate = (list(map(Fraction, fields.pop(name))) for name in ("z", "w", "certificate"))
    return ExactResult(z=z, w=w, certificate=certificate or None, **fields)


def residual(M: ArrayLike, q: ArrayLike, z: ArrayLike, row_sizes: ArrayLike | None = None) -> Residual:
    """How far z is from solving the LCP (M, q), without unit.

    Each row is judged by the size of its own terms, so that no change of units of w or z changes the residual.

    Parameters
    ----------
    M : array_like, shape (n, n)
    q, z : array_like, shape (n,)
    row_sizes : array_like, shape (n,), optional
        The typical size of each w_i, >= 0, in its unit: an approach speed, say. It decides what is round-off in a row
        whose own terms all vanish. Left out, contacts are recognised and get the sizes that `contact_problem` gives;
        other rows get a small share of the largest entry of q.

    Returns
    -------
    Residual

    Raises
    ------
    ValueError
        For shapes that do not fit, NaN, infinite or masked entries of M or q.

    Examples
    --------
    >>> residual([[2, 1], [1, 2]], [-5, -6], [4 / 3, 7 / 3]).largest < 1e-15
    True
    >>> round(residual([[2, 1], [1, 2]], [-5, -6], [1, 2]).negative_w, 3)  # w = (-1, -1), of terms up to 6
    0.111
    """
    return Residual(*_core.residual(M, q, z, row_sizes))


def parse(text: str, name: str = "lcp") -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """M and q from text as ``tumble lcp FILE`` reads it: a line ``M``, the rows, a line ``q``, its entries.

    Parameters
    ----------
    text : str
        Numbers as 1e-3 or 1/3; everything behind a ``#`` is a comment.
    name : str
        Stands for the text in error messages.

    Returns
    -------
    M : ndarray, shape (n, n)
    q : ndarray, shape (n,)

    Raises
    ------
    ValueError
        "name:line:column: what is wrong".

    Examples
    --------
    >>> M, q = parse("M\\n2 1\\n1 2\\nq\\n-1 -1/2\\n")
    >>> q
    array([-1. , -0.5])
    """
    return _core.parse_lcp(text, name)
