"""`Simulation`: a scene step by step, with forces and motions from outside."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tumble import _core
from tumble._core import Snapshot
from tumble._scene import Scene, require_scene
from tumble._shapes import Angle
from tumble._trajectory import BodyName, index_of


class BodyState(NamedTuple):
    """Pose of the centre of mass [m, m, rad] and velocity [m/s, m/s, rad/s] of a body."""

    x: float
    y: float
    angle: float
    vx: float
    vy: float
    omega: float


class Simulation:
    """A scene step by step, for control and learning: look, push, advance.

    It has no end and keeps no history; `simulate` does both. The steps are the same, bit for bit.

    Parameters
    ----------
    scene : Scene
        Copied; later changes of it have no effect.
    step_size : float, optional
        [s]; that of the scene if left out.
    solver : str
    num_sweeps : int
        As in `simulate`.

    Attributes
    ----------
    scene : Scene
    step_size, time : float
        [s]
    num_steps : int
        Taken since the start.
    pose, velocity : ndarray, shape (B, 3)
        (x, y, angle) of the centres of mass [m, m, rad], (vx, vy, omega) [m/s, m/s, rad/s]; new arrays each time.
        ``simulation["box"]`` has those of one body by name.
    energy : record
        As in `Trajectory`; works and losses are those of the last call of `advance`.
    contacts : structured array
        Of the last step, as in `Trajectory`, also those that are in reach but open.
    status, residual
        Of the last step.
    state : Snapshot
        All that the next steps depend on, orders by ``set_`` included. Kept and set again it takes the simulation back.

    >>> import tumble
    >>> scene = tumble.Scene()
    >>> floor = scene.add_fixed(tumble.half_plane(), name="floor")
    >>> box = scene.add_body(tumble.square(0.25), mass=1, name="box", position=(0, 0.125))
    >>> simulation = tumble.Simulation(scene)
    >>> simulation.set_wrench("box", force=(10, 0))  # friction is 0.5: it slides with (10 - 0.5 9.81) m/s^2
    >>> simulation.advance(1000)
    'solved'
    >>> print(f"{simulation['box'].vx:.6f} m/s after {simulation.time} s")
    5.095000 m/s after 1.0 s
    """

    __slots__ = ("_core", "scene")

    def __init__(
        self, scene: Scene, *, step_size: float | None = None, solver: str = "exact", num_sweeps: int = 24
    ) -> None:
        require_scene(scene)
        self._core = _core.Stepper(scene._core, step_size, solver, num_sweeps)
        self.scene = scene.copy()

    def advance(self, steps: int = 1) -> str:
        """Take steps; ends with the first one that is not solved.

        Ctrl-C raises KeyboardInterrupt between two steps; the simulation is then at the last one taken and goes on from
        there when it is advanced again. Other Python threads run meanwhile.

        Returns
        -------
        str
            The status of the last step, "solved" if all is well.
        """
        return self._core.advance(steps)

    def reset(self) -> None:
        """Go back to the start of the scene; all that was set by ``set_`` is forgotten."""
        self._core.reset()

    def set_pose(self, body: BodyName, position: ArrayLike | None = None, angle: Angle | None = None) -> None:
        """Put a dynamic or kinematic body somewhere else; what is left out stays as it is.

        A kinematic body goes on from there with the velocity it has, in place of the motion that the scene gives it.

        Parameters
        ----------
        body : str, int or Body
        position : array_like, shape (2,), optional
            Of the centre of mass [m].
        angle : float or str, optional
            [rad, or "30 deg"]
        """
        self._core.set_pose(index_of(self.scene, body), position, angle)

    def set_velocity(
        self, body: BodyName, velocity: ArrayLike | None = None, angular_velocity: float | None = None
    ) -> None:
        """Give a body another velocity; what is left out stays as it is.

        A kinematic body keeps it from now on, in place of the motion that the scene gives it.

        Parameters
        ----------
        body : str, int or Body
        velocity : array_like, shape (2,), optional
            [m/s]
        angular_velocity : float, optional
            [rad/s]
        """
        self._core.set_velocity(index_of(self.scene, body), velocity, angular_velocity)

    def set_wrench(self, body: BodyName, force: ArrayLike = (0.0, 0.0), torque: float = 0.0) -> None:
        """Let a force and a torque act on a dynamic body from now on, in place of what did.

        Parameters
        ----------
        body : str, int or Body
        force : array_like, shape (2,)
            At the centre of mass, in directions of the world [N].
        torque : float
            [N m]
        """
        self._core.set_wrench(index_of(self.scene, body), force, torque)

    def __getitem__(self, body: BodyName) -> BodyState:
        index = index_of(self.scene, body)
        return BodyState(*self._core.pose()[index].tolist(), *self._core.velocity()[index].tolist())

    @property
    def state(self) -> Snapshot:
        return self._core.snapshot()

    @state.setter
    def state(self, snapshot: Snapshot) -> None:
        if not isinstance(snapshot, Snapshot):
            raise TypeError(f"state: must be one that a Simulation gave, got {type(snapshot).__name__}")
        self._core.restore(snapshot)

    @property
    def step_size(self) -> float:
        return self._core.step_size

    @property
    def time(self) -> float:
        return self._core.time

    @property
    def num_steps(self) -> int:
        return self._core.num_steps

    @property
    def pose(self) -> NDArray[np.float64]:
        return self._core.pose()

    @property
    def velocity(self) -> NDArray[np.float64]:
        return self._core.velocity()

    @property
    def energy(self) -> Any:
        return self._core.energy().view(np.recarray)[0]

    @property
    def contacts(self) -> NDArray[Any]:
        return self._core.contacts()

    @property
    def status(self) -> str:
        return self._core.status

    @property
    def residual(self) -> float:
        return self._core.residual

    def __repr__(self) -> str:
        return f"<Simulation: {len(self.scene)} bodies, at {self.time:g} s, last step {self.status}>"
