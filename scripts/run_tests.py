"""Run all tests of a build: C++ by CTest, Python and program by pytest, page by vitest. The last line is "N passed, N failed" (", N skipped").

    python3 scripts/run_tests.py --build build
"""

import argparse
import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# The longest first: a process of pytest takes the next file when it is done with one.
FOLDERS = ("tests/determinism", "tests/install", "tests/python", "tests/cli")


def count(report: Path) -> tuple[int, int, int]:
    """(passed, failed, skipped) of a JUnit file; one failure if there is none, since then the runner has died."""
    if not report.exists():
        return 0, 1, 0
    cases = list(ElementTree.parse(report).getroot().iter("testcase"))
    skipped = sum(case.find("skipped") is not None for case in cases)
    failed = sum(case.find("failure") is not None or case.find("error") is not None for case in cases)
    return len(cases) - failed - skipped, failed, skipped


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build")
    build = parser.parse_args().build.resolve()
    reports = [build / "ctest.xml", build / "pytest.xml", build / "vitest.xml"]
    for report in reports:
        report.unlink(missing_ok=True)
    environment = {
        **os.environ,
        "TUMBLE_BUILD": str(build),
        "PYTHONPATH": str(build / "python"),
        "PYTHONDONTWRITEBYTECODE": "1",
        "MPLBACKEND": "Agg",
    }
    ctest = ["ctest", "--test-dir", str(build), "--output-on-failure", "-j", "2", "--output-junit", str(reports[0])]
    # A file stays in one process, so that what its tests share is made once.
    two_processes = ["-n", "2", "--dist", "loadfile"]
    pytest = [sys.executable, "-m", "pytest", "-q", *two_processes, f"--junit-xml={reports[1]}", *FOLDERS]
    vitest = ["npx", "--no-install", "vitest", "run", "--reporter=default", "--reporter=junit", f"--outputFile.junit={reports[2]}"]
    runs = ((ctest, ROOT), (pytest, ROOT), (vitest, ROOT / "viewer"))
    codes = [subprocess.run(command, cwd=folder, env=environment).returncode for command, folder in runs]
    passed, failed, skipped = (sum(numbers) for numbers in zip(*(count(report) for report in reports)))
    if any(codes) and failed == 0:
        failed = 1  # a runner failed without a failed test: no tests found, or it could not start
    print(f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
    return 0 if failed == 0 and passed > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
