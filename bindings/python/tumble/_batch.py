"""Many drops of the document's model at once; public as ``tumble.drop.simulate_batch``."""

from __future__ import annotations

import math
import operator
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from tumble import _core
from tumble._core import Parameters
from tumble._progress import ProgressLine

_DEFAULTS = Parameters()
_DOCUMENT = _DEFAULTS.asdict()
_INVALID = 2  # of Batch.STATUSES

ParametersLike = Union[Parameters, Sequence[Parameters], Mapping[str, Any]]


@dataclass(frozen=True, eq=False)
class Batch:
    """What became of N drops.

    Attributes
    ----------
    q, v : ndarray, shape (N, 3) or (N, 3, T), or None
        Last poses [m, m, rad] and velocities [m/s, m/s, rad/s], or those of the T columns that are kept. NaN where a
        drop has no good column. None with ``keep="measures"``.
    status : ndarray of uint8, shape (N,)
        Index into `Batch.STATUSES`: 0 solved; 1 numerical: a step left the range of double arithmetic, the columns
        before it are good; 2 invalid: the start or the parameters are NaN or out of range, `why` says how.
    columns : ndarray of int32, shape (N,)
        Good columns: all of them if solved.
    measures : structured ndarray, shape (N,), or None
        With ``measures=True`` or ``keep="measures"``: ``measures["face"]`` and so on, see `simulate_batch`.
    """

    STATUSES = ("solved", "numerical", "invalid")

    q: Any
    v: Any
    status: NDArray[np.uint8]
    columns: NDArray[np.int32]
    measures: NDArray[Any] | None
    _invalid: Any  # starts and parameters of those that are, or None

    def __len__(self) -> int:
        return len(self.status)

    def __repr__(self) -> str:
        counts = np.bincount(self.status, minlength=3)
        told = ", ".join(f"{count} {name}" for count, name in zip(counts, self.STATUSES) if count)
        return f"<Batch: {len(self)} drops{', ' if told else ''}{told}>"

    def why(self, i: int) -> str:
        """Why drop i is invalid, in the words of `simulate`; an empty text if it is not."""
        try:
            index = operator.index(i)
        except TypeError:
            raise TypeError(f"i: must be a whole number, got {i!r}") from None
        if not -len(self) <= index < len(self):
            raise IndexError(f"i: must be in [{-len(self)}, {len(self) - 1}], got {index}")
        index %= len(self)
        if self.status[index] != _INVALID:
            return ""
        q0, v0, values = self._invalid
        return _core.what_is_invalid(q0, v0, values, int(np.count_nonzero(self.status[:index] == _INVALID)))


def simulate_batch(
    q0: ArrayLike,
    v0: ArrayLike,
    params: ParametersLike = _DEFAULTS,
    *,
    keep: str | int = "final",
    measures: bool = False,
    rest_speed: float = 0.2,
    region: tuple[float, float] = (-math.inf, math.inf),
    dtype: DTypeLike = np.float64,
    threads: int = 0,
    instruction_set: str | None = None,
    progress: bool = False,
) -> Batch:
    """N drops at once, on all cores, each to the bits that `simulate` gives it alone.

    Parameters
    ----------
    q0, v0 : array_like, shape (N, 3)
        Poses (x, y, theta) [m, m, rad] and velocities (vx, vy, omega) [m/s, m/s, rad/s] at the start.
    params : Parameters, sequence of N Parameters, or mapping
        For all drops, for each drop, or by name: numbers for all and arrays of shape (N,), such as
        ``{"mu": np.linspace(0, 1, N), "eps": 0.5, "columns": 200}``; what is left out is the document's.
    keep : "final", "all", int k >= 1, or "measures"
        Columns that are kept: the last, all, or those numbered 0, k, 2k, ...; or none, only what is measured: q and v are
        None then. For statistics of drops that are drawn from distributions, and are more than fit into memory, see
        `tumble.sweep`.
    measures : bool
        Tell of each drop, as a structured array: ``last_contact``, end of the last step with a contact force [s], NaN
        if there was none; ``rest_time``, from when on it is at rest [s], NaN if it is not at the end; ``max_impulse``,
        the largest normal impulse of a step [N s]; ``energy_lost``, kinetic and potential [J], NaN if it leaves the range of double; ``escape_time``, first
        column with x outside `region` [s], NaN if there is none; ``impacts``, steps with a contact force whose step
        before had none; ``face``, the side that is up at the end: 0 that at +y in the body frame, 1 at +x, 2 at -y,
        3 at -x, and -1 if the drop is not solved.
    rest_speed : float
        At rest is what is at most this fast [m/s]: sqrt(vx^2 + vy^2 + (l^2 / 6) omega^2). The document's square never
        stops: delta lifts it at each contact.
    region : (float, float)
        Bounds of x [m] for ``escape_time``.
    dtype : float64 or float32
        float32 computes in single precision, about twice as fast and not to the bits of `simulate`, but as equal on
        all machines.
    threads : int
        0: one for each core. Of no influence on the numbers.
    instruction_set : str, optional
        "scalar", "sse2" (or "neon"), "avx2", "avx512"; the widest there is if not given, or what the environment
        variable TUMBLE_INSTRUCTION_SET says. Of no influence on the numbers.
    progress : bool
        Show on the terminal how far it is, if standard error is one and it takes longer than a second.

    Returns
    -------
    Batch

    Raises
    ------
    ValueError
        For wrong shapes, and for parameters common to all that are out of range. What is wrong with one drop alone is
        that drop's status.
    KeyboardInterrupt
        At Ctrl-C, within a second or two at most.

    >>> import numpy as np
    >>> from tumble.drop import simulate_batch
    >>> theta = np.linspace(0, np.pi, 1000)
    >>> q0 = np.column_stack([np.zeros(1000), np.full(1000, 1.5), theta])
    >>> batch = simulate_batch(q0, np.zeros((1000, 3)), measures=True)
    >>> batch
    <Batch: 1000 drops, 1000 solved>
    >>> faces = np.bincount(batch.measures["face"], minlength=4)
    >>> int(faces.sum())
    1000
    """
    arrays = _parameter_arrays(params)
    states = not (isinstance(keep, str) and keep == "measures")
    every = _every(keep) if states else 0
    try:
        kind = np.dtype(dtype)
    except TypeError:
        raise ValueError(f"dtype: must be float64 or float32, got {dtype!r}") from None
    if kind not in (np.float64, np.float32):
        raise ValueError(f"dtype: must be float64 or float32, got {kind}")
    settings = (_number("rest_speed", rest_speed), *_region(region), _threads(threads), instruction_set)
    line = ProgressLine() if progress else None
    told = None if line is None else _teller(line, np.shape(q0)[0])
    arguments = (q0, v0, arrays, every, states, bool(measures) or not states, *settings, told)
    try:
        results: Any = _core.simulate_batch(*arguments) if kind == np.float64 else _single(arguments)
    finally:
        if line is not None:
            line.clear()
    has_invalid, q, v, status, columns, told_of = results
    invalid = _rows_of(status == _INVALID, q0, v0, arrays, kind) if has_invalid else None
    return Batch(q, v, status, columns, told_of, invalid)


def _single(arguments: tuple[Any, ...]) -> Any:
    with np.errstate(over="ignore"):  # what float32 cannot hold becomes infinite, and its drop is invalid
        return _core.simulate_batch_single(*arguments)


def _rows_of(chosen: NDArray[np.bool_], q0: ArrayLike, v0: ArrayLike, arrays: dict[str, Any], kind: Any) -> Any:
    """Copies, since the caller may change the arrays later."""
    values = {name: np.asarray(value)[chosen] if np.size(value) == len(chosen) != 1 else value for name, value in arrays.items()}
    with np.errstate(over="ignore"):
        return np.asarray(q0)[chosen].astype(kind), np.asarray(v0)[chosen].astype(kind), values


def _teller(line: ProgressLine, count: int) -> Any:
    return lambda done: line.show(done / max(count, 1), f"{done} of {count} drops")


def _every(keep: str | int) -> int:
    if isinstance(keep, str):
        if keep == "final":
            return 0
        if keep == "all":
            return 1
    elif isinstance(keep, (int, np.integer)) and not isinstance(keep, bool) and 1 <= keep < 2**31:
        return int(keep)
    raise ValueError(f"keep: must be 'final', 'all', 'measures' or a whole number >= 1, got {keep!r}")


def _number(name: str, value: object) -> float:
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{name}: must be a number, got {value!r}") from None


def _region(region: tuple[float, float]) -> tuple[float, float]:
    try:
        x_min, x_max = (float(x) for x in region)
        if x_min <= x_max:
            return x_min, x_max
    except (TypeError, ValueError, OverflowError):
        pass
    raise ValueError(f"region: must be (x_min, x_max) [m] with x_min <= x_max, got {region!r}") from None


def _threads(threads: object) -> int:
    if isinstance(threads, (int, np.integer)) and not isinstance(threads, bool) and 0 <= threads <= 1024:
        return int(threads)
    raise ValueError(f"threads: must be a whole number in [0, 1024], 0 for one for each core, got {threads!r}")


def _parameter_arrays(params: ParametersLike) -> dict[str, Any]:
    """The seven parameters by name, each a number or an array, and columns."""
    if isinstance(params, Parameters):
        return params.asdict()
    if isinstance(params, Mapping):
        for name in params:
            if name not in _DOCUMENT:
                raise ValueError(f"params: must have names out of {', '.join(_DOCUMENT)}, got {name!r}")
        arrays = {**_DOCUMENT, **params}
        arrays["columns"] = Parameters(columns=arrays["columns"]).columns
        return arrays
    if not isinstance(params, Sequence):
        raise TypeError(f"params: must be tumble.drop.Parameters, a sequence or a mapping, got {type(params).__name__}")
    rows = [_require_parameters(each).asdict() for each in params]
    if not rows:
        return {**_DOCUMENT, "mu": np.empty(0)}  # as many as drops, if there are none
    columns = {row["columns"] for row in rows}
    if len(columns) != 1:
        raise ValueError(f"params: must all have the same columns, got {min(columns)} to {max(columns)}")
    arrays = {name: np.array([row[name] for row in rows]) for name in _DOCUMENT if name != "columns"}
    return {**arrays, "columns": columns.pop()}


def _require_parameters(each: object) -> Parameters:
    if not isinstance(each, Parameters):
        raise TypeError(f"params: must be tumble.drop.Parameters, a sequence or a mapping, got {type(each).__name__}")
    return each
