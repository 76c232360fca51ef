"""How far a long call is, on the terminal."""

from __future__ import annotations

import sys
import time

_SECONDS_BEFORE_PROGRESS = 1.0
_SECONDS_BETWEEN_LINES = 0.2


class ProgressLine:
    """One line on standard error, written over and over; nothing if that is no terminal."""

    def __init__(self) -> None:
        self._is_wanted = sys.stderr.isatty()
        self._start = time.monotonic()
        self._shown = 0.0

    def show(self, share: float, what: str) -> None:
        """`share` of the work is done, 0 to 1; `what` is said behind it."""
        passed = time.monotonic() - self._start
        if not self._is_wanted or share <= 0.0:
            return
        if passed < _SECONDS_BEFORE_PROGRESS or passed - self._shown < _SECONDS_BETWEEN_LINES:
            return
        self._shown = passed
        left = passed / share - passed
        sys.stderr.write(f"\r\x1b[K{100 * share:5.1f} %  {what}  {left:.0f} s left")
        sys.stderr.flush()

    def clear(self) -> None:
        if self._shown > 0.0:
            sys.stderr.write("\r\x1b[K")
            sys.stderr.flush()
