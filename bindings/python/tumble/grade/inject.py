"""Put correct functions in the place of a student's, so that one mistake costs the points of one part."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from tumble import drop

from tumble.grade.codec import Array

# The document's functions; other capital letters in a submission mean the same function.
FUNCTIONS = ("get_contacts", "form_lcp", "solve_LCP", "step", "simulate")

# How a student's functions hand over their results, if not as documented. Keys, with True for:
#   contacts_swapped   get_contacts returns phi, J
#   J_transposed       J is 2 x 3
#   J_columns_swapped  J = [J_n, J_t]
#   lcp_swapped        form_lcp returns p, V
#   step_swapped       step returns v, q
Conventions = dict[str, bool]


def to_student_J(J: Array, conventions: Conventions) -> Array:
    """The documented J, shape (3, 2), as the student's functions expect it."""
    if conventions.get("J_columns_swapped"):
        J = J[:, ::-1]
    return np.array(J.T if conventions.get("J_transposed") else J)


def from_student_J(J: Any, conventions: Conventions) -> Array:
    """The inverse of `to_student_J`."""
    documented = np.asarray(J, dtype=np.float64)
    if conventions.get("J_transposed"):
        documented = documented.T
    return documented[:, ::-1] if conventions.get("J_columns_swapped") else documented


class Reference:
    """Correct functions with a submission's parameters and conventions.

    Attributes
    ----------
    used : set of str
        The functions called since it was last cleared.
    phi : float or None
        If set, what `get_contacts` returns for the distance [m].
    """

    def __init__(self, params: drop.Parameters, conventions: Conventions) -> None:
        self.params = params
        self.conventions = conventions
        self.used: set[str] = set()
        self.phi: float | None = None

    # Further arguments are ignored: some students hand parameters from function to function.

    def get_contacts(self, q: Any, *_: Any, **__: Any) -> tuple[Any, Any]:
        self.used.add("get_contacts")
        J, phi = drop.get_contacts(_flat(q), self.params)
        if self.phi is not None:
            phi = self.phi
        J = to_student_J(J, self.conventions)
        return (phi, J) if self.conventions.get("contacts_swapped") else (J, phi)

    def form_lcp(self, J: Any, v: Any, *_: Any, **__: Any) -> tuple[Array, Array]:
        self.used.add("form_lcp")
        V, p = drop.form_lcp(from_student_J(J, self.conventions), _flat(v), self.params)
        return (p, V) if self.conventions.get("lcp_swapped") else (V, p)

    def solve_LCP(self, V: Any, p: Any, *_: Any, **__: Any) -> Array:
        self.used.add("solve_LCP")
        return drop.solve_LCP(np.asarray(V, dtype=float), _flat(p))

    def step(self, q: Any, v: Any, *_: Any, **__: Any) -> tuple[Array, Array]:
        self.used.add("step")
        q_next, v_next = drop.step(_flat(q), _flat(v), self.params)
        return (v_next, q_next) if self.conventions.get("step_swapped") else (q_next, v_next)

    def install(self, namespace: dict[str, Any], names: list[str]) -> Callable[[], None]:
        """Put functions into a module.

        Parameters
        ----------
        namespace : dict
            Globals of the student's module.
        names : list of str
            Of `FUNCTIONS`.

        Returns
        -------
        callable
            Puts the student's functions back.
        """
        saved = dict(namespace)
        for name in names:
            for key in self._keys(namespace, name):
                namespace[key] = getattr(self, name)

        def restore() -> None:
            for name in names:
                for key in self._keys(namespace, name):
                    if key in saved:
                        namespace[key] = saved[key]
                    else:
                        del namespace[key]

        return restore

    @staticmethod
    def _keys(namespace: dict[str, Any], name: str) -> list[str]:
        """The names to replace: a constant STEP or a class Step next to the function is left alone."""
        others = [key for key in namespace if key != name and key.lower() == name.lower()]
        keys = [key for key in others if callable(namespace[key]) and not isinstance(namespace[key], type)]
        return [name, *keys] if callable(namespace.get(name, print)) else keys


def _flat(values: Any) -> Array:
    return np.asarray(values, dtype=float).reshape(-1)
