"""The command line of `tumble.course`. Exit codes: 0 done, 2 bad input."""

from __future__ import annotations

import argparse
import sys

from tumble.course.write import FILES, write_assignment


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python3 -m tumble.course", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    new = commands.add_parser(
        "new", help="write a ready assignment", description=f"Writes {', '.join(FILES)}."
    )
    new.add_argument("folder", metavar="DIR", help="folder to write; created if missing")
    new.add_argument(
        "--side", type=float, default=0.2, metavar="L", help="side of the square [m], > 0 (default 0.2)"
    )
    new.add_argument(
        "--force", action="store_true", help="replace the assignment's files in a folder that has some"
    )
    return parser


def main(arguments: list[str] | None = None) -> int:
    """Run the command line; returns the exit code."""
    options = _parser().parse_args(arguments)
    try:
        folder = write_assignment(options.folder, side=options.side, force=options.force)
    except (ValueError, OSError) as error:
        print(f"tumble.course: {error}", file=sys.stderr)
        return 2
    print(f"{folder}: {', '.join(FILES)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
