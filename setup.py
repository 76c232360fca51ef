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
        options = [f"-DPython_EXECUTABLE={sys.executable}", "-DTUMBLE_BUILD_PYTHON=ON", "-DTUMBLE_BUILD_CLI=OFF"]
        configure = ["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", *options]
        targets = ["tumble_python", "tumble_python_output", "tumble_python_sweep"]
        if subprocess.run([*configure, "-DTUMBLE_BUILD_OUTPUT=ON"]).returncode != 0:
            print("tumble: built without cairo, giflib or zlib, so that Trajectory.save and tumble.sweep will not work", file=sys.stderr)
            subprocess.run([*configure, "-DTUMBLE_BUILD_OUTPUT=OFF"], check=True)
            targets = targets[:1]
        subprocess.run(["cmake", "--build", build, "--target", *targets], check=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        for module in (build / "python/tumble").glob("*.so"):
            self.copy_file(str(module), str(target.parent / module.name))
        page = ROOT / "build/python/tumble/tumble.html"  # there once `make viewer` has built it
        if page.is_file():
            self.copy_file(str(page), str(target.parent / page.name))


version = re.search(r"project\(tumble VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
assert version, "CMakeLists.txt: no project version"
setup(version=version[1], ext_modules=[Extension("tumble._core", [])], cmdclass={"build_ext": CMakeBuild})
