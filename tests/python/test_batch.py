"""`simulate_batch`: many drops at once, from Python."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from typing import Any

import numpy as np
import pytest
import tumble
from scene_samples import HEEDS_CTRL_C, shown_on_a_terminal, ticks_during
from tumble import _core
from tumble.drop import Batch, Parameters, simulate, simulate_batch

SETS = [name for name in ("scalar", "sse2", "neon", "avx2", "avx512")]


def starts(count: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(seed)
    q0 = np.column_stack([random.uniform(-1, 1, count), random.uniform(0.2, 1.5, count), random.uniform(-7, 7, count)])
    v0 = np.column_stack([random.uniform(-2, 2, count), random.uniform(-2, 0, count), random.uniform(-9, 9, count)])
    return q0, v0


def test_final_states_are_those_of_simulate() -> None:
    q0, v0 = starts(200)
    batch = simulate_batch(q0, v0)
    assert batch.q.shape == batch.v.shape == (200, 3) and (batch.status == 0).all() and (batch.columns == 150).all()
    for i in range(200):
        q, v = simulate(q0[i], v0[i])
        assert np.array_equal(batch.q[i], q[:, -1]) and np.array_equal(batch.v[i], v[:, -1])


@pytest.mark.parametrize("keep", ["all", 1, 7, 149, 200, np.int64(3)])
def test_columns_are_those_of_simulate(keep: Any) -> None:
    q0, v0 = starts(20)
    batch = simulate_batch(q0, v0, keep=keep)
    every = 1 if keep == "all" else int(keep)
    for i in range(20):
        q, v = simulate(q0[i], v0[i])
        assert np.array_equal(batch.q[i], q[:, ::every]) and np.array_equal(batch.v[i], v[:, ::every])


def test_parameters_for_each_in_every_form() -> None:
    q0, v0 = starts(30)
    mu = np.linspace(0, 1, 30)
    each = [Parameters(mu=value, eps=0.3, columns=80) for value in mu]
    one_by_one = np.array([simulate(q, v, p)[0][:, -1] for q, v, p in zip(q0, v0, each)])
    assert np.array_equal(simulate_batch(q0, v0, each).q, one_by_one)
    assert np.array_equal(simulate_batch(q0, v0, {"mu": mu, "eps": 0.3, "columns": 80}).q, one_by_one)
    assert np.array_equal(simulate_batch(q0, v0, {"mu": list(mu), "eps": [0.3], "columns": 80}).q, one_by_one)
    assert np.array_equal(simulate_batch(q0, v0, each[3]).q[3], one_by_one[3])


def test_arrays_of_any_kind_are_taken() -> None:
    q0, v0 = starts(10)
    wanted = simulate_batch(q0, v0).q
    assert np.array_equal(simulate_batch(q0.tolist(), np.asfortranarray(v0)).q, wanted)
    wide = np.zeros((10, 6))
    wide[:, ::2] = q0
    assert np.array_equal(simulate_batch(wide[:, ::2], v0).q, wanted)
    assert len(simulate_batch(np.zeros((0, 3)), np.zeros((0, 3)))) == 0


def test_measures_alone() -> None:
    q0, v0 = starts(100)
    batch, whole = simulate_batch(q0, v0, keep="measures"), simulate_batch(q0, v0, measures=True)
    assert batch.q is None and batch.v is None
    assert batch.measures is not None and whole.measures is not None
    assert batch.measures.tobytes() == whole.measures.tobytes() and (batch.columns == 150).all()


def test_single_precision() -> None:
    q0, v0 = starts(500)
    for q, v in [(q0, v0), (q0.astype(np.float32), v0.astype(np.float32))]:
        batch = simulate_batch(q, v, Parameters(columns=10), dtype=np.float32)
        assert batch.q.dtype == np.float32
        assert np.array_equal(batch.q, simulate_batch(q0, v0, Parameters(columns=10), dtype="f4").q)
    assert np.median(np.abs(batch.q - simulate_batch(q0, v0, Parameters(columns=10)).q)) < 1e-6


def test_instruction_sets_and_threads_change_no_bit() -> None:
    q0, v0 = starts(777)
    wanted = simulate_batch(q0, v0, measures=True)
    tried = 0
    for name in SETS:
        try:
            batch = simulate_batch(q0, v0, measures=True, instruction_set=name, threads=3)
        except ValueError as error:
            assert "must be one of" in str(error)
            continue
        tried += 1
        assert batch.q.tobytes() == wanted.q.tobytes()
        assert batch.measures is not None and wanted.measures is not None
        assert batch.measures.tobytes() == wanted.measures.tobytes()
    assert tried >= 2


@pytest.mark.parametrize("name", ["scalar", "sse2"])
def test_the_environment_picks_the_instruction_set(name: str) -> None:
    code = "from tumble import _core; print(_core.instruction_set())"
    environment = {**os.environ, "TUMBLE_INSTRUCTION_SET": name}
    run = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert run.stdout.strip() == name


def test_an_unknown_instruction_set_in_the_environment_is_named() -> None:
    code = "from tumble.drop import simulate_batch; simulate_batch([[0, 1, 0]], [[0, 0, 0]])"
    environment = {**os.environ, "TUMBLE_INSTRUCTION_SET": "mmx"}
    run = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert run.stderr.splitlines()[-1].startswith("ValueError: TUMBLE_INSTRUCTION_SET: must be one of scalar, ")


def test_what_is_wrong_with_one_drop_is_its_status() -> None:
    q0, v0 = starts(50)
    good = simulate_batch(q0, v0, keep="all")
    q0[7, 1] = np.nan
    bad = simulate_batch(q0, v0, {"mu": np.where(np.arange(50) == 9, -1.0, 0.3)}, keep="all", measures=True)
    assert list(np.flatnonzero(bad.status)) == [7, 9] and (bad.status[[7, 9]] == 2).all()
    assert bad.why(7) == "q[1]: must be finite, got nan" and bad.why(9) == "mu: must be finite and >= 0, got -1"
    assert bad.why(8) == "" and bad.why(-41) == bad.why(9)
    others = np.setdiff1d(np.arange(50), [7, 9])
    assert np.array_equal(bad.q[others], good.q[others]) and np.isnan(bad.q[[7, 9]]).all()
    assert bad.measures is not None and (bad.measures["face"][[7, 9]] == -1).all()
    assert repr(bad) == "<Batch: 50 drops, 48 solved, 2 invalid>"


def test_a_drop_that_leaves_the_range_of_double() -> None:
    batch = simulate_batch([[0, 1.5, 0.1]] * 2, [[0, 0, 0], [1e308, 0, 0]], {"dt": [0.01, 10.0]}, keep="all")
    assert list(batch.status) == [0, 1] and batch.columns[1] < 150
    assert np.isfinite(batch.q[1, :, : batch.columns[1]]).all() and np.isnan(batch.q[1, :, batch.columns[1] :]).all()


BAD: list[tuple[dict[str, Any], str]] = [
    ({"q0": np.zeros((3, 2))}, "q0: must have shape (N, 3), got (3, 2)"),
    ({"q0": np.zeros(3)}, "q0: must have shape (N, 3), got (3,)"),
    ({"v0": np.zeros((4, 3))}, "q0, v0: must have as many rows, got 3 and 4"),
    ({"q0": "abc"}, "q0: must be an array of real numbers, got dtype <U3"),
    ({"params": {"mu": [0.1, 0.2]}}, "mu: must have 1 or 3 values, got 2"),
    ({"params": {"mu": -1}}, "mu: must be finite and >= 0, got -1"),
    ({"params": {"mu": []}}, "mu: must have 1 or 3 values, got 0"),
    ({"params": []}, "mu: must have 1 or 3 values, got 0"),
    ({"dtype": "zz"}, "dtype: must be float64 or float32, got 'zz'"),
    ({"rest_speed": 10**400}, f"rest_speed: must be a number, got {10**400}"),
    ({"params": {"nu": 1}}, "params: must have names out of l, m, mu, eps, dt, delta, g, columns, got 'nu'"),
    ({"params": {"columns": 1}}, "columns: must be in [2, 10000000], got 1"),
    ({"params": [Parameters(), Parameters(columns=3)]}, "params: must all have the same columns, got 3 to 150"),
    ({"params": [Parameters(), Parameters()]}, "l: must have 1 or 3 values, got 2"),
    ({"keep": 0}, "keep: must be 'final', 'all', 'measures' or a whole number >= 1, got 0"),
    ({"keep": "last"}, "keep: must be 'final', 'all', 'measures' or a whole number >= 1, got 'last'"),
    ({"threads": -1}, "threads: must be a whole number in [0, 1024], 0 for one for each core, got -1"),
    ({"threads": 1.5}, "threads: must be a whole number in [0, 1024], 0 for one for each core, got 1.5"),
    ({"rest_speed": -1}, "rest_speed: must be >= 0 m/s, got -1"),
    ({"region": (1, 0)}, "region: must be (x_min, x_max) [m] with x_min <= x_max, got (1, 0)"),
    ({"region": 3}, "region: must be (x_min, x_max) [m] with x_min <= x_max, got 3"),
    ({"dtype": np.int32}, "dtype: must be float64 or float32, got int32"),
]


@pytest.mark.parametrize("arguments, message", BAD)
def test_what_is_wrong_for_all_is_one_line(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError) as error:
        simulate_batch(**{"q0": np.zeros((3, 3)), "v0": np.zeros((3, 3)), **arguments})
    assert str(error.value) == message


def test_other_threads_run_meanwhile() -> None:
    q0, v0 = starts(20000)
    ticks, seconds = ticks_during(lambda: simulate_batch(q0, v0, Parameters(columns=2000), threads=1))
    assert ticks > seconds / 0.05  # at least a tenth of what it would be alone


def test_ctrl_c_ends_it_soon() -> None:
    code = (
        "import numpy as np, tumble, sys\n"
        "q = np.tile([[0, 1.5, 0.5]], (100000, 1))\n"
        "print('begun', flush=True)\n"
        "tumble.simulate_batch(q, 0 * q, tumble.drop.Parameters(columns=1000000), threads=2)"
    )
    command = [sys.executable, "-c", HEEDS_CTRL_C + code]
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert child.stdout is not None and child.stdout.readline() == "begun\n"
    time.sleep(0.5)
    child.send_signal(signal.SIGINT)
    _, errors = child.communicate(timeout=60)
    assert "KeyboardInterrupt" in errors.splitlines()[-1]


PROGRESS = """
import numpy as np, tumble, tumble._progress as module
module._SECONDS_BEFORE_PROGRESS = module._SECONDS_BETWEEN_LINES = 0.0
q = np.tile([[0, 1.5, 0.5]], (200000, 1))
tumble.simulate_batch(q, 0 * q, tumble.drop.Parameters(columns=500), progress=True)
"""


def test_progress_is_shown_on_a_terminal_only() -> None:
    shown = shown_on_a_terminal(PROGRESS)
    assert b" of 200000 drops" in shown and shown.endswith(b"\r\x1b[K"), shown


@pytest.mark.parametrize("parameters", [{"dt": 1e38}, {"dt": 10.0, "g": 1e36}, {"delta": 1e39}, {"l": 1e-46}, {"g": 1e39}])
def test_what_single_precision_cannot_hold_is_not_solved(parameters: dict[str, float]) -> None:
    batch = simulate_batch([[0, 0.3, 0.4]], [[1.0, 0, 0]], parameters, dtype=np.float32, keep="all")
    good = batch.columns[0]
    assert (batch.status[0] == 0) == (good == 150)
    assert np.isfinite(batch.q[0, :, :good]).all() and np.isnan(batch.q[0, :, good:]).all()


def test_a_start_that_single_precision_cannot_hold() -> None:
    batch = simulate_batch([[1e39, 0.15, 0.4]], [[0, 0, 0]], dtype=np.float32)
    assert batch.status[0] == 2 and batch.why(0) == "q[0]: must be finite, got inf"


def test_why_remembers_what_was_wrong() -> None:
    q0 = np.array([[0, 1, 0], [np.nan, 1, 0]])
    batch = simulate_batch(q0, np.zeros((2, 3)))
    q0[1] = 0
    assert batch.why(1) == batch.why(-1) == "q[0]: must be finite, got nan"
    for index, error in ((2, IndexError), (-3, IndexError), (1.5, TypeError), ("a", TypeError)):
        with pytest.raises(error, match="^i: must be"):
            batch.why(index)  # type: ignore[arg-type]


def test_names() -> None:
    assert tumble.simulate_batch is simulate_batch
    assert Batch.STATUSES == ("solved", "numerical", "invalid")
    assert _core.instruction_set() in SETS
