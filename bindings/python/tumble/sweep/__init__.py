"""Many drops as one question: which face is up, where do they land, when do they rest.

run
    A sweep, from a spec to a `Sweep`: columns, a summary, pictures.
run_shard, merge
    The same in parts, on several machines or on several days, and the parts together.
load
    A sweep from the folder or the file that it was written to.
Sweep, Summary, Share, MeasureSummary
    What comes out.

The spec is that of ``tumble sweep`` (docs/sweep.md): the name of a TOML file, its text, or a dict of the same keys.
`tumble.sweep.dask` hands the parts of a sweep to a Dask cluster.

>>> import tumble.sweep
>>> sweep = tumble.sweep.run({"samples": 1000, "start": {"theta": {"uniform": [0, 6.283]}}})
>>> len(sweep), sorted(sweep.columns)[:3]
(1000, ['energy_lost', 'escape_time', 'face'])
>>> share = sweep.summary().outcomes["+y up"]
>>> 0 <= share.low <= share.share <= share.high <= 1
True
"""

from tumble.sweep._run import load, merge, run, run_shard
from tumble.sweep._sweep import MeasureSummary, Share, Summary, Sweep

__all__ = ["MeasureSummary", "Share", "Summary", "Sweep", "load", "merge", "run", "run_shard"]
