#!/usr/bin/python3
"""Check the include rule: a folder of src/tumble includes only itself and the folders before it.

The order is math, lcp, scene, geometry, contact, step, trajectory, drop, batch, explain, output, sweep; cli and bindings may include all of them.
Prints one line "file:line: what is wrong" for each fault and exits with 1 if there is one.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ORDER = ("math", "lcp", "scene", "geometry", "contact", "step", "trajectory", "drop", "batch", "explain", "output", "sweep")
SUFFIXES = {".cpp", ".hpp"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def includes(file: Path) -> Iterator[tuple[int, str, str]]:
    """Line number, opening bracket and path of every #include of a file."""
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), start=1):
        match = INCLUDE.match(line)
        if match:
            yield number, match[1], match[2]


def fault_of(folder: str | None, bracket: str, path: str) -> str | None:
    """What is wrong with including `path` from src/tumble/`folder`; `folder` None is a program outside it."""
    parts = path.split("/")
    if parts[0] != "tumble":
        if folder is not None and bracket == '"':
            return f'"{path}" must be written from src, as "tumble/..."'
        return None
    if bracket == "<":
        return f'<{path}> must be written in quotes'
    if len(parts) == 2:
        return None if folder is None else f'"{path}" takes in everything'
    if parts[1] not in ORDER:
        return f'"{path}": {parts[1]} is not one of the folders {", ".join(ORDER)}'
    if folder is not None and ORDER.index(parts[1]) > ORDER.index(folder):
        return f'{folder} must not include "{path}": {parts[1]} comes after it'
    if not (ROOT / "src" / path).is_file():
        return f'"{path}" does not exist'
    return None


def faults() -> Iterator[str]:
    """All faults as "file:line: text"."""
    for top in ("src/tumble", "cli", "bindings"):
        for file in sorted((ROOT / top).rglob("*")):
            if file.suffix not in SUFFIXES:
                continue
            name = file.relative_to(ROOT)
            folder = name.parts[2] if top == "src/tumble" and len(name.parts) > 3 else None
            if folder is not None and folder not in ORDER:
                yield f"{name}:1: folder {folder} is not in the order {' < '.join(ORDER)}"
                continue
            for number, bracket, path in includes(file):
                fault = fault_of(folder, bracket, path)
                if fault:
                    yield f"{name}:{number}: {fault}"


def main() -> int:
    """Print the faults; 1 if there are any."""
    found = list(faults())
    print("\n".join(found) if found else f"includes follow the order {' < '.join(ORDER)} < (cli, bindings)")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
