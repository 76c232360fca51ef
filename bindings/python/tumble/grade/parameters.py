"""The parameters of a submission, whatever the student called them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np

DEFAULTS: dict[str, float] = {
    "l": 0.2,
    "m": 0.3,
    "mu": 0.3,
    "eps": 0.5,
    "dt": 0.01,
    "delta": 0.001,
    "g": 9.81,
}

# Lower case, most likely first; upper and lower case count as equal.
_SPELLINGS: dict[str, tuple[str, ...]] = {
    "l": ("l", "side", "side_length", "length", "edge", "width"),
    "m": ("m", "mass"),
    "mu": ("mu", "μ", "friction", "mu_f", "mu_s", "mu_k", "friction_coefficient", "coeff_friction"),
    "eps": ("eps", "ep", "epsilon", "ε", "restitution", "e", "cor", "e_r", "eps_r"),
    "dt": ("dt", "delta_t", "deltat", "time_step", "timestep", "step_size", "δt"),
    "delta": ("delta", "δ", "phi_min", "threshold", "contact_threshold", "tol", "tolerance"),
    "g": ("g", "gravity", "grav", "g_vec", "gvec", "g_acc", "gravity_vector"),
}

# Values outside are another quantity that happens to have the name, such as `e` of `from math import *` or the
# spacing of floating point numbers in `eps`.
_PLAUSIBLE: dict[str, Callable[[float], bool]] = {
    "l": lambda value: 1e-4 <= value <= 100.0,
    "m": lambda value: 1e-6 <= value <= 1e6,
    "mu": lambda value: 0.0 <= value <= 10.0,
    "eps": lambda value: value == 0.0 or 1e-6 <= value <= 1.0,
    "dt": lambda value: 1e-6 <= value <= 1.0,
    "delta": lambda value: 0.0 <= value <= 0.1,
    "g": lambda value: 0.1 <= value <= 1000.0,
}

# A dictionary or class counts as a place for parameters if it has at least this many of them.
_LEAST_MATCHES = 3


def read_parameters(namespace: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Look for the parameters among the globals of a submission, and in its dictionaries and classes.

    Parameters
    ----------
    namespace : mapping
        Globals of the student's module.

    Returns
    -------
    dict
        For each of l [m], m [kg], mu, eps, dt [s], delta [m], g [m/s^2]: "value", and "name" as found in the module or
        None where the document's value stands in.
    """
    places = list(_places(namespace))
    found: dict[str, dict[str, Any]] = {}
    for key, default in DEFAULTS.items():
        candidates = [pair for place in places for pair in _candidates(key, place)]
        # Of several names, the one with the document's value: the others are more likely to mean something else.
        name, value = next((pair for pair in candidates if pair[1] == default), (None, default))
        if name is None and candidates:
            name, value = candidates[0]
        found[key] = {"value": value, "name": name}
    return found


def _places(namespace: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    yield namespace
    module_name = namespace.get("__name__")
    for name, value in list(namespace.items()):
        if name.startswith("__"):
            continue
        inside = _inside(value, module_name)
        if sum(bool(list(_candidates(key, inside))) for key in DEFAULTS) >= _LEAST_MATCHES:
            yield inside


def _inside(value: Any, module_name: Any) -> Mapping[str, Any]:
    """The named values inside a dictionary, class or object of the submission, else nothing."""
    try:
        if isinstance(value, dict):
            return {key: item for key, item in value.items() if isinstance(key, str)}
        if isinstance(value, tuple) and hasattr(value, "_asdict"):
            return dict(value._asdict())
        own_class = value if isinstance(value, type) else type(value)
        if isinstance(value, SimpleNamespace) or own_class.__module__ == module_name:
            inherited = {} if isinstance(value, type) else dict(vars(own_class))
            return {**inherited, **vars(value)}
    except Exception:  # student objects may raise anything; then they hold no parameters
        pass
    return {}


def _candidates(key: str, place: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    for spelling in _SPELLINGS[key]:
        for name in sorted((name for name in place if name.lower() == spelling), reverse=True):
            value = _size_of(place[name]) if key == "g" else _scalar(place[name])
            if value is not None and _PLAUSIBLE[key](value):
                yield name, value


def _scalar(value: Any) -> float | None:
    if isinstance(value, bool) or not isinstance(value, (int, float, np.number, np.ndarray)):
        return None
    if np.size(value) != 1 or np.iscomplexobj(value) or np.asarray(value).dtype.kind not in "iuf":
        return None
    number = float(np.asarray(value).reshape(()))
    return number if math.isfinite(number) else None


def _size_of(value: Any) -> float | None:
    """Gravity as a number of any sign or as a vector of any shape: the size of its largest entry."""
    if isinstance(value, bool) or not isinstance(value, (int, float, np.number, np.ndarray, list, tuple)):
        return None
    try:
        numbers = np.abs(np.asarray(value, dtype=float)).ravel()
    except (TypeError, ValueError):
        return None
    if not 1 <= numbers.size <= 3 or not np.all(np.isfinite(numbers)) or np.count_nonzero(numbers) != 1:
        return None
    return float(numbers.max())
