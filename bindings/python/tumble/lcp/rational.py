"""LCPs in rational arithmetic: nothing is rounded."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tumble import _core
from tumble.lcp.solvers import Result

_Number = Union[int, float, str, Fraction]
_Vector = Union[Sequence[_Number], NDArray[Any]]
_Matrix = Union[Sequence[Sequence[_Number]], NDArray[Any]]


@dataclass(frozen=True, eq=False)
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
class ExactFace:
    """One polyhedron of solutions: the hull of its vertices plus the cone of its rays.

    Attributes
    ----------
    vertices, rays : list of int
        Places in the lists of the `ExactSolutionSet`.
    """

    vertices: list[int]
    rays: list[int]


@dataclass(frozen=True, eq=False)
class ExactSolutionSet:
    """All solutions of a problem: the union of the faces.

    Attributes
    ----------
    status : str
        "solved"; "infeasible" or "no_solution_proved", both proofs; "iteration_limit": the set has too many vertices.
    vertices : list of ExactResult
        In the order of their bases as binary numbers, z_0 the lowest bit.
    rays : list of list of Fraction
        Directions in z.
    faces : list of ExactFace
        The largest ones.
    certificate : list of Fraction, or None
        For "infeasible", as in `Result`.
    """

    status: str
    vertices: list[ExactResult]
    rays: list[list[Fraction]]
    faces: list[ExactFace]
    certificate: list[Fraction] | None


def _as_fractions(texts: list[str]) -> list[Fraction]:
    return [Fraction(text) for text in texts]


def _as_result(fields: dict[str, Any]) -> ExactResult:
    z, w, certificate = (_as_fractions(fields.pop(name)) for name in ("z", "w", "certificate"))
    return ExactResult(z=z, w=w, certificate=certificate or None, **fields)


def _entries(values: Any, name: str, kind: str) -> list[Any]:
    """The entries of a sequence; a text is none, though it has a length."""
    try:
        if isinstance(values, str):
            raise TypeError
        return list(values)
    except TypeError:
        raise ValueError(f"{name}: must be a list of {kind}, got {values!r}") from None


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


def _problem_texts(M: Any, q: Any) -> tuple[list[str], list[str]]:
    vector = _entries(q, "q", "numbers")
    n = len(vector)
    rows = [_entries(row, f"M[{i}]", "numbers") for i, row in enumerate(_entries(M, "M", "rows"))]
    lengths = [len(row) for row in rows]
    if lengths != [n] * n:
        raise ValueError(f"M: must have shape ({n}, {n}) for q of length {n}, got rows of length {lengths}")
    return [text for i, row in enumerate(rows) for text in _as_texts(row, f"M[{i}]")], _as_texts(vector, "q")


def exact(
    M: _Matrix,
    q: _Vector,
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
        out, Lemke's method with a lexicographic rule [1]_ looks for one and, where it ends without an answer and
        n <= 12, `solution_set`.

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
    >>> from tumble.lcp import solve
    >>> exact([[2, 1], [1, 2]], [-5, -6], solve([[2, 1], [1, 2]], [-5, -6])).z
    [Fraction(4, 3), Fraction(7, 3)]
    """
    if isinstance(basis, (Result, ExactResult)):
        basis = basis.basis
    return _as_result(_core.exact(*_problem_texts(M, q), basis))


def solution_set(M: _Matrix, q: _Vector) -> ExactSolutionSet:
    """All solutions of the LCP (M, q), n <= 12, in rational arithmetic.

    Parameters
    ----------
    M : array_like, shape (n, n)
        As for `exact`.
    q : array_like, shape (n,)

    Returns
    -------
    ExactSolutionSet

    Raises
    ------
    ValueError
        As `exact`, and for n > 12.

    Examples
    --------
    Two feet carry one weight, in any shares: a segment of solutions.

    >>> found = solution_set([[1, 1], [1, 1]], [-1, -1])
    >>> [[str(z) for z in vertex.z] for vertex in found.vertices], found.faces
    ([['1', '0'], ['0', '1']], [ExactFace(vertices=[0, 1], rays=[])])
    """
    fields = _core.solution_set(*_problem_texts(M, q))
    certificate = _as_fractions(fields["certificate"])
    return ExactSolutionSet(
        status=fields["status"],
        vertices=[_as_result(vertex) for vertex in fields["vertices"]],
        rays=[_as_fractions(ray) for ray in fields["rays"]],
        faces=[ExactFace(*face) for face in fields["faces"]],
        certificate=certificate or None,
    )
