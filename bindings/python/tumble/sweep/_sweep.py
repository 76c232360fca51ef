"""What comes out of a sweep."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import MappingProxyType, ModuleType
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from tumble._files import as_pixels, complete_file


def sweep_module() -> ModuleType:
    from tumble import _core  # noqa: F401  the types that the other module uses

    try:
        from tumble import _sweep
    except ImportError as error:
        text = "tumble.sweep: this package was built without cairo, giflib or zlib; install these, then build it again"
        raise ImportError(text) from error
    return _sweep


@dataclass(frozen=True)
class Share:
    """How often an outcome came up.

    Attributes
    ----------
    count : int
        Instances.
    share : float
        Of those that were solved; NaN if none was.
    low, high : float
        95 % confidence interval of the probability [Wilson 1927].
    """

    count: int
    share: float
    low: float
    high: float


@dataclass(frozen=True)
class MeasureSummary:
    """A measure over the instances that were solved and have it; NaN where there are too few.

    Attributes
    ----------
    unit : str
        "" if it has none.
    count, missing : int
        Instances with the measure, and those solved without the event that is measured.
    mean, low, high, deviation : float
        Mean, its 95 % confidence interval, standard deviation.
    min, q05, q25, q50, q75, q95, max : float
        Extremes, exact, and quantiles, good to 0.2 % of their value.
    """

    unit: str
    count: int
    missing: int
    mean: float
    low: float
    high: float
    deviation: float
    min: float
    q05: float
    q25: float
    q50: float
    q75: float
    q95: float
    max: float


@dataclass(frozen=True)
class Summary:
    """A sweep in numbers; ``print`` shows it as a table.

    Attributes
    ----------
    instances, solved, numerical, invalid : int
        All, and how they ended: `numerical` are those in which a step left the range of double arithmetic, `invalid`
        those whose start or parameters are out of range. Both are left out of all that follows.
    outcomes : dict of Share
        "+y up", "+x up", "-y up", "-x up": at rest, with that side of the square up; "still moving".
    measures : dict of MeasureSummary
        By the name of the column.
    """

    instances: int
    solved: int
    numerical: int
    invalid: int
    outcomes: Mapping[str, Share]
    measures: Mapping[str, MeasureSummary]
    _text: str
    _csv: str
    _json: str

    def __str__(self) -> str:
        return self._text.rstrip("\n")

    def to_csv(self) -> str:
        """A line for each outcome and each measure."""
        return self._csv

    def to_json(self) -> str:
        """The same as JSON; null where there is no number."""
        return self._json


class Sweep:
    """A sweep that is done.

    ``sweep["final_x"]`` is a column; ``len(sweep)`` the number of instances. In a notebook it shows itself as a picture.

    Attributes
    ----------
    spec : str
        What was run, as TOML.
    columns : dict of ndarray
        A row for each instance, read-only: what is swept, then ``final_x``, ``final_y`` [m], ``final_theta`` [rad], ``face``,
        ``rest_time``, ``last_contact`` [s], ``impacts``, ``max_impulse`` [N s], ``energy_lost`` [J], ``escape_time`` [s],
        ``status``; see docs/sweep.md. Empty if the spec keeps statistics alone.
    units : dict of str
        Of the columns.
    """

    def __init__(self, answers: Any) -> None:
        self._answers = answers

    def __len__(self) -> int:
        return len(self._answers)

    def __repr__(self) -> str:
        summary = self.summary()
        return f"<Sweep: {summary.instances} instances, {summary.solved} solved>"

    def __getitem__(self, name: str) -> NDArray[Any]:
        try:
            return self.columns[name]
        except KeyError:
            told = ", ".join(self.columns) or "none, as the spec keeps statistics alone"
            raise KeyError(f"{name!r}: the columns are {told}") from None

    def _repr_svg_(self) -> str:
        return bytes(self._answers.draw("overview", 0, 0, True)).decode()

    @property
    def spec(self) -> str:
        return str(self._answers.spec)

    @cached_property
    def columns(self) -> Mapping[str, NDArray[Any]]:
        return MappingProxyType(self._answers.columns)

    @cached_property
    def units(self) -> Mapping[str, str]:
        return MappingProxyType(self._answers.units)

    def summary(self) -> Summary:
        """Shares of the outcomes with confidence intervals, means and quantiles of the measures."""
        text = self._answers.summary_json
        data = json.loads(text)
        outcomes = {
            row["name"]: Share(row["count"], _number(row["share"]), *map(_number, row["interval"]))
            for row in data["outcomes"]
        }
        measures = {row["name"]: _measure(row) for row in data["measures"]}
        return Summary(
            data["instances"],
            data["solved"],
            data["numerical"],
            data["invalid"],
            MappingProxyType(outcomes),
            MappingProxyType(measures),
            self._answers.summary_text,
            self._answers.summary_csv,
            text,
        )

    def plot(
        self, path: Union[str, os.PathLike[str]], kind: str = "overview", *, width: int = 0, height: int = 0
    ) -> None:
        """Write a picture.

        Parameters
        ----------
        path : path
            Ends in .png or .svg. A file of that name is replaced.
        kind : str
            "overview"; "faces", the shares of the outcomes; the name of a measure, its histogram; "map", the most
            frequent face over the first two swept quantities; "map NAME", the mean of a measure over them; "fan", x over
            time of up to 200 instances, which are run again for it.
        width, height : int
            In pixels, 160 to 4096; 0 is chosen.

        Raises
        ------
        ValueError
            For an unknown kind or ending, and for sizes out of range.
        OSError
            If the file cannot be written.
        """
        target = Path(path)
        ending = target.suffix.lower()
        if ending not in (".png", ".svg"):
            raise ValueError(f"{target}: the name must end in .png or .svg")
        if not isinstance(kind, str):
            raise TypeError(f"kind: must be a text, got {type(kind).__name__}")
        size = as_pixels(width, "width"), as_pixels(height, "height")
        picture = self._answers.draw(kind, *size, ending == ".svg")
        with complete_file(target) as unfinished:
            unfinished.write_bytes(picture)

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Write spec and columns into an .npz file, for `load` and numpy.load. A file of that name is replaced."""
        target = Path(path)
        if target.suffix.lower() != ".npz":
            raise ValueError(f"{target}: the name must end in .npz")
        if not self.columns:
            raise ValueError("save: the spec keeps statistics alone, there are no columns")
        with complete_file(target) as unfinished:
            scene = {"scene": self._answers.scene} if self._answers.scene else {}
            with unfinished.open("wb") as file:  # to a name that ends in .NPZ, numpy would add .npz
                np.savez(file, spec=self.spec, **scene, **self.columns)


def _number(value: Any) -> float:
    return float("nan") if value is None else float(value)


def _measure(row: Mapping[str, Any]) -> MeasureSummary:
    low, high = map(_number, row["interval"])
    rest = {name: _number(row[name]) for name in ("mean", "deviation", "min", "q05", "q25", "q50", "q75", "q95", "max")}
    return MeasureSummary(unit=row["unit"], count=row["count"], missing=row["missing"], low=low, high=high, **rest)
