"""Types of the compiled module. The documented functions are in tumble.drop and tumble.lcp."""

from typing import Any, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

class NoSolution(RuntimeError): ...

@final
class Parameters:
    def __init__(
        self,
        *,
        l: float = 0.2,
        m: float = 0.3,
        mu: float = 0.3,
        eps: float = 0.5,
        dt: float = 0.01,
        delta: float = 0.001,
        g: float = 9.81,
        columns: int = 150,
    ) -> None: ...
    @property
    def l(self) -> float: ...
    @property
    def m(self) -> float: ...
    @property
    def mu(self) -> float: ...
    @property
    def eps(self) -> float: ...
    @property
    def dt(self) -> float: ...
    @property
    def delta(self) -> float: ...
    @property
    def g(self) -> float: ...
    @property
    def columns(self) -> int: ...
    def asdict(self) -> dict[str, Any]: ...

def get_contacts(q: ArrayLike, params: Parameters) -> tuple[NDArray[np.float64], float]: ...
def form_lcp(
    J: ArrayLike, v: ArrayLike, params: Parameters
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def solve_LCP(V: ArrayLike, p: ArrayLike) -> NDArray[np.float64]: ...
def step(
    q: ArrayLike, v: ArrayLike, params: Parameters
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def simulate(
    q0: ArrayLike, v0: ArrayLike, params: Parameters
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def simulate_with_record(q0: ArrayLike, v0: ArrayLike, params: Parameters) -> dict[str, Any]: ...
def corner_positions(q: ArrayLike, params: Parameters) -> NDArray[np.float64]: ...

STATUSES: tuple[str, ...]
RUNGS: tuple[str, ...]

def methods() -> dict[str, str]: ...
def settings_of(method: str) -> dict[str, Any]: ...
def solve(
    M: ArrayLike, q: ArrayLike, method: str, row_sizes: ArrayLike | None, settings: dict[str, Any]
) -> dict[str, Any]: ...
def solve_batch(
    M: ArrayLike,
    q: ArrayLike,
    method: str,
    row_sizes: ArrayLike | None,
    start: ArrayLike | None,
    threads: int,
    settings: dict[str, Any],
) -> dict[str, NDArray[Any]]: ...
def contact_problem(
    J_n: ArrayLike, J_t: ArrayLike, inverse_mass: ArrayLike, velocity: ArrayLike, friction: ArrayLike, offset: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]: ...
def solve_contacts(
    J_n: ArrayLike,
    J_t: ArrayLike,
    inverse_mass: ArrayLike,
    velocity: ArrayLike,
    friction: ArrayLike,
    offset: ArrayLike,
    method: str,
    settings: dict[str, Any],
) -> dict[str, Any]: ...
def all_solutions(M: ArrayLike, q: ArrayLike, accepted_residual: float) -> list[dict[str, Any]]: ...
def residual(
    M: ArrayLike, q: ArrayLike, z: ArrayLike, row_sizes: ArrayLike | None
) -> tuple[float, float, float]: ...
def parse_lcp(text: str, name: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
