"""What a scene is made of: materials, parts, motions, forces, bodies."""

from __future__ import annotations

from dataclasses import dataclass

from numpy.typing import ArrayLike

from tumble._core import Shape
from tumble._shapes import Angle

Vector = tuple[float, float]


@dataclass(frozen=True)
class ContactLaw:
    """How two surfaces touch.

    Attributes
    ----------
    friction, static_friction : float
        Coefficients while the surfaces slide and while they stick [-].
    restitution : float
        Speed of separation over speed of approach [-], 0 to 1.
    """

    friction: float
    static_friction: float
    restitution: float


@dataclass(frozen=True)
class Material:
    """A name, and the `law` of two surfaces of this material."""

    name: str
    law: ContactLaw


@dataclass(frozen=True)
class Part:
    """One shape of a body that has several.

    Attributes
    ----------
    shape : Shape
    position : (x, y)
        Where the origin of the shape lies in the frame of the body [m].
    angle : float or str
        About that origin [rad, or "30 deg"].
    material : str or Material, optional
        That of the body if left out.
    surface_speed : float, optional
        [m/s]; that of the body if left out.
    """

    shape: Shape
    position: ArrayLike = (0.0, 0.0)
    angle: Angle = 0.0
    material: str | Material | None = None
    surface_speed: float | None = None


@dataclass(frozen=True)
class Knot:
    """Where a kinematic body is at `time` [s]. What is left out is that of the knot before, first that of the body."""

    time: float
    position: ArrayLike | None = None
    angle: Angle | None = None


@dataclass(frozen=True)
class Wrench:
    """Force [N] at the centre of mass, in directions of the world, and torque [N m] from `time` [s] until the next one."""

    time: float = 0.0
    force: ArrayLike = (0.0, 0.0)
    torque: float = 0.0


@dataclass(frozen=True)
class Body:
    """A body of a scene as the simulation sees it; its frame has its origin in the centre of mass.

    Attributes
    ----------
    index : int
        Its place among the bodies of the scene.
    name, kind : str
        The kind is "dynamic", "kinematic" or "fixed".
    parts : tuple of Part
        Shapes in the frame of the body.
    mass, moment_of_inertia : float
        [kg, kg m^2], about the centre of mass; 0 unless dynamic.
    position, angle
        Pose at the start [m, rad]: of the centre of mass, or the point that a kinematic body turns about.
    velocity, angular_velocity
        At the start [m/s, rad/s].
    motion : tuple of Knot
    wrenches : tuple of Wrench
    linear_damping, angular_damping : float
        [1/s]
    """

    index: int
    name: str
    kind: str
    parts: tuple[Part, ...]
    mass: float
    moment_of_inertia: float
    position: Vector
    angle: float
    velocity: Vector
    angular_velocity: float
    motion: tuple[Knot, ...]
    wrenches: tuple[Wrench, ...]
    linear_damping: float
    angular_damping: float
