"""From a spec to a sweep."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Callable, Optional

import numpy as np

from tumble._progress import ProgressLine
from tumble.sweep._spec import PathLike, SpecLike, SpecText, as_bytes, path_text, read_spec
from tumble.sweep._sweep import Sweep, sweep_module


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
        If a file cannot be read or written, or with `overwrite` another process is at work in the folder.
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
        return Sweep(sweep_module().simulate(*read, as_threads(threads), told))


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

    Raises
    ------
    ValueError, OSError, KeyboardInterrupt
        As `run`; ValueError also if `index` is not in [1, `count`] or `count` not in [1, 1 000 000].
    """
    shards = as_whole_number(count, "shard: count", 1, 1_000_000)
    shard = as_whole_number(index, "shard: index", 1, shards) - 1
    read, path, cores = read_spec(spec), as_bytes(folder, "folder"), as_threads(threads)
    _begin(read, path, bool(overwrite))
    with _Progress(progress, sweep_module().plan(*read, shard, shards)["instances"]) as told:
        return dict(sweep_module().run_shard(path, shard, shards, cores, told))


def _begin(spec: SpecText, folder: bytes, overwrite: bool) -> None:
    try:
        sweep_module().begin(*spec, folder, overwrite)
    except ValueError as error:
        if "holds another sweep" not in str(error):
            raise
        raise ValueError(f"{error}; overwrite=True replaces it") from None


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
    paths = [as_bytes(folder, "folders") for folder in folders]
    if not paths:
        raise ValueError("folders: must be at least one")
    return Sweep(sweep_module().read(paths, as_threads(threads)))


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
    as_bytes(path, "path")
    path = Path(path)
    shown = path_text(path)
    ending = path.suffix.lower()
    if ending not in (".npz", ".h5") or path.is_dir():
        return merge([path], threads=threads)
    arrays = _read_npz(path) if ending == ".npz" else _read_h5(path)
    if "spec" not in arrays:
        raise ValueError(f"{shown}: is no sweep: it has no array 'spec'")
    text, scene = (_text(arrays.pop(name, "")) for name in ("spec", "scene"))
    numbers = {name: values for name, values in arrays.items() if values.dtype.kind in "fi"}
    statistics = {name: values for name, values in numbers.items() if name.startswith("statistics_")}
    try:
        if statistics:
            return Sweep(sweep_module().from_statistics(text, shown, scene, statistics))
        columns = {name: values for name, values in numbers.items() if values.ndim == 1}
        return Sweep(sweep_module().from_columns(text, shown, scene, columns))
    except ValueError as error:
        message = str(error)
        raise ValueError(message if message.startswith(shown) else f"{shown}: {message}") from None


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


def as_threads(threads: object) -> int:
    return as_whole_number(threads, "threads", 0, 1024, ", 0 for one for each core")


def as_whole_number(value: object, field: str, low: int, high: int, note: str = "") -> int:
    if isinstance(value, (int, np.integer)) and not isinstance(value, bool) and low <= value <= high:
        return int(value)
    raise ValueError(f"{field}: must be a whole number in [{low}, {high}]{note}, got {value!r:.40}")


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
