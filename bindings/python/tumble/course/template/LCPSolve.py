"""Lemke's algorithm for linear complementarity problems. You do not need to change this file."""

import numpy as np

# Two numbers that agree to this share of their size count as equal: the rest is round-off.
ROUND_OFF = 1e-13
# A ray whose artificial variable is below this share of the largest entry of q ended at a solution all the same.
ZERO = 1e-12


def LCPSolve(M, q, pivtol=1e-8):
    """Find w and z with w = M z + q, w >= 0, z >= 0 and w . z = 0.

    Parameters
    ----------
    M : array_like, shape (n, n)
    q : array_like, shape (n,)
    pivtol : float
        An entry of the tableau can be a pivot only above this share of the largest entry of its column.

    Returns
    -------
    w, z : ndarray, shape (n,)
        The solution. If there is none, the last values reached.
    retcode : tuple (code, z0, pivots)
        code is 1 for a solution and 2 if the algorithm stopped without one (it ran along a ray to infinity).
        z0 is the last value of the artificial variable, 0 for a solution. pivots counts the pivots.
    """
    M = np.array(M, dtype=float)
    q = np.array(q, dtype=float).reshape(-1)
    n = q.size
    if M.shape != (n, n):
        raise ValueError(f"M: shape must be {(n, n)} to fit q, got {M.shape}")
    if not (np.all(np.isfinite(M)) and np.all(np.isfinite(q))):
        raise ValueError("M and q: every entry must be a finite number")
    if np.all(q >= 0.0):
        return q.copy(), np.zeros(n), (1, 0.0, 0)

    # The equation I w - M z - e z0 = q as a table. Columns: w_0 .. w_n-1, z_0 .. z_n-1, z0, right side.
    # The artificial variable z0 lifts all negative entries of q; the algorithm ends when z0 has left the basis.
    table = np.hstack([np.eye(n), -M, -np.ones((n, 1)), q.reshape(n, 1)])
    artificial = 2 * n
    basis = list(range(n))

    # First pivot: z0 enters in the row of the most negative q, which makes every right side >= 0.
    row, entering = int(np.argmin(q)), artificial
    most_pivots = 100 * n + 1000
    for pivots in range(1, most_pivots + 1):
        _pivot(table, row, entering)
        leaving, basis[row] = basis[row], entering
        if leaving == artificial:
            return (*_values(table, basis, n), (1, 0.0, pivots))
        # The partner of the variable that left enters: only one of w_i and z_i is ever in the basis.
        entering = leaving + n if leaving < n else leaving - n
        row = _leaving_row(table, entering, basis.index(artificial), pivtol)
        if row is None:
            break
    z0 = float(table[basis.index(artificial), -1])
    code = 1 if z0 <= ZERO * np.max(np.abs(q)) else 2
    return (*_values(table, basis, n), (code, z0, pivots))


def _pivot(table, row, column):
    """Solve the equation of this row for the variable of this column and put it into all other rows."""
    table[row] /= table[row, column]
    for i in range(table.shape[0]):
        if i != row:
            old, change = table[i].copy(), table[i, column] * table[row]
            table[i] = old - change
            # A difference of equal numbers is 0. Left as 1e-17, it would hide that two variables reach zero together.
            table[i, np.abs(table[i]) <= ROUND_OFF * np.abs(old)] = 0.0


def _leaving_row(table, column, artificial_row, pivtol):
    """The row whose variable reaches zero first while the entering one grows; None if it can grow forever."""
    entries, right_side = table[:, column], table[:, -1]
    candidates = np.flatnonzero(entries > pivtol * np.max(np.abs(entries)))
    if candidates.size == 0:
        return None
    ratios = right_side[candidates] / entries[candidates]
    growth = np.min(ratios)
    tied = candidates[ratios <= growth + ROUND_OFF * abs(growth)]
    # On a tie the artificial variable leaves, since that ends the search; else the largest pivot, the most accurate.
    if artificial_row in tied:
        return artificial_row
    return int(tied[np.argmax(entries[tied])])


def _values(table, basis, n):
    """Read w and z off the table: basic variables have the value of the right side, all others are zero."""
    values = np.zeros(2 * n + 1)
    values[basis] = np.maximum(table[:, -1], 0.0)
    return values[:n], values[n : 2 * n]
