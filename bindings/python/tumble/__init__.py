"""Tumble: planar rigid bodies under frictional contact, one linear complementarity problem per step.

Scenes
------
Scene
    Bodies, the fixed world, materials, gravity; from files or built piece by piece.
square, rectangle, regular_polygon, polygon, disc, ellipse, capsule, segment, half_plane, terrain
    Shapes.
simulate
    A scene from its start to its end, as a `Trajectory`.
rollout
    The same with many starts, masses, contact laws at once, over all cores, as a `Rollout`.
Simulation
    A scene step by step, with forces and motions from outside.
Part, Knot, Wrench, Material, ContactLaw, Body
    What a scene is made of.

Modules
-------
drop
    The document's model: a square falls on the ground (`get_contacts`, `form_lcp`, `solve_LCP`, `step`, `simulate`,
    `render`), one drop at a time or many at once (`simulate_batch`).
sweep
    Many drops as one question, from a spec to a summary and pictures (import it by its name: ``import tumble.sweep``).
lcp
    Solvers for linear complementarity problems of any origin.
course
    ``python3 -m tumble.course new DIR`` writes a ready assignment.
grade
    ``python3 -m tumble.grade FILE`` grades a submission.
"""

from tumble import drop, lcp
from tumble._batch import simulate_batch
from tumble._bodies import Body, ContactLaw, Knot, Material, Part, Wrench
from tumble._core import NoSolution, Shape, __version__
from tumble._scene import Scene
from tumble._shapes import (
    capsule,
    disc,
    ellipse,
    half_plane,
    polygon,
    rectangle,
    regular_polygon,
    segment,
    square,
    terrain,
)
from tumble._rollout import BodyRollout, Rollout, rollout
from tumble._simulate import Interrupted, SimulationWarning, simulate
from tumble._simulation import BodyState, Simulation
from tumble._trajectory import BodyTrajectory, Trajectory

__all__ = [
    "Body",
    "BodyRollout",
    "BodyState",
    "BodyTrajectory",
    "ContactLaw",
    "Interrupted",
    "Knot",
    "Material",
    "NoSolution",
    "Part",
    "Rollout",
    "Scene",
    "Shape",
    "Simulation",
    "SimulationWarning",
    "Trajectory",
    "Wrench",
    "__version__",
    "capsule",
    "disc",
    "drop",
    "ellipse",
    "half_plane",
    "lcp",
    "polygon",
    "rectangle",
    "regular_polygon",
    "rollout",
    "segment",
    "simulate",
    "simulate_batch",
    "square",
    "terrain",
]
