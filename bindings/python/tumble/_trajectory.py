"""The course of a scene over time."""

from __future__ import annotations

import os
from functools import cached_property
from pathlib import Path
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from tumble import _core
from tumble._bodies import Body
from tumble._body_arrays import BodyArrays
from tumble._files import as_target, output_module
from tumble._scene import Scene
from tumble._view import Page, view

BodyName = Union[str, int, Body]


def index_of(scene: Scene, body: BodyName) -> int:
    """The index of a body given by name, index or itself."""
    return scene._core.find_body(body.name or body.index if isinstance(body, Body) else body)


class BodyTrajectory(BodyArrays):
    """The course of one body; arrays over T samples, views of those of the whole trajectory.

    Attributes
    ----------
    body : Body
    time : ndarray, shape (T,)
        [s]
    pose, velocity : ndarray, shape (T, 3)
        (x, y, angle) of the centre of mass [m, m, rad], (vx, vy, omega) [m/s, m/s, rad/s].
    x, y, angle, vx, vy, omega : ndarray, shape (T,)
        Their columns.
    """

    __slots__ = ()

    def __repr__(self) -> str:
        return f"<BodyTrajectory: {self.body.name or self.body.index!r}, {len(self.time)} samples>"


class Trajectory:
    """What `simulate` returns: T samples of B bodies, the first at time 0.

    All arrays are read-only; all but `contacts` are views of the memory of the run.

    ``trajectory["box"]`` is the course of one body, by its name, index or the `Body` itself; see `BodyTrajectory`.

    Attributes
    ----------
    scene : Scene
        What was simulated.
    step_size : float
        [s]
    time : ndarray, shape (T,)
        [s]
    pose : ndarray, shape (T, B, 3)
        (x, y, angle) of the centres of mass [m, m, rad].
    velocity : ndarray, shape (T, B, 3)
        (vx, vy, omega) [m/s, m/s, rad/s].
    energy : record array, shape (T,)
        `kinetic` and `potential` [J] at each sample; `external_work`, `friction_loss`, `impact_loss`, `damping_loss`,
        `stabilisation_work`, `created` [J] since the sample before. Up to round-off, kinetic + potential changes by
        external_work - friction_loss - impact_loss - damping_loss + stabilisation_work.
    contacts : structured array
        A row for each contact at work in each step, in the order of time; see below.
    status : str
        "solved"; or that of the last step, as in `tumble.lcp.Result`, where the run ended.
    is_complete : bool
        The run reached its end.
    num_steps : int
        Steps taken.
    residual : float
        The largest of all steps [-].
    num_inexact_steps : int
        Steps that were not solved, but to a residual of at most 1e-3: the run went on.
    first_inexact : float or None
        When first [s].
    created_energy : float
        [J] from nothing, in all; Newton's restitution with friction can do that.
    num_creating_steps : int
        In how many steps.
    first_creation : float or None
        When first [s].

    Notes
    -----
    The fields of a contact. Velocities are those of body b seen from a, impulses act on b and their opposites on a; the
    tangent is the normal turned right, +x on level ground under the body b.

    - `step` (1, 2, ...), `time` [s] at its end; `body_a`, `body_b` (indices, a < b), `part_a`, `part_b`, `feature` (the
      same number for the same corners or sides);
    - `mode`: "stick", "slip left", "slip right" (and "open" in `Simulation.contacts`);
    - before the step: `point_a`, `point_b` (x, y) [m] on the two surfaces, `normal` from a to b, `gap` [m],
      `normal_velocity`, `tangential_velocity` [m/s];
    - after it: `normal_velocity_after`, `tangential_velocity_after` [m/s];
    - `normal_impulse` >= 0 and `friction_impulse` along the tangent [N s]; divided by the step size they are mean forces;
    - `restitution` that was at work, 0 where nothing bounced; `law_friction`, `law_static_friction`, `law_restitution`.
    """

    def __init__(self, core: _core.Trajectory, has_contacts: bool = True) -> None:
        self._core = core
        self._has_contacts = has_contacts
        self.scene = Scene._of(core.scene())
        self.step_size = core.step_size
        self.num_steps = core.num_steps
        self.status = core.status
        self.is_complete = core.is_complete
        self.residual = core.residual
        self.num_inexact_steps = core.num_inexact_steps
        self.first_inexact = core.first_inexact if core.num_inexact_steps > 0 else None
        self.created_energy = core.created_energy
        self.num_creating_steps = core.num_creating_steps
        self.first_creation = core.first_creation if core.num_creating_steps > 0 else None

    @cached_property
    def time(self) -> NDArray[np.float64]:
        return self._core.time()

    @cached_property
    def pose(self) -> NDArray[np.float64]:
        return self._core.pose()

    @cached_property
    def velocity(self) -> NDArray[np.float64]:
        return self._core.velocity()

    @cached_property
    def energy(self) -> np.recarray[Any, Any]:
        energy: np.recarray[Any, Any] = self._core.energy().view(np.recarray)
        return energy

    @cached_property
    def contacts(self) -> NDArray[Any]:
        if not self._has_contacts:
            raise AttributeError("contacts: were not kept; simulate with contacts=True")
        return self._core.contacts()

    def __getitem__(self, body: BodyName) -> BodyTrajectory:
        index = index_of(self.scene, body)
        return BodyTrajectory(self.scene[index], self.time, self.pose[:, index], self.velocity[:, index])

    def contacts_of(self, body: BodyName, other: BodyName | None = None) -> NDArray[Any]:
        """The rows of `contacts` in which a body takes part, or these two bodies.

        >>> import tumble
        >>> scene = tumble.Scene(duration=0.1)
        >>> floor = scene.add_fixed(tumble.half_plane(), name="floor")
        >>> box = scene.add_body(tumble.square(0.25), mass=2, name="box", position=(0, 0.125))
        >>> rows = tumble.simulate(scene).contacts_of("box", "floor")
        >>> last = rows[rows["step"] == 100]
        >>> bool(abs(last["normal_impulse"].sum() / scene.step_size - 2 * 9.81) < 1e-12)
        True
        """
        index = index_of(self.scene, body)
        rows = self.contacts
        chosen = (rows["body_a"] == index) | (rows["body_b"] == index)
        if other is not None:
            index = index_of(self.scene, other)
            chosen &= (rows["body_a"] == index) | (rows["body_b"] == index)
        found: NDArray[Any] = rows[chosen]
        return found

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        format: str = "",
        width: int = 0,
        height: int = 0,
        speed: float = 1.0,
    ) -> Path:
        """Write a file; an existing one is replaced, once the new one is complete. docs/formats.md says what is in it.

        Parameters
        ----------
        path : path
            Its ending says what: ``.gif`` and ``.mp4`` (with ffmpeg) a film in real time, ``.png`` and ``.svg`` poses and
            paths in one picture; ``.html`` a page that plays the run in a browser (see `view`); ``.csv`` bodies and energies over time, ``.contacts.csv`` contacts over time, ``.npz`` and
            ``.h5`` (with HDF5) all of it.
        format : str, optional
            Such an ending without its first dot, whatever the path ends in.
        width, height : int
            Of a picture [px], 160 to 4096; chosen for you if left out.
        speed : float
            Seconds of the motion per second of a film, > 0.

        Returns
        -------
        Path

        Raises
        ------
        ValueError
            For an unknown ending or a size out of range.
        OSError
            If the file cannot be written, or there is no page for an ``.html``.
        ImportError
            If the package was built without the libraries for files and pictures.
        """
        module = output_module()
        module.save(self._core, self._has_contacts, *as_target(path, format, width, height, speed))
        return Path(os.fsdecode(path))

    def view(self, path: str | os.PathLike[str] | None = None) -> Path | Page:
        """Play the run in a browser, or in the notebook: as a page with everything in it, which `make viewer` builds.

        Parameters
        ----------
        path : path, optional
            Keep the page here; must end in ``.html``. A temporary file if left out.

        Returns
        -------
        Path or Page
            The file that the browser shows; in a notebook, what the notebook shows.

        Raises
        ------
        ValueError
            For another ending.
        OSError
            If there is no page, or the file cannot be written.
        ImportError
            If the package was built without the libraries for files and pictures.
        """
        return view(self.save, path)

    def __repr__(self) -> str:
        end = "complete" if self.is_complete else f"ended early, last step {self.status}"
        return f"<Trajectory: {len(self.scene)} bodies, {len(self.time)} samples to {self.time[-1]:g} s, {end}>"
