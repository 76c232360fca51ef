"""`rollout`: many runs of one scene, over all cores."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tumble import _core
from tumble._bodies import Body, Material
from tumble._body_arrays import BodyArrays
from tumble._progress import ProgressLine
from tumble._scene import Scene, require_scene
from tumble._trajectory import BodyName, index_of

MaterialKey = Union[str, Material, tuple[Union[str, Material], Union[str, Material]]]
OfBodies = Union[ArrayLike, Mapping[Union[str, int], ArrayLike]]
OfMaterials = Union[ArrayLike, Mapping[MaterialKey, ArrayLike]]

_LEDGER = ["kinetic", "potential", "external_work", "friction_loss", "impact_loss", "damping_loss", "stabilisation_work"]
_STATUSES = np.array(_core.STATUSES)


class BodyRollout(BodyArrays):
    """One body in all instances; arrays are views of those of the whole rollout.

    Attributes
    ----------
    body : Body
    time : ndarray, shape (T,)
        [s]
    pose, velocity : ndarray, shape (N, 3), or (N, 3, T) with samples
        (x, y, angle) of the centre of mass [m, m, rad], (vx, vy, omega) [m/s, m/s, rad/s].
    x, y, angle, vx, vy, omega : ndarray, shape (N,), or (N, T)
    """

    __slots__ = ()

    def __repr__(self) -> str:
        return f"<BodyRollout: {self.body.name or self.body.index!r}, {len(self.pose)} instances>"


class Rollout:
    """What `rollout` returns: N instances of a scene of B movable bodies.

    ``result["box"]`` is one body in all instances, by its name, index or the `Body` itself; see `BodyRollout`.

    Attributes
    ----------
    scene : Scene
        What all instances are made from; see `scene_of`.
    bodies : tuple of Body
        The B bodies whose start is free: dynamic ones, and kinematic ones without a motion.
    time : ndarray, shape (T,)
        [s]; T is 1 without samples.
    pose, velocity : ndarray, shape (N, B, 3), or (N, B, 3, T) with samples
        (x, y, angle) of the centres of mass [m, m, rad], (vx, vy, omega) [m/s, m/s, rad/s]. NaN in samples that a run
        did not reach; where the last one would be without samples, the last state reached.
    status : ndarray of str, shape (N,)
        "solved", or with what the run ended early, as in `Trajectory`; "bad_input": NaN or out of range, not run, see
        `why`.
    num_steps : ndarray of int, shape (N,)
        Steps taken.
    residual : ndarray, shape (N,)
        The largest of all steps [-].
    rest_time : ndarray, shape (N,)
        From when on no dynamic body was faster than `rest_speed` [s]; NaN if one was at the end.
    last_contact : ndarray, shape (N,)
        End of the last step with a contact impulse [s]; NaN if there was none.
    impacts : ndarray of int, shape (N,)
        Times that two bodies began to push each other: an impulse in a step, none in the step before.
    max_impulse : ndarray, shape (N,)
        Largest sum of the normal impulses between two bodies in a step [N s].
    energy_lost : ndarray, shape (N,)
        Kinetic and potential energy at the start less that at the end [J].
    escape_time : ndarray, shape (N,)
        End of the first step where a dynamic body's x is outside of `region` [s]; NaN if there is none.
    energy : record array, shape (N,)
        `kinetic` and `potential` [J] at the end; `external_work`, `friction_loss`, `impact_loss`, `damping_loss`,
        `stabilisation_work` [J] of all steps, as in `Trajectory`.
    created_energy, num_creating_steps, num_inexact_steps : ndarray, shape (N,)
        As in `Trajectory`.
    """

    def __init__(self, inputs: _core.RolloutInputs, fields: dict[str, NDArray[Any]]) -> None:
        self._inputs = inputs
        self.scene = Scene._of(inputs.scene())
        self._indices = list(inputs.bodies)
        self.bodies = tuple(self.scene[i] for i in self._indices)
        self.time = fields["time"]
        self.pose = fields["pose"]
        self.velocity = fields["velocity"]
        self._codes = fields["status"]
        measures = fields["measures"]
        self.num_steps: NDArray[np.int64] = measures["num_steps"]
        self.residual: NDArray[np.float64] = measures["residual"]
        self.rest_time: NDArray[np.float64] = measures["rest_time"]
        self.last_contact: NDArray[np.float64] = measures["last_contact"]
        self.impacts: NDArray[np.int64] = measures["impacts"]
        self.max_impulse: NDArray[np.float64] = measures["max_impulse"]
        self.energy_lost: NDArray[np.float64] = measures["energy_lost"]
        self.escape_time: NDArray[np.float64] = measures["escape_time"]
        self.energy: np.recarray[Any, Any] = measures[_LEDGER].view(np.recarray)
        self.created_energy: NDArray[np.float64] = measures["created_energy"]
        self.num_creating_steps: NDArray[np.int64] = measures["num_creating_steps"]
        self.num_inexact_steps: NDArray[np.int64] = measures["num_inexact_steps"]

    @property
    def status(self) -> NDArray[np.str_]:
        words: NDArray[np.str_] = _STATUSES[self._codes]
        return words

    def scene_of(self, instance: int) -> Scene:
        """The scene that `simulate` runs as this instance was run, bit for bit.

        Raises
        ------
        IndexError
            For a number that is not in [-N, N - 1].

        >>> import tumble
        >>> scene = tumble.Scene(duration=0.5)
        >>> floor = scene.add_fixed(tumble.half_plane())
        >>> ball = scene.add_body(tumble.disc(0.1), mass=1, name="ball", position=(0, 1))
        >>> result = tumble.rollout(scene, velocities=[[0, 0, 0], [3, 0, 0]], restitution=[0.2, 0.8])
        >>> trajectory = tumble.simulate(result.scene_of(1))
        >>> bool((trajectory["ball"].pose[-1] == result["ball"].pose[1]).all())
        True
        """
        return Scene._of(self._inputs.scene_of(self._number(instance)))

    def why(self, instance: int) -> str:
        """Why an instance was not run, in one line; "" if it was. Raises as `scene_of`."""
        return self._inputs.what_is_invalid(self._number(instance))

    def _number(self, instance: int) -> int:
        if not -len(self) <= instance < len(self):
            raise IndexError(f"instance: must be in [{-len(self)}, {len(self) - 1}], got {instance}")
        return instance % len(self)

    def __getitem__(self, body: BodyName) -> BodyRollout:
        index = index_of(self.scene, body)
        if index not in self._indices:
            raise ValueError(f"body: must be one that moves freely, see Rollout.bodies, got {body!r:.40}")
        b = self._indices.index(index)
        return BodyRollout(self.scene[index], self.time, self.pose[:, b], self.velocity[:, b])

    def __len__(self) -> int:
        return len(self._codes)

    def __repr__(self) -> str:
        solved = int(np.count_nonzero(self._codes == 0))
        return f"<Rollout: {len(self)} instances of {len(self.bodies)} bodies to {self.time[-1]:g} s, {solved} solved>"


def rollout(
    scene: Scene,
    poses: OfBodies | None = None,
    velocities: OfBodies | None = None,
    *,
    mass: OfBodies | None = None,
    moment_of_inertia: OfBodies | None = None,
    friction: OfMaterials | None = None,
    static_friction: OfMaterials | None = None,
    restitution: OfMaterials | None = None,
    gravity: ArrayLike | None = None,
    step_size: float | None = None,
    duration: float | None = None,
    every: int = 0,
    solver: str = "exact",
    num_sweeps: int = 24,
    rest_speed: float = 1e-3,
    region: ArrayLike | None = None,
    threads: int = 0,
    progress: bool = False,
) -> Rollout:
    """Run N instances of a scene, over all cores, each bit for bit as `simulate` runs it alone.

    What is not given is that of the scene. Arrays of one entry and single values hold for all instances; the others
    have N entries. Bodies are named in dicts, like ``mass={"box": [0.2, 0.3]}``, by name or index.

    Parameters
    ----------
    scene : Scene
    poses, velocities : array_like, shape (N, B, 3) or (B, 3), or dict of bodies with shapes (N, 3) or (3,)
        At the start: (x, y, angle) of the centre of mass [m, m, rad], (vx, vy, omega) [m/s, m/s, rad/s], of the B bodies
        that are dynamic, or kinematic without a motion, in the order of the scene. Where B is 1, (N, 3) will do.
    mass : array_like, shape (N,), or dict of dynamic bodies
        [kg]. Moments of inertia grow in proportion.
    moment_of_inertia : array_like, shape (N,), or dict of dynamic bodies
        [kg m^2], in place of that.
    friction, restitution : array_like, shape (N,), or dict of materials and pairs of them
        [-]. Not a dict: of all contacts. ``friction={"wood": mu, ("wood", "ice"): 0.05}`` sets the law of two surfaces of
        wood, from which those with other materials are mixed, and that of a pair of the scene.
    static_friction : array_like, shape (N,), or dict of materials and pairs of them
        [-], >= friction; left out, it is the friction given.
    gravity : array_like, shape (N, 2) or (2,)
        [m/s^2]
    step_size, duration : float, optional
        [s], as in `simulate`.
    every : int
        0: final states. k >= 1: samples, those of `simulate` with sample_every k; memory for N x B x 6 x T numbers.
    solver, num_sweeps
        As in `simulate`.
    rest_speed : float
        For `Rollout.rest_time` [m/s]: bounds sqrt(vx^2 + vy^2 + I / m omega^2), the speed that all of the kinetic energy
        would give.
    region : (x_min, x_max), optional
        For `Rollout.escape_time` [m].
    threads : int
        0: one for each core. The results do not depend on it.
    progress : bool
        Show on the terminal how far it is, if standard error is one and it takes longer than a second.

    Returns
    -------
    Rollout
        Look at `status`: an instance with NaN, or with values out of range, is not run, and changes no other.

    Raises
    ------
    ValueError
        Naming the argument, its value and the allowed range: for shapes that do not fit, and values common to all
        instances that are out of range.
    KeyboardInterrupt
        At Ctrl-C; nothing is kept.

    >>> import numpy as np, tumble
    >>> scene = tumble.Scene(step_size=0.005, duration=2)
    >>> floor = scene.add_fixed(tumble.half_plane(), name="floor")
    >>> box = scene.add_body(tumble.square(0.2), mass=0.3, name="box")
    >>> angles = np.linspace(0, np.pi / 4, 100)
    >>> poses = np.column_stack([np.zeros(100), np.ones(100), angles])
    >>> result = tumble.rollout(scene, poses, restitution=0.3)
    >>> result
    <Rollout: 100 instances of 1 bodies to 2 s, 100 solved>
    >>> result["box"].x.shape, bool(np.isfinite(result.rest_time).all())
    ((100,), True)
    """
    require_scene(scene)
    inputs = _core.RolloutInputs(scene._core)
    _set_starts(inputs, scene, True, "poses", poses)
    _set_starts(inputs, scene, False, "velocities", velocities)
    for name, values in (("mass", mass), ("moment_of_inertia", moment_of_inertia)):
        _vary_bodies(inputs, scene, name, values)
    for name, laws in (("friction", friction), ("static_friction", static_friction), ("restitution", restitution)):
        _vary_laws(inputs, name, laws)
    if gravity is not None:
        inputs.set_gravity(gravity)
    inputs.finish()
    line = ProgressLine() if progress else None
    settings = {
        "step_size": step_size,
        "duration": duration,
        "every": every,
        "solver": solver,
        "num_sweeps": num_sweeps,
        "rest_speed": rest_speed,
        "region": region,
        "threads": threads,
        "progress": None if line is None else partial(_show, line, inputs.count),
    }
    try:
        fields = inputs.run(settings)
    finally:
        if line is not None:
            line.clear()
    return Rollout(inputs, fields)


def _show(line: ProgressLine, count: int, done: int) -> None:
    line.show(done / count, f"{done} of {count}")


def _set_starts(inputs: _core.RolloutInputs, scene: Scene, is_pose: bool, name: str, values: OfBodies | None) -> None:
    if isinstance(values, Mapping):
        for body, rows in values.items():
            inputs.set_start_of(is_pose, index_of(scene, body), f"{name}[{body!r:.40}]", rows)
    elif values is not None:
        inputs.set_starts(is_pose, name, values)


def _vary_bodies(inputs: _core.RolloutInputs, scene: Scene, name: str, values: OfBodies | None) -> None:
    if isinstance(values, Mapping):
        for body, numbers in values.items():
            inputs.vary(name, index_of(scene, body), f"{name}[{body!r:.40}]", numbers)
    elif values is not None:
        dynamic = [body.index for body in scene.bodies if body.kind == "dynamic"]
        if len(dynamic) != 1:
            raise ValueError(
                f'{name}: must be a dict of bodies, like {{"box": ...}}, in a scene of {len(dynamic)} dynamic bodies'
            )
        inputs.vary(name, dynamic[0], name, values)


def _vary_laws(inputs: _core.RolloutInputs, name: str, laws: OfMaterials | None) -> None:
    if isinstance(laws, Mapping):
        for key, numbers in laws.items():
            materials = key if isinstance(key, tuple) else (key, None)
            if len(materials) != 2:
                raise ValueError(f"{name}: must be of a material, or of a pair of them, got {key!r:.40}")
            a, b = (m.name if isinstance(m, Material) else m for m in materials)
            inputs.vary_law(name, a, b, f"{name}[{key!r:.40}]", numbers)
    elif laws is not None:
        inputs.vary_all_laws(name, laws)
