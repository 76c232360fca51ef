"""The same bits from every compiler, optimisation level and instruction set: hashes of reference runs against golden.txt.

The builds are those of a project that has the library by add_subdirectory, and the one under test. A change of golden.txt
is a change of results and belongs in CHANGELOG.md under "Numerics".
"""

import os
import platform
import shutil
import subprocess
from pathlib import Path

import pytest
from tumble import drop

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("TUMBLE_BUILD", ROOT / "build")).resolve()
PROJECT = ROOT / "tests/install/consumer"
GOLDEN = (Path(__file__).parent / "golden.txt").read_text()

# haswell has fused multiply-add: with it the compiler could contract, and must not. Each build compiles the whole library.
BUILDS = {
    "gcc-O0": ("g++", "-O0"),
    "gcc-O2": ("g++", "-O2"),
    "gcc-O3-haswell": ("g++", "-O3 -march=haswell"),
    "clang-O0": ("clang++-14", "-O0"),
    "clang-O2": ("clang++-14", "-O2"),
    "clang-O3-haswell": ("clang++-14", "-O3 -march=haswell"),
}


def runs_here(flags: str) -> bool:
    return "haswell" not in flags or {"avx2", "fma"} <= set(Path("/proc/cpuinfo").read_text().split())


def printed_by(program: Path) -> str:
    return subprocess.run([str(program)], check=True, capture_output=True, text=True).stdout


def require_own_symbols(build: Path) -> None:
    """A function that several files define inline is taken from whichever of them the linker sees first: from a file that
    was compiled for AVX-512 it would end a program on an older processor."""
    objects = [path for path in build.rglob("*_avx*.o") if "_lanes_" in path.name]
    assert len(objects) == 4 or platform.machine() != "x86_64"
    for path in objects:
        lines = subprocess.run(["nm", "-C", str(path)], check=True, capture_output=True, text=True).stdout.splitlines()
        assert [line for line in lines if line[17] not in "Ttrdb" and "_GLOBAL_OFFSET_TABLE_" not in line] == [], path


@pytest.mark.parametrize("name", BUILDS)
def test_hashes_are_the_golden_ones(name: str) -> None:
    compiler, flags = BUILDS[name]
    build = ROOT / "build-bits" / name
    options = [f"-DTUMBLE_SOURCE_DIR={ROOT}", "-DTUMBLE_BUILD_HASH=ON", f"-DCMAKE_CXX_COMPILER={compiler}"]
    configure = ["cmake", "-S", str(PROJECT), "-B", str(build), "-G", "Ninja", *options, f"-DCMAKE_CXX_FLAGS={flags}"]
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", str(build)], check=True, stdout=subprocess.DEVNULL)
    if "-O0" not in flags:
        require_own_symbols(build)
    if not runs_here(flags):
        pytest.skip("this processor cannot run AVX2 and FMA; the build was checked")
    assert printed_by(build / "tumble/tests/determinism/tumble_hash") == GOLDEN
    q, _ = drop.simulate([0.0, 1.5, 0.5235987755982988], [0.0, -0.2, 0.0])
    assert [float(word) for word in printed_by(build / "consumer").split()] == list(q[:, -1])


def test_hashes_of_this_build_are_the_golden_ones() -> None:
    assert printed_by(BUILD / "tests/determinism/tumble_hash") == GOLDEN
    require_own_symbols(BUILD / "src")


def test_hashes_of_webassembly_are_the_golden_ones() -> None:
    program = ROOT / "build-wasm/tests/determinism/tumble_hash.cjs"
    printed = subprocess.run(["node", str(program)], check=True, capture_output=True, text=True).stdout
    assert printed == GOLDEN


def test_compilers_are_there() -> None:
    assert all(shutil.which(compiler, path=os.environ["PATH"]) for compiler, _ in BUILDS.values())
