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
    >>> from tumble.lcp import solve
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
