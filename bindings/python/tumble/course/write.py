"""Write the folder of an assignment."""

from __future__ import annotations

import math
import os
import shutil
import tempfile
from pathlib import Path

FILES = ("assignment_3.py", "LCPSolve.py", "assignment_3_render.py", "assignment_3_helper.py", "handout.md")

# The files that name the side of the square, each exactly once, in these words.
_FILES_WITH_SIDE = ("assignment_3.py", "assignment_3_render.py", "handout.md")
_SIDE_IN_TEMPLATE = "l = 0.2"


def template_path(name: str) -> Path:
    """Path of a file of the assignment as it is kept in the package, for a side of 0.2 m.

    Parameters
    ----------
    name : str
        One of `FILES`.
    """
    return Path(__file__).parent / "template" / name


def write_assignment(folder: str | os.PathLike[str], side: float = 0.2, force: bool = False) -> Path:
    """Write a ready assignment: all of `FILES`, which need numpy and matplotlib and nothing else.

    Everything is first written beside the folder and then moved, so a failure leaves nothing half done.

    Parameters
    ----------
    folder : path
        Created if missing, with its parents.
    side : float
        Side of the square [m], > 0.
    force : bool
        Write into a folder that has files already. Files of the same names are replaced, others stay.

    Returns
    -------
    Path
        The folder.

    Raises
    ------
    ValueError
        For a side that is not a positive number.
    FileExistsError
        If the folder is not empty and `force` is not set.
    OSError
        If it cannot be written.
    """
    if not (math.isfinite(side) and side > 0.0):
        raise ValueError(f"side: must be a number > 0 [m], got {side}")
    target = Path(folder).resolve()
    if target.exists() and not target.is_dir():
        raise FileExistsError(f"{folder}: is a file, not a folder")
    if target.is_dir() and any(target.iterdir()) and not force:
        raise FileExistsError(
            f"{folder}: the folder is not empty; --force replaces the assignment's files in it"
        )
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=f".{target.name}.", dir=target.parent) as scratch:
        # A folder of its own inside, because that of tempfile is readable by its owner alone.
        fresh = Path(scratch) / "assignment"
        fresh.mkdir()
        for name in FILES:
            _write_file(fresh / name, name, side)
        if target.is_dir() and any(target.iterdir()):
            for name in FILES:
                os.replace(fresh / name, target / name)
        else:
            os.rename(fresh, target)
    return target


def _write_file(path: Path, name: str, side: float) -> None:
    if name not in _FILES_WITH_SIDE:
        shutil.copyfile(template_path(name), path)
        return
    text = template_path(name).read_text(encoding="utf-8")
    if text.count(_SIDE_IN_TEMPLATE) != 1:
        raise RuntimeError(f"{template_path(name)}: must hold {_SIDE_IN_TEMPLATE!r} exactly once")
    path.write_text(text.replace(_SIDE_IN_TEMPLATE, f"l = {side:.15g}"), encoding="utf-8")
