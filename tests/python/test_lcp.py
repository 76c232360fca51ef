"""tumble.lcp: solvers for any linear complementarity problem, from Python."""

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
        np.testing.assert_allclose(result.z, [4 / 3, 7 / 3], rtol=1e-15)
        assert result.status == "solved" and result.residual < 1e-15 and result.pivots > 0
        assert np.array_equal(result.w, M @ result.z + q) and result.basis.tolist() == [True, True]


def test_all_solutions_lists_each_once() -> None:
    solutions = lcp.all_solutions([[-2, -1], [-1, -2]], [1, 1])
    found = sorted(tuple(np.round(s.z, 12)) for s in solutions)
    assert found == [(0, 0), (0, 0.5), (0.333333333333, 0.333333333333), (0.5, 0)]
    assert lcp.all_solutions([[-1]], [-1]) == []


def test_no_solution_is_an_outcome() -> None:
    assert lcp.solve([[-1.0]], [-1.0]).status == "ray_unproven"
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
def test_lemke_solves_every_problem_with_a_definite_matrix(data) -> None:
    result = lcp.solve(data[:5] @ data[:5].T + 0.1 * np.eye(5), data[5])
    assert result.status == "solved" and is_solution(result)


@given(matrices(0.0))
@settings(max_examples=300, deadline=None, derandomize=True)
def test_solved_is_never_said_of_a_wrong_vector(data) -> None:
    """Entries down to 1e-308 beside others of order 1: an answer may be missed, but not invented."""
    result = lcp.solve(data[:5] @ data[:5].T + 0.1 * np.eye(5), data[5])
    assert result.status != "solved" or is_solution(result)


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
        (lambda: lcp.solve([[1.0]], [1.0], method="simplex"), "method: must be one of lemke, enumerate, got 'simplex'"),
        (lambda: lcp.solve([[1.0]], [1.0], pivot_tolerance=2.0), r"pivot_tolerance: must be in \[0, 1\), got 2"),
        (lambda: lcp.solve([[1.0]], [1.0], accepted_residual=np.inf), r"accepted_residual: must be in \(0, 0.01\], got inf"),
        (lambda: lcp.all_solutions(np.eye(13), np.ones(13)), "at most 12 entries"),
        (lambda: lcp.residual([[1.0]], [1.0], [1.0, 2.0]), "z: must have 1 entries like q, got 2"),
        (lambda: lcp.parse("M\n1 x\n", name="here"), "here:2:3: expected a number"),
    ],
)
def test_bad_input_is_a_value_error_that_names_it(call, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()


def test_unknown_settings_are_type_errors() -> None:
    with pytest.raises(TypeError):
        lcp.solve([[1.0]], [1.0], tolerance=1.0)
    with pytest.raises(TypeError):
        lcp.solve([[1.0]], [1.0], method="enumerate", max_pivots=3)


def test_parse_reads_the_text_of_the_command_line() -> None:
    M, q = lcp.parse("M\n2 1 # a comment\n1 2\nq\n-5 -1/2\n")
    assert np.array_equal(M, [[2, 1], [1, 2]]) and np.array_equal(q, [-5, -0.5])
