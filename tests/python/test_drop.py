"""tumble.drop: the document's functions from Python."""

import copy
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tumble import NoSolution, drop
from tumble.drop import Parameters

Q0 = np.array([0.0, 1.5, np.deg2rad(30.0)])
V0 = np.array([0.0, -0.2, 0.0])


def test_shapes_and_types_are_the_documents() -> None:
    J, phi = drop.get_contacts(Q0)
    V, p = drop.form_lcp(J, V0)
    f_c = drop.solve_LCP(V, p)
    q1, v1 = drop.step(Q0, V0)
    q, v = drop.simulate(Q0, V0)
    assert isinstance(phi, float)
    for array, shape in [(J, (3, 2)), (V, (4, 4)), (p, (4,)), (f_c, (3,)), (q1, (3,)), (v1, (3,)), (q, (3, 150)), (v, (3, 150))]:
        assert array.shape == shape and array.dtype == np.float64
    assert np.array_equal(J[:, 0], [1.0, 0.0, J[2, 0]]) and np.array_equal(J[:, 1], [0.0, 1.0, J[2, 1]])
    assert np.array_equal(q[:, 0], Q0) and np.array_equal(q[:, 1], q1) and np.array_equal(v[:, 1], v1)


def test_functions_put_together_by_hand_give_the_step() -> None:
    """Part 3 written with numpy from parts 1 and 2, at every column in contact."""
    params = Parameters(l=0.4, mu=0.5)
    inverse_M = np.diag([1 / params.m, 1 / params.m, 6 / (params.m * params.l**2)])
    q, v = drop.simulate(Q0, V0, params=params)
    contacts = 0
    for k in range(149):
        J, phi = drop.get_contacts(q[:, k], params=params)
        if phi >= params.delta:
            continue
        contacts += 1
        f_n, f_t1, f_t2 = drop.solve_LCP(*drop.form_lcp(J, v[:, k], params=params))
        force = np.array([0, -params.m * params.g, 0]) + J[:, 1] * f_n - J[:, 0] * f_t1 + J[:, 0] * f_t2
        expected = v[:, k] + params.dt * inverse_M @ force
        np.testing.assert_allclose(v[:, k + 1], expected, atol=1e-13)  # speeds up to 20, a few roundings
        np.testing.assert_allclose(q[:, k + 1], q[:, k] + params.dt * expected + [0, params.delta, 0], atol=1e-13)
    assert contacts > 3


@pytest.mark.parametrize("kind", [list, tuple, np.float32, np.int64, np.float16, "strided", "reversed", "readonly", "big-endian"])
def test_any_real_array_is_taken_and_none_is_changed_or_kept(kind) -> None:
    whole = np.array([1.0, 2.0, 3.0])
    if kind in (list, tuple):
        argument = kind(whole)
    elif kind == "strided":
        argument = np.array([1.0, 0, 2.0, 0, 3.0, 0])[::2]
    elif kind == "reversed":
        argument = np.array([3.0, 2.0, 1.0])[::-1]
    elif kind == "readonly":
        argument = whole.copy()
        argument.setflags(write=False)
    elif kind == "big-endian":
        argument = whole.astype(">f8")
    else:
        argument = whole.astype(kind)
    before = copy.copy(argument)
    q1, v1 = drop.step(argument, argument)
    assert np.array_equal(q1, drop.step(whole, whole)[0]) and np.array_equal(v1, drop.step(whole, whole)[1])
    assert np.array_equal(argument, before)
    q, v = drop.simulate(argument, argument)
    q[:] = v[:] = 7.0  # results are the caller's own
    assert np.array_equal(drop.simulate(whole, whole)[0][:, 0], whole)


def test_a_matrix_may_be_in_any_order() -> None:
    J, _ = drop.get_contacts(Q0)
    V, p = drop.form_lcp(J, [1.0, -2.0, 0.5])
    V2, p2 = drop.form_lcp(np.asfortranarray(J), [1.0, -2.0, 0.5])
    assert np.array_equal(V, V2) and np.array_equal(p, p2)
    assert np.array_equal(drop.solve_LCP(V, p), drop.solve_LCP(np.asfortranarray(V), p))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: drop.get_contacts([1.0, 2.0]), r"q: must have shape \(3,\), got \(2,\)"),
        (lambda: drop.get_contacts([[1.0], [2.0], [3.0]]), r"q: must have shape \(3,\), got \(3, 1\)"),
        (lambda: drop.get_contacts([]), r"q: must have shape \(3,\), got \(0,\)"),
        (lambda: drop.get_contacts(None), "q: must be an array of real numbers"),
        (lambda: drop.get_contacts("abc"), "q: must be an array of real numbers"),
        (lambda: drop.get_contacts([1j, 0, 0]), "complex"),
        (lambda: drop.get_contacts([True, False, True]), "bool"),
        (lambda: drop.get_contacts([[1], [2, 3]]), "q: must be an array of"),
        (lambda: drop.get_contacts([0.0, np.nan, 0.0]), r"q\[1\]: must be finite, got nan"),
        (lambda: drop.step(Q0, [0.0, 0.0, np.inf]), r"v\[2\]: must be finite, got inf"),
        (lambda: drop.form_lcp(np.zeros((2, 3)), V0), r"J: must have shape \(3, 2\), got \(2, 3\)"),
        (lambda: drop.form_lcp(np.full((3, 2), np.nan), V0), "J_t"),
        (lambda: drop.get_contacts(np.ma.array(Q0, mask=[0, 1, 0])), "q: must have no masked entry, got 1"),
        (lambda: drop.simulate(Q0, np.ma.array([0, 1, 2], mask=True)), "v0: must have no masked entry, got 3"),
        (lambda: drop.render(np.ma.array(np.ones((3, 2)), mask=[[0, 0], [0, 1], [0, 0]])), "q: must have no masked entry, got 1"),
        (lambda: drop.record([0.0, 1.0, 0.0], [0.0, 1e200, 0.0]), "q0, v0: the kinetic and the potential energy must be finite"),
        (lambda: drop.solve_LCP(np.eye(3), np.zeros(4)), r"V: must have shape \(4, 4\), got \(3, 3\)"),
        (lambda: drop.solve_LCP(np.eye(4), np.zeros(3)), r"p: must have shape \(4,\), got \(3,\)"),
        (lambda: drop.solve_LCP(np.full((4, 4), np.nan), np.zeros(4)), r"M\[0\]\[0\]: must be finite"),
        (lambda: drop.simulate(Q0, [0.0]), r"v0: must have shape \(3,\), got \(1,\)"),
        (lambda: Parameters(l=0.0), "l: must be finite and > 0, got 0 m"),
        (lambda: Parameters(l="0.2"), "l: must be a number, got '0.2'"),
        (lambda: Parameters(m=None), "m: must be a number, got None"),
        (lambda: Parameters(columns=150.5), r"columns: must be a whole number in \[2, 10000000\], got 150.5"),
        (lambda: Parameters(columns=10**30), "columns: must be a whole number"),
        (lambda: Parameters(columns=-3), "columns: must be a whole number"),
        (lambda: Parameters(eps=2.0), r"eps: must be in \[0, 1\], got 2"),
        (lambda: Parameters(columns=0), r"columns: must be in \[2, 10000000\], got 0"),
        (lambda: Parameters(mu=float("nan")), "mu: must be finite and >= 0, got nan"),
    ],
)
def test_bad_input_is_a_value_error_that_names_it(call, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()


def test_unknown_parameters_are_refused() -> None:
    with pytest.raises(TypeError):
        Parameters(side=0.4)
    with pytest.raises(TypeError):
        Parameters(0.4)


@pytest.mark.parametrize("params", [None, {"l": 0.4}, 0.4])
def test_other_things_than_parameters_are_refused_in_one_line(params) -> None:
    message = f"^params: must be a tumble.drop.Parameters, got {type(params).__name__}$"
    for call in (drop.step, drop.simulate, drop.record):
        with pytest.raises(TypeError, match=message):
            call(Q0, V0, params=params)
    with pytest.raises(TypeError, match=message):
        drop.get_contacts(Q0, params)


def test_parameters_are_values() -> None:
    a = Parameters(l=0.4, mu=0.5)
    assert a == Parameters(l=0.4, mu=0.5) and hash(a) == hash(Parameters(l=0.4, mu=0.5)) and a != Parameters()
    assert a.l == 0.4 and a.columns == 150
    assert eval(repr(a)) == a
    assert pickle.loads(pickle.dumps(a)) == a and Parameters(**a.asdict()) == a
    with pytest.raises(AttributeError):
        a.l = 1.0


def test_a_problem_without_solution_raises_with_its_status() -> None:
    with pytest.raises(NoSolution, match="no_solution_proved"):
        drop.solve_LCP(-np.eye(4), [-1.0, 0.0, 0.0, 0.0])
    assert issubclass(NoSolution, RuntimeError)


def test_a_run_beyond_double_raises_and_says_where() -> None:
    params = Parameters(dt=1e158, g=0.0, columns=50)
    with pytest.raises(NoSolution, match="step 2 of 49"):
        drop.simulate([0.0, 1.0, 0.0], [1e150, 0.0, 0.0], params=params)
    record = drop.record([0.0, 1.0, 0.0], [1e150, 0.0, 0.0], params=params)
    assert record.status == ["solved", "numerical"] and record.q.shape == (3, 2)


def test_energies_of_a_record_are_finite() -> None:
    """The speed grows until its square leaves the range of double; the state itself is finite for longer."""
    params = Parameters(g=-1e153, dt=1.0, columns=100)
    record = drop.record([0.0, 1e3, 0.0], [0.0, 0.0, 0.0], params=params)
    assert record.status[-1] == "numerical" and set(record.status[:-1]) == {"solved"} and record.q.shape[1] > 10
    assert np.isfinite(record.kinetic).all() and np.isfinite(record.potential).all()


def test_masked_arrays_without_a_masked_entry_are_arrays() -> None:
    assert np.array_equal(drop.step(np.ma.array(Q0), np.ma.array(V0, mask=False))[0], drop.step(Q0, V0)[0])


def test_long_runs_are_made_of_the_same_steps() -> None:
    """Longer than the pieces in which Python runs are made; the step is taken from every boundary once more."""
    params = Parameters(dt=1e-4, columns=250_123)
    q, v = drop.simulate(Q0, V0, params=params)
    record = drop.record(Q0, V0, params=params)
    assert q.shape == (3, 250_123) and np.array_equal(record.q, q) and np.array_equal(record.v, v)
    assert len(record.status) == len(record.mode) == 250_123
    for k in [*range(99_990, 100_010), *range(199_990, 200_010), 250_121]:
        q1, v1 = drop.step(q[:, k], v[:, k], params=params)
        assert np.array_equal(q[:, k + 1], q1) and np.array_equal(v[:, k + 1], v1)
        assert record.gap[k] == drop.get_contacts(q[:, k], params)[1]


def test_a_long_run_that_fails_late_says_where() -> None:
    """Free flight upwards: the height passes 1.8e308 at a known step, far behind the first piece."""
    params = Parameters(g=0.0, dt=1.0, columns=300_000)
    with pytest.raises(NoSolution, match="step 179770 of 299999"):
        drop.simulate([0.0, 1.0, 0.0], [0.0, 1e303, 0.0], params=params)


@pytest.mark.parametrize("function", ["simulate", "record"])
def test_a_long_run_can_be_interrupted(function: str) -> None:
    """A handler that is called while the run goes on, and ends it at its fifth call."""
    code = (
        "import signal\n"
        "from tumble import drop\n"
        "calls = []\n"
        "def handler(*_):\n"
        "    calls.append(1)\n"
        "    if len(calls) == 5: raise KeyboardInterrupt\n"
        "params = drop.Parameters(columns=10_000_000)\n"
        "signal.signal(signal.SIGPROF, handler)\n"
        "signal.setitimer(signal.ITIMER_PROF, 0.01, 0.01)\n"
        "try:\n"
        f"    drop.{function}([0, 1, 0.5], [0, 0, 0], params=params)\n"
        "except KeyboardInterrupt:\n"
        "    signal.setitimer(signal.ITIMER_PROF, 0)\n"
        "    print('interrupted')\n"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert result.stdout == "interrupted\n", result.stderr


def test_record_holds_what_happened() -> None:
    record = drop.record(Q0, V0)
    q, v = drop.simulate(Q0, V0)
    assert np.array_equal(record.q, q) and np.array_equal(record.v, v)
    assert np.array_equal(record.gap, [drop.get_contacts(q[:, k])[1] for k in range(150)])
    assert set(record.mode) == {"open", "stick", "slip left", "slip right"}
    touching = record.f_n > 0
    assert np.array_equal(touching, [mode != "open" for mode in record.mode])
    assert (np.abs(record.f_t2 - record.f_t1) <= 0.3 * record.f_n * (1 + 1e-15)).all()
    assert (record.residual < 1e-14).all() and set(record.status) == {"solved"}
    np.testing.assert_allclose(record.potential, 0.3 * 9.81 * q[1], rtol=1e-15)
    np.testing.assert_allclose(record.kinetic, 0.15 * (v[0] ** 2 + v[1] ** 2) + 0.001 * v[2] ** 2, rtol=1e-14)
    np.testing.assert_allclose(record.t, np.arange(150) * 0.01, rtol=1e-15)


coordinate = st.floats(-3.0, 3.0)


@given(st.tuples(coordinate, st.floats(-0.1, 1.0), st.floats(-20.0, 20.0)), st.tuples(coordinate, coordinate, st.floats(-20.0, 20.0)))
@settings(max_examples=200, deadline=None, derandomize=True)
def test_contact_forces_solve_the_lcp_of_the_document(q, v) -> None:
    J, phi = drop.get_contacts(q)
    V, p = drop.form_lcp(J, v)
    f_n, f_t1, f_t2 = drop.solve_LCP(V, p)
    slip = J[:, 0] @ np.array(v) + V[2, :3] @ [f_n, f_t1, f_t2]  # gravity has no part along x
    z = np.array([f_n, f_t1, f_t2, abs(slip)])
    w = V @ z + p
    # forces up to 1e4 N from velocities up to 10 m/s, V about 0.1: round-off of 1e-14 in w
    assert (z >= 0).all() and (w >= -1e-11).all() and (np.minimum(z / 1e3, w) <= 1e-11).all()


def test_corner_positions_turn_with_the_square() -> None:
    corners = drop.corner_positions([1.0, 2.0, np.pi / 2], params=Parameters(l=2.0))
    np.testing.assert_allclose(corners, [[2, 1], [2, 3], [0, 3], [0, 1]], atol=1e-15)


def test_simulate_runs_in_threads() -> None:
    from concurrent.futures import ThreadPoolExecutor

    expected = drop.simulate(Q0, V0)[0]
    with ThreadPoolExecutor(4) as pool:
        for q, _ in pool.map(lambda _: drop.simulate(Q0, V0), range(200)):
            assert np.array_equal(q, expected)


@pytest.mark.parametrize("module", ["tumble", "tumble.drop", "tumble.lcp"])
def test_every_public_name_is_documented(module: str) -> None:
    import importlib

    loaded = importlib.import_module(module)
    for name in loaded.__all__:
        if name != "__version__" and name != "METHODS":
            assert (getattr(loaded, name).__doc__ or "").strip(), f"{module}.{name} has no docstring"


def test_types_are_checked_by_mypy(tmp_path: Path) -> None:
    root = Path(__file__).resolve().parents[2]
    good = tmp_path / "good.py"
    good.write_text("from tumble.drop import simulate, Parameters\nq, v = simulate([0, 1, 0], [0, 0, 0], params=Parameters(l=0.4))\n")
    bad = tmp_path / "bad.py"
    bad.write_text("from tumble.drop import Parameters\nParameters(side=0.4)\n")
    scene = tmp_path / "scene.py"
    scene.write_text(
        "import tumble\nscene = tumble.Scene()\nwood = scene.add_material('wood')\n"
        "box = scene.add_body([tumble.square(1), tumble.Part(tumble.disc(1))], mass=1, angle='30 deg', material=wood)\n"
        "reveal_type(tumble.simulate(scene)[box].x)\nscene.add_body(tumble.square(1), mas=1)\n"
    )
    command = [sys.executable, "-m", "mypy", "--config-file", str(root / "pyproject.toml"), "--cache-dir", str(tmp_path / "cache")]
    environment = {"MYPYPATH": str(root / "bindings/python"), "PATH": "/usr/bin:/bin"}

    def check(*arguments: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run([*command, *arguments], capture_output=True, text=True, env=environment, cwd=root)

    package = check()
    assert package.returncode == 0, package.stdout
    assert check(str(good)).returncode == 0
    wrong = check(str(bad))
    assert wrong.returncode != 0 and "side" in wrong.stdout
    said = check(str(scene)).stdout.splitlines()
    assert len(said) == 3 and "numpy.float" in said[0] and 'argument "mas"' in said[1], said
