"""`Scene`: bodies, the fixed world, materials, gravity."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, Union

from numpy.typing import ArrayLike

from tumble import _core
from tumble._core import Shape
from tumble._bodies import Body, ContactLaw, Knot, Material, Part, Vector, Wrench
from tumble._files import complete_file
from tumble._shapes import Angle

Shapes = Union[Shape, Part, Iterable[Union[Shape, Part]]]
MaterialName = Union[str, Material, None]


class Scene:
    """What a simulation starts from. It grows by the ``add_`` methods, or is read from a file by `load`.

    Units are SI, y points up, angles grow counter-clockwise and are numbers in rad or text like "30 deg". Arguments,
    defaults and allowed ranges are those of scene files (docs/scenes.md). A method that refuses its arguments leaves
    the scene as it was. Scenes compare equal if everything in them is equal.

    Parameters
    ----------
    title : str
    gravity : array_like, shape (2,)
        [m/s^2]
    step_size : float
        Of a simulation that is told no other [s].
    duration : float
        The same [s].

    Attributes
    ----------
    title, gravity, step_size, duration
        As above; they may be set.
    bodies : tuple of Body
    materials : mapping from names to Material

    >>> import tumble
    >>> scene = tumble.Scene(gravity=(0, -9.81))
    >>> wood = scene.add_material("wood", friction=0.3, restitution=0.5)
    >>> floor = scene.add_fixed(tumble.half_plane(), name="floor", material=wood)
    >>> box = scene.add_body(tumble.square(0.2), mass=0.3, name="box", position=(0, 1.5), angle="30 deg", material=wood)
    >>> round(box.moment_of_inertia, 12)
    0.002
    >>> scene["box"].position
    (0.0, 1.5)
    """

    __slots__ = ("_core",)
    __hash__ = None  # type: ignore[assignment]  # it may change

    def __init__(
        self,
        title: str = "",
        *,
        gravity: ArrayLike = (0.0, -9.81),
        step_size: float = 1e-3,
        duration: float = 1.0,
    ) -> None:
        self._core = _core.Scene()
        self.title = title
        self._core.gravity = gravity
        self.step_size = step_size
        self.duration = duration

    # Files and texts.

    @classmethod
    def _of(cls, core: _core.Scene) -> Scene:
        scene = cls.__new__(cls)
        scene._core = core
        return scene

    @classmethod
    def parse(cls, text: str | bytes, name: str = "scene") -> Scene:
        """The scene of a TOML text.

        Parameters
        ----------
        text : str or bytes
            As docs/scenes.md describes it.
        name : str
            What error messages call the text, usually the name of a file.

        Raises
        ------
        ValueError
            "name:line:column: field: what is allowed, what is there"

        >>> Scene.parse("tumble = 1\\ngravty = [0, 0]")
        Traceback (most recent call last):
        ValueError: scene:2:1: 'gravty': unknown key; did you mean 'gravity'?
        """
        if not isinstance(text, (str, bytes)):
            raise TypeError(f"text: must be text, got {type(text).__name__}; a file is read by Scene.load")
        return cls._of(_core.Scene.parse(text.encode() if isinstance(text, str) else text, name))

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """The scene of a TOML file of up to 64 MiB.

        Raises
        ------
        OSError
            If the file cannot be read.
        ValueError
            As `parse`.
        """
        with open(path, "rb") as file:
            text = file.read(_core.MAX_SCENE_BYTES + 1)
        return cls.parse(text, os.fsencode(path).decode(errors="replace"))

    def to_toml(self) -> str:
        """The text of the scene, which `parse` reads back to an equal scene, bit for bit."""
        return self._core.to_toml()

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write `to_toml` to a file; an existing one is replaced, once the new one is complete.

        Returns
        -------
        Path

        Raises
        ------
        OSError
            If the file cannot be written.
        """
        target = Path(path)
        with complete_file(target) as unfinished:
            unfinished.write_text(self.to_toml(), encoding="utf-8")
        return target

    # What there is.

    @property
    def title(self) -> str:
        return self._core.title

    @title.setter
    def title(self, value: str) -> None:
        self._core.title = value

    @property
    def gravity(self) -> Vector:
        vector: Vector = self._core.gravity
        return vector

    @gravity.setter
    def gravity(self, value: Vector) -> None:
        self._core.gravity = value

    @property
    def step_size(self) -> float:
        return self._core.step_size

    @step_size.setter
    def step_size(self, value: float) -> None:
        self._core.step_size = value

    @property
    def duration(self) -> float:
        return self._core.duration

    @duration.setter
    def duration(self, value: float) -> None:
        self._core.duration = value

    def __len__(self) -> int:
        return len(self._core)

    def __getitem__(self, body: str | int) -> Body:
        """The body of this name or index."""
        return self._body(self._core.find_body(body))

    def __iter__(self) -> Iterator[Body]:
        return (self._body(i) for i in range(len(self)))

    def __contains__(self, name: object) -> bool:
        try:
            return isinstance(name, str) and self._core.find_body(name) >= 0
        except ValueError:
            return False

    @property
    def bodies(self) -> tuple[Body, ...]:
        return tuple(self)

    @property
    def materials(self) -> Mapping[str, Material]:
        return MappingProxyType({name: Material(name, ContactLaw(*law)) for name, *law in self._core.materials()})

    def contact_law(self, a: str | Material, b: str | Material) -> ContactLaw:
        """The law between two materials: that of their pair, or else the geometric mean of each coefficient."""
        return ContactLaw(*self._core.law(_name_of(a), _name_of(b)))

    def check(self) -> list[str]:
        """What is allowed and yet probably not meant, a line each: bodies that overlap at the start, that nothing will
        stop from falling for ever, that move far in one step; more steps than a simulation takes.

        >>> import tumble
        >>> scene = tumble.Scene()
        >>> box = scene.add_body(tumble.square(0.2), mass=1, name="box")
        >>> for line in scene.check():
        ...     print(line)
        nothing is below box: it falls for ever
        """
        return self._core.check()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scene):
            return NotImplemented
        return self._core == other._core

    def __repr__(self) -> str:
        title = f"{self.title!r}, " if self.title else ""
        return f"<Scene: {title}{len(self)} bodies, {len(self._core.materials())} materials>"

    def copy(self) -> Scene:
        """A scene of its own with the same content."""
        return Scene._of(self._core.copy())

    __copy__ = copy

    def __deepcopy__(self, memo: Any) -> Scene:
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        return Scene.parse, (self.to_toml(),)

    # What comes in.

    def add_material(
        self,
        name: str,
        *,
        friction: float = 0.5,
        static_friction: float | None = None,
        restitution: float = 0.0,
    ) -> Material:
        """Add a material. Bodies that name none have "default": friction 0.5, restitution 0, unless that is added first.

        Parameters
        ----------
        name : str
            Differs from all others.
        friction : float
            Coefficient while two surfaces of this material slide [-], 0 to 1e6.
        static_friction : float, optional
            Coefficient while they stick [-], >= `friction`; that of `friction` if left out.
        restitution : float
            Speed of separation over speed of approach [-], 0 to 1.
        """
        self._core.add_material(name, friction, static_friction, restitution)
        return self.materials[name]

    def add_pair(
        self,
        a: str | Material,
        b: str | Material,
        *,
        friction: float | None = None,
        static_friction: float | None = None,
        restitution: float | None = None,
    ) -> ContactLaw:
        """Give two materials a law of their own.

        Parameters
        ----------
        a, b : str or Material
        friction, static_friction, restitution : float, optional
            As in `add_material`. What is left out is the geometric mean of the two, `static_friction` that of
            `friction` if this is given.

        >>> scene = Scene()
        >>> rubber, steel = scene.add_material("rubber", friction=0.9), scene.add_material("steel", friction=0.4)
        >>> round(scene.contact_law(rubber, steel).friction, 12)
        0.6
        >>> scene.add_pair(rubber, steel, friction=0.7)
        ContactLaw(friction=0.7, static_friction=0.7, restitution=0.0)
        """
        self._core.add_pair(_name_of(a), _name_of(b), friction, static_friction, restitution)
        return self.contact_law(a, b)

    def add_body(
        self,
        shape: Shapes,
        *,
        density: float | None = None,
        mass: float | None = None,
        moment_of_inertia: float | None = None,
        centre_of_mass: ArrayLike | None = None,
        name: str | None = None,
        position: ArrayLike = (0.0, 0.0),
        angle: Angle = 0.0,
        velocity: ArrayLike = (0.0, 0.0),
        angular_velocity: float = 0.0,
        material: MaterialName = None,
        surface_speed: float = 0.0,
        linear_damping: float = 0.0,
        angular_damping: float = 0.0,
        wrenches: Iterable[Wrench] = (),
    ) -> Body:
        """Add a body that forces move.

        Parameters
        ----------
        shape : Shape, Part, or several of these
        density : float
            Mass per area [kg/m^2]. Either this or `mass`.
        mass : float
            [kg]
        moment_of_inertia : float, optional
            About the centre of mass [kg m^2]; that of `mass` spread evenly if left out.
        centre_of_mass : array_like, shape (2,), optional
            In the frame that the shape is drawn in [m], beside `moment_of_inertia`; the centroid if left out.
        name : str, optional
            Differs from all others.
        position : array_like, shape (2,)
            Where the origin that the shape is drawn about starts [m].
        angle : float or str
            About that origin [rad, or "30 deg"].
        velocity : array_like, shape (2,)
            Of the centre of mass [m/s].
        angular_velocity : float
            [rad/s]
        material : str or Material, optional
            Of all parts that name none; "default" if left out.
        surface_speed : float
            Of a conveyor: its surface runs along itself, to the right on top [m/s].
        linear_damping, angular_damping : float
            Force -linear_damping mass velocity, torque -angular_damping moment_of_inertia angular_velocity [1/s].
        wrenches : sequence of Wrench
            Forces and torques from a time on.

        Returns
        -------
        Body
            `position` there is that of the centre of mass.

        Raises
        ------
        ValueError, TypeError
            One line that names the argument, the value and what is allowed.

        >>> import tumble
        >>> scene = tumble.Scene()
        >>> hammer = scene.add_body(
        ...     [tumble.rectangle(0.05, 0.5), tumble.Part(tumble.rectangle(0.25, 0.125), position=(0, 0.3125))],
        ...     density=40,
        ... )
        >>> round(hammer.mass, 12)
        2.25
        >>> scene.add_body(tumble.square(0.2), mass=-1)
        Traceback (most recent call last):
        ValueError: mass: must be in [1e-60, 1e+60] kg, got -1
        """
        fields = {
            "density": density,
            "mass": mass,
            "moment_of_inertia": moment_of_inertia,
            "centre_of_mass": centre_of_mass,
            "velocity": velocity,
            "angular_velocity": angular_velocity,
            "linear_damping": linear_damping,
            "angular_damping": angular_damping,
            "wrenches": _tuples(wrenches, "wrenches", Wrench, ("time", "force", "torque")),
        }
        return self._add("dynamic", shape, name, position, angle, material, surface_speed, fields)

    def add_fixed(
        self,
        shape: Shapes,
        *,
        name: str | None = None,
        position: ArrayLike = (0.0, 0.0),
        angle: Angle = 0.0,
        material: MaterialName = None,
        surface_speed: float = 0.0,
    ) -> Body:
        """Add a body that nothing moves: ground, walls, ramps, conveyors. Arguments as in `add_body`."""
        return self._add("fixed", shape, name, position, angle, material, surface_speed, {})

    def add_kinematic(
        self,
        shape: Shapes,
        *,
        name: str | None = None,
        position: ArrayLike | None = None,
        angle: Angle | None = None,
        velocity: ArrayLike = (0.0, 0.0),
        angular_velocity: float = 0.0,
        motion: Iterable[Knot] = (),
        material: MaterialName = None,
        surface_speed: float = 0.0,
    ) -> Body:
        """Add a body that moves as it is told, whatever it meets: a pusher, a tilting table.

        Parameters
        ----------
        velocity, angular_velocity
            Kept for ever [m/s, rad/s]; `position` moves, and the body turns about it.
        motion : sequence of Knot
            In place of a velocity: between two knots it moves with constant velocity, before the first and after the
            last one it stands still.
        others
            As in `add_body`. A body with `motion` starts at its first knot: `position` and `angle` may be left out,
            and must not differ from it.

        >>> import tumble
        >>> scene = tumble.Scene()
        >>> motion = [tumble.Knot(1), tumble.Knot(6, angle="25 deg")]  # from 1 s to 6 s it tilts by 25 degrees
        >>> scene.add_kinematic(tumble.rectangle(2, 0.1), name="table", motion=motion).kind
        'kinematic'
        """
        fields = {
            "velocity": velocity,
            "angular_velocity": angular_velocity,
            "motion": _tuples(motion, "motion", Knot, ("time", "position", "angle")),
        }
        return self._add("kinematic", shape, name, position, angle, material, surface_speed, fields)

    def _add(
        self,
        kind: str,
        shape: Shapes,
        name: str | None,
        position: ArrayLike | None,
        angle: Angle | None,
        material: MaterialName,
        surface_speed: float,
        fields: dict[str, Any],
    ) -> Body:
        fields.update(
            name=name, position=position, angle=angle, material=_name_of(material), surface_speed=surface_speed
        )
        return self._body(self._core.add_body(kind, _parts_of(shape), fields))

    def _body(self, index: int) -> Body:
        fields = self._core.body(index)
        fields["parts"] = tuple(Part(shape, material=name, surface_speed=speed) for shape, name, speed in fields["parts"])
        fields["motion"] = tuple(Knot(*knot) for knot in fields["motion"])
        fields["wrenches"] = tuple(Wrench(*wrench) for wrench in fields["wrenches"])
        return Body(index=index, **fields)


def require_scene(scene: Any) -> None:
    """Raise TypeError for anything but a scene."""
    if not isinstance(scene, Scene):
        raise TypeError(f"scene: must be a tumble.Scene, got {type(scene).__name__}; a file is read by tumble.Scene.load")


def _name_of(material: Any) -> Any:
    return material.name if isinstance(material, Material) else material


def _parts_of(shape: Any) -> list[tuple[Any, ...]]:
    if isinstance(shape, (Shape, Part)):
        shape = [shape]
    elif not isinstance(shape, Iterable) or isinstance(shape, (str, bytes, Mapping)):
        raise TypeError(f"shape: must be a shape like tumble.square(0.2), or a list of them, got {shape!r:.40}")
    parts = (part if isinstance(part, Part) else Part(part) for part in shape)
    return [(p.shape, p.position, p.angle, _name_of(p.material), p.surface_speed) for p in parts]


def _tuples(entries: Any, field: str, kind: type, names: tuple[str, ...]) -> list[tuple[Any, ...]]:
    if isinstance(entries, kind) or not isinstance(entries, Iterable):
        raise TypeError(f"{field}: must be a list of tumble.{kind.__name__}, got {entries!r:.40}")
    tuples = []
    for i, entry in enumerate(entries):
        if not isinstance(entry, kind):
            raise TypeError(f"{field}[{i}]: must be a tumble.{kind.__name__}, got {entry!r:.40}")
        tuples.append(tuple(getattr(entry, name) for name in names))
    return tuples
