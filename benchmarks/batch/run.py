"""Batches of drops against the numpy script, the memory's pace and one core; writes out/bench-batch.md.

    python3 benchmarks/batch/run.py --build build --output out/bench-batch.md

Rounds of all measurements one after the other; medians, and ratios inside each round.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))
from run import seconds_per_call  # noqa: E402

SETS = ("scalar", "sse2", "neon", "avx2", "avx512")


class Bench:
    def __init__(self, build: Path) -> None:
        self.program = build / "benchmarks/batch/tumble_bench_batch"
        sys.path[:0] = [str(build / "python"), str(ROOT / "benchmarks/compare")]

    def rate(self, name: str, starts: str, keep: str, threads: int = 1, real: str = "double") -> tuple[float, float]:
        """Steps and bytes of results per second."""
        steps, size = self._call("rate", name, starts, keep, threads, real).split()
        return float(steps), float(size)

    def stream(self, threads: int) -> float:
        """Bytes per second that go to memory in use."""
        return float(self._call("stream", threads))

    def has(self, name: str) -> bool:
        doctor = self.program.parents[2] / "bin/tumble"
        return name in json.loads(subprocess.run([doctor, "doctor", "--json"], check=True, capture_output=True).stdout)["hashes"]

    def _call(self, *words: object) -> str:
        return subprocess.run([str(self.program), *map(str, words)], check=True, capture_output=True, text=True).stdout


def python_overhead() -> tuple[float, float]:
    """Seconds of a call of one drop of one step, and the share of a call of 10^4 drops that is not the drops'."""
    import numpy as np
    from tumble import drop

    one = np.array([[0.0, 1.5, 0.5]]), np.zeros((1, 3))
    short = drop.Parameters(columns=2)
    seconds = seconds_per_call(lambda: drop.simulate_batch(*one, short, threads=1))
    many = np.tile(one[0], (10000, 1)), np.zeros((10000, 3))
    whole = seconds_per_call(lambda: drop.simulate_batch(*many, threads=1), 0.5)
    return seconds, seconds / whole


def round_of(bench: Bench, sets: list[str], cores: int) -> dict[str, float]:
    import numpy as np
    import student_drop

    q0, v0 = np.array([0.0, 1.5, np.deg2rad(30.0)]), np.array([0.0, -0.2, 0.0])
    widest = sets[-1]
    found = {"numpy": 149.0 / seconds_per_call(lambda: student_drop.simulate(q0, v0))}
    for name in sets:
        for starts in ("course", "random"):
            found[f"{name} {starts} final"] = bench.rate(name, starts, "final")[0]
    found["float"] = bench.rate(widest, "random", "final", real="float")[0]
    found["measures"] = bench.rate(widest, "random", "measures")[0]
    found["cores"] = bench.rate(widest, "random", "final", cores)[0]
    for threads in (1, cores):
        found[f"stream {threads}"] = bench.stream(threads)
        for starts in ("course", "random"):
            found[f"{starts} all {threads}"] = bench.rate(widest, starts, "all", threads)[1]
    found["call"], found["share"] = python_overhead()
    return found


def table(rounds: list[dict[str, float]], sets: list[str], cores: int) -> str:
    def median(name: str) -> float:
        return statistics.median(found[name] for found in rounds)

    def ratio(name: str, to: str) -> float:
        return statistics.median(found[name] / found[to] for found in rounds)

    widest = sets[-1]
    load = os.getloadavg()[0]
    lines = [
        f"Medians of {len(rounds)} rounds, ratios inside each round; load of the machine at the end {load:.1f}, {cores} cores.",
        "",
        "| one core, last states | steps/s | times the numpy script |",
        "|---|---|---|",
        f"| numpy script | {median('numpy'):,.0f} | 1 |",
    ]
    for name in sets:
        for starts, words in (("course", "the course's start"), ("random", "random starts")):
            key = f"{name} {starts} final"
            lines.append(f"| {name}, {words} | {median(key):.2e} | {ratio(key, 'numpy'):,.0f} |")
    lines.append(f"| {widest}, random starts, single precision | {median('float'):.2e} | {ratio('float', 'numpy'):,.0f} |")
    lines.append(f"| {widest}, random starts, with measures | {median('measures'):.2e} | {ratio('measures', 'numpy'):,.0f} |")
    share = ratio("cores", f"{widest} random final") / cores
    lines += ["", f"All {cores} cores, {widest}, random starts: {median('cores'):.2e} steps/s, {share:.0%} of {cores} times one core."]
    lines += ["", "| all columns to memory in use | GB/s | of what the memory takes |", "|---|---|---|"]
    for threads in (1, cores):
        words = "one core" if threads == 1 else f"{threads} cores"
        lines.append(f"| {words}, a stream of zeros | {median(f'stream {threads}') / 1e9:.1f} | 100 % |")
        for starts in ("course", "random"):
            key = f"{starts} all {threads}"
            lines.append(f"| {words}, {starts} | {median(key) / 1e9:.1f} | {ratio(key, f'stream {threads}'):.0%} |")
    lines += ["", f"A call from Python for one drop takes {median('call') * 1e6:.1f} us more than the drop; of a call for 10^4 drops "
              f"that is {median('share'):.2%}."]
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build")
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    bench = Bench(arguments.build.resolve())
    sets = [name for name in SETS if bench.has(name)]
    cores = os.cpu_count() or 1
    text = table([round_of(bench, sets, cores) for _ in range(arguments.rounds)], sets, cores)
    arguments.output.write_text(text)
    print(text, end="")
    print(f"wrote {arguments.output}")


if __name__ == "__main__":
    main()
