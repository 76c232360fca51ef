"""`simulate`: a scene from its start to its end."""

from __future__ import annotations

import warnings

from tumble import _core
from tumble._progress import ProgressLine
from tumble._scene import Scene, require_scene
from tumble._trajectory import Trajectory

_SECONDS_BETWEEN_LOOKS = 0.05  # for Ctrl-C and the progress line


class SimulationWarning(UserWarning):
    """A run created energy, or ended early because a step could not be solved."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during `simulate`; `trajectory` holds what was computed until then, its last sample the state it was in."""

    def __init__(self, trajectory: Trajectory) -> None:
        super().__init__(f"interrupted at {trajectory.time[-1]:g} s; .trajectory of this exception holds the run so far")
        self.trajectory = trajectory


def simulate(
    scene: Scene,
    *,
    step_size: float | None = None,
    duration: float | None = None,
    sample_every: int = 1,
    solver: str = "exact",
    num_sweeps: int = 24,
    contacts: bool = True,
    progress: bool = False,
) -> Trajectory:
    """Simulate a scene.

    Other Python threads run meanwhile, so that ``concurrent.futures.ThreadPoolExecutor`` runs many scenes side by side.

    Parameters
    ----------
    scene : Scene
    step_size, duration : float, optional
        [s], 1e-12 to 1e12, up to 1e9 steps; those of the scene if left out. The last step reaches `duration` or ends
        less than a step behind it.
    sample_every : int
        Steps from one sample to the next. The last step is always one.
    solver : str
        "exact": the LCP of each step to a residual of 1e-10 and mostly to round-off, or a status that says it is not.
        "fast": the same where up to 50 contacts hang together; where more do, up to `num_sweeps` sweeps of block
        Gauss-Seidel. For many bodies at once.
    num_sweeps : int
        Of the fast solver, at most.
    contacts : bool
        Keep the contacts of every step.
    progress : bool
        Show on the terminal how far it is, if standard error is one and it takes longer than a second.

    Returns
    -------
    Trajectory

    Raises
    ------
    ValueError
        Naming the argument, its value and the allowed range.
    Interrupted
        (a KeyboardInterrupt) at Ctrl-C. Its `trajectory` holds what was computed; in an interactive session it is
        ``sys.last_value.trajectory`` afterwards.

    Warns
    -----
    SimulationWarning
        If a step created energy, or could not be solved: the run ends with that step and its status.

    >>> import tumble
    >>> scene = tumble.Scene(duration=0.3)
    >>> ball = scene.add_body(tumble.disc(0.1), mass=1, name="ball", position=(0, 2), velocity=(3, 0))
    >>> trajectory = tumble.simulate(scene)
    >>> trajectory
    <Trajectory: 1 bodies, 301 samples to 0.3 s, complete>
    >>> x, y, angle = trajectory["ball"].pose[-1]
    >>> print(f"{x:.6f} {y:.6f}")  # 3 t, 2 - g t^2 / 2
    0.900000 1.558550
    """
    require_scene(scene)
    run = _core.Run(scene._core, step_size, duration, sample_every, solver, num_sweeps, contacts)
    line = ProgressLine() if progress else None
    try:
        while not run.is_done:
            run.run_for(_SECONDS_BETWEEN_LOOKS)
            if line is not None:
                line.show(run.step / run.num_steps, f"{run.time:.4g} s")
    except KeyboardInterrupt:
        raise Interrupted(Trajectory(run.finish(), contacts)) from None
    finally:
        if line is not None:
            line.clear()
    trajectory = Trajectory(run.finish(), contacts)
    for text in _remarks(trajectory):
        warnings.warn(text, SimulationWarning, stacklevel=2)
    return trajectory


def _remarks(trajectory: Trajectory) -> list[str]:
    texts = []
    if trajectory.status != "solved":
        texts.append(
            f"the run ended at {trajectory.time[-1]:g} s: step {trajectory.num_steps} is {trajectory.status}, "
            f"residual {trajectory.residual:.1e}"
        )
    if trajectory.num_inexact_steps > 0:
        texts.append(
            f"{trajectory.num_inexact_steps} steps were not solved, the first at {trajectory.first_inexact:g} s: "
            f"contact laws are off by up to {trajectory.residual:.1e} of the speeds"
        )
    if trajectory.num_creating_steps > 0:
        texts.append(
            f"{trajectory.num_creating_steps} steps created {trajectory.created_energy:.3g} J in all, the first at "
            f"{trajectory.first_creation:g} s"
        )
    return texts
