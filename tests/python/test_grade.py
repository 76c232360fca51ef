"""The autograder: fair to right solutions of any style, precise about wrong ones, unmoved by broken ones."""

from __future__ import annotations

import csv
import json
import os
import re
import runpy
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from tumble import drop
from tumble.grade import grade_file, grade_folder
from tumble.grade.__main__ import main
from tumble.grade.checks import part_1, part_2, part_3, part_4
from tumble.grade.grading import MAXIMUM, find_submissions
from tumble.grade.parameters import read_parameters
from tumble.grade.report import as_csv, as_json, as_table, as_text
from tumble.grade.states import CORNER_NAMES, contact_mode


SUBMISSIONS = Path(__file__).parent / "submissions" / "correct"
MISTAKES = runpy.run_path(str(SUBMISSIONS.parent / "mistakes.py"))["ALL"]
BROKEN = runpy.run_path(str(SUBMISSIONS.parent / "broken.py"))
IMPORT_FAILURES, SPOILED_PARTS = BROKEN["IMPORT_FAILURES"], BROKEN["SPOILED_PARTS"]
RIGHT = (SUBMISSIONS / "documented_names.py").read_text()
# Enough for the parts that are right, also on a busy machine; parts that never end cost this long.
FEW_SECONDS = 3.0


def changed(*replacements):
    text = RIGHT
    for old, new in replacements:
        assert text.count(old) >= 1, f"{old!r} is not in documented_names.py"
        text = text.replace(old, new)
    return text


def graded(folder, name, text, **options):
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return grade_file(path, **options)


def words(grade):
    return " | ".join(
        [grade.problem, *grade.doubts, *grade.notes, *(m for part in grade.parts for m in [*part.mistakes, *part.notes])]
    )


def points(grade):
    return [part.points for part in grade.parts]


# ---- right solutions ----


@pytest.fixture(scope="module")
def correct():
    return {grade.name: grade for grade in grade_folder(SUBMISSIONS)}


@pytest.mark.parametrize("name", sorted(path.name for path in SUBMISSIONS.glob("*.py")))
def test_right_solutions_get_all_points(correct, name):
    grade = correct[name]
    assert grade.points == MAXIMUM == 100.0, as_text(grade)
    assert all(part.mistakes == [] for part in grade.parts)


def test_other_parameters_are_read_from_the_submission(correct):
    values = {key: entry["value"] for key, entry in correct["params_dict.py"].parameters.items()}
    assert values == {"l": 0.3, "m": 0.7, "mu": 0.5, "eps": 0.2, "dt": 0.005, "delta": 0.002, "g": 9.81}
    assert correct["own_solver.py"].parameters["eps"] == {"value": 0.5, "name": "epsilon"}
    assert "other than the document's: l" in as_text(correct["class_based.py"])


def test_prints_and_plots_are_noted_and_cost_nothing(correct):
    assert any("prints" in note for note in correct["if_else_and_matrix.py"].notes)
    note = " ".join(correct["everything_inline.py"].notes)
    assert "as soon as it is imported" in note and "simulate" in note and "show" in note
    assert correct["documented_names.py"].notes == []


@pytest.mark.parametrize(
    "values",
    [
        {"l": "0.4"},
        {"mu": "0.0"},
        {"mu": "1.0", "eps": "1.0"},
        {"eps": "0.0", "m": "12.5"},
        {"l": "2.0", "m": "0.01", "dt": "0.001", "delta": "0.0"},
        {"l": "0.05", "dt": "0.02", "delta": "0.005"},
    ],
)
def test_right_for_any_parameters(tmp_path, values):
    defaults = {"l": "0.2", "m": "0.3", "mu": "0.3", "eps": "0.5", "dt": "0.01", "delta": "0.001"}
    text = changed(
        *((f"\n{key} = {defaults[key]}\n", f"\n{key} = {value}\n") for key, value in values.items())
    )
    grade = graded(tmp_path, "other.py", text)
    assert grade.points == 100.0, as_text(grade)
    assert grade.parameters["l"]["value"] == float(values.get("l", "0.2"))


# ---- one mistake each ----


@pytest.fixture(scope="module")
def mistaken(tmp_path_factory):
    folder = tmp_path_factory.mktemp("mistakes")
    for mistake in MISTAKES:
        (folder / f"{mistake.name}.py").write_text(changed(*mistake.replacements))
    return {grade.name.removesuffix(".py"): grade for grade in grade_folder(folder)}


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda mistake: mistake.name)
def test_a_mistake_costs_points_in_its_part_and_is_named(mistaken, mistake):
    grade = mistaken[mistake.name]
    lost = [part.number for part in grade.parts if part.points < part.maximum]
    assert lost == [mistake.part], as_text(grade)
    part = grade.parts[mistake.part - 1]
    assert mistake.words in " | ".join(part.mistakes), as_text(grade)
    assert len(part.mistakes) <= mistake.most_messages, as_text(grade)
    assert part.maximum - part.points <= mistake.costs_at_most, as_text(grade)


def test_two_mistakes_in_a_part_are_both_named(tmp_path):
    text = changed(("-r[1, k]", "r[1, k]"), ("phi = q[1] + r[1, k]", "phi = abs(q[1] + r[1, k])"))
    part = graded(tmp_path, "two.py", text).parts[0]
    assert len(part.mistakes) == 2 and 9.0 < part.points < 21.0
    assert any("sign in its third entry" in m for m in part.mistakes) and any(
        "absolute" in m for m in part.mistakes
    )


def test_a_mistake_that_nobody_foresaw_is_shown_with_numbers(tmp_path):
    part = graded(tmp_path, "odd.py", changed(("[mu, -1, -1, 0]", "[2 * mu, -1, -1, 0]"))).parts[1]
    assert part.points == 28.0
    assert "(0.6, -1, -1, 0, 0) instead of (0.3, -1, -1, 0, 0)" in " ".join(part.mistakes)


def test_the_condition_of_a_mistake_is_named(tmp_path):
    text = changed(("phi = q[1] + r[1, k]", "phi = q[1] + r[1, k] + (0.01 if theta < 0 else 0.0)"))
    assert "except where the angle is negative" in words(graded(tmp_path, "negative.py", text))


def test_rounded_constants_are_suspected(tmp_path):
    text = changed(("dt * np.matmul(M_inv, f_e)\n    p", "dt * np.array([0.0, -9.8, 0.0])\n    p"))
    assert "rounded constant" in words(graded(tmp_path, "rounded.py", text))


# ---- broken files ----


@pytest.fixture(scope="module")
def unimportable(tmp_path_factory):
    folder = tmp_path_factory.mktemp("broken")
    for name, (text, _) in IMPORT_FAILURES.items():
        (folder / f"{name}.py").write_bytes(text if isinstance(text, bytes) else text.encode())
    return {grade.name.removesuffix(".py"): grade for grade in grade_folder(folder)}


@pytest.mark.parametrize("name", IMPORT_FAILURES)
def test_a_file_that_cannot_be_imported_gets_0_and_a_line(unimportable, name):
    grade = unimportable[name]
    assert grade.points == 0.0
    assert IMPORT_FAILURES[name][1] in grade.problem
    assert grade.problem.isprintable() and len(grade.problem) < 300
    assert [part.maximum for part in grade.parts] == [30.0, 30.0, 30.0, 10.0]


@pytest.fixture(scope="module")
def spoiled(tmp_path_factory):
    folder = tmp_path_factory.mktemp("spoiled")
    for name, _, replacement, _ in SPOILED_PARTS:
        (folder / f"{name}.py").write_text(changed(replacement))
    return {grade.name.removesuffix(".py"): grade for grade in grade_folder(folder, seconds=FEW_SECONDS)}


@pytest.mark.parametrize(
    ("name", "part", "text"), [(name, part, text) for name, part, _, text in SPOILED_PARTS]
)
def test_a_broken_function_costs_its_part_alone(spoiled, name, part, text):
    grade = spoiled[name]
    expected = [
        0.0 if index + 1 == part else maximum for index, maximum in enumerate((30.0, 30.0, 30.0, 10.0))
    ]
    assert points(grade) == expected, as_text(grade)
    assert text in " ".join(grade.parts[part - 1].mistakes), as_text(grade)


def test_a_crash_in_contact_leaves_the_points_of_free_flight(tmp_path):
    text = changed(("        V, p = form_lcp(J, v)\n", "        import os; os._exit(1)\n"))
    grade = graded(tmp_path, "half.py", text)
    assert 0.0 < grade.parts[2].points < 15.0 and grade.points - grade.parts[2].points == 70.0


def test_an_endless_import_ends(tmp_path):
    start = time.monotonic()
    grade = graded(tmp_path, "loop.py", "while True: pass\n", seconds=1.0)
    assert "does not finish within 1 s" in grade.problem
    assert time.monotonic() - start < 20.0


def test_nothing_is_left_behind(tmp_path, monkeypatch):
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(scratch))
    target = tmp_path / "outside.txt"
    text = changed(
        (
            "def get_contacts(q):\n",
            "def get_contacts(q):\n"
            "    open('inside.txt', 'w').close()\n"
            f"    try: open({str(target)!r}, 'w').close()\n"
            "    except PermissionError: pass\n",
        )
    )
    grade = graded(tmp_path, "files.py", text)
    assert grade.points == 100.0, as_text(grade)
    assert not target.exists() and list(scratch.iterdir()) == []


def test_a_solution_that_asks_tumble_is_noted(tmp_path):
    text = changed(("import numpy as np\n", "import numpy as np\nfrom tumble.drop import step as solved\n"))
    assert "imports tumble" in " ".join(graded(tmp_path, "copied.py", text).doubts)


def test_printing_a_score_changes_nothing(tmp_path, capfd):
    text = changed(("def step(q, v):\n", "def step(q, v):\n    print('{\"points\": 100}'); return q, v\n"))
    grade = graded(tmp_path, "forged.py", text)
    assert grade.parts[2].points < 10.0
    assert capfd.readouterr() == ("", "")


def test_noise_on_the_connection_costs_the_part(tmp_path):
    noise = (
        "    import os\n    for fd in range(3, 64):\n"
        "        try: os.write(fd, b'{\"result\": 1}\\n')\n        except OSError: pass\n"
    )
    grade = graded(tmp_path, "noise.py", changed(("def form_lcp(J, v):\n", "def form_lcp(J, v):\n" + noise)))
    assert grade.parts[1].points == 0.0 and grade.points == 70.0, as_text(grade)
    assert "connection to the grader" in words(grade)


def test_the_environment_of_the_grader_stays_private(tmp_path, monkeypatch):
    monkeypatch.setenv("TUMBLE_TEST_SECRET", "hush")
    text = changed(
        (
            "import numpy as np\n",
            "import os\nimport numpy as np\nif 'TUMBLE_TEST_SECRET' in os.environ: exit()\n",
        )
    )
    assert graded(tmp_path, "curious.py", text).points == 100.0


# ---- deviations of form that one part makes and another takes over ----


@pytest.mark.parametrize(
    ("name", "replacements", "expected"),
    [
        (
            "phi_first",
            [("return J, phi", "return phi, J"), ("J, phi = get_contacts(q)", "phi, J = get_contacts(q)")],
            [29.0, 30.0, 30.0, 10.0],
        ),
        (
            "p_first",
            [("return V, p", "return p, V"), ("V, p = form_lcp", "p, V = form_lcp")],
            [30.0, 29.0, 30.0, 10.0],
        ),
        (
            "v_first",
            [
                ("return q_next, v_next", "return v_next, q_next"),
                ("q[:, k + 1], v[:, k + 1] =", "v[:, k + 1], q[:, k + 1] ="),
            ],
            [30.0, 30.0, 29.0, 10.0],
        ),
        (
            "J_transposed",
            [
                ("np.column_stack([J_t, J_n])", "np.array([J_t, J_n])"),
                ("J_t, J_n = J[:, 0], J[:, 1]", "J_t, J_n = J"),
            ],
            [29.0, 30.0, 30.0, 10.0],
        ),
        (
            "columns_swapped",
            [
                ("column_stack([J_t, J_n])", "column_stack([J_n, J_t])"),
                ("J_t, J_n = J[:, 0], J[:, 1]", "J_n, J_t = J[:, 0], J[:, 1]"),
            ],
            [12.0, 30.0, 30.0, 10.0],
        ),
        (
            "f_t_swapped",
            [
                ("D = np.array([J_n, -J_t, J_t])", "D = np.array([J_n, J_t, -J_t])"),
                ("p[1] = -", "p[1] = "),
                ("p[2] = np", "p[2] = -np"),
                ("- J_t * f_t1 + J_t * f_t2", "+ J_t * f_t1 - J_t * f_t2"),
            ],
            [30.0, 13.3, 30.0, 10.0],
        ),
    ],
)
def test_a_form_taken_over_by_later_parts_costs_points_once(tmp_path, name, replacements, expected):
    grade = graded(tmp_path, f"{name}.py", changed(*replacements))
    assert points(grade) == expected, as_text(grade)


# ---- folders and reports ----


@pytest.fixture(scope="module")
def mixed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("course")
    (folder / "adams.py").write_text(RIGHT)
    (folder / "LCPSolve.py").write_text("raise SystemError\n")
    (folder / "notes.txt").write_text("not a submission\n")
    for name, file, text in (
        ("baker", "assignment_3.py", changed(("phi < delta", "phi <= delta"))),
        ("clark", "assignment_3-2.py", RIGHT),
        ("davis", "report.txt", "I was ill.\n"),
        ("evans", "assignment_3.py", "def (\n"),
    ):
        (folder / name).mkdir()
        (folder / name / file).write_text(text)
        (folder / name / "LCPSolve.py").write_text("raise SystemError\n")
    (folder / ".hidden").mkdir()
    return folder


def test_a_folder_gives_one_row_each(mixed, capsys):
    assert main([str(mixed), "--csv", str(mixed / "out.csv")]) == 0
    rows = capsys.readouterr().out.splitlines()
    assert [row.split()[0] for row in rows] == ["submission", "adams.py", "baker", "clark", "davis", "evans"]
    assert [float(row.split()[1]) for row in rows[1:]] == [100.0, 99.0, 100.0, 0.0, 0.0]
    assert "no assignment_3.py" in rows[4] and "SyntaxError" in rows[5] and "phi == delta" in rows[2]
    table = list(csv.DictReader((mixed / "out.csv").open()))
    assert [row["name"] for row in table] == ["adams.py", "baker", "clark", "davis", "evans"]
    assert table[1]["part_3"] == "29.0" and "phi == delta" in table[1]["mistakes"]
    (mixed / "out.csv").unlink()


def test_a_folder_as_json(mixed, capsys):
    assert main([str(mixed), "--json"]) == 0
    submissions = json.loads(capsys.readouterr().out)["submissions"]
    assert [s["points"] for s in submissions] == [100.0, 99.0, 100.0, 0.0, 0.0]
    assert submissions[0]["problem"] is None and "SyntaxError" in submissions[4]["problem"]


def test_the_folder_that_the_course_writes_has_one_submission(tmp_path):
    from tumble.course import write_assignment

    assert [name for name, _ in find_submissions(write_assignment(tmp_path / "new"))] == ["assignment_3.py"]


def test_json_of_one_file(tmp_path, capsys):
    path = tmp_path / "assignment_3.py"
    path.write_text(RIGHT)
    assert main([str(path), "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert (report["points"], report["maximum"], report["problem"]) == (100.0, 100.0, None)
    assert [part["maximum"] for part in report["parts"]] == [30.0, 30.0, 30.0, 10.0]
    for part in report["parts"]:
        assert sum(item["maximum"] for item in part["items"]) == part["maximum"]
        assert all(item["passed"] == item["total"] > 0 for item in part["items"])


@pytest.mark.parametrize(
    "arguments", [["nowhere.py"], ["empty_folder"], [os.devnull], ["x.py", "--seconds", "0"]]
)
def test_bad_input_ends_with_2_and_one_line(tmp_path, monkeypatch, capsys, arguments):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty_folder").mkdir()
    (tmp_path / "x.py").write_text(RIGHT)
    assert main(arguments) == 2
    error = capsys.readouterr().err
    assert error.startswith("tumble.grade: ") and error.count("\n") == 1


def test_the_command_is_quick(tmp_path):
    path = tmp_path / "assignment_3.py"
    path.write_text(RIGHT)
    start = time.monotonic()
    result = subprocess.run(
        [sys.executable, "-m", "tumble.grade", str(path)], capture_output=True, text=True, check=False
    )
    assert result.returncode == 0 and result.stdout.startswith(
        "assignment_3.py: 100 of 100 points\n"
    ), result.stderr
    assert time.monotonic() - start < 20.0, "a few seconds, with room for a busy machine"


def test_reports_of_a_broken_submission(unimportable):
    grade = unimportable["syntax"]
    assert as_text(grade).splitlines()[0] == "syntax.py: 0 of 100 points"
    assert len(as_table([grade]).splitlines()) == 2 and as_csv([grade]).count("\n") == 2
    assert as_json(grade)["parts"][0]["points"] == 0.0


def test_a_grader_that_cannot_work_blames_nobody(tmp_path, monkeypatch, capsys):
    (tmp_path / "x.py").write_text(RIGHT)
    monkeypatch.setattr(
        "tumble.grade.sandbox._environment", lambda scratch, cache: {"PYTHONPATH": str(tmp_path)}
    )
    assert main([str(tmp_path / "x.py")]) == 1
    assert "the process for student code does not start" in capsys.readouterr().err


# ---- the states and the parameters ----


def test_states_cover_what_can_happen():
    params = drop.Parameters()
    tags = {tag for case in part_1.cases(params) for tag in case.tags}
    assert tags >= {f"corner {name} of the body is the lowest" for name in CORNER_NAMES}
    assert tags >= {
        "the angle is negative",
        "the angle is more than one turn",
        "the corner is below the ground",
    }
    contact = [case for case in part_3.cases(params) if case.data["kind"] == "contact"]
    seen = {(case.tags[1], contact_mode(*case.arguments, params)) for case in contact}
    assert len(seen) == 4 * len(("opens", "sticks", "slides left", "slides right"))
    distances = [drop.get_contacts(case.arguments[0])[1] for case in contact]
    assert min(distances) < 0.0 and 0.0 < max(distances) < params.delta
    assert any(case.phi == params.delta for case in part_3.cases(params))


@pytest.mark.parametrize("part", [part_1, part_2, part_3, part_4])
def test_states_are_the_same_every_time_and_nothing_wrong_is_right(part):
    params = drop.Parameters()
    first, second = part.cases(params), part.cases(params)
    for a, b in zip(first, second, strict=True):
        assert all(
            np.array_equal(x, y) for x, y in zip(a.arguments + a.truth, b.arguments + b.truth, strict=True)
        )
    for variant in part.variants(params):
        outputs = [variant.solve(case) for case in first]
        assert any(
            not all(np.allclose(x, y, rtol=1e-9, atol=1e-12) for x, y in zip(case.truth, output, strict=True))
            for case, output in zip(first, outputs, strict=True)
        ), variant.message


@pytest.mark.parametrize(
    ("namespace", "key", "value", "name"),
    [
        ({"L": 0.4}, "l", 0.4, "L"),
        ({"l": 0.4, "L": 0.2}, "l", 0.2, "L"),
        ({"M": 0.5}, "m", 0.5, "M"),
        ({"M": np.eye(3), "mass": 0.5}, "m", 0.5, "mass"),
        ({"e": 2.718281828459045}, "eps", 0.5, None),
        ({"eps": 2.2e-16, "restitution": 0.7}, "eps", 0.7, "restitution"),
        ({"g": -9.8}, "g", 9.8, "g"),
        ({"g": np.array([[0.0], [-9.7], [0.0]])}, "g", 9.7, "g"),
        ({"G": [0, -9.6]}, "g", 9.6, "G"),
        ({"g": np.zeros(3)}, "g", 9.81, None),
        ({"dt": True}, "dt", 0.01, None),
        ({"dt": "0.02"}, "dt", 0.01, None),
        ({"DELTA": float("nan")}, "delta", 0.001, None),
        ({"cfg": {"l": 0.3, "m": 1.0, "mu": 0.1}}, "mu", 0.1, "mu"),
        ({"only_one": {"mu": 0.1}}, "mu", 0.3, None),
    ],
)
def test_parameters_are_found_under_many_names(namespace, key, value, name):
    assert read_parameters(namespace)[key] == {"value": value, "name": name}


def test_a_submission_that_deletes_its_folder_is_graded(tmp_path):
    path = tmp_path / "assignment_3.py"
    course_style = (SUBMISSIONS / "course_style.py").read_text()
    path.write_text("import os, shutil\nshutil.rmtree(os.getcwd())\n" + course_style)
    grade = grade_file(path)
    assert grade.problem is None or "No such file" not in grade.problem


@pytest.mark.parametrize("name", ["mu", "eps", "delta"])
def test_a_parameter_of_zero_is_said_to_hide_mistakes(tmp_path, name):
    path = tmp_path / "assignment_3.py"
    text = (SUBMISSIONS / "documented_names.py").read_text()
    path.write_text(re.sub(rf"(?m)^{name} = .*$", f"{name} = 0.0", text))
    assert f"{name} = 0.0" in path.read_text()
    assert any(f"{name} = 0 in this file" in doubt for doubt in grade_file(path).doubts)


def test_doubts_stand_in_the_table(tmp_path):
    (tmp_path / "a.py").write_text(changed(("\nmu = 0.3\n", "\nmu = 0\n")))
    grades = grade_folder(tmp_path)
    assert "doubt: mu = 0 in this file" in as_table(grades).splitlines()[1]
    assert "mu = 0 in this file" in next(csv.DictReader(as_csv(grades).splitlines()))["doubts"]
    assert "mu = 0 in this file" in as_json(grades[0])["doubts"][0]


# ---- numbers of single precision, and none ----

SINGLE = {
    "contacts": (("    return J, phi", "    return J.astype(np.float32), np.float32(phi)"),),
    "contacts_inside": (("    theta = q[2]", "    q = np.float32(q); theta = q[2]"),),
    "lcp": (("    return V, p", "    return np.float32(V), np.float32(p)"),),
    "step": (("    return q_next, v_next", "    return np.float32(q_next), np.float32(v_next)"),),
    "simulate": (("zeros((3, num_columns))", "zeros((3, num_columns), dtype=np.float32)"),),
}


@pytest.mark.parametrize("name", SINGLE)
def test_single_precision_is_named_and_costs_nothing(tmp_path, name):
    grade = graded(tmp_path, f"{name}.py", changed(*SINGLE[name]))
    assert grade.points == 100.0, as_text(grade)
    assert sum("single precision" in note for part in grade.parts for note in part.notes) == 1


def test_a_mistake_in_single_precision_is_named_as_without(tmp_path):
    text = changed(*SINGLE["contacts"], ("-r[1, k]", "r[1, k]"))
    part = graded(tmp_path, "both.py", text).parts[0]
    assert part.points == 21.0 and len(part.mistakes) == 1 and "J_t has the wrong sign" in part.mistakes[0]


@pytest.mark.parametrize(
    ("part", "result"),
    [(1, "    return J, phi"), (2, "    return V, p"), (3, "    return q_next, v_next"), (4, "    return q, v\n")],
)
def test_nan_gets_no_points_and_one_line(tmp_path, part, result):
    a, b = result.strip().removeprefix("return ").split(", ")
    grade = graded(tmp_path, "nan.py", changed((result, f"    return {a} * np.nan, {b} * np.nan\n")))
    assert [p.number for p in grade.parts if p.points < p.maximum] == [part]
    assert grade.parts[part - 1].points == 0.0
    (mistake,) = grade.parts[part - 1].mistakes
    assert mistake.startswith("returns nan or infinity in ")


def test_odd_file_names_do_not_cost_the_table(tmp_path):
    folder = tmp_path / "all"
    folder.mkdir()
    text = (SUBMISSIONS / "course_style.py").read_bytes()
    (folder / os.fsdecode(b"b\xff.py")).write_bytes(text)
    command = [sys.executable, "-m", "tumble.grade", str(folder), "--csv", str(tmp_path / "out.csv")]
    run = subprocess.run(command, capture_output=True)
    assert run.returncode == 0 and b"100" in run.stdout, run.stderr
    assert "100" in (tmp_path / "out.csv").read_text()
