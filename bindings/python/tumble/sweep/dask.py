"""Sweeps on a Dask cluster: the shards of a sweep as futures.

Needs the package ``distributed`` (Debian: python3-distributed), and a folder that all workers see.
"""

from __future__ import annotations

import os
import tempfile
from typing import Any, Optional

from tumble.sweep._run import as_threads, as_whole_number, load
from tumble.sweep._spec import PathLike, SpecLike, as_bytes, read_spec
from tumble.sweep._sweep import Sweep, sweep_module

_SHARDS_FOR_EACH_WORKER = 4  # so that no worker is idle for long while the last ones finish


def run(
    spec: SpecLike,
    client: Any,
    folder: Optional[PathLike] = None,
    *,
    shards: Optional[int] = None,
    threads: int = 0,
) -> Sweep:
    """Run a sweep on the workers of a Dask cluster, with the same bits as `tumble.sweep.run`.

    Parameters
    ----------
    spec : path, str, or dict
        As in `tumble.sweep.run`; a file is read here, the workers need not see it.
    client : distributed.Client
        Of the cluster. Workers need the package tumble.
    folder : path, optional
        Seen by all workers under this name; called again with it, the sweep goes on from the chunks that are finished. If it
        is not given, a temporary folder of this machine, which suits a LocalCluster.
    shards : int, optional
        Parts that are handed out, each to the next free worker; four for each worker if not given, and at most one for
        each chunk.
    threads : int
        Of each part; 0: as many as its worker has.

    Raises
    ------
    ValueError, OSError
        As `tumble.sweep.run`, also for what happens on a worker. A part whose worker dies is given to another one by Dask.
    """
    if folder is None:
        with tempfile.TemporaryDirectory(prefix="tumble-sweep-") as made:
            return run(spec, client, os.path.join(made, "sweep"), shards=shards, threads=threads)
    read, path, cores = read_spec(spec), os.path.abspath(as_bytes(folder, "folder")), as_threads(threads)
    chunks = int(sweep_module().plan(*read)["chunks"])
    if shards is None:
        shards = _SHARDS_FOR_EACH_WORKER * max(1, len(client.scheduler_info()["workers"]))
    count = min(as_whole_number(shards, "shards", 1, 1_000_000), chunks)
    sweep_module().begin(*read, path, False)
    futures = [client.submit(_work, path, index, count, cores, pure=False) for index in range(count)]
    try:
        client.gather(futures)
    finally:
        client.cancel(futures)  # of no effect on what is done; at Ctrl-C or an error it stops what is not
    return load(folder)


def _work(folder: bytes, index: int, count: int, threads: int) -> None:
    """On a worker: one shard of the sweep that the folder was begun for."""
    if threads == 0:
        from distributed import get_worker

        threads = get_worker().state.nthreads
    sweep_module().run_shard(folder, index, count, threads, None)
