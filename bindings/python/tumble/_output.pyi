"""Types of the compiled module that writes files. Documented are save of tumble.Trajectory and of tumble.drop.Record."""

from tumble._core import Trajectory

mode_names: list[str]
status_names: list[str]

def save(
    trajectory: Trajectory,
    has_contacts: bool,
    path: bytes,
    format: str,
    width: int,
    height: int,
    speed: float,
    page: bytes,
) -> None: ...
def save_record(
    npz: bytes, path: bytes, format: str, width: int, height: int, speed: float, page: bytes
) -> None: ...
