"""The files to hand out: what `python3 -m tumble.course new` writes, and what the helper files compute and draw."""

from __future__ import annotations

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from tumble import course, drop, lcp
from tumble.course.__main__ import main

SUBMISSIONS = Path(__file__).parent / "submissions" / "correct"
START = np.array([0.0, 1.5, np.pi / 6]), np.array([0.0, -0.2, 0.0])
# Both sides round differently; over the bounces of this trajectory a difference of 1e-16 grows to 1e-13.
SAME_TRAJECTORY = 1e-10


def load_helper(name):
    """A helper file as a module, without making its folder a place for imports."""
    spec = importlib.util.spec_from_file_location(name, course.template_path(f"{name}.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


LCPSolve = load_helper("LCPSolve").LCPSolve


@pytest.fixture
def folder(tmp_path):
    assert main(["new", str(tmp_path / "new")]) == 0
    return tmp_path / "new"


def run_python(folder, code, **environment):
    """Run code where tumble is not to be found, as on a student's machine."""
    return subprocess.run(
        [sys.executable, "-c", code],
        cwd=folder,
        env={"PATH": os.defpath, "HOME": str(folder), "OPENBLAS_NUM_THREADS": "1", **environment},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


def trajectory_of(folder):
    code = (
        "import sys, numpy as np, assignment_3 as a\n"
        "q, v = a.simulate(np.array([0.0, 1.5, np.pi / 6]), np.array([0.0, -0.2, 0.0]))\n"
        "np.save('q.npy', q); np.save('v.npy', v)"
    )
    result = run_python(folder, code)
    assert result.returncode == 0, result.stderr
    return np.load(folder / "q.npy"), np.load(folder / "v.npy")


def test_writes_all_files_and_nothing_else(folder):
    assert sorted(path.name for path in folder.iterdir()) == sorted(course.FILES)
    assert sorted(path.name for path in folder.parent.iterdir()) == ["new"]
    assert (folder.stat().st_mode & 0o777) == 0o777 & ~current_umask()


def current_umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def test_creates_parents_and_fills_an_empty_folder(tmp_path):
    (tmp_path / "a").mkdir()
    assert main(["new", str(tmp_path / "a")]) == 0
    assert main(["new", str(tmp_path / "b" / "c")]) == 0
    assert (tmp_path / "a" / "handout.md").is_file() and (tmp_path / "b" / "c" / "handout.md").is_file()


def test_refuses_a_folder_with_files(folder, capsys):
    (folder / "assignment_3.py").write_text("work of a night\n")
    assert main(["new", str(folder)]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1 and str(folder) in error and "not empty" in error
    assert (folder / "assignment_3.py").read_text() == "work of a night\n"


def test_force_replaces_its_files_and_keeps_others(folder):
    (folder / "assignment_3.py").write_text("old\n")
    (folder / "notes.txt").write_text("mine\n")
    assert main(["new", str(folder), "--force"]) == 0
    assert "def get_contacts" in (folder / "assignment_3.py").read_text()
    assert (folder / "notes.txt").read_text() == "mine\n"
    assert sorted(path.name for path in folder.iterdir()) == sorted([*course.FILES, "notes.txt"])


@pytest.mark.parametrize("side", ["0", "-0.4", "nan", "inf"])
def test_refuses_a_bad_side(tmp_path, capsys, side):
    assert main(["new", str(tmp_path / "new"), f"--side={side}"]) == 2
    assert "side: must be a number > 0" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("arguments", [["new"], [], ["new", "x", "--side", "wide"], ["old", "x"]])
def test_bad_arguments_end_with_2(arguments):
    with pytest.raises(SystemExit) as end:
        main(arguments)
    assert end.value.code == 2


def test_refuses_a_file_as_folder(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert main(["new", str(tmp_path / "file")]) == 2
    assert "is a file" in capsys.readouterr().err


def test_side_reaches_every_file_that_names_it(tmp_path):
    course.write_assignment(tmp_path / "new", side=0.4)
    for name in ("assignment_3.py", "assignment_3_render.py", "handout.md"):
        text = (tmp_path / "new" / name).read_text()
        assert "l = 0.4" in text and "l = 0.2" not in text


def test_a_failure_leaves_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(shutil, "copyfile", lambda *_: (_ for _ in ()).throw(OSError("disk full")))
    assert main(["new", str(tmp_path / "new")]) == 2
    assert list(tmp_path.iterdir()) == []


def test_template_has_the_documented_parameters_and_blanks(folder):
    code = (
        "import assignment_3 as a, numpy as np\n"
        "print(a.l, a.m, a.mu, a.eps, a.dt, a.delta, a.g[1], a.num_columns, np.diag(a.M)[2])\n"
        "for f, n in ((a.get_contacts, 1), (a.form_lcp, 2), (a.step, 2), (a.simulate, 2)):\n"
        "    try: f(*[np.zeros(3)] * n)\n"
        "    except NotImplementedError as error: print(error)\n"
        "print(a.solve_LCP(np.eye(4), -np.arange(4.0)))"
    )
    lines = run_python(folder, code).stdout.splitlines()
    assert lines[0].split()[:8] == ["0.2", "0.3", "0.3", "0.5", "0.01", "0.001", "-9.81", "150"]
    assert float(lines[0].split()[8]) == pytest.approx(0.3 * 0.2**2 / 6, rel=1e-15)
    assert lines[1:5] == [f"part {k} is still blank" for k in (1, 2, 3, 4)]
    assert lines[5] == "[0. 1. 2.]"


def test_solve_lcp_of_the_template_says_when_there_is_no_solution(folder):
    result = run_python(folder, "import assignment_3 as a, numpy as np; a.solve_LCP(-np.eye(4), -np.ones(4))")
    assert "no solution found" in result.stderr


@pytest.mark.parametrize("style", ["course_style", "documented_names", "plain_lists", "if_else_and_matrix"])
def test_a_solution_runs_unmodified_and_agrees_with_tumble(folder, style):
    shutil.copyfile(SUBMISSIONS / f"{style}.py", folder / "assignment_3.py")
    q, v = trajectory_of(folder)
    expected_q, expected_v = drop.simulate(*START)
    assert np.shape(q) == (3, 150)
    np.testing.assert_allclose(q, expected_q, rtol=0, atol=SAME_TRAJECTORY)
    np.testing.assert_allclose(v, expected_v, rtol=0, atol=SAME_TRAJECTORY)


def test_a_solution_agrees_with_tumble_for_the_side_of_later_editions(tmp_path):
    course.write_assignment(tmp_path / "new", side=0.4)
    text = (SUBMISSIONS / "course_style.py").read_text()
    (tmp_path / "new" / "assignment_3.py").write_text(text.replace("L = 0.2", "L = 0.4"))
    q, _ = trajectory_of(tmp_path / "new")
    np.testing.assert_allclose(
        q, drop.simulate(*START, drop.Parameters(l=0.4))[0], rtol=0, atol=SAME_TRAJECTORY
    )


def test_the_helper_module_has_all_names(folder):
    code = "from assignment_3_helper import LCPSolve, assignment_3_render, render; print(render is assignment_3_render)"
    assert run_python(folder, code).stdout == "True\n"


def test_render_without_a_display_writes_a_film_beside_the_script(folder):
    code = "import numpy as np; from assignment_3_render import render; render(np.array([[0, 1], [1, 0.1], [0, 0.5]]))"
    result = run_python(folder, code)
    assert "trajectory.gif" in result.stdout, result.stderr
    film = (folder / "trajectory.gif").read_bytes()
    assert film[:6] == b"GIF89a"
    assert film.count(b"\x21\xf9\x04") >= 2, "one graphic control block for each frame"


@pytest.mark.parametrize(
    "bad", ["np.zeros((4, 5))", "np.zeros(3)", "np.full((3, 2), np.nan)", "np.zeros((3, 0))"]
)
def test_render_names_a_bad_trajectory(folder, bad):
    result = run_python(folder, f"import numpy as np; from assignment_3_render import render; render({bad})")
    assert re.search(r"ValueError: traj: (shape must be|every entry)", result.stderr)


class TestLCPSolve:
    """LCPs of contacts, and small ones of integers, where ties are common."""

    # Relative, as tumble.lcp defines it: round-off of a few pivots.
    RESIDUAL = 1e-11

    def test_return_values(self):
        w, z, code = LCPSolve([[2.0, 1.0], [1.0, 2.0]], [-5.0, -6.0])
        np.testing.assert_allclose(z, [4 / 3, 7 / 3], rtol=1e-14)
        np.testing.assert_allclose(w, 0.0, atol=1e-14)
        assert (w.shape, z.shape, len(code)) == ((2,), (2,), 3)
        assert code[0] == 1 and code[1] == 0.0 and code[2] >= 2

    def test_nothing_to_do(self):
        w, z, code = LCPSolve(np.eye(2), np.array([[1.0], [0.0]]))
        assert w.tolist() == [1.0, 0.0] and z.tolist() == [0.0, 0.0] and code == (1, 0.0, 0)

    def test_a_ray(self):
        _, _, (code, z0, _) = LCPSolve(-np.eye(2), [-1.0, -1.0])
        assert code == 2 and z0 > 0.0

    def test_arguments_stay_as_they_are(self):
        M, q = np.array([[2.0, 1.0], [1.0, 2.0]]), np.array([-5.0, -6.0])
        LCPSolve(M, q)
        assert M.tolist() == [[2.0, 1.0], [1.0, 2.0]] and q.tolist() == [-5.0, -6.0]

    @pytest.mark.parametrize(("M", "q"), [(np.eye(3), [1.0]), (np.eye(2), [np.nan, 1.0])])
    def test_bad_input(self, M, q):
        with pytest.raises(ValueError, match="must be"):
            LCPSolve(M, q)

    def test_contacts_of_every_size(self):
        generator = np.random.default_rng(1)
        for k in range(1500):
            params = drop.Parameters(
                l=10 ** generator.uniform(-2, 1),
                m=10 ** generator.uniform(-2, 2),
                mu=generator.choice([0.0, 0.1, 0.3, 1.0, 3.0]),
                eps=generator.uniform(0, 1),
                dt=10 ** generator.uniform(-4, -1),
            )
            angle = generator.uniform(-10, 10) if k % 2 else np.pi / 4 * generator.integers(-8, 9)
            v = generator.choice([0.0, 1.0, 10.0]) * generator.normal(size=3)
            J, _ = drop.get_contacts([0.0, 0.1, angle], params)
            V, p = drop.form_lcp(J, v, params)
            _, z, code = LCPSolve(V, p)
            assert code[0] == 1, (params.asdict(), angle, v)
            speed = max(abs(p))  # idle rows hold nothing but the round-off of the others
            assert lcp.residual(V, p, z, [speed, speed, speed, speed / V[0, 0]]).largest < 1e-11

    def test_degenerate_problems_of_integers(self):
        generator = np.random.default_rng(2)
        solved = 0
        for _ in range(600):
            n = generator.integers(1, 7)
            A = generator.integers(-2, 3, (n, n)).astype(float)
            q = generator.integers(-3, 4, n).astype(float)
            _, z, code = LCPSolve(A @ A.T, q)
            exists = lcp.solve(A @ A.T, q, "enumerate").status == "solved"
            assert (code[0] == 1) == exists, (A, q)
            if exists:
                solved += 1
                assert lcp.residual(A @ A.T, q, z).largest < self.RESIDUAL
        assert 100 < solved < 600, "the test must see both outcomes"
