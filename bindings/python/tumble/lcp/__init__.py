"""Linear complementarity problems: find z with w = M z + q >= 0, z >= 0, z . w = 0.

In each pair (z_i, w_i) one number is zero. Which one is the whole difficulty: once it is known, the rest is linear. For
a contact, z_i is an impulse and w_i a velocity: either the bodies press, or they separate.

>>> from tumble import lcp
>>> result = lcp.solve([[2.0, 1.0], [1.0, 2.0]], [-5.0, -6.0])
>>> result.status, result.z
('solved', array([1.33333333, 2.33333333]))

`solve` for one problem, `solve_batch` for many of one size, `solve_contacts` for bodies in contact, `solve_one_contacts`
for many single contacts. `all_solutions` for every solution of a small problem, `contact_motions` for every motion,
`exact` and `solution_set` for fractions in place of rounded numbers. `METHODS` says what each method does. Theory:
docs/theory/lcp.md.
"""

from tumble.lcp.contacts import (
    ContactResult,
    Motion,
    Motions,
    OneContacts,
    contact_motions,
    contact_problem,
    solve_contacts,
    solve_one_contacts,
)
from tumble.lcp.rational import ExactFace, ExactResult, ExactSolutionSet, exact, solution_set
from tumble.lcp.solvers import (
    METHODS,
    BatchResult,
    Residual,
    Result,
    all_solutions,
    default_settings,
    parse,
    residual,
    solve,
    solve_batch,
)

__all__ = [
    "METHODS",
    "BatchResult",
    "ContactResult",
    "ExactFace",
    "ExactResult",
    "ExactSolutionSet",
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
    "solution_set",
    "solve",
    "solve_batch",
    "solve_contacts",
    "solve_one_contacts",
]
