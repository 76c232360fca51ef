"""Results of student code as JSON, so that nothing but plain numbers and text crosses the process border."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# Beyond these sizes a result is described, not sent: no documented result comes near them.
_MOST_ENTRIES = 100_000
_MOST_ITEMS = 20


@dataclass(frozen=True)
class Other:
    """A result that holds no numbers, in words."""

    text: str


def encode(value: Any, depth: int = 0) -> dict[str, Any]:
    """A result as a JSON object.

    Parameters
    ----------
    value : object
        What a student's function returned.
    depth : int
        Levels of nesting above it.

    Returns
    -------
    dict
        kind "tuple" with items, "array" with shape and data, or "other" with a text.
    """
    if isinstance(value, tuple) and depth < 2:
        if len(value) > _MOST_ITEMS:
            return {"kind": "other", "text": f"a tuple of {len(value)} items"}
        return {"kind": "tuple", "items": [encode(item, depth + 1) for item in value]}
    array = _as_numbers(value)
    if array is None:
        if isinstance(value, list) and depth < 2 and len(value) <= _MOST_ITEMS:
            return {"kind": "tuple", "items": [encode(item, depth + 1) for item in value]}
        return {"kind": "other", "text": "None" if value is None else f"a {type(value).__name__}"}
    if array.size > _MOST_ENTRIES:
        return {"kind": "other", "text": f"an array of shape {array.shape}"}
    return {"kind": "array", "shape": list(array.shape), "data": array.ravel().tolist()}


def _as_numbers(value: Any) -> Array | None:
    try:
        array = np.asarray(value)
        if array.dtype == object and array.size <= _MOST_ENTRIES:
            array = np.array(array.tolist())
        if array.dtype.kind not in "biuf":
            return None
        return array.astype(np.float64)
    except Exception:  # student classes may raise anything when numpy asks them for numbers
        return None


def decode(message: dict[str, Any]) -> tuple[Any, ...] | Array | Other:
    """The inverse of `encode`.

    Returns
    -------
    tuple, ndarray or Other
    """
    if message["kind"] == "tuple":
        return tuple(decode(item) for item in message["items"])
    if message["kind"] == "array":
        return np.array(message["data"], dtype=np.float64).reshape(message["shape"])
    return Other(str(message["text"]))


def as_pair(value: tuple[Any, ...] | Array | Other) -> tuple[Any, ...] | None:
    """The items of a result that `a, b = result` would unpack, None if it has none."""
    if isinstance(value, tuple):
        return value
    if isinstance(value, np.ndarray) and value.ndim > 0 and value.shape[0] == 2:
        return (value[0], value[1])
    return None


def describe(value: Any) -> str:
    """A result in a few words, for feedback."""
    if isinstance(value, Other):
        return value.text
    if isinstance(value, tuple):
        return "(" + ", ".join(describe(item) for item in value) + ")"
    if value.ndim == 0:
        return "a number"
    return f"an array of shape {value.shape}"
