"""From a spec to a sweep."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Callable, Optional, Union

import numpy as np

from tumble._progress import ProgressLine
from tumble.sweep._spec import SpecLike, read_spec
from tumble.sweep._sweep import Sweep, sweep_module

PathLike = Union[str, "os.PathLike[str]"]


def run(
    spec: SpecLike,
    folder: Optional[PathLike] = None,
    *,
    threads: int = 0,
    overwrite: bool = False,
    progress: bool = False,
) -> Sweep:
    """Run a sweep on all cores.

    Parameters
    ----------
    spec : path, str, or dict
        Name of a TOML file, its text, or a dict of the same keys, in which an array of numpy stands for ``{"list": ...}``.
    folder : path, optional
        Where finished chunks of instances are kept: after Ctrl-C, a crash or a full disk the same call goes on from there.
        ``tumble sweep`` and `run_shard` work in the same folders. Without one, all is in memory.
    threads : int
        0: one for each core. Of no influence on the numbers.
    overwrite : bool
        Let the folder be that of another sweep, which is lost.
    progress : bool
        Show on the terminal how far it is, if standard error is one and it takes longer than a second.

    Raises
    ------
    ValueError
        "file:line:column: field: what is allowed, what is there"; or the folder holds something else.
    OSError
        If a file cannot be read or written.
    MemoryError
        If the columns do not fit into memory: ``"keep": "statistics"`` in the spec needs none.
    KeyboardInterrupt
        At Ctrl-C, within a second.
    """
    if folder is not None:
        run_shard(spec, folder, threads=threads, overwrite=overwrite, progress=progress)
        return load(folder, threads=threads)
    read = read_spec(spec)
    with _Progress(progress, sweep_module().plan(*read)["instances"]) as told:
        return Sweep(sweep_module().simulate(*read, _threads(threads), told))


def run_shard(
    spec: SpecLike,
    folder: PathLike,
    index: int = 1,
    count: int = 1,
    *,
    threads: int = 0,
    overwrite: bool = False,
    progress: bool = False,
) -> dict[str, Any]:
    """Compute part `index` of `count` of a sweep into a folder: ``tumble sweep --shard index/count``.

    The parts may run at the same time, in one folder that they share or in several, on any machines; `merge` and `load`
    make one sweep of them, with the same bits as `run`. What is finished in the folder is not computed again.

    Returns
    -------
    dict
        ``chunks``, how many belong to this part; ``found``, how many of them were there before; ``faults``, why files of
        chunks were computed again.
    """
    if not (isinstance(count, (int, np.integer)) and isinstance(index, (int, np.integer)) and 1 <= index <= count):
        raise ValueError(f"shard: must be a whole number of 1 to {count!r}, got {index!r}")
    read = read_spec(spec)
    cores = _threads(threads)
    sweep_module().begin(*read, os.fsencode(folder), bool(overwrite))
    with _Progress(progress, sweep_module().plan(*read)["instances"] // int(count)) as told:
        return dict(sweep_module().run_shard(os.fsencode(folder), int(index) - 1, int(count), cores, told))


def merge(folders: Sequence[PathLike], *, threads: int = 0) -> Sweep:
    """The sweep whose parts are in these folders.

    Raises
    ------
    ValueError
        If one of them holds another sweep, or none.
    OSError
        If chunks are missing, naming them, or damaged.
    """
    if isinstance(folders, (str, bytes, os.PathLike)):
        raise TypeError("folders: must be a list of folders")
    paths = [os.fsencode(folder) for folder in folders]
    if not paths:
        raise ValueError("folders: must be at least one")
    return Sweep(sweep_module().read(paths, _threads(threads)))


def load(path: PathLike, *, threads: int = 0) -> Sweep:
    """A sweep from its folder, or from an .npz or .h5 file that ``tumble sweep`` or `Sweep.save` wrote.

    Raises
    ------
    ValueError
        If there is something else.
    OSError
        If it cannot be read, or the sweep is not finished.
    ImportError
        For an .h5 file, if the package h5py is absent.
    """
    path = Path(path)
    ending = path.suffix.lower()
    if ending not in (".npz", ".h5") or path.is_dir():
        return merge([path], threads=threads)
    arrays = _read_npz(path) if ending == ".npz" else _read_h5(path)
    if "spec" not in arrays:
        raise ValueError(f"{path}: is no sweep: it has no array 'spec'")
    text, scene = (_text(arrays.pop(name, "")) for name in ("spec", "scene"))
    numbers = {name: values for name, values in arrays.items() if values.dtype.kind in "fi"}
    statistics = {name: values for name, values in numbers.items() if name.startswith("statistics_")}
    try:
        if statistics:
            return Sweep(sweep_module().from_statistics(text, str(path), scene, statistics))
        columns = {name: values for name, values in numbers.items() if values.ndim == 1}
        return Sweep(sweep_module().from_columns(text, str(path), scene, columns))
    except ValueError as error:
        message = str(error)
        raise ValueError(message if message.startswith(str(path)) else f"{path}: {message}") from None


def _text(value: Any) -> str:
    first = np.asarray(value).reshape(-1)[0]
    return first.decode() if isinstance(first, bytes) else str(first)


def _read_npz(path: Path) -> dict[str, Any]:
    with np.load(path, allow_pickle=False) as file:
        return dict(file)


def _read_h5(path: Path) -> dict[str, Any]:
    try:
        import h5py
    except ImportError as error:
        raise ImportError(f"{path}: reading .h5 files needs the package h5py") from error
    with h5py.File(path, "r") as file:
        return {name: np.asarray(data[()]) for name, data in file.items()}


def _threads(threads: object) -> int:
    if isinstance(threads, (int, np.integer)) and not isinstance(threads, bool) and 0 <= threads <= 1024:
        return int(threads)
    raise ValueError(f"threads: must be a whole number in [0, 1024], 0 for one for each core, got {threads!r}")


class _Progress:
    """Gives the function that is told how many instances are done, or None."""

    def __init__(self, is_wanted: bool, instances: int) -> None:
        self._line = ProgressLine() if is_wanted else None
        self._instances = instances

    def __enter__(self) -> Optional[Callable[[int], None]]:
        if self._line is None:
            return None
        line, instances = self._line, self._instances

        def told(done: int) -> None:
            line.show(done / max(instances, 1), f"{done} of {instances} instances")

        return told

    def __exit__(self, *_: object) -> None:
        if self._line is not None:
            self._line.clear()
