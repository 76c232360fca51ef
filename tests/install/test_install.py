"""The library as others take it: find_package, pkg-config, and the Python package by pip.

By add_subdirectory it is built in tests/determinism.
"""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from tumble import drop

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("TUMBLE_BUILD", ROOT / "build")).resolve()
CONSUMER = ROOT / "tests/install/consumer"
COURSE_START = ([0.0, 1.5, 0.5235987755982988], [0.0, -0.2, 0.0])


def run(*command: object, **options: object) -> str:
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def check_output(printed: str) -> None:
    q, _ = drop.simulate(*COURSE_START)
    assert [float(word) for word in printed.split()] == list(q[:, -1])  # to the bit


@pytest.fixture(scope="module")
def prefix(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("prefix")
    run("cmake", "--install", BUILD, "--prefix", folder)
    return folder


def test_find_package(prefix: Path, tmp_path: Path) -> None:
    run("cmake", "-S", CONSUMER, "-B", tmp_path, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", tmp_path)
    check_output(run(tmp_path / "consumer"))
    files = [tmp_path / f"drop.{ending}" for ending in ("csv", "npz", "h5", "png", "svg", "gif")]
    run(tmp_path / "output_consumer", *files)
    q, _ = drop.simulate(*COURSE_START)
    assert np.array_equal(np.load(tmp_path / "drop.npz")["q"], q)
    assert all(file.stat().st_size > 1000 for file in files)


def test_find_package_without_cairo_gives_the_core(prefix: Path, tmp_path: Path) -> None:
    """A machine without the libraries of tumble::output: the core is found, the component is not."""
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\n"
        "find_package(tumble REQUIRED)\nif(NOT TARGET tumble::tumble OR TARGET tumble::output)\n"
        "  message(FATAL_ERROR wrong)\nendif()\n"
        "find_package(tumble COMPONENTS output)\nif(tumble_FOUND)\n  message(FATAL_ERROR wrong)\nendif()\n"
    )
    run(
        *("cmake", "-S", tmp_path, "-B", tmp_path / "build", f"-DCMAKE_PREFIX_PATH={prefix}"),
        "-DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON",
    )


def test_find_package_refuses_another_minor_version(prefix: Path, tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\nfind_package(tumble 0.99 REQUIRED)\n"
    )
    command = ["cmake", "-S", tmp_path, "-B", tmp_path / "build", f"-DCMAKE_PREFIX_PATH={prefix}"]
    assert subprocess.run([str(word) for word in command], capture_output=True).returncode != 0


def test_pkg_config(prefix: Path, tmp_path: Path) -> None:
    folder = next(prefix.rglob("pkgconfig"))
    flags = run("pkg-config", "--cflags", "--libs", "tumble", env={**os.environ, "PKG_CONFIG_PATH": str(folder)}).split()
    run("g++", "-std=c++20", CONSUMER / "consumer.cpp", *flags, "-o", tmp_path / "consumer")
    check_output(run(tmp_path / "consumer"))


def test_the_page_is_installed_if_it_was_built(prefix: Path) -> None:
    page = Path("share/tumble/tumble.html")
    assert (prefix / page).is_file() == (BUILD / page).is_file()


def test_installed_program_runs(prefix: Path) -> None:
    assert run(prefix / "bin/tumble", "--version").startswith("tumble ")


def test_pip_install_in_a_virtual_environment(tmp_path: Path) -> None:
    environment = tmp_path / "venv"
    run(sys.executable, "-m", "venv", "--system-site-packages", environment)
    python = environment / "bin/python"
    clean = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    clean["CMAKE_BUILD_TYPE"] = "Debug"  # without optimisation, which takes longer than everything else in this file
    run(python, "-m", "pip", "install", "--no-build-isolation", "--no-index", "--no-deps", ROOT, env=clean)
    code = (
        "import tumble, tumble.course, tumble.grade, tumble.sweep\n"
        "from tumble.drop import simulate\n"
        f"q, v = simulate(*{COURSE_START!r})\n"
        "ball = tumble.Scene(duration=0.01)\nball.add_body(tumble.disc(0.1), mass=1)\n"
        "tumble.simulate(ball).save('ball.csv')\n"
        "assert len(tumble.sweep.run({'samples': 10, 'start': {'theta': {'uniform': [0, 1]}}})) == 10\n"
        "print(tumble.__file__)\nprint(*map(repr, map(float, q[:, -1])))\n"
    )
    where, numbers = run(python, "-c", code, env=clean, cwd=tmp_path).strip().splitlines()
    assert where.startswith(str(environment))
    assert Path(where).with_name("tumble.html").is_file() == (ROOT / "build/python/tumble/tumble.html").is_file()
    check_output(numbers)
    help_text = run(python, "-m", "tumble.course", "--help", env=clean, cwd=tmp_path)
    assert "new" in help_text
    run(python, "-m", "tumble.course", "new", tmp_path / "assignment", env=clean, cwd=tmp_path)  # the templates are there
    assert np.isfinite(q_of(numbers)).all()


def q_of(numbers: str) -> np.ndarray:
    return np.array([float(word) for word in numbers.split()])
