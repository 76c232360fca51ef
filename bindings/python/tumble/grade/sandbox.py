"""Run a submission in processes of its own, with limits.

The limits guard against accidents: endless loops, crashes, huge arrays, files in wrong places. They are no defence
against an attacker; grade strangers' code in a container or a virtual machine.
"""

from __future__ import annotations

import json
import math
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any

import tumble
from tumble.course import FILES, template_path
from tumble.grade.codec import Array, Other, decode
from tumble.grade.inject import FUNCTIONS, Conventions
from tumble.grade.parameters import DEFAULTS

_DISTURBED = "disturbs the connection to the grader"
_STARTS_WITHIN = 60.0  # time for a process to load numpy and tumble, on a busy machine [s]
_LONGEST_MESSAGE = 50_000_000  # far above the largest result that the child sends [bytes]
_ENDS_WITHIN = 1.0  # time for a process that closed its socket to end by itself [s]


class SandboxError(RuntimeError):
    """The grader itself cannot work; it says nothing about a submission."""


@dataclass(frozen=True)
class Job:
    """One call of a student's function.

    Attributes
    ----------
    arguments : tuple of ndarray
    phi : float or None
        What our `get_contacts` returns for the distance [m] during the call, if it is not the true one.
    """

    arguments: tuple[Array, ...]
    phi: float | None = None


@dataclass(frozen=True)
class Observation:
    """What came of a `Job`.

    Attributes
    ----------
    result : tuple, ndarray, Other or None
        None if the call did not return; `error` then says why.
    error : str
        Empty if the call returned.
    changed : tuple of int
        Which arguments the call changed.
    printed : bool
    used : tuple of str
        Which of our functions the call used.
    """

    result: tuple[Any, ...] | Array | Other | None = None
    error: str = ""
    changed: tuple[int, ...] = ()
    printed: bool = False
    used: tuple[str, ...] = ()


@contextmanager
def temporary_folder() -> Iterator[Path]:
    """An empty folder that is gone after use, whatever student code left in it."""
    folder = tempfile.mkdtemp(prefix="tumble-grade-")
    try:
        yield Path(folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


@contextmanager
def scratch_folder(source: bytes) -> Iterator[Path]:
    """A temporary folder with a submission and the helper files of the assignment.

    Parameters
    ----------
    source : bytes
        Of the student's file.
    """
    with temporary_folder() as folder:
        for name in FILES:
            if name.endswith(".py") and name != "assignment_3.py":
                shutil.copyfile(template_path(name), folder / name)
        (folder / "assignment_3.py").write_bytes(source)
        yield folder


class StudentProcess:
    """A running submission. Use it in a ``with`` block: at its end the process and its children are killed.

    Parameters
    ----------
    scratch : Path
        Folder with the submission.
    cache : Path
        Folder for the font list of matplotlib, shared by all submissions because it is slow to make.
    seconds : float
        Time for loading the submission and all calls [s].

    Attributes
    ----------
    end : str
        Why the process ended, empty while it runs.
    """

    def __init__(self, scratch: Path, cache: Path, seconds: float) -> None:
        self.end = ""
        self._seconds = seconds
        self._deadline = time.monotonic() + _STARTS_WITHIN
        self._received = b""
        self._socket, other = socket.socketpair()
        folders = (str(scratch), str(cache))
        with other:
            self._process = subprocess.Popen(
                (sys.executable, "-m", "tumble.grade.child", str(other.fileno()), str(seconds), *folders),
                cwd=scratch,
                env=_environment(scratch, cache),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                pass_fds=(other.fileno(),),
                start_new_session=True,
            )

    def __enter__(self) -> StudentProcess:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._socket.close()
        self._kill()

    def load(self) -> dict[str, Any] | None:
        """What the submission holds, see `tumble.grade.child`; None if it could not be loaded, `end` says why.

        Raises
        ------
        SandboxError
            If the process does not get as far as the submission.
        """
        if self._receive() is None:
            raise SandboxError(f"the process for student code does not start: it {self.end}")
        self._deadline = time.monotonic() + self._seconds
        message = self._receive()
        if message is not None and "error" in message:
            self.end = _printable(message["error"])
            return None
        if message is not None and not _is_module(message):
            self.end = _DISTURBED
            return None
        return message

    def call(
        self,
        function: str,
        jobs: list[Job],
        parameters: dict[str, float],
        replaced: tuple[str, ...] = (),
        conventions: Conventions | None = None,
    ) -> list[Observation]:
        """Call a function of the submission.

        Parameters
        ----------
        function : str
            Its name in the submission.
        jobs : list of Job
        parameters : dict
            Of our functions.
        replaced : tuple of str
            Functions of the submission to replace by ours.
        conventions : Conventions, optional
            Of our functions.

        Returns
        -------
        list of Observation
            One for each job. Jobs not done when the process ended have `end` as their error.
        """
        request = {
            "function": function,
            "parameters": parameters,
            "replaced": list(replaced),
            "conventions": conventions or {},
            "jobs": [{"arguments": [a.tolist() for a in job.arguments], "phi": job.phi} for job in jobs],
        }
        self._send(request)
        observations: list[Observation] = []
        while len(observations) < len(jobs) and (message := self._receive()) is not None:
            observation = _observation(message, len(observations))
            if observation is None:
                self.end = _DISTURBED
                break
            observations.append(observation)
        missing = len(jobs) - len(observations)
        return observations + [Observation(error=self.end)] * missing

    def _send(self, message: dict[str, Any]) -> None:
        if self.end:
            return
        try:
            self._socket.settimeout(max(self._deadline - time.monotonic(), 0.001))
            self._socket.sendall(json.dumps(message).encode() + b"\n")
        except OSError:
            self.end = self._how_it_ended()

    def _receive(self) -> dict[str, Any] | None:
        while not self.end and b"\n" not in self._received:
            try:
                self._socket.settimeout(max(self._deadline - time.monotonic(), 0.001))
                chunk = self._socket.recv(1 << 16)
            except socket.timeout:
                self.end = f"does not finish within {self._seconds:g} s (an endless loop?)"
                break
            except OSError:
                chunk = b""
            if not chunk:
                self.end = self._how_it_ended()
            self._received += chunk
            if len(self._received) > _LONGEST_MESSAGE:
                self.end = _DISTURBED
        if self.end:
            return None
        line, _, self._received = self._received.partition(b"\n")
        try:
            message = json.loads(line)
        except (ValueError, RecursionError):
            message = None
        if not isinstance(message, dict):
            self.end = _DISTURBED
            return None
        return message

    def _how_it_ended(self) -> str:
        limit = time.monotonic() + _ENDS_WITHIN
        flags = os.WEXITED | os.WNOHANG | os.WNOWAIT
        while os.waitid(os.P_PID, self._process.pid, flags) is None and time.monotonic() < limit:
            time.sleep(0.005)
        code = self._kill()
        if code == -signal.SIGXCPU:
            return f"uses more than {self._seconds:g} s of processor time (an endless loop?)"
        if code < 0:
            name = signal.Signals(-code).name
            return (
                f"crashes Python ({name})"
                if code != -signal.SIGKILL
                else "is ended by the system (out of memory?)"
            )
        return f"ends the Python process (os._exit or the like, code {code})"

    def _kill(self) -> int:
        if self._process.returncode is None:
            # The process is not reaped yet, so its group cannot belong to anyone else.
            try:
                os.killpg(self._process.pid, signal.SIGKILL)
            except (ProcessLookupError, PermissionError):
                self._process.kill()
        return self._process.wait()


def _printable(text: Any) -> str:
    """Text of student code must not steer the terminal of whoever grades."""
    return "".join(letter if letter.isprintable() else " " for letter in str(text))


def _is_module(message: dict[str, Any]) -> bool:
    """Whether a message is what the child tells of a submission."""
    try:
        values = [float(message["parameters"][key]["value"]) for key in DEFAULTS]
        names = [message["functions"][name] for name in FUNCTIONS] + [
            message["similar"][name] for name in FUNCTIONS
        ]
        texts = [*message["notes"], *message["doubts"], *(name for name in names if name is not None)]
    except (KeyError, TypeError, ValueError):
        return False
    return all(map(math.isfinite, values)) and all(isinstance(text, str) for text in texts)


def _observation(message: dict[str, Any], number: int) -> Observation | None:
    """None if the message is not the answer to the job of that number."""
    try:
        if message["number"] != number:
            return None
        return Observation(
            result=decode(message["result"]) if "result" in message else None,
            error=_printable(message.get("error", "")),
            changed=tuple(message["changed"]),
            printed=bool(message["printed"]),
            used=tuple(message["used"]),
        )
    except (KeyError, TypeError, ValueError):
        return None


def _environment(scratch: Path, cache: Path) -> dict[str, str]:
    """A clean environment: the same for every submission, whoever grades."""
    package = str(Path(tumble.__file__).parent.parent)
    # The first entry is the folder of whoever grades; its files must not stand in for modules.
    inherited = [entry for entry in sys.path[1:] if entry and os.path.isabs(entry)]
    return {
        "PATH": os.defpath,
        "HOME": str(scratch),
        "TMPDIR": str(scratch),
        "LANG": "C.UTF-8",
        "PYTHONPATH": os.pathsep.join([package, *inherited]),
        "PYTHONDONTWRITEBYTECODE": "1",
        "PYTHONHASHSEED": "0",
        "MPLBACKEND": "Agg",
        "MPLCONFIGDIR": str(cache),
        "OPENBLAS_NUM_THREADS": "1",
        "OMP_NUM_THREADS": "1",
        "MKL_NUM_THREADS": "1",
    }
