"""tumble.sweep: the same numbers as one drop at a time, however a sweep is run; files, summaries, pictures."""

import json
import os
import signal
import struct
import subprocess
import sys
import threading
import time
import zlib
from pathlib import Path

import numpy as np
import pytest

from tumble import drop

sweep_package = pytest.importorskip("tumble.sweep")
try:
    from tumble import _sweep  # noqa: F401
except ImportError:
    pytest.skip("built without pictures and sweeps", allow_module_level=True)

SPEC = {
    "title": "Squares",
    "seed": 5,
    "samples": 40,
    "chunk": 64,
    "start": {"theta": {"uniform": ["0 deg", "360 deg"]}, "omega": {"normal": [0, 4]}},
    "parameters": {"mu": np.array([0.1, 0.4, 0.8]), "eps": {"range": [0.2, 0.6, 3]}, "steps": 200},
    "measures": {"region": [-0.5, 0.5]},
}
N = 9 * 40
PACKAGE = {**os.environ, "PYTHONPATH": str(Path(drop.__file__).parents[1])}  # for programs that run elsewhere


@pytest.fixture(scope="module")
def swept():
    return sweep_package.run(SPEC)


def assert_same(a, b):
    assert a.spec == b.spec
    assert list(a.columns) == list(b.columns)
    for name in a.columns:
        np.testing.assert_array_equal(a[name], b[name], err_msg=name)
    assert a.summary().to_json() == b.summary().to_json()


def test_each_instance_is_the_drop_alone(swept):
    assert len(swept) == N
    for i in (0, 1, 63, 64, 200, N - 1):
        q0 = [0, 1.5, swept["theta"][i]]
        v0 = [0, -0.2, swept["omega"][i]]
        params = drop.Parameters(mu=swept["mu"][i], eps=swept["eps"][i], columns=201)
        q, _ = drop.simulate(q0, v0, params)
        assert swept["final_x"][i] == q[0, -1]
        assert swept["final_theta"][i] == q[2, -1]


def test_the_grid_is_in_order(swept):
    np.testing.assert_array_equal(swept["mu"], np.repeat([0.1, 0.4, 0.8], 3 * 40))
    np.testing.assert_allclose(swept["eps"][::40], [0.2, 0.4, 0.6] * 3, rtol=1e-15)


def test_threads_folders_and_shards_do_not_matter(swept, tmp_path):
    assert_same(sweep_package.run(SPEC, threads=1), swept)
    assert_same(sweep_package.run(SPEC, threads=5), swept)
    assert_same(sweep_package.run(SPEC, tmp_path / "whole"), swept)
    for index in (3, 1, 2):
        sweep_package.run_shard(SPEC, tmp_path / f"part{index}", index, 3, threads=2)
    with pytest.raises(OSError, match="missing"):
        sweep_package.merge([tmp_path / "part1", tmp_path / "part3"])
    assert_same(sweep_package.merge([tmp_path / f"part{index}" for index in (1, 2, 3)]), swept)


def test_what_is_finished_is_not_computed_again(tmp_path):
    first = sweep_package.run_shard(SPEC, tmp_path / "sweep", 1, 2)
    assert first == {"chunks": 3, "found": 0, "faults": []}
    assert sweep_package.run_shard(SPEC, tmp_path / "sweep") == {"chunks": 6, "found": 3, "faults": []}
    other = {**SPEC, "seed": 6}
    with pytest.raises(ValueError, match="holds another sweep: .*; overwrite=True replaces it"):
        sweep_package.run(other, tmp_path / "sweep")
    assert len(sweep_package.run(other, tmp_path / "sweep", overwrite=True)) == N


def test_a_chunk_with_more_rows_than_it_has_is_refused(tmp_path):
    sweep_package.run_shard(SPEC, tmp_path / "sweep")
    file = tmp_path / "sweep/chunks/000001.chunk"
    data = file.read_bytes()
    parts = struct.unpack_from("<Q", data, 24)[0]
    head = list(struct.unpack_from(f"<{4 + 2 * parts}Q", data))
    last = data[-head[-2] :] * 1000  # a column a thousand times over, with a checksum that fits
    head[-2:] = len(last), zlib.crc32(last)
    words = struct.pack(f"<{len(head)}Q", *head)
    start = 8 * (len(head) + 1)
    kept = sum(head[4:-2:2])
    file.write_bytes(words + struct.pack("<Q", zlib.crc32(words)) + data[start : start + kept] + last)
    with pytest.raises(OSError, match="chunk 1: status: must have 64 rows, has 64000"):
        sweep_package.load(tmp_path / "sweep")


def test_files_come_back(swept, tmp_path):
    swept.save(tmp_path / "sweep.npz")
    assert_same(sweep_package.load(tmp_path / "sweep.npz"), swept)
    swept.save(tmp_path / "SWEEP.NPZ")
    assert_same(sweep_package.load(tmp_path / "SWEEP.NPZ"), swept)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["SWEEP.NPZ", "sweep.npz"]
    with np.load(tmp_path / "sweep.npz") as file:
        assert set(swept.columns) < set(file.files)


def test_statistics_alone_give_the_same_summary(swept, tmp_path):
    alone = sweep_package.run({**SPEC, "keep": "statistics"})
    assert not alone.columns
    assert alone.summary() == alone.summary()
    assert alone.summary().to_json() == swept.summary().to_json()
    folder = sweep_package.run({**SPEC, "keep": "statistics"}, tmp_path / "folder")
    assert folder.summary().to_json() == swept.summary().to_json()
    with pytest.raises(KeyError, match="statistics alone"):
        alone["final_x"]
    with pytest.raises(ValueError, match="statistics alone"):
        alone.save(tmp_path / "alone.npz")


def test_summary_is_what_numpy_says(swept):
    summary = swept.summary()
    assert summary.instances == summary.solved == N
    is_at_rest = ~np.isnan(swept["rest_time"])
    for face, name in enumerate(("+y up", "+x up", "-y up", "-x up")):
        share = summary.outcomes[name]
        assert share.count == np.sum((swept["face"] == face) & is_at_rest)
        assert share.low <= share.share <= share.high
    assert summary.outcomes["still moving"].count == np.sum(~is_at_rest)
    for name, measure in summary.measures.items():
        values = swept[name][~np.isnan(swept[name])]
        assert measure.count == len(values) and measure.missing == N - len(values)
        assert measure.unit == swept.units[name]
        if len(values) == 0:
            continue
        # A sum of N numbers, rounded each time.
        np.testing.assert_allclose(measure.mean, values.mean(), rtol=1e-12, atol=1e-13)
        np.testing.assert_allclose(measure.deviation, values.std(ddof=1), rtol=1e-10)
        assert (measure.min, measure.max) == (values.min(), values.max())
        low, high = np.quantile(values, [0.24, 0.26])  # 0.2 % of the value, and the gaps between N values
        assert low - 0.002 * abs(low) - 0.02 <= measure.q25 <= high + 0.002 * abs(high) + 0.02
    data = json.loads(summary.to_json())
    assert data["instances"] == N and len(data["measures"]) == len(summary.measures)
    assert str(summary).startswith("Squares\n")
    assert summary.to_csv().count("\n") == 1 + 7 + len(summary.measures)


def test_columns_are_read_only_and_outlive_the_sweep(swept):
    sweep = sweep_package.run({"samples": 10, "start": {"x": {"uniform": [0, 1]}}})
    x = sweep["x"]
    before = x.copy()
    with pytest.raises(ValueError):
        x[0] = 1.0
    del sweep
    np.testing.assert_array_equal(x, before)
    assert swept["face"].dtype == np.int32


def test_a_spec_may_be_a_file_a_text_or_a_dict(tmp_path):
    text = "sweep = 1\nsamples = 3\nstart.theta = { uniform = [0, 1] }\n"
    (tmp_path / "spec.toml").write_text(text)
    sweeps = [
        sweep_package.run(text),
        sweep_package.run(tmp_path / "spec.toml"),
        sweep_package.run(str(tmp_path / "spec.toml")),
        sweep_package.run({"samples": 3, "start": {"theta": {"uniform": (0, np.float64(1))}}}),
    ]
    for sweep in sweeps:
        np.testing.assert_array_equal(sweep["theta"], sweeps[0]["theta"])


CYCLE = {"start": {}}
CYCLE["start"]["x"] = CYCLE


@pytest.mark.parametrize(
    ("spec", "error", "message"),
    [
        ({"start": {"thetta": 1}}, ValueError, "thetta"),
        ({"parameters": {"mu": -1.0}}, ValueError, "mu.*-1"),
        ({"parameters": {"mu": {"uniform": [0, {"a": object()}]}}}, TypeError, "parameters.mu"),
        ({"samples": 0}, ValueError, "samples"),
        ({"samples": 10}, ValueError, "samples: must be 1 where nothing is drawn"),
        ({3: 1}, TypeError, "keys must be texts"),
        ({'a"\n\\': 1}, ValueError, "not known|unknown|allowed"),
        (7, TypeError, "spec: must be"),
        ("absent.toml", FileNotFoundError, "absent.toml"),
        ("", ValueError, "spec: must be .* got an empty text"),
        ("\ud800.toml", ValueError, r"spec: must be a path that the system can take, got '\\ud800.toml'"),
        ("title = '\ud800'", ValueError, "spec: must be valid UTF-8"),
        ({"title": "a\ud800"}, ValueError, r"title: must be valid UTF-8, got '\\ud800'"),
        (CYCLE, ValueError, "spec: must not contain itself"),
        ({"parameters": {"mu": np.ma.array([0.1, 0.2], mask=[0, 1])}}, ValueError, "parameters.mu: .*masked entry, got 1"),
        ({"parameters": {"mu": {"list": [0.1, np.ma.masked]}}}, ValueError, "parameters.mu.list: .*masked entry, got 1"),
    ],
)
def test_bad_specs_are_refused_by_name(spec, error, message):
    with pytest.raises(error, match=message) as raised:
        sweep_package.run(spec)
    assert "\n" not in str(raised.value)


def test_names_of_files_may_have_any_bytes(swept, tmp_path):
    folder = tmp_path / os.fsdecode(b"\xff")
    folder.mkdir()
    (folder / "spec.toml").write_text("sweep = 1\nsample = 3\n")
    with pytest.raises(ValueError, match="\ufffd/spec.toml:2:1: 'sample': unknown key"):
        sweep_package.run(folder / "spec.toml")
    swept.save(folder / "sweep.npz")
    assert_same(sweep_package.load(folder / "sweep.npz"), swept)
    assert_same(sweep_package.run(SPEC, folder / "sweep"), swept)


def test_bad_calls_are_refused(swept, tmp_path):
    for shard in ((0, 2), (3, 2), (1.5, 2), (1, 0), (True, 2), (1, 10**30)):
        with pytest.raises(ValueError, match="shard"):
            sweep_package.run_shard(SPEC, tmp_path / "x", *shard)
    with pytest.raises(ValueError, match=r"shard: count: must be a whole number in \[1, 1000000\], got 'RS'"):
        sweep_package.run_shard(SPEC, tmp_path / "x", 3, "RS")
    with pytest.raises(TypeError, match="folder: must be a path, got 0"):
        sweep_package.run_shard(SPEC, 0)
    with pytest.raises(ValueError, match="threads"):
        sweep_package.run(SPEC, threads=-1)
    with pytest.raises(ValueError, match="folders"):
        sweep_package.merge([])
    with pytest.raises(TypeError, match="folders"):
        sweep_package.merge("folder")
    with pytest.raises(ValueError, match="spec"):
        np.savez(tmp_path / "other.npz", a=1)
        sweep_package.load(tmp_path / "other.npz")
    with pytest.raises(OSError):
        sweep_package.load(tmp_path / "absent.npz")
    with pytest.raises(ValueError):
        sweep_package.load(tmp_path / "absent")
    np.savez(tmp_path / "short.npz", spec=swept.spec, **{n: v[:-1] for n, v in swept.columns.items()})
    with pytest.raises(ValueError, match=f"short.npz.*must have {N} rows"):
        sweep_package.load(tmp_path / "short.npz")


def test_pictures(swept, tmp_path):
    for kind in ("overview", "faces", "map", "fan", "final_x", "map final_x"):
        swept.plot(tmp_path / "plot.svg", kind)
        assert (tmp_path / "plot.svg").read_text().startswith("<?xml")
    swept.plot(tmp_path / "plot.png", width=320, height=200)
    header = (tmp_path / "plot.png").read_bytes()[:24]
    assert header[1:4] == b"PNG" and header[16:24] == (320).to_bytes(4, "big") + (200).to_bytes(4, "big")
    assert "<svg" in swept._repr_svg_()
    for arguments, error in (
        ((tmp_path / "plot.gif",), ValueError),
        ((tmp_path / "plot.png", "face"), ValueError),
        ((tmp_path / "plot.png", 3), TypeError),
        ((tmp_path / "absent" / "plot.png",), OSError),
    ):
        with pytest.raises(error):
            swept.plot(*arguments)
    with pytest.raises(ValueError, match="width"):
        swept.plot(tmp_path / "plot.png", width=100)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["plot.png", "plot.svg"]


def test_nothing_needs_matplotlib(tmp_path):
    code = (
        "import sys; sys.modules['matplotlib'] = None\n"
        "import tumble.sweep\n"
        "s = tumble.sweep.run({'samples': 5, 'start': {'theta': {'uniform': [0, 1]}}})\n"
        "s.plot('plot.png'); print(s.summary())\n"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=PACKAGE, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "plot.png").exists()


LONG = {"samples": 100_000_000, "keep": "statistics", "start": {"theta": {"uniform": [0, 6]}}}


def interrupt_soon():
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()


def test_ctrl_c_ends_a_sweep():
    interrupt_soon()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        sweep_package.run(LONG)
    assert time.monotonic() - start < 20.0  # 0.5 s, and room for a loaded machine; all of it takes minutes


def test_ctrl_c_keeps_finished_chunks(tmp_path):
    interrupt_soon()
    with pytest.raises(KeyboardInterrupt):
        sweep_package.run({**LONG, "chunk": 1000, "samples": 10_000_000}, tmp_path / "sweep")
    assert len(list((tmp_path / "sweep" / "chunks").iterdir())) > 0
    with pytest.raises(OSError, match="not finished"):
        sweep_package.load(tmp_path / "sweep")


def test_other_threads_run_meanwhile():
    ticks = []
    is_done = threading.Event()

    def tick():
        while not is_done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.005)

    thread = threading.Thread(target=tick)
    thread.start()
    sweep_package.run({**LONG, "samples": 400_000}, threads=1)
    is_done.set()
    thread.join()
    assert len(ticks) > 5


def test_command_line_and_python_agree(swept, tmp_path):
    root = Path(__file__).parents[2]
    program = Path(os.environ.get("TUMBLE_BUILD", root / "build")).resolve() / "bin" / "tumble"
    if not program.exists():
        pytest.skip("the program is not built")
    (tmp_path / "spec.toml").write_text(swept.spec)
    for name in ("out.npz", "out.h5"):
        if name.endswith(".h5"):
            pytest.importorskip("h5py")
        subprocess.run([program, "sweep", "spec.toml", "-o", name, "--quiet"], cwd=tmp_path, check=True)
        assert_same(sweep_package.load(tmp_path / name), swept)
    (tmp_path / "alone.toml").write_text('keep = "statistics"\n' + swept.spec)
    subprocess.run([program, "sweep", "alone.toml", "-o", "alone.npz", "--quiet"], cwd=tmp_path, check=True)
    assert sweep_package.load(tmp_path / "alone.npz").summary().to_json() == swept.summary().to_json()
    subprocess.run([program, "sweep", "spec.toml", "-o", "folder", "--quiet"], cwd=tmp_path, check=True)
    assert_same(sweep_package.load(tmp_path / "folder"), swept)


def test_scenes_are_swept_too(tmp_path, monkeypatch):
    (tmp_path / "drop.toml").write_text((Path(__file__).parents[2] / "scenes" / "rocking_block.toml").read_text())
    spec = {
        "scene": "drop.toml",
        "samples": 6,
        "chunk": 4,
        "bodies": {"block": {"theta": {"uniform": [0.0, 0.2]}, "mass": np.array([1.0, 2.0])}},
    }
    monkeypatch.chdir(tmp_path)
    sweep = sweep_package.run(spec)
    assert len(sweep) == 12
    assert_same(sweep_package.run(spec, "folder"), sweep)
    sweep.save("sweep.npz")
    os.unlink("drop.toml")
    assert_same(sweep_package.load("sweep.npz"), sweep)
    assert_same(sweep_package.load("folder"), sweep)
    sweep.plot("plot.png")
    with pytest.raises((OSError, ValueError), match="drop.toml"):
        sweep_package.run(spec)


def test_a_dask_cluster_gives_the_same(swept, tmp_path):
    distributed = pytest.importorskip("distributed")
    from tumble.sweep import dask

    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=False, dashboard_address=None
    ) as cluster, distributed.Client(cluster) as client:
        assert_same(dask.run(SPEC, client), swept)
        assert_same(dask.run(SPEC, client, tmp_path / "shared", shards=4), swept)
        with pytest.raises(ValueError, match="other"):
            dask.run({**SPEC, "seed": 6}, client, tmp_path / "shared")
