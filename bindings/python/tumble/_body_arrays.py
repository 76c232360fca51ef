"""The arrays of one body, in the course of time or over many runs."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from tumble._bodies import Body


class BodyArrays:
    """Poses and velocities of one body with their components by name; all are views of the arrays that they come from.

    Attributes
    ----------
    body : Body
    time : ndarray, shape (T,)
        [s]
    pose, velocity : ndarray, shape (K, 3), or (K, 3, T)
        (x, y, angle) of the centre of mass [m, m, rad], (vx, vy, omega) [m/s, m/s, rad/s].
    x, y, angle, vx, vy, omega : ndarray, shape (K,), or (K, T)
    """

    __slots__ = ("body", "time", "pose", "velocity")

    def __init__(self, body: Body, time: NDArray[Any], pose: NDArray[Any], velocity: NDArray[Any]) -> None:
        self.body = body
        self.time = time
        self.pose = pose
        self.velocity = velocity

    @property
    def x(self) -> NDArray[np.float64]:
        return self.pose[:, 0]

    @property
    def y(self) -> NDArray[np.float64]:
        return self.pose[:, 1]

    @property
    def angle(self) -> NDArray[np.float64]:
        return self.pose[:, 2]

    @property
    def vx(self) -> NDArray[np.float64]:
        return self.velocity[:, 0]

    @property
    def vy(self) -> NDArray[np.float64]:
        return self.velocity[:, 1]

    @property
    def omega(self) -> NDArray[np.float64]:
        return self.velocity[:, 2]
