"""Builds the compiled module with CMake. Everything else is in pyproject.toml; the version is in CMakeLists.txt."""

import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, extension: Extension) -> None:
        target = Path(self.get_ext_fullpath(extension.name)).resolve()
        build = Path(self.build_temp).resolve()
        build.mkdir(parents=True, exist_ok=True)
        off = [f"-DTUMBLE_BUILD_{part}=OFF" for part in ("OUTPUT", "CLI", "TESTS")]
        python = f"-DPython_EXECUTABLE={sys.executable}"
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", python, "-DTUMBLE_BUILD_PYTHON=ON", *off], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "tumble_python"], check=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(next((build / "python/tumble").glob("_core*.so"))), str(target))


version = re.search(r"project\(tumble VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
assert version, "CMakeLists.txt: no project version"
setup(version=version[1], ext_modules=[Extension("tumble._core", [])], cmdclass={"build_ext": CMakeBuild})
