"""Files that appear under their name when they are complete, and those that the compiled module writes."""

from __future__ import annotations

import operator
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple, Union

import numpy as np

from tumble._view import find_page


@contextmanager
def complete_file(path: Path) -> Iterator[Path]:
    """A new file of the same ending in the same folder, which takes the place of `path` unless the block raises."""
    handle, name = tempfile.mkstemp(suffix=path.suffix, prefix=".tumble-", dir=path.parent)
    os.close(handle)
    unfinished = Path(name)
    try:
        yield unfinished
        umask = os.umask(0)
        os.umask(umask)
        unfinished.chmod(0o666 & ~umask)
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)


def output_module() -> ModuleType:
    try:
        from tumble import _output
    except ImportError as error:
        text = "save: this package was built without cairo, giflib or zlib; install these, then build it again"
        raise ImportError(text) from error
    return _output


class Target(NamedTuple):
    """Where a file goes and what kind it is, as the compiled module takes them."""

    path: bytes
    format: str
    width: int  # [px]
    height: int
    speed: float
    page: bytes  # of an .html


def as_target(path: Union[str, os.PathLike[str]], format: str, width: int, height: int, speed: float) -> Target:
    name, kind = os.fsencode(path), str(format)
    size = as_pixels(width, "width"), as_pixels(height, "height")
    if not isinstance(speed, (int, float, np.number)):
        raise TypeError(f"speed: must be a number, got {speed!r:.40}")
    is_page = kind.lower() == "html" if kind else name.lower().endswith(b".html")
    return Target(name, kind, *size, float(speed), os.fsencode(find_page()) if is_page else b"")


def as_pixels(value: Any, field: str) -> int:
    try:
        return max(-1, min(operator.index(value), 1_000_000))  # what C++ refuses fits into its int
    except TypeError:
        raise TypeError(f"{field}: must be a whole number, got {value!r:.40}") from None
