"""Runs a sweep on a Dask cluster, or on worker processes of this machine, and tells which side is up.

    python3 sweep_dask.py                                    # two worker processes, faces.toml into faces.sweep
    python3 sweep_dask.py --scheduler tcp://head:8786 --folder /scratch/faces.sweep

Killed or interrupted, the same call goes on where it was.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import tumble.sweep.dask
from distributed import Client, LocalCluster


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("spec", nargs="?", type=Path, default=Path("faces.toml"))
    parser.add_argument("--folder", type=Path, default=Path("faces.sweep"), help="seen by all workers under this name")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="of a cluster that runs; without it, one is started here")
    parser.add_argument("--workers", type=int, default=2, help="processes of the cluster that is started here")
    words = parser.parse_args()

    if words.scheduler:
        with Client(words.scheduler) as client:
            sweep = tumble.sweep.dask.run(words.spec, client, words.folder)
    else:
        with LocalCluster(
            n_workers=words.workers, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster, Client(cluster) as client:
            sweep = tumble.sweep.dask.run(words.spec, client, words.folder)
    print(sweep.summary())


if __name__ == "__main__":  # worker processes import this file, too
    main()
