"""tumble.lcp: solvers for any linear complementarity problem, from Python."""

import _thread
import math
import signal
import threading
import time
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from tumble import lcp


def test_solve_returns_everything_about_the_solution() -> None:
    M, q = np.array([[2.0, 1.0], [1.0, 2.0]]), np.array([-5.0, -6.0])
    for method in lcp.METHODS:
        result = lcp.solve(M, q, method=method)
        # The methods that iterate to a limit stop at their accepted residual, 1e-8 at most.
        np.testing.assert_allclose(result.z, [4 / 3, 7 / 3], rtol=1e-7)
        assert result.status == "solved" and result.residual < 1e-7 and result.pivots > 0
        assert np.array_equal(result.w, M @ result.z + q) and result.basis.tolist() == [True, True]
        assert result.parts == lcp.residual(M, q, result.z) and result.parts.largest == result.residual
        assert result.rung != "none" and result.refactorisations >= 0 and result.certificate is None


def test_the_default_is_robust() -> None:
    M, q = [[1, 0, 0, 0], [0, 1, -1, 1], [0, -1, 1, 1], [0.5, -1, -1, 0]], [-2, 1, -1, 0]
    assert lcp.solve(M, q).rung == lcp.solve(M, q, "robust").rung == "closed_form"
    assert next(iter(lcp.METHODS)) == "robust" and lcp.solve(M, q, "lemke").rung == "lemke"
    assert lcp.solve(M, np.abs(q)).rung == "none"


def test_infeasible_problems_come_with_their_proof() -> None:
    M, q = np.array([[-1.0, 2.0], [-1.0, -1.0]]), np.array([1.0, -1.0])
    for result in (lcp.solve(M, q), lcp.solve_batch(M, [q])[0]):
        y = result.certificate
        assert result.status == "infeasible" and y is not None
        assert (y >= 0).all() and (M.T @ y <= 0).all() and q @ y < 0


def test_a_ray_is_handed_out() -> None:
    ray = lcp.solve([[-1.0]], [-1.0], "lemke")
    assert ray.status == "ray_unproven" and ray.certificate is not None and ray.certificate.shape == (1,)


def test_solve_starts_from_a_result_or_a_basis() -> None:
    random = np.random.default_rng(0)
    root = random.standard_normal((20, 20))
    M, q = root @ root.T + np.eye(20), random.standard_normal(20)
    for method in ("robust", "lemke_lu"):
        cold = lcp.solve(M, q, method)
        for start in (cold, cold.basis, cold.basis.astype(int), list(cold.basis)):
            warm = lcp.solve(M, 1.01 * q, method, start=start)
            assert cold.pivots > 0 and warm.pivots == 0 and warm.status == "solved"
            assert np.array_equal(warm.basis, cold.basis)


def test_row_sizes_decide_what_is_round_off() -> None:
    M, q, z = [[1.0, 0.0], [0.0, 1.0]], [-1.0, -1e-9], [1.0, 0.0]
    assert lcp.residual(M, q, z, row_sizes=[1.0, 0.0]).largest == 1.0
    assert lcp.residual(M, q, z, row_sizes=[1.0, 1.0]).largest < 1e-8
    result = lcp.solve(M, q, row_sizes=[1.0, 1.0])
    assert result.status == "solved" and result.residual <= 1e-12


def test_methods_and_settings_are_listed() -> None:
    assert set(lcp.METHODS) >= {"robust", "lemke", "lemke_lu", "enumerate"}
    for method, summary in lcp.METHODS.items():
        assert 20 < len(summary) < 100 and "\n" not in summary
        defaults = lcp.default_settings(method)
        assert 0 < defaults["accepted_residual"] <= 0.01
        given = {name: value for name, value in defaults.items() if value is not None}
        result, same = lcp.solve([[1.0]], [-1.0], method), lcp.solve([[1.0]], [-1.0], method, **given)
        assert np.array_equal(result.z, same.z)
    assert lcp.solve([[2, 1], [1, 2]], [-5, -6], "lemke", max_pivots=1).status == "iteration_limit"
    assert lcp.solve([[2, 1], [1, 2]], [-5, -6], "lemke_lu", precision="quad").rung == "lemke_quad"


def random_contacts(seed: int, count: int) -> tuple[np.ndarray, np.ndarray]:
    """(count, 8, 8) matrices of two contacts on one body, (count, 8) vectors; every tenth q is >= 0."""
    random = np.random.default_rng(seed)
    M, q = np.zeros((count, 8, 8)), np.zeros((count, 8))
    for i in range(count):
        J_n, J_t = random.standard_normal((2, 2, 3))
        velocity = random.standard_normal(3) * 10.0 ** random.integers(-6, 6)
        M[i], q[i], _ = lcp.contact_problem(J_n, J_t, [1.0, 1.0, 5.0], velocity, random.uniform(0, 1, 2))
        if i % 10 == 0:
            q[i] = np.abs(q[i])
    return M, q


def assert_same(batch: lcp.BatchResult, results: list[lcp.Result]) -> None:
    """Field by field, bit by bit."""
    assert len(batch) == len(results)
    for one, other in zip(batch, results):
        for name in ("status", "residual", "parts", "pivots", "refactorisations", "rung"):
            assert getattr(one, name) == getattr(other, name), name
        for name in ("z", "w", "basis"):
            assert getattr(one, name).tobytes() == getattr(other, name).tobytes(), name
        assert (one.certificate is None) == (other.certificate is None)
        if one.certificate is not None and other.certificate is not None:
            assert one.certificate.tobytes() == other.certificate.tobytes()


@pytest.mark.parametrize("method", lcp.METHODS)
@pytest.mark.parametrize("threads", [0, 1, 3])
def test_a_batch_is_its_problems_one_by_one(method: str, threads: int) -> None:
    M, q = random_contacts(1, 200)
    assert_same(lcp.solve_batch(M, q, method, threads=threads), [lcp.solve(*pair, method) for pair in zip(M, q)])


def test_a_batch_may_share_its_matrix_sizes_and_start() -> None:
    M, q = random_contacts(2, 1)[0][0], random_contacts(3, 150)[1]
    sizes, start = np.full(8, 0.5), np.arange(8) < 3
    batch = lcp.solve_batch(M, q, row_sizes=sizes, start=start)
    assert_same(batch, [lcp.solve(M, row, row_sizes=sizes, start=start) for row in q])
    own_sizes = np.linspace(0.0, 1.0, 8 * len(q)).reshape(q.shape)
    batch = lcp.solve_batch(M, q, row_sizes=own_sizes, start=batch)
    assert set(batch.status) <= {"solved", "numerical", "ray_unproven", "no_solution_proved"}
    M, q = random_contacts(4, 90)
    cold = lcp.solve_batch(M, q)
    warm = lcp.solve_batch(M, q, start=cold, threads=2)
    assert_same(warm, [lcp.solve(*pair, start=result) for *pair, result in zip(M, q, cold)])
    assert (warm.rung[warm.pivots == 0] != "lemke").all() and (warm.status == "solved").all()


@given(st.lists(st.tuples(st.integers(0, 149), st.sampled_from([np.nan, np.inf, -np.inf])), min_size=1, max_size=20))
@settings(max_examples=30, deadline=None, derandomize=True)
def test_a_bad_problem_of_a_batch_touches_no_other(places) -> None:
    M, q = random_contacts(5, 150)
    good = lcp.solve_batch(M, q)
    is_bad = np.zeros(150, dtype=bool)
    for k, (i, value) in enumerate(places):
        is_bad[i] = True
        if k % 2:
            M[i, k % 8, 3] = value
        else:
            q[i, k % 8] = value
    batch = lcp.solve_batch(M, q, threads=2)
    assert ((batch.status == "bad_input") == is_bad).all() and np.isinf(batch.residual[is_bad]).all()
    assert not batch.z[is_bad].any() and not batch.w[is_bad].any()
    keep = [i for i in range(150) if not is_bad[i]]
    for name in ("status", "z", "w", "residual", "pivots", "rung", "basis"):
        assert np.array_equal(getattr(batch, name)[keep], getattr(good, name)[keep])


def test_an_empty_batch_is_empty() -> None:
    batch = lcp.solve_batch(np.zeros((0, 3, 3)), np.zeros((0, 3)))
    assert len(batch) == 0 and batch.z.shape == (0, 3) and list(batch) == []


@pytest.mark.parametrize("kind", ["float32", "int64", "uint8", ">f8", "fortran", "strided", "read_only", "list"])
def test_any_array_of_numbers_will_do(kind: str) -> None:
    M, q = np.array([[2.0, 1.0, 0.0], [1.0, 2.0, 1.0], [0.0, 1.0, 3.0]]), np.array([1.0, 0.0, 2.0])

    def convert(values: np.ndarray) -> np.ndarray | list[float]:
        if kind == "fortran":
            return np.asfortranarray(values)
        if kind == "strided":
            return np.repeat(values, 3, axis=-1)[..., ::3]
        if kind == "list":
            return values.tolist()
        if kind == "read_only":
            copy = values.copy()
            copy.flags.writeable = False
            return copy
        return values.astype(kind)

    given_M, given_q = convert(M), convert(q)
    expected = lcp.solve(M, q)
    assert np.array_equal(lcp.solve(given_M, given_q).z, expected.z)
    assert np.array_equal(given_M, M) and np.array_equal(given_q, q)
    stacked_M, stacked_q = convert(np.stack([M, M])), convert(np.stack([q, q]))
    assert np.array_equal(lcp.solve_batch(stacked_M, stacked_q).z, [expected.z, expected.z])


def test_all_solutions_lists_each_once() -> None:
    solutions = lcp.all_solutions([[-2, -1], [-1, -2]], [1, 1])
    found = sorted(tuple(np.round(s.z, 12)) for s in solutions)
    assert found == [(0, 0), (0, 0.5), (0.333333333333, 0.333333333333), (0.5, 0)]
    assert lcp.all_solutions([[-1]], [-1]) == []


def test_no_solution_is_an_outcome() -> None:
    assert lcp.solve([[-1.0]], [-1.0], method="lemke").status == "ray_unproven"
    assert lcp.solve([[-1.0]], [-1.0], method="enumerate").status == "no_solution_proved"


def test_residual_names_its_parts() -> None:
    parts = lcp.residual([[2, 1], [1, 2]], [-5, -6], [1, 2])
    assert parts.negative_w > 0.05 and parts.negative_z == 0 and parts.largest == parts.negative_w


def matrices(smallest: float) -> st.SearchStrategy:
    """Arrays with entries 0 or of size smallest to 1."""
    return hnp.arrays(np.float64, (6, 5), elements=st.floats(-1, 1).map(lambda x: x if abs(x) > smallest else 0.0))


def is_solution(result: lcp.Result) -> bool:
    """Absolute bounds: M and q are of order 1, the solution at most of order 10."""
    return (result.z >= 0).all() and (result.w >= -1e-12).all() and abs(result.z @ result.w) < 1e-11


@given(matrices(1e-9))
@settings(max_examples=300, deadline=None, derandomize=True)
def test_lemke_and_robust_solve_every_problem_with_a_definite_matrix(data) -> None:
    for method in ("robust", "lemke"):
        result = lcp.solve(data[:5] @ data[:5].T + 0.1 * np.eye(5), data[5], method)
        assert result.status == "solved" and is_solution(result), method


@given(matrices(0.0))
@settings(max_examples=300, deadline=None, derandomize=True)
def test_solved_is_never_said_of_a_wrong_vector(data) -> None:
    """Entries down to 1e-308 beside others of order 1: an answer may be missed, but not invented."""
    for method in ("robust", "lemke", "lemke_lu", "enumerate"):
        result = lcp.solve(data[:5] @ data[:5].T + 0.1 * np.eye(5), data[5], method)
        assert result.status != "solved" or is_solution(result), method


@pytest.mark.parametrize("n", [1, 2, 7, 40, 150])
def test_any_size(n: int) -> None:
    random = np.random.default_rng(n)
    root = random.standard_normal((n, n))
    M, q = root @ root.T / n + np.eye(n), random.standard_normal(n)
    result = lcp.solve(M, q)
    assert result.status == "solved" and result.residual < 1e-13


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: lcp.solve(np.eye(2), [1.0]), r"M: must have shape \(1, 1\) for q of length 1, got \(2, 2\)"),
        (lambda: lcp.solve(np.ones((2, 3)), [1.0, 1.0]), r"M: must have shape \(2, 2\)"),
        (lambda: lcp.solve([], []), "M: must have shape"),
        (lambda: lcp.solve(np.zeros((0, 0)), []), "q: must have at least 1 entry, got 0"),
        (lambda: lcp.solve([[np.nan]], [1.0]), r"M\[0\]\[0\]: must be finite, got nan"),
        (lambda: lcp.solve([[1.0]], [np.inf]), r"q\[0\]: must be finite, got inf"),
        (lambda: lcp.solve([[1.0]], [1.0], method="simplex"), "method: must be one of robust, lemke, .*, got 'simplex'"),
        (lambda: lcp.solve([[1.0]], [1.0], method=3), "method: must be a name, got 3"),
        (lambda: lcp.solve([[1.0]], [1.0], "lemke", pivot_tolerance=2.0), r"pivot_tolerance: must be in \[0, 1\), got 2"),
        (lambda: lcp.solve([[1.0]], [1.0], accepted_residual=np.inf), r"accepted_residual: must be in \(0, 0.01\], got inf"),
        (lambda: lcp.solve([[1.0]], [1.0], "lemke", max_pivots=1.5), "max_pivots: must be a whole number, got 1.5"),
        (lambda: lcp.solve([[1.0]], [1.0], "lemke", max_pivots=[1]), r"max_pivots: must be a number, got \[1\]"),
        (lambda: lcp.solve([[1.0]], [1.0], "lemke_lu", precision="half"), "precision: must be double or quad, got 'half'"),
        (lambda: lcp.solve([[1.0]], [1.0], start=[True, False]), "start_basis: must be empty or have 1 entries, got 2"),
        (lambda: lcp.solve([[1.0]], [1.0], start=[0.5]), "start_basis: must be zeros and ones, got 0.5"),
        (lambda: lcp.solve([[1.0]], [1.0], start=[[True]]), r"start_basis: must have shape \(n,\), got \(1, 1\)"),
        (lambda: lcp.solve([[1.0]], [1.0], row_sizes=[1.0, 2.0]), r"row_sizes: must have shape \(1,\), got \(2,\)"),
        (lambda: lcp.solve([[1.0]], [1.0], row_sizes=[-1.0]), r"row_sizes\[0\]: must be finite and >= 0, got -1"),
        (lambda: lcp.solve([[1j]], [1.0]), "M: must be an array of real numbers, got dtype complex128"),
        (lambda: lcp.solve([["a"]], [1.0]), "M: must be an array of real numbers"),
        (lambda: lcp.solve(None, [1.0]), "M: must be an array"),
        (lambda: lcp.solve_batch(np.eye(2), [1.0, 1.0]), r"q: must have shape \(N, n\), got \(2,\)"),
        (lambda: lcp.solve_batch(np.eye(3), np.ones((5, 2))), r"M: must have shape \(2, 2\), got \(3, 3\)"),
        (lambda: lcp.solve_batch(np.ones((4, 2, 2)), np.ones((5, 2))), r"M: must have shape \(5, 2, 2\), got \(4, 2, 2\)"),
        (lambda: lcp.solve_batch(np.eye(2), np.ones((5, 2)), row_sizes=[1.0]), r"row_sizes: must have shape \(2,\), got \(1,\)"),
        (lambda: lcp.solve_batch(np.eye(2), np.ones((5, 2)), start=[1]), r"start_basis: must have shape \(2,\), got \(1,\)"),
        (lambda: lcp.solve_batch(np.eye(2), np.ones((5, 2)), threads=-1), r"threads: must be a whole number in \[0, 1024\], got -1"),
        (lambda: lcp.solve_batch(np.eye(2), np.ones((5, 2)), threads=1.5), "threads: must be a whole number"),
        (lambda: lcp.solve_batch(np.eye(2), np.ones((5, 2)), accepted_residual=1.0), "accepted_residual: must be in"),
        (lambda: lcp.solve_batch(np.zeros((5, 0, 0)), np.ones((5, 0))), "q: must have at least 1 entry per problem"),
        (lambda: lcp.all_solutions(np.eye(13), np.ones(13)), "at most 12 entries"),
        (lambda: lcp.residual([[1.0]], [1.0], [1.0, 2.0]), "z: must have 1 entries like q, got 2"),
        (lambda: lcp.parse("M\n1 x\n", name="here"), "here:2:3: expected a number"),
    ],
)
def test_bad_input_is_a_value_error_that_names_it(call, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()


def test_unknown_settings_are_type_errors_that_list_the_known() -> None:
    with pytest.raises(TypeError, match="tolerance: .* has accepted_residual, start_basis"):
        lcp.solve([[1.0]], [1.0], tolerance=1.0)
    with pytest.raises(TypeError, match="max_pivots: .* has accepted_residual"):
        lcp.solve([[1.0]], [1.0], method="enumerate", max_pivots=3)


def test_a_start_is_for_methods_that_take_one_and_is_given_once() -> None:
    M, q = [[2, 1], [1, 2]], [-5, -6]
    for call in (lambda **words: lcp.solve(M, q, **words), lambda **words: lcp.solve_batch(M, [q], **words)):
        with pytest.raises(TypeError, match="^start: the method lemke takes none; those that do are robust, lemke_lu, pgs, nlgs$"):
            call(method="lemke", start=[1, 1])
        with pytest.raises(TypeError, match="^start, start_basis: say the same, give one of them$"):
            call(start=[1, 1], start_basis=[1, 1])
        with pytest.raises(TypeError, match="^start, start_z: say the same, give one of them$"):
            call(method="pgs", start=[1, 1], start_z=[1, 1])
        call(start=[1, 1], start_basis=None)
        with pytest.raises(ValueError, match="^start_basis: must be an array of real numbers, got ContactResult$"):
            call(start=lcp.solve_contacts([[0, 1, 0]], [[1, 0, 0]], [1, 1, 1], [0, -1, 0], 0.5))
    with pytest.raises(ValueError, match=r"^start_basis: must have shape \(n,\), got \(1, 2\)$"):
        lcp.solve(M, q, start=lcp.solve_batch(M, [q]))
    shared = lcp.solve_batch(M, [q, q], start=lcp.solve(M, q))
    assert shared.rung.tolist() == ["warm_start", "warm_start"]


@pytest.mark.parametrize("method", lcp.METHODS)
def test_default_settings_are_settings(method: str) -> None:
    M, q, defaults = [[2, 1], [1, 2]], [-5, -6], lcp.default_settings(method)
    assert np.array_equal(lcp.solve(M, q, method, **defaults).z, lcp.solve(M, q, method).z)
    assert np.array_equal(lcp.solve_batch(M, [q], method, **defaults).z, lcp.solve_batch(M, [q], method).z)
    with pytest.raises(TypeError, match="tolerance: is not a setting"):
        lcp.solve(M, q, method, tolerance=None)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"M": np.eye(13), "q": np.ones((3, 13)), "method": "enumerate"}, "q: enumeration takes at most 12 entries"),
        ({"M": np.eye(2), "q": -np.ones((3, 2)), "row_sizes": [1, -1]}, r"row_sizes\[1\]: must be finite and >= 0, got -1"),
        ({"M": np.eye(2), "q": -np.ones((3, 2)), "row_sizes": [1, np.nan]}, r"row_sizes\[1\]: must be finite and >= 0, got nan"),
        ({"M": np.eye(2), "q": -np.ones((3, 2)), "method": "pgs", "start": [1, np.nan]}, "start_z"),
        ({"M": np.eye(2), "q": -np.ones((3, 2)), "start": [0.5, 1]}, "start_basis: must be zeros and ones, got 0.5"),
    ],
)
def test_what_is_wrong_with_every_problem_of_a_batch_is_refused(words: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        lcp.solve_batch(**words)  # type: ignore[arg-type]


def test_row_sizes_of_its_own_touch_one_problem_only() -> None:
    batch = lcp.solve_batch(np.eye(2), -np.ones((2, 2)), row_sizes=[[1, -1], [1, 1]])
    assert batch.status.tolist() == ["bad_input", "solved"]


def test_masks_are_refused_wherever_they_hide() -> None:
    row, masked = np.ma.array([2.0, 1.0], mask=[False, False]), np.ma.array([1.0, 2.0], mask=[True, False])
    lcp.solve([row, [1.0, 2.0]], [-5, -6])
    for M in ([row, masked], (row, masked), [[2.0, 1.0], [np.ma.masked, 2.0]], np.ma.stack([row, masked])):
        with pytest.raises(ValueError, match="^M: must have no masked entry, got 1$"):
            lcp.solve(M, [-5, -6])
        with pytest.raises(ValueError, match="^M: must have no masked entry, got 1$"):
            lcp.solve_batch([M, M], [[-5, -6], [-5, -6]])
        with pytest.raises(ValueError, match=r"^M\[1\]\[0\]: must be a finite number, got masked$"):
            lcp.exact(M, [-5, -6])  # type: ignore[arg-type]
    endless: list[object] = []
    endless.append(endless)
    with pytest.raises(ValueError, match="^M: must"):
        lcp.solve(endless, [-5, -6])  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="^start_basis: must have no masked entry, got 1$"):
        lcp.solve(np.eye(2), [-5, -6], start=np.ma.array([True, True], mask=[True, False]))


def test_results_compare_without_an_error() -> None:
    M, q = [[2, 1], [1, 2]], [-5, -6]
    system = ([[0, 1, 0]], [[1, 0, 0]], [1, 1, 1], [0, -1, 0], 0.5)
    makers = (
        lambda: lcp.solve(M, q),
        lambda: lcp.solve_batch(M, [q]),
        lambda: lcp.exact(M, q),
        lambda: lcp.solution_set(M, q),
        lambda: lcp.solve_contacts(*system),
        lambda: lcp.solve_contacts(*system, motions=True).motions,
        lambda: lcp.solve_one_contacts([1, 1], [0, 0], [1, 1], [-1, -1], [0, 0], [0.5, 0.5]),
    )
    for make in makers:
        one = make()
        assert one == one and one != make() and one in {one}


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda: lcp.all_solutions([[1]], [1], "x"), ValueError, "accepted_residual: must be a number, got 'x'"),
        (lambda: lcp.all_solutions([[1]], [1], None), ValueError, "accepted_residual: must be a number, got None"),
        (lambda: lcp.solve_batch([[1]], [[1]], threads="x"), ValueError, "threads: must be a number, got 'x'"),
        (lambda: lcp.solve_batch([[1]], [[1]], threads=None), ValueError, "threads: must be a number, got None"),
        (lambda: lcp.parse(None), TypeError, "text: must be text, got None"),
        (lambda: lcp.parse("", name=3), TypeError, "name: must be text, got 3"),
        (
            lambda: lcp.solve_contacts([[0, 1, 0]], [[1, 0, 0]], [1, 1, 1], [0, -1, 0], 0.5, motions="all"),
            TypeError,
            "motions: must be True or False, got 'all'",
        ),
    ],
)
def test_a_wrong_type_is_told_in_one_line(call, error: type[Exception], message: str) -> None:
    with pytest.raises(error) as raised:
        call()
    assert str(raised.value) == message


def test_parse_reads_the_text_of_the_command_line() -> None:
    M, q = lcp.parse("M\n2 1 # a comment\n1 2\nq\n-5 -1/2\n")
    assert np.array_equal(M, [[2, 1], [1, 2]]) and np.array_equal(q, [-5, -0.5])


def test_exact_answers_are_fractions() -> None:
    M, q = [["1", "1/3"], [Fraction(1, 3), 2]], ["-0.1", np.int64(-1)]
    found = lcp.exact(M, q)
    assert found.status == "solved" and found.certificate is None and found.basis.tolist() == [False, True]
    assert found.z == [0, Fraction(1, 2)] and found.w == [Fraction(-1, 10) + Fraction(1, 6), 0]
    assert lcp.exact(M, q, found).z == lcp.exact(M, q, [0, 1]).z == found.z


@given(st.integers(0, 10**6), st.integers(1, 6))
@settings(max_examples=50, deadline=None, derandomize=True)
def test_the_basis_of_a_result_gives_its_exact_solution(seed: int, n: int) -> None:
    random = np.random.default_rng(seed)
    root = random.standard_normal((n, n))
    M, q = root @ root.T + np.eye(n), random.standard_normal(n)
    result = lcp.solve(M, q)
    found = lcp.exact(M, q, result)
    assert found.status == "solved" and found.basis.tolist() == result.basis.tolist()
    np.testing.assert_allclose([float(z) for z in found.z], result.z, rtol=1e-9, atol=1e-12)  # condition up to 1e3
    for i in range(n):
        assert found.w[i] == sum(Fraction(M[i, j]) * found.z[j] for j in range(n)) + Fraction(q[i])
        assert found.z[i] * found.w[i] == 0 and min(found.z[i], found.w[i]) >= 0
    assert lcp.exact(M, q).z == found.z  # M is a P-matrix: one solution


def test_exact_proves_that_there_is_no_solution() -> None:
    M, q = [[-1, 2], [-1, -1]], [1, -1]
    found = lcp.exact(M, q)
    y = found.certificate
    assert found.status == "infeasible" and y is not None and found.z == []
    assert min(y) >= 0 and all(sum(M[i][j] * y[i] for i in range(2)) <= 0 for j in range(2))
    assert sum(q[i] * y[i] for i in range(2)) < 0
    assert lcp.exact([[1]], [-1], [0]).status == "no_solution_proved"  # of that basis


@pytest.mark.parametrize(
    ("M", "q", "message"),
    [
        ([[1, "a third"], [1, 2]], [1, 2], r"M\[0\]\[1\]"),
        ([[1, 2], [np.nan, 2]], [1, 2], r"M\[1\]\[0\]: must be a finite number, got nan"),
        ([[1]], [np.inf], r"q\[0\]: must be a finite number, got inf"),
        ([[1]], [None], r"q\[0\]: must be a finite number, got None"),
        ([[1, 2]], [1, 2], r"M: must have shape \(2, 2\)"),
        (["12", "34"], [1, 2], r"M\[0\]: must be a list of numbers, got '12'"),
        ([1, 2], [1, 2], r"M\[0\]: must be a list of numbers, got 1"),
        (3, [1, 2], "M: must be a list of rows, got 3"),
        ([[1]], 1, "q: must be a list of numbers, got 1"),
        ([[1]], "1", "q: must be a list of numbers, got '1'"),
        ([[1]], None, "q: must be a list of numbers, got None"),
        (np.eye(41), np.ones(41), "q: exact arithmetic takes at most"),
    ],
)
def test_exact_names_what_is_no_number(M: object, q: object, message: str) -> None:
    for function in (lcp.exact, lcp.solution_set):
        with pytest.raises(ValueError, match=message):
            function(M, q)  # type: ignore[operator]


def test_the_solution_set_is_exact() -> None:
    points = lcp.solution_set([[-2, -1], [-1, -2]], [1, 1])
    third, half = Fraction(1, 3), Fraction(1, 2)
    assert [vertex.z for vertex in points.vertices] == [[0, 0], [half, 0], [0, half], [third, third]]
    assert points.faces == [lcp.ExactFace([v], []) for v in (0, 2, 1, 3)] and points.rays == []  # 0 first in z_0
    ray = lcp.solution_set([[0, 0], [0, 1]], ["0", "-1/3"])
    assert ray.status == "solved" and [vertex.z for vertex in ray.vertices] == [[0, third]]
    assert ray.rays == [[1, 0]] and ray.faces == [lcp.ExactFace([0], [0])] and ray.certificate is None
    none = lcp.solution_set([[-1, 2], [-1, -1]], [1, -1])
    y = none.certificate
    assert none.status == "infeasible" and none.vertices == [] and y is not None and y[0] - y[1] < 0
    with pytest.raises(ValueError, match="q: exact arithmetic takes at most 12 entries"):
        lcp.solution_set(np.eye(13), np.ones(13))


def test_exact_takes_a_basis_of_zeros_and_ones() -> None:
    with pytest.raises(ValueError, match="basis: must be zeros and ones, got 2"):
        lcp.exact([[1]], [-1], [2])
    with pytest.raises(ValueError, match="basis: must have 1 entries like q, got 2"):
        lcp.exact([[1]], [-1], [0, 1])


def test_a_batch_ends_at_ctrl_c() -> None:
    # A program started in the background ignores Ctrl-C, and the test with it.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        expect_a_batch_to_end_at_ctrl_c()
    finally:
        signal.signal(signal.SIGINT, before)


def expect_a_batch_to_end_at_ctrl_c() -> None:
    M, q = random_contacts(6, 2)
    slow: dict[str, object] = {"method": "lemke_lu", "precision": "quad"}
    seconds_each = math.inf  # at best: another program may hold up any of these
    for _ in range(20):
        begin = time.perf_counter()
        lcp.solve_batch(M[1], np.tile(q[1], (20, 1)), **slow)  # type: ignore[arg-type]
        seconds_each = min(seconds_each, (time.perf_counter() - begin) / 20)
    whole = np.tile(q[1], (int(40.0 / seconds_each), 1))  # takes 20 s on two threads
    timer = threading.Timer(0.5, _thread.interrupt_main)
    timer.start()
    begin = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        lcp.solve_batch(M[1], whole, threads=2, **slow)  # type: ignore[arg-type]
    timer.join()
    assert time.perf_counter() - begin < 5.0
