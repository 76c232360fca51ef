"""Specs of sweeps as text."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple, Union

import numpy as np

SpecLike = Union[str, "os.PathLike[str]", Mapping[str, Any]]


class SpecText(NamedTuple):
    text: str
    name: str  # for messages
    folder: bytes  # that the file of a scene is named from


def read_spec(spec: SpecLike) -> SpecText:
    """The spec as TOML. A text with a line break or a "=" is the spec itself, any other the name of its file."""
    if isinstance(spec, Mapping):
        lines = [f"{_key(key)} = {_value(value, str(key))}\n" for key, value in {"sweep": 1, **spec}.items()]
        return SpecText("".join(lines), "spec", b".")
    if isinstance(spec, str) and ("\n" in spec or "=" in spec):
        return SpecText(spec, "spec", b".")
    if not isinstance(spec, (str, os.PathLike)):
        raise TypeError(f"spec: must be the name of a file, its text or a dict, got {type(spec).__name__}")
    return SpecText(Path(spec).read_text(encoding="utf-8"), os.fspath(spec), os.fsencode(Path(spec).parent))


def _key(key: object) -> str:
    if not isinstance(key, str):
        raise TypeError(f"spec: keys must be texts, got {key!r}")
    return _quoted(key)


def _value(value: Any, field: str) -> str:
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_value(entry, f'{field}.{key}')}" for key, entry in value.items()) + " }"
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(_value(entry, field) for entry in value) + "]"
    if isinstance(value, np.ndarray):
        return _value({"list": value.tolist()}, field)
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, str):
        return _quoted(value)
    raise TypeError(f"{field}: must be a number, a text, a list, an array or a dict, got {type(value).__name__}")


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c >= " " and c != "\x7f" else f"\\u{ord(c):04x}" for c in escaped) + '"'
