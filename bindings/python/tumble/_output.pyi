"""Types of the compiled module that writes files. The documented method is tumble.Trajectory.save."""

from tumble._core import Trajectory

def save(
    trajectory: Trajectory, path: bytes, format: str, width: int, height: int, speed: float, has_contacts: bool
) -> None: ...
