"""The same bits from every compiler, optimisation level and instruction set: hashes of reference runs against golden.txt.

A change of golden.txt is a change of results and belongs in CHANGELOG.md under "Numerics".
"""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
GOLDEN = (Path(__file__).parent / "golden.txt").read_text()

# haswell has fused multiply-add: with it the compiler could contract, and must not.
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


@pytest.mark.parametrize("name", BUILDS)
def test_hashes_are_the_golden_ones(name: str) -> None:
    compiler, flags = BUILDS[name]
    build = ROOT / "build-hash" / name
    off = [f"-DTUMBLE_BUILD_{part}=OFF" for part in ("OUTPUT", "CLI", "PYTHON", "TESTS")]
    options = [f"-DCMAKE_CXX_COMPILER={compiler}", "-DCMAKE_BUILD_TYPE=None", f"-DCMAKE_CXX_FLAGS={flags}"]
    configure = ["cmake", "-S", str(ROOT), "-B", str(build), "-G", "Ninja", "-DTUMBLE_BUILD_HASH=ON", *off, *options]
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", str(build)], check=True, stdout=subprocess.DEVNULL)
    if not runs_here(flags):
        pytest.skip("this processor cannot run AVX2 and FMA; the build was checked")
    printed = subprocess.run([str(build / "tests/determinism/tumble_hash")], check=True, capture_output=True, text=True)
    assert printed.stdout == GOLDEN


def test_compilers_are_there() -> None:
    assert all(shutil.which(compiler, path=os.environ["PATH"]) for compiler, _ in BUILDS.values())
