"""Draw performance profiles [Dolan & More 2002] of a table that tumble_bench_lcp wrote.

    python3 benchmarks/lcp/plot.py out/bench-lcp.csv

One picture per group of problems, beside the table. A curve shows the share of the problems that a solver gets right
within so many times the time of the fastest right answer: its height at the right edge is its reliability. Solvers
that take only some problems of a group are left out of its picture.
"""

import argparse
import csv
import re
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

LARGEST_RATIO = 1e4
# Okabe & Ito, and line styles for more curves than colours.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
STYLES = ["-", "--", ":"]


def read(path: Path) -> dict[str, dict[str, dict[str, float]]]:
    """Seconds of each solver on each case that it was tried on, by group; infinity where it was not right."""
    groups: dict[str, dict[str, dict[str, float]]] = defaultdict(lambda: defaultdict(dict))
    with path.open(newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            seconds = float(row["seconds"]) if row["verdict"] == "good" else float("inf")
            groups[row["group"]][row["solver"]][row["case"]] = seconds
    return groups


def profile(times: dict[str, float], fastest: dict[str, float]) -> tuple[list[float], list[float]]:
    """Corners of the curve of one solver: ratios to the fastest, and the share of its cases solved within them."""
    ratios = sorted(seconds / fastest[case] for case, seconds in times.items() if seconds < float("inf"))
    x, y = [1.0], [0.0]
    for count, ratio in enumerate(ratios, start=1):
        x.append(min(ratio, LARGEST_RATIO))
        y.append(count / len(times))
    return x + [LARGEST_RATIO], y + [y[-1]]


def draw(group: str, solvers: dict[str, dict[str, float]], path: Path) -> None:
    """The profiles of one group as a PNG."""
    num_cases = max(len(times) for times in solvers.values())
    solvers = {solver: times for solver, times in solvers.items() if len(times) == num_cases}
    fastest: dict[str, float] = {}
    for times in solvers.values():
        for case, seconds in times.items():
            fastest[case] = min(seconds, fastest.get(case, float("inf")))
    figure, axes = plt.subplots(figsize=(8, 4.5), layout="constrained")
    for number, (solver, times) in enumerate(solvers.items()):
        x, y = profile(times, fastest)
        style = STYLES[number // len(COLOURS) % len(STYLES)]
        axes.step(x, y, style, where="post", color=COLOURS[number % len(COLOURS)], label=solver)
    axes.set(xscale="log", xlim=(1, LARGEST_RATIO), ylim=(0, 1.02), title=f"{group}: {len(fastest)} problems")
    axes.set_xlabel("time over that of the fastest right answer [-]")
    axes.set_ylabel("share of problems solved right [-]")
    axes.grid(alpha=0.3)
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    figure.savefig(path, dpi=120)
    plt.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw performance profiles of LCP solvers, one PNG per group.")
    parser.add_argument("table", type=Path, help="bench-lcp.csv")
    table = parser.parse_args().table
    for group, solvers in read(table).items():
        name = "-".join(re.findall(r"[a-z0-9]+", group.lower()))
        draw(group, solvers, table.with_name(f"{table.stem}-{name}.png"))


if __name__ == "__main__":
    main()
