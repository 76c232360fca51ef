"""Tumble: planar rigid bodies under frictional contact, one linear complementarity problem per step.

Modules
-------
drop
    The document's model: a square falls on the ground (`get_contacts`, `form_lcp`, `solve_LCP`, `step`, `simulate`,
    `render`).
lcp
    Solvers for linear complementarity problems of any origin.
course
    ``python3 -m tumble.course new DIR`` writes a ready assignment.
grade
    ``python3 -m tumble.grade FILE`` grades a submission.
"""

from tumble import drop, lcp
from tumble._core import NoSolution, __version__

__all__ = ["NoSolution", "__version__", "drop", "lcp"]
