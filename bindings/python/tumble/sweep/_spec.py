"""Specs of sweeps as text."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple, Union

import numpy as np

PathLike = Union[str, "os.PathLike[str]"]
SpecLike = Union[PathLike, Mapping[str, Any]]


class SpecText(NamedTuple):
    text: str
    name: str  # for messages
    folder: bytes  # that the file of a scene is named from


def read_spec(spec: SpecLike) -> SpecText:
    """The spec as TOML. A text with a line break or a "=" is the spec itself, any other the name of its file."""
    if isinstance(spec, Mapping):
        return SpecText(_as_toml({"sweep": 1, **spec}), "spec", b".")
    if isinstance(spec, str) and ("\n" in spec or "=" in spec):
        return SpecText(require_utf8(spec, "spec"), "spec", b".")
    if not isinstance(spec, (str, os.PathLike)):
        raise TypeError(f"spec: must be the name of a file, its text or a dict, got {type(spec).__name__}")
    if not os.fspath(spec):
        raise ValueError("spec: must be the name of a file, its text or a dict, got an empty text")
    as_bytes(spec, "spec")
    return SpecText(Path(spec).read_text(encoding="utf-8"), path_text(spec), os.fsencode(Path(spec).parent))


def as_bytes(path: PathLike, field: str) -> bytes:
    """The path as the system takes it."""
    try:
        return os.fsencode(path)
    except TypeError:
        raise TypeError(f"{field}: must be a path, got {path!r:.40}") from None
    except UnicodeEncodeError:
        raise ValueError(f"{field}: must be a path that the system can take, got {path!r:.40}") from None


def path_text(path: PathLike) -> str:
    """The path for messages, valid UTF-8 whatever its bytes are."""
    return os.fsencode(path).decode(errors="replace")


def require_utf8(text: str, field: str) -> str:
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise ValueError(f"{field}: must be valid UTF-8, got {text[error.start]!r}") from None
    return text


def _as_toml(spec: Mapping[Any, Any]) -> str:
    try:
        return "".join(f"{_key(key)} = {_value(value, str(key))}\n" for key, value in spec.items())
    except RecursionError:
        raise ValueError("spec: must not contain itself") from None


def _key(key: object) -> str:
    if not isinstance(key, str):
        raise TypeError(f"spec: keys must be texts, got {key!r}")
    return _quoted(key, "spec")


def _value(value: Any, field: str) -> str:
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_value(entry, f'{field}.{key}')}" for key, entry in value.items()) + " }"
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(_value(entry, field) for entry in value) + "]"
    if isinstance(value, np.ndarray):
        if (masked := int(np.sum(np.ma.getmaskarray(value)))) > 0:  # type: ignore[no-untyped-call]
            raise ValueError(f"{field}: must have no masked entry, got {masked}")
        return _value({"list": value.tolist()}, field)
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, str):
        return _quoted(value, field)
    raise TypeError(f"{field}: must be a number, a text, a list, an array or a dict, got {type(value).__name__}")


def _quoted(text: str, field: str) -> str:
    escaped = require_utf8(text, field).replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c >= " " and c != "\x7f" else f"\\u{ord(c):04x}" for c in escaped) + '"'
