"""Measure everything in one run and write the table of docs/benchmarks.md: medians, ratios, and accuracy beside time.

    python3 benchmarks/run.py --build build --output out/bench.md
"""

import argparse
import json
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
ROUNDS = 7


def seconds_per_call(function, at_least: float = 0.1) -> float:
    """Mean over as many calls as fill `at_least` seconds."""
    calls = 1
    while True:
        start = time.perf_counter()
        for _ in range(calls):
            function()
        elapsed = time.perf_counter() - start
        if elapsed >= at_least:
            return elapsed / calls
        calls = max(2 * calls, int(calls * at_least / max(elapsed, 1e-9)))


def micro_benchmarks(build: Path) -> dict[str, list[float]]:
    """Nanoseconds per call of each micro benchmark, ROUNDS values each, rounds interleaved."""
    command = [
        str(build / "benchmarks/micro/tumble_micro"),
        "--benchmark_format=json",
        f"--benchmark_repetitions={ROUNDS}",
        "--benchmark_enable_random_interleaving=true",
        "--benchmark_min_time=0.05",
    ]
    report = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    times: dict[str, list[float]] = {}
    for run in report["benchmarks"]:
        if run["run_type"] == "iteration":
            times.setdefault(run["run_name"], []).append(run["cpu_time"])
    return times


def compare_drops(build: Path) -> tuple[dict[str, list[float]], float]:
    """Seconds per drop of the course's start for each way to run it, and the largest difference of their states."""
    sys.path[:0] = [str(build / "python"), str(ROOT / "benchmarks" / "compare")]
    import numpy as np
    import student_drop
    from tumble import drop

    q0, v0 = np.array([0.0, 1.5, np.deg2rad(30.0)]), np.array([0.0, -0.2, 0.0])
    times: dict[str, list[float]] = {"numpy": [], "python": [], "c++": []}
    for _ in range(ROUNDS):
        times["numpy"].append(seconds_per_call(lambda: student_drop.simulate(q0, v0)))
        times["python"].append(seconds_per_call(lambda: drop.simulate(q0, v0)))
        command = [str(build / "benchmarks/micro/tumble_micro"), "--benchmark_format=json",
                   "--benchmark_filter=^simulate_course_start$", "--benchmark_min_time=0.1"]
        report = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        times["c++"].append(report["benchmarks"][0]["cpu_time"] * 1e-9)
    ours, theirs = drop.simulate(q0, v0), student_drop.simulate(q0, v0)
    difference = max(float(np.abs(a - b).max()) for a, b in zip(ours, theirs))
    return times, difference


def table(drops: dict[str, list[float]], difference: float, micro: dict[str, list[float]]) -> str:
    median = {name: statistics.median(values) for name, values in drops.items()}
    ratio = {name: statistics.median(n / t for n, t in zip(drops["numpy"], drops[name])) for name in drops}
    names = {
        "numpy": "plain numpy script with a tableau Lemke",
        "python": "`tumble.drop.simulate` from Python",
        "c++": "`simulate` in C++",
    }
    lines = [
        f"The course's start, 149 steps; medians of {ROUNDS} rounds, ratios round by round. "
        f"Largest difference between the states of the first two: {difference:.1e}.",
        "",
        "| what | time per drop | steps per second | times the numpy script |",
        "|---|---|---|---|",
    ]
    for name, words in names.items():
        microseconds = f"{median[name] * 1e6:,.1f} us"
        lines.append(f"| {words} | {microseconds} | {149 / median[name]:,.0f} | {ratio[name]:,.0f} |")
    lines += ["", "| one call | median | fastest |", "|---|---|---|"]
    for name, values in micro.items():
        lines.append(f"| {name} | {statistics.median(values):,.1f} ns | {min(values):,.1f} ns |")
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build")
    parser.add_argument("--output", type=Path, required=True)
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    drops, difference = compare_drops(build)
    text = table(drops, difference, micro_benchmarks(build))
    arguments.output.write_text(text)
    print(text, end="")
    print(f"wrote {arguments.output}")


if __name__ == "__main__":
    main()
