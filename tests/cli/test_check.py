"""`tumble check` as a user meets it."""

import json
from pathlib import Path

import pytest
from program import ROOT, refuse, succeed, tumble

ODD = """
tumble = 1
title = "Odd"
[[bodies]]
name = "ledge"
kind = "fixed"
shape = { rectangle = [1, 0.5] }
[[bodies]]
name = "box"
shape = { square = 0.5 }
density = 8
position = [0, 0.25]
copies = { count = 9, step = [0.75, 0] }
[[bodies]]
shape = { disc = 0.125 }
mass = 1
position = [0, 2]
velocity = [0, -300]
"""


@pytest.mark.parametrize("scene", sorted(path.name for path in (ROOT / "scenes").glob("*.toml")))
def test_named_scenes_are_in_order(scene: str, tmp_path: Path) -> None:
    assert succeed("check", ROOT / "scenes" / scene, cwd=tmp_path).endswith("\nno warnings\n")


def test_bodies_and_warnings_are_listed(tmp_path: Path) -> None:
    (tmp_path / "odd.toml").write_text(ODD)
    run = tumble("check", "odd.toml", cwd=tmp_path)
    assert run.returncode == 1 and run.stderr == ""
    lines = run.stdout.splitlines()
    assert lines[:2] == ["Odd", "10 dynamic, 0 kinematic, 1 fixed; gravity 0, -9.81 m/s^2; 1 s in steps of 0.001 s"]
    rows = [line.split() for line in lines[4:15]]
    assert rows[0] == ["ledge", "fixed", "1", "0", "0", "0"]
    assert rows[1] == ["box1", "dynamic", "1", "2", "0.083333", "0", "0.25", "0"]  # 8 / 4 kg, m a^2 / 6
    assert rows[10] == ["body10", "dynamic", "1", "1", "0.0078125", "0", "2", "0"]  # m r^2 / 2
    assert lines[16:] == [
        "warning: ledge and box1 overlap by 0.25 m at the start; they will be pushed apart",
        *[f"warning: nothing is below box{i}: it falls for ever" for i in range(2, 7)],
        "         and 3 more of this kind",
        "warning: body10 goes far in one step of 0.001 s; step_size = 6e-05 would follow it better",
    ]


def test_json_has_all_of_it(tmp_path: Path) -> None:
    run = tumble("check", "-", "--json", cwd=tmp_path, stdin=ODD)
    report = json.loads(run.stdout)
    assert run.returncode == 1 and len(report["bodies"]) == 11 and len(report["warnings"]) == 10
    assert report["bodies"][1] == {"name": "box1", "kind": "dynamic", "parts": 1, "mass": 2.0,
                                   "moment_of_inertia": pytest.approx(1 / 12), "position": [0.0, 0.25], "angle": 0.0}
    first = report["warnings"][0]
    assert (first["kind"], first["bodies"], first["depth"]) == ("overlap", ["ledge", "box1"], 0.25)
    assert [warning["kind"] for warning in report["warnings"][1:]] == ["no_support"] * 8 + ["fast"]


def test_quiet_leaves_the_exit_code(tmp_path: Path) -> None:
    run = tumble("check", "-", "--quiet", cwd=tmp_path, stdin=ODD)
    assert (run.returncode, run.stdout, run.stderr) == (1, "", "")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("tumble = 2", "tumble: standard input:1:10: tumble: must be"),
        ("tumble = 1\nduration = -1", "tumble: standard input:2:12: duration: must be in [1e-12, 1000000000000] s, got -1"),
        ("tumble = 1\n[[bodies]]\nshape = { disc = 1 }", "tumble: standard input:2:"),
        ("", "tumble: standard input:1:1: "),
    ],
)
def test_a_bad_file_is_one_line_with_its_place(text: str, message: str, tmp_path: Path) -> None:
    assert refuse("check", "-", cwd=tmp_path, stdin=text).startswith(message)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    assert "cannot read none.toml: No such file" in refuse("check", "none.toml", cwd=tmp_path)
