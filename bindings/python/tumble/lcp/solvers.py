"""LCPs of any origin: one solution, many problems at once, all solutions, the residual."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tumble import _core

METHODS: Mapping[str, str] = MappingProxyType(_core.methods())
"""The methods by name, each with one line on what it does and when it can be relied on."""

STATUSES = np.array(_core.STATUSES)
RUNGS = np.array(_core.RUNGS)


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


@dataclass(frozen=True, eq=False)
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


@dataclass(frozen=True, eq=False)
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


def as_result(fields: dict[str, Any]) -> Result:
    parts = Residual(*fields.pop("parts"))
    return Result(parts=parts, **fields)


def _start_name(method: str) -> str | None:
    """The setting that takes a start, if any: the methods that sweep begin at a z, the others at a basis."""
    known = default_settings(method)
    return next((name for name in ("start_z", "start_basis") if name in known), None)


def _named_start(
    method: str, start: Result | BatchResult | ArrayLike, settings: dict[str, Any]
) -> tuple[str, ArrayLike]:
    """The name and value of the setting that `start` stands for."""
    name = _start_name(method)
    if name is None:
        takers = ", ".join(other for other in METHODS if _start_name(other))
        raise TypeError(f"start: the method {method} takes none; those that do are {takers}")
    if settings.get(name) is not None:
        raise TypeError(f"start, {name}: say the same, give one of them")
    if isinstance(start, (Result, BatchResult)):
        start = start.z if name == "start_z" else start.basis
    return name, start


def with_start(method: str, start: Result | ArrayLike | None, settings: dict[str, Any]) -> dict[str, Any]:
    if start is None:
        return settings
    name, value = _named_start(method, start, settings)
    return {**settings, name: value}


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
        Settings of the method, by name; `default_settings` lists them. None stands for the default.

    Returns
    -------
    Result
        Check `status`: a problem without a solution is an outcome, not an error.

    Notes
    -----
    One problem is solved in one go: Ctrl-C is noticed after it, also in `solve_contacts` and `all_solutions`.

    Raises
    ------
    ValueError
        For an unknown method, a matrix that does not fit q, NaN, infinite or masked entries, or a setting out of range.
    TypeError
        For a setting that the method does not have, a `start` included, and for two starts.

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
    return as_result(_core.solve(M, q, method, row_sizes, with_start(method, start, settings)))


def solve_batch(
    M: ArrayLike,
    q: ArrayLike,
    method: str = "robust",
    *,
    row_sizes: ArrayLike | None = None,
    start: BatchResult | Result | ArrayLike | None = None,
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
    start : BatchResult, Result or array_like, shape (N, n) or (n,), optional
        Where to start, see `solve`; of shape (n,) for all.
    threads : int
        0 takes one for each processor. The interpreter is free while they work. Ctrl-C is noticed every 64 problems, not
        within one.
    **settings
        Settings of the method, by name; `default_settings` lists them.

    Returns
    -------
    BatchResult

    Raises
    ------
    ValueError
        For an unknown method, shapes that do not fit, a setting out of range, and for what no problem could be solved
        with: negative shared row_sizes, or n > 12 with "enumerate".
    TypeError
        As `solve`.

    Examples
    --------
    >>> batch = solve_batch([[2, 1], [1, 2]], [[-5, -6], [1, 1], [np.nan, 0]])
    >>> batch.status
    array(['solved', 'solved', 'bad_input'], dtype='<U18')
    >>> batch[0].z
    array([1.33333333, 2.33333333])
    """
    if start is not None:
        _, start = _named_start(method, start, settings)
    fields = _core.solve_batch(M, q, method, row_sizes, start, threads, settings)
    status, rung = STATUSES[fields.pop("status")], RUNGS[fields.pop("rung")]
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
        - ridge: added to the diagonal of the scaled M; the answer is judged without, in [0, 1e-6];
        - start_basis, start_z: see `start` of `solve`.

    Raises
    ------
    ValueError
        For an unknown method.

    Examples
    --------
    >>> default_settings("lemke")
    {'max_pivots': 0, 'pivot_tolerance': 1e-08, 'accepted_residual': 1e-10}
    """
    return _core.settings_of(method)


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
    return [as_result(fields) for fields in _core.all_solutions(M, q, accepted_residual)]


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
