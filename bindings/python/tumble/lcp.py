"""Linear complementarity problems: find z with w = M z + q >= 0, z >= 0, z . w = 0.

>>> import numpy as np
>>> from tumble import lcp
>>> result = lcp.solve([[2.0, 1.0], [1.0, 2.0]], [-5.0, -6.0])
>>> result.status, result.z
('solved', array([1.33333333, 2.33333333]))
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tumble import _core

__all__ = ["METHODS", "Residual", "Result", "all_solutions", "parse", "residual", "solve"]

METHODS = ("lemke", "enumerate")


@dataclass(frozen=True)
class Result:
    """What a solver returns.

    Attributes
    ----------
    status : str
        "solved"; "no_solution_proved" (every complementary basis was tried and failed clearly); "ray_unproven" (Lemke ended on a ray: none
        found, none excluded); "iteration_limit"; "numerical" (the residual is above the accepted bound).
    z, w : ndarray, shape (n,)
        The solution and M z + q; if the status is not "solved", the best candidate met, or 0.
    residual : float
        How far z is from solving the problem, without unit: see `residual`. Recomputed from M and q.
    pivots : int
        Pivots made, or bases tried.
    basis : ndarray of bool, shape (n,)
        True where z_i is basic, so that w_i = 0; elsewhere z_i = 0.
    """

    status: str
    z: NDArray[np.float64]
    w: NDArray[np.float64]
    residual: float
    pivots: int
    basis: NDArray[np.bool_]


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


def solve(M: ArrayLike, q: ArrayLike, method: str = "lemke", **settings: float) -> Result:
    """One solution of the LCP (M, q).

    Parameters
    ----------
    M : array_like, shape (n, n)
    q : array_like, shape (n,)
    method : {"lemke", "enumerate"}
        "lemke" pivots, for any n. It finds a solution of every contact problem and of many others, but a "no" from it
        (status "ray_unproven") proves nothing. "enumerate" tries all 2^n bases, n <= 12, and proves a "no".
    **settings
        For "lemke": max_pivots (0: 100 n + 1000), pivot_tolerance (1e-8), accepted_residual (1e-8).
        For "enumerate": accepted_residual (1e-9).

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
    Cottle, Pang, Stone: The Linear Complementarity Problem, 1992, algorithm 4.4.1.
    """
    if method == "lemke":
        return Result(*_core.lemke(M, q, **settings))  # type: ignore[arg-type]
    if method == "enumerate":
        return Result(*_core.enumerate(M, q, **settings))
    raise ValueError(f"method: must be one of {', '.join(METHODS)}, got {method!r}")


def all_solutions(M: ArrayLike, q: ArrayLike, accepted_residual: float = 1e-9) -> list[Result]:
    """Every vertex solution of the LCP (M, q), n <= 12, in the order of their bases.

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
    """
    return [Result(*result) for result in _core.all_solutions(M, q, accepted_residual)]


def residual(M: ArrayLike, q: ArrayLike, z: ArrayLike, row_sizes: ArrayLike | None = None) -> Residual:
    """How far z is from solving the LCP (M, q), without unit.

    Each row is judged by the size of its own terms, so that no change of units of w or z changes the residual.

    Parameters
    ----------
    M : array_like, shape (n, n)
    q, z : array_like, shape (n,)
    row_sizes : array_like, shape (n,), optional
        The typical size of each w_i, >= 0, in its unit: an approach speed, say. It decides what is round-off in a row
        whose own terms all vanish. Left out, a small share of the largest entry of q is taken.

    Returns
    -------
    Residual

    Raises
    ------
    ValueError
        For shapes that do not fit, NaN, infinite or masked entries of M or q.
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
    """
    return _core.parse_lcp(text, name)
