"""Keep student code from doing harm by accident. It runs inside the process that runs the student code.

This guards against accidents, not against malice: code that wants to break out of a Python process can.
"""

from __future__ import annotations

import importlib.abc
import importlib.machinery
import io
import math
import os
import resource
import sys
from collections.abc import Callable, Sequence
from types import ModuleType
from typing import Any

# Room for numpy and matplotlib, which reserve far more addresses than they use.
_MEMORY = 2 * 1024**3
_LARGEST_FILE = 32 * 1024**2
_OPEN_FILES = 64

# There is no limit on the number of processes: the system counts those of the whole user, so any number is wrong
# somewhere, and matplotlib needs a thread. New processes are refused below instead.
_PROCESS_EVENTS = (
    "os.exec",
    "os.fork",
    "os.forkpty",
    "os.posix_spawn",
    "os.spawn",
    "os.system",
    "subprocess.Popen",
)
_OTHER_EVENTS = {
    "os.kill": "sending signals",
    "os.killpg": "sending signals",
    "socket.connect": "using the network",
    "socket.bind": "using the network",
}
_FILE_EVENTS = ("os.remove", "os.rename", "os.rmdir", "os.mkdir", "os.truncate", "os.chmod", "shutil.rmtree")
_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND


def limit_resources(seconds: float) -> None:
    """Limit processor time, memory, file size and open files of this process.

    Parameters
    ----------
    seconds : float
        Processor time [s].
    """
    processor = math.ceil(seconds) + 1
    # The hard limit lies above the soft one, because only the soft one has a signal of its own.
    resource.setrlimit(resource.RLIMIT_CPU, (processor, processor + 1))
    for kind, limit in (
        (resource.RLIMIT_AS, _MEMORY),
        (resource.RLIMIT_FSIZE, _LARGEST_FILE),
        (resource.RLIMIT_NOFILE, _OPEN_FILES),
        (resource.RLIMIT_CORE, 0),
    ):
        hard = resource.getrlimit(kind)[1]
        allowed = limit if hard == resource.RLIM_INFINITY else min(limit, hard)
        resource.setrlimit(kind, (allowed, allowed))


def refuse_side_effects(folders: Sequence[str]) -> None:
    """From now on refuse new processes, the network, and changes to files outside some folders.

    Parameters
    ----------
    folders : sequence of str
        Where files may be written, changed and removed.
    """
    allowed = tuple(os.path.join(os.path.realpath(folder), "") for folder in folders)

    def is_outside(path: Any) -> bool:
        if isinstance(path, int) or path is None:
            return False
        place = os.path.realpath(os.fsdecode(path))
        return place != os.devnull and not (place + os.sep).startswith(allowed)

    def hook(event: str, details: tuple[Any, ...]) -> None:
        if event in _PROCESS_EVENTS:
            raise PermissionError("starting other programs is not allowed while grading")
        if event in _OTHER_EVENTS:
            raise PermissionError(f"{_OTHER_EVENTS[event]} is not allowed while grading")
        if event == "open":
            path, mode, flags = details
            writes = (
                any(letter in mode for letter in "wax+") if isinstance(mode, str) else bool(flags & _WRITING)
            )
            if writes and is_outside(path):
                raise PermissionError(f"writing to {path} is not allowed while grading")
        elif event in _FILE_EVENTS:
            for path in details[: 2 if event == "os.rename" else 1]:
                if is_outside(path):
                    raise PermissionError(f"changing {path} is not allowed while grading")

    sys.addaudithook(hook)


class Sink(io.TextIOBase):
    """Swallows output and counts its characters."""

    def __init__(self) -> None:
        super().__init__()
        self.characters = 0

    def write(self, text: str) -> int:
        self.characters += len(text)
        return len(text)

    def writable(self) -> bool:
        return True

    encoding = "utf-8"


def _do_nothing(*_: Any, **__: Any) -> None:
    pass


def _silence_pyplot(module: ModuleType) -> None:
    # Settled now, because pyplot would otherwise choose a backend with the first figure.
    module.switch_backend("Agg")
    for name in ("show", "pause", "ion", "switch_backend", "waitforbuttonpress", "ginput"):
        setattr(module, name, _do_nothing)


def _silence_matplotlib(module: ModuleType) -> None:
    module.use = _do_nothing  # type: ignore[attr-defined]


def _silence_animation(module: ModuleType) -> None:
    module.Animation.save = _do_nothing


_SILENCERS: dict[str, Callable[[ModuleType], None]] = {
    "matplotlib": _silence_matplotlib,
    "matplotlib.pyplot": _silence_pyplot,
    "matplotlib.animation": _silence_animation,
}


class _SilencingLoader(importlib.abc.Loader):
    """Loads a module as another loader does and then changes it."""

    def __init__(self, loader: importlib.abc.Loader, silence: Callable[[ModuleType], None]) -> None:
        self._loader = loader
        self._silence = silence

    def create_module(self, spec: importlib.machinery.ModuleSpec) -> ModuleType | None:
        return self._loader.create_module(spec)

    def exec_module(self, module: ModuleType) -> None:
        self._loader.exec_module(module)
        self._silence(module)


class _PlotSilencer(importlib.abc.MetaPathFinder):
    """Makes windows, pauses and films harmless as soon as the student's code loads matplotlib, and not before: loading
    it takes longer than all the grading."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> importlib.machinery.ModuleSpec | None:
        silence = _SILENCERS.get(fullname)
        if silence is None:
            return None
        spec = importlib.machinery.PathFinder.find_spec(fullname, path, target)
        if spec is None or spec.loader is None:
            return None
        spec.loader = _SilencingLoader(spec.loader, silence)
        return spec


def silence_plots() -> None:
    """Make plt.show, plt.pause, matplotlib.use and Animation.save do nothing."""
    sys.meta_path.insert(0, _PlotSilencer())
