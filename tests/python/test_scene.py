"""tumble.Scene: what the builders make is what scene files say, and bad input is refused in one line."""

import copy
import os
import pickle
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomllib
import tumble
from scene_samples import ROOT, refuse_in_one_line
from tumble import Knot, Part, Scene, Wrench

FILES = sorted((ROOT / "scenes").glob("*.toml"))


def shape_of(table: dict[str, Any]) -> tumble.Shape:
    """The builder's shape of a table of a scene file."""
    table = dict(table)
    rounding = {"rounding": table.pop("rounding")} if "rounding" in table else {}
    if "half_plane" in table:
        return tumble.half_plane(table["half_plane"], table.get("offset", 0.0))
    [(kind, value)] = table.items()
    if kind == "regular":
        return tumble.regular_polygon(*value, **rounding)
    if kind in ("rectangle", "ellipse", "capsule", "segment"):
        return getattr(tumble, kind)(*value, **rounding)
    return getattr(tumble, kind)(value, **rounding)


def parts_of(table: dict[str, Any]) -> Any:
    if "shape" in table:
        return shape_of(table.pop("shape"))
    return [Part(shape_of(part.pop("shape")), **part) for part in table.pop("parts")]


def places_of(copies: Any) -> list[tuple[float, float]]:
    """How far each copy is moved, the first table counting fastest."""
    tables = copies if isinstance(copies, list) else [copies]
    rows = [[(i * table["step"][0], i * table["step"][1]) for i in range(table["count"])] for table in tables]
    if len(rows) == 1:
        return rows[0]
    return [(a[0] + b[0], a[1] + b[1]) for b in rows[1] for a in rows[0]]


def build(text: str) -> Scene:
    """The scene of a TOML text by the methods of Scene alone."""
    data = tomllib.loads(text)
    scene = Scene(**{key: data[key] for key in ("title", "gravity", "step_size", "duration") if key in data})
    for name, law in data.get("materials", {}).items():
        scene.add_material(name, **law)
    for pair in data.get("pairs", []):
        scene.add_pair(*pair.pop("materials"), **pair)
    add = {"dynamic": scene.add_body, "kinematic": scene.add_kinematic, "fixed": scene.add_fixed}
    for table in data.get("bodies", []):
        kind, copies, name = table.pop("kind", "dynamic"), table.pop("copies", None), table.pop("name", None)
        if "motion" in table:
            table["motion"] = [Knot(**knot) for knot in table["motion"]]
        if "wrenches" in table:
            table["wrenches"] = [Wrench(**wrench) for wrench in table["wrenches"]]
        shape, position = parts_of(table), table.pop("position", None)
        if copies is None:
            add[kind](shape, name=name, **({"position": position} if position else {}), **table)
            continue
        for k, (x, y) in enumerate(places_of(copies), start=1):
            at = (position or [0, 0])[0] + x, (position or [0, 0])[1] + y
            add[kind](shape, name=f"{name}{k}" if name else None, position=at, **table)
    return scene


def random_text(rng: random.Random) -> str:
    """A scene file with all that one may hold."""

    def number(low: float = -1.0, high: float = 1.0) -> str:
        return repr(rng.choice([rng.uniform(low, high), round(rng.uniform(low, high), 1)]) or high)

    def vector() -> str:
        return f"[{number()}, {number()}]"

    def size() -> str:
        return repr(rng.uniform(0.01, 1.0))

    def angle() -> str:
        return rng.choice([number(), f'"{number(-90, 90)} deg"'])

    def law() -> str:
        friction = rng.uniform(0.0, 1.0)
        keys = [f"friction = {friction}", f"static_friction = {friction + rng.random()}", f"restitution = {rng.random()}"]
        return "\n".join(keys[: rng.randrange(4)])

    def shape(kind: str) -> str:
        shapes = [
            f"square = {size()}",
            "square = 0.5, rounding = 0.1",
            f"rectangle = [{size()}, {size()}]",
            f"regular = [{rng.randrange(3, 9)}, {size()}]",
            f"polygon = [[0, 0], [{size()}, 0], [0, {size()}]], rounding = {size()}",
            f"disc = {size()}",
            f"ellipse = [{size()}, {size()}]",
            f"capsule = [{size()}, {size()}]",
        ]
        if kind != "dynamic":
            shapes += ["segment = [[0, 0], [1, 0.5]]", "terrain = [[-1, 0], [0, 0.25], [1, 0]]"]
        if kind == "fixed":
            shapes += [f"half_plane = [{size()}, 1], offset = {number()}"]
        return "{ " + rng.choice(shapes) + " }"

    names = ["wood", "a b", 'quote"d', "bürste", "default"][: rng.randrange(6)]
    lines = ["tumble = 1", f"gravity = {vector()}", f"step_size = {size()}", 'title = "Größe \\"x\\""'][: rng.randrange(1, 5)]
    for name in names:
        lines += [f"[materials.'{name}']", law()]
    if len(names) > 1:
        lines += ["[[pairs]]", f"materials = ['{names[1]}', '{names[0]}']", law()]
    for i in range(rng.randrange(6)):
        kind = rng.choice(["dynamic", "kinematic", "fixed"])
        lines += ["[[bodies]]", f'kind = "{kind}"']
        if rng.random() < 0.5:
            lines += [f'name = "body {i}"']
        has_motion = kind == "kinematic" and rng.random() < 0.5
        if not has_motion:
            lines += [f"position = {vector()}", f"angle = {angle()}"]
        if names and rng.random() < 0.5:
            lines += [f"material = '{rng.choice(names)}'"]
        if rng.random() < 0.3:
            lines += [f"surface_speed = {number()}"]
        if rng.random() < 0.5:
            lines += [f"shape = {shape(kind)}"]
        else:
            lines += [f"parts = [{{ shape = {shape(kind)} }}, {{ shape = {shape(kind)}, position = {vector()}, angle = {angle()} }}]"]
        if kind == "dynamic":
            lines += [
                rng.choice(
                    [
                        f"density = {size()}",
                        f"mass = {size()}",
                        f"mass = {size()}\nmoment_of_inertia = {size()}",
                        f"mass = {size()}\nmoment_of_inertia = {size()}\ncentre_of_mass = {vector()}",
                    ]
                )
            ]
            if rng.random() < 0.5:
                lines += [f"linear_damping = {size()}", f"angular_damping = {size()}"]
                lines += [f"wrenches = [{{ force = {vector()} }}, {{ time = {size()}, torque = {number()} }}]"]
        if has_motion:
            lines += [f"motion = [{{ time = 0.5 }}, {{ time = 1, angle = {angle()} }}, {{ time = 2, position = {vector()} }}]"]
        elif kind != "fixed":
            lines += [f"velocity = {vector()}", f"angular_velocity = {number()}"]
    return "\n".join(lines)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_builders_make_the_scenes_of_the_files(file: Path, tmp_path: Path) -> None:
    scene = Scene.load(file)
    assert build(file.read_text()) == scene
    assert Scene.parse(scene.to_toml()) == scene
    assert Scene.load(scene.save(tmp_path / "again.toml")) == scene


def test_there_are_scenes() -> None:
    assert len(FILES) >= 28


@pytest.mark.parametrize("seed", range(200))
def test_builders_make_the_scenes_of_random_files(seed: int) -> None:
    text = random_text(random.Random(seed))
    scene = Scene.parse(text)
    assert build(text) == scene, text
    assert Scene.parse(scene.to_toml()) == scene


def test_a_scene_written_by_hand_is_the_documents_drop() -> None:
    scene = Scene("A square dropped on the floor", duration=4)
    wood = scene.add_material("wood", friction=0.3, restitution=0.5)
    scene.add_fixed(tumble.half_plane(), name="floor", material=wood)
    box = scene.add_body(
        tumble.square(0.2), mass=0.3, name="square", position=(0, 1.5), angle=np.deg2rad(30), velocity=(0, -0.2), material="wood"
    )
    assert scene == Scene.load(ROOT / "scenes/drop.toml")
    assert (box.index, box.name, box.kind, box.mass) == (1, "square", "dynamic", 0.3)
    assert box.position == (0.0, 1.5) and box.velocity == (0.0, -0.2)
    assert box.moment_of_inertia == pytest.approx(0.3 * 0.2**2 / 6, rel=1e-15)  # m l^2 / 6, a few roundings
    assert scene["square"] == scene[1] == scene[-1] == scene.bodies[1] == box
    assert [body.name for body in scene] == ["floor", "square"] and len(scene) == 2
    assert "floor" in scene and "wall" not in scene


def test_defaults_are_those_of_scene_files() -> None:
    scene = Scene()
    scene.add_body(tumble.disc(0.5), density=1)
    scene.add_fixed(tumble.disc(0.5))
    scene.add_kinematic(tumble.disc(0.5))
    lines = ["tumble = 1"]
    for kind in ("dynamic\"\ndensity = 1 #", "fixed", "kinematic"):
        lines += ["[[bodies]]", "shape = { disc = 0.5 }", f'kind = "{kind}"']
    assert scene == Scene.parse("\n".join(lines))
    material = Scene()
    material.add_material("m")
    assert material == Scene.parse("tumble = 1\n[materials.m]")
    assert material.materials["m"].law == tumble.ContactLaw(0.5, 0.5, 0.0)


def test_scenes_that_differ_are_not_equal() -> None:
    scene = Scene.load(ROOT / "scenes/drop.toml")
    for change in (
        lambda s: setattr(s, "title", "x"),
        lambda s: setattr(s, "gravity", (0, -9.8)),
        lambda s: setattr(s, "step_size", 2e-3),
        lambda s: setattr(s, "duration", 5),
        lambda s: s.add_material("ice"),
        lambda s: s.add_body(tumble.disc(1), density=1),
    ):
        other = scene.copy()
        assert other == scene
        change(other)
        assert other != scene
    assert scene != "a text"


@pytest.mark.parametrize("twin", [copy.copy, copy.deepcopy, lambda s: pickle.loads(pickle.dumps(s)), Scene.copy])
def test_copies_are_equal_and_apart(twin) -> None:
    scene = Scene.load(ROOT / "scenes/compound.toml")
    other = twin(scene)
    assert other == scene
    other.gravity = (0, 0)
    assert other != scene and scene.gravity == (0.0, -9.81)


def test_laws_are_mixed_or_given() -> None:
    scene = Scene()
    scene.add_material("a", friction=0.2, static_friction=0.8, restitution=1.0)
    scene.add_material("b", friction=0.8, restitution=0.25)
    assert scene.contact_law("a", "a") == tumble.ContactLaw(0.2, 0.8, 1.0)
    assert scene.contact_law("a", "b") == tumble.ContactLaw(pytest.approx(0.4), pytest.approx(0.8), 0.5)
    assert scene.add_pair("b", "a", restitution=0.9).restitution == 0.9
    assert scene.contact_law("a", "b") == scene.contact_law("b", "a")
    assert scene.contact_law("a", "b").friction == pytest.approx(0.4)


@pytest.mark.parametrize(
    ("shape", "area", "polar"),
    [
        (tumble.square(2), 4.0, 4 * (4 + 4) / 12),
        (tumble.rectangle(3, 2), 6.0, 6 * (9 + 4) / 12),
        (tumble.disc(2), 4 * np.pi, 8 * np.pi),
        (tumble.ellipse(3, 1), 3 * np.pi, 3 * np.pi * 10 / 4),
        (tumble.capsule(2, 1), np.pi + 4, None),
        (tumble.regular_polygon(6, 1), 1.5 * np.sqrt(3), None),
        (tumble.segment((0, 0), (1, 0)), 0.0, 0.0),
        (tumble.half_plane(), 0.0, 0.0),
    ],
    ids=str,
)
def test_shapes_know_their_moments(shape: tumble.Shape, area: float, polar: float | None) -> None:
    assert shape.area == pytest.approx(area, rel=1e-14)
    if polar is not None:
        assert shape.polar_moment == pytest.approx(polar, rel=1e-14)


@pytest.mark.parametrize(
    "shape",
    [
        tumble.square(2, rounding=0.25),
        tumble.polygon([(0, 0), (1, 0), (0, 1)]),
        tumble.disc(0.5),
        tumble.ellipse(1, 2).moved((1, 2), 0.3),
        tumble.half_plane((1, 3), 0.7),
        tumble.terrain([(0, 0), (1, 0.1), (2, 0)]),
        tumble.segment((0, 0), (1, 1)),
    ],
    ids=str,
)
def test_shapes_are_values(shape: tumble.Shape) -> None:
    twin = pickle.loads(pickle.dumps(shape))
    assert twin == shape and hash(twin) == hash(shape) and repr(twin) == repr(shape)
    assert shape.moved() == shape and shape != tumble.disc(3.0)
    assert shape.moved((1, 0)) != shape
    with pytest.raises(AttributeError):
        shape.area = 3.0  # type: ignore[misc]


def test_a_shape_gives_its_numbers() -> None:
    moved = tumble.square(2).moved((1, 0), "90 deg").asdict()
    assert moved["kind"] == "polygon" and moved["rounding"] == 0.0
    np.testing.assert_allclose(moved["vertices"], [[2, -1], [2, 1], [0, 1], [0, -1]], atol=1e-15)


def drop() -> Scene:
    return Scene.load(ROOT / "scenes/drop.toml")


BOX = tumble.square(0.2)
NAN = float("nan")


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        # shapes
        (lambda: tumble.square(0), ValueError, "side: must be in [1e-12, 1000000000000] m, got 0"),
        (lambda: tumble.square(-1), ValueError, "side: must be in [1e-12, 1000000000000] m, got -1"),
        (lambda: tumble.square(NAN), ValueError, "side: must be in [1e-12, 1000000000000] m, got nan"),
        (lambda: tumble.square("0.2"), ValueError, "side: must be a number, got '0.2'"),
        (lambda: tumble.square(None), ValueError, "side: must be a number, got None"),
        (lambda: tumble.square(1, rounding=0.6), ValueError, "rounding: must be in [0, 0.5] m, half of the shorter side, got 0.6"),
        (lambda: tumble.rectangle(1, np.inf), ValueError, "height: must be in [1e-12, 1000000000000] m, got inf"),
        (lambda: tumble.regular_polygon(2, 1), ValueError, "corners: must be in [3, 1000], got 2"),
        (lambda: tumble.regular_polygon(10**30, 1), ValueError, "corners: must be in [3, 1000], got 1001"),
        (lambda: tumble.regular_polygon(3.5, 1), ValueError, "corners: must be a whole number, got 3.5"),
        (lambda: tumble.disc(1e13), ValueError, "radius: must be in [1e-12, 1000000000000] m, got 10000000000000"),
        (lambda: tumble.ellipse(1, 1e7), ValueError, "semi_axis_x: must be within a factor 1000000 of semi_axis_y, got 1 m and 10000000 m"),
        (lambda: tumble.polygon([(0, 0), (0, 1), (1, 0)]), ValueError, "vertices: must run counter-clockwise, got clockwise; write them in the opposite order"),
        (lambda: tumble.polygon([(0, 0), (2, 0), (1, 0.5), (0, 2)]), ValueError, "vertices[2]: must be a convex corner, got a reflex one at (1, 0.5)"),
        (lambda: tumble.polygon([(0, 0), (1, NAN), (0, 1)]), ValueError, "vertices[1].y: must be in [-1000000000000, 1000000000000] m, got nan"),
        (lambda: tumble.polygon([1, 2, 3]), ValueError, "vertices: must have shape (n, 2), got (3,)"),
        (lambda: tumble.polygon([]), ValueError, "vertices: must have shape (n, 2), got (0,)"),
        (lambda: tumble.polygon("triangle"), ValueError, "vertices: must be an array of real numbers"),
        (lambda: tumble.polygon(np.random.default_rng(0).random((2000, 2))), ValueError, "vertices: must have 1 to 1000 entries, got 2000"),
        (lambda: tumble.polygon([(0, 0)]), ValueError, "rounding: must be in [1e-12, 1000000000000] m, got 0"),
        (lambda: tumble.half_plane((0, 0)), ValueError, "normal: must be a vector other than 0"),
        (lambda: tumble.half_plane((0, 1, 0)), ValueError, "normal: must have shape (2,), got (3,)"),
        (lambda: tumble.half_plane((0, NAN)), ValueError, "normal[1]: must be in [-1000000000000, 1000000000000] m, got nan"),
        (lambda: tumble.terrain([(0, 0)]), ValueError, "points: must have 2 to 100000 entries, got 1"),
        (lambda: tumble.segment((0, 0), (0, 0)), ValueError, "vertices: must reach 1e-12 m in x or y, got less"),
        (lambda: BOX.moved((0, 0), "30 grad"), ValueError, "angle: must be a number in rad or text like \"30 deg\", got '30 grad'"),
        # the scene
        (lambda: Scene(gravity=9.81), ValueError, "gravity: must have shape (2,), got ()"),
        (lambda: Scene(gravity=(0, NAN)), ValueError, "gravity[1]: must be in [-1000000000, 1000000000] m/s^2, got nan"),
        (lambda: Scene(step_size=0), ValueError, "step_size: must be in [1e-12, 1000000000000] s, got 0"),
        (lambda: Scene(duration=-1), ValueError, "duration: must be in [1e-12, 1000000000000] s, got -1"),
        (lambda: Scene(title=3), TypeError, "title: must be text, got 3"),
        (lambda: Scene(title="a\nb"), ValueError, "title: must be UTF-8 without control characters"),
        (lambda: Scene(title="\udc80"), ValueError, "title: must be valid UTF-8, got '\\udc80'"),
        (lambda: Scene.parse(3), TypeError, "text: must be text, got int"),
        (lambda: Scene.parse("tumble = 1", name=3), TypeError, "name: must be text, got 3"),
        (lambda: Scene.parse("# \udc80"), ValueError, "surrogates not allowed"),
        (lambda: Scene.parse(b"# \xff"), ValueError, "scene:1:"),
        (lambda: Scene.parse("tumble = 2"), ValueError, "scene:1:10: tumble: must be"),
        (lambda: Scene.parse("tumble = 1\nbodys = []", "my.toml"), ValueError, "my.toml:2:1: 'bodys': unknown key; did you mean 'bodies'?"),
        (lambda: Scene.load(ROOT / "scenes/none.toml"), FileNotFoundError, "none.toml"),
        # materials
        (lambda: drop().add_material("wood"), ValueError, "name: must differ from the materials before, got 'wood'"),
        (lambda: drop().add_material(""), ValueError, "name: must not be empty"),
        (lambda: drop().add_material("x" * 101), ValueError, "name: must have at most 100 bytes, got 101"),
        (lambda: drop().add_material("x", friction=-0.1), ValueError, "friction: must be in [0, 1000000], got -0.1"),
        (lambda: drop().add_material("x", friction=0.5, static_friction=0.4), ValueError, "static_friction: must be >= friction, which is 0.5, got 0.4"),
        (lambda: drop().add_material("x", restitution=1.1), ValueError, "restitution: must be in [0, 1], got 1.1"),
        (lambda: drop().add_pair("wood", "wod"), ValueError, "b: must be the name of a material, got 'wod'; did you mean 'wood'?"),
        (lambda: drop().add_pair("wood", "wood"), ValueError, "b: must be another material than a"),
        # bodies
        (lambda: drop().add_body(BOX), ValueError, "mass: a dynamic body must have a mass or a density"),
        (lambda: drop().add_body(BOX, mass=1, density=1), ValueError, "mass: must not stand beside density"),
        (lambda: drop().add_body(BOX, mass=0), ValueError, "mass: must be in [1e-60, 1e+60] kg, got 0"),
        (lambda: drop().add_body(BOX, mass=NAN), ValueError, "mass: must be in [1e-60, 1e+60] kg, got nan"),
        (lambda: drop().add_body(BOX, mass="heavy"), ValueError, "mass: must be a number, got 'heavy'"),
        (lambda: drop().add_body(BOX, density=-1), ValueError, "density: must be in [1e-30, 1e+30] kg/m^2, got -1"),
        (lambda: drop().add_body(BOX, density=1, moment_of_inertia=1), ValueError, "moment_of_inertia: must not stand beside density"),
        (lambda: drop().add_body(BOX, mass=1, centre_of_mass=(0, 0)), ValueError, "centre_of_mass: must stand beside moment_of_inertia"),
        (lambda: drop().add_body(BOX, mass=1, moment_of_inertia=0), ValueError, "moment_of_inertia: must be in [1e-60, 1e+60] kg m^2, got 0"),
        (lambda: drop().add_body(tumble.segment((0, 0), (1, 0)), mass=1), ValueError, "parts[0].shape: must have an area"),
        (lambda: drop().add_body(tumble.half_plane(), mass=1), ValueError, "shape: must"),
        (lambda: drop().add_body(BOX, mass=1, name="square"), ValueError, "name: must differ from the bodies before, got 'square'"),
        (lambda: drop().add_body(BOX, mass=1, name=7), TypeError, "name: must be text, got 7"),
        (lambda: drop().add_body(BOX, mass=1, material="wod"), ValueError, "material: must be the name of a material, got 'wod'; did you mean 'wood'?"),
        (lambda: drop().add_body(BOX, mass=1, material="glass"), ValueError, "material: must be the name of a material, got 'glass'; allowed are wood"),
        (lambda: drop().add_body(BOX, mass=1, position=(1, 2, 3)), ValueError, "position: must have shape (2,), got (3,)"),
        (lambda: drop().add_body(BOX, mass=1, position=(0, np.inf)), ValueError, "position[1]: must be in [-1000000000000, 1000000000000] m, got inf"),
        (lambda: drop().add_body(BOX, mass=1, position=np.ma.array([0, 1], mask=[0, 1])), ValueError, "position: must have no masked entry, got 1"),
        (lambda: drop().add_body(BOX, mass=1, angle="thirty"), ValueError, "angle: must be a number in rad or text like \"30 deg\", got 'thirty'"),
        (lambda: drop().add_body(BOX, mass=1, angle=1e10), ValueError, "angle: must be in [-1000000000, 1000000000] rad, got 10000000000"),
        (lambda: drop().add_body(BOX, mass=1, velocity=(1e10, 0)), ValueError, "velocity[0]: must be in [-1000000000, 1000000000] m/s, got 10000000000"),
        (lambda: drop().add_body(BOX, mass=1, angular_velocity=NAN), ValueError, "angular_velocity: must be in [-1000000000, 1000000000] rad/s, got nan"),
        (lambda: drop().add_body(BOX, mass=1, linear_damping=-1), ValueError, "linear_damping: must be in [0, 1000000000] 1/s, got -1"),
        (lambda: drop().add_body(BOX, mass=1, surface_speed=NAN), ValueError, "surface_speed: must be in [-1000000000, 1000000000] m/s, got nan"),
        (lambda: drop().add_body("box", mass=1), TypeError, "shape: must be a shape like tumble.square(0.2), or a list of them, got 'box'"),
        (lambda: drop().add_body(3, mass=1), TypeError, "shape: must be a shape like tumble.square(0.2), or a list of them, got 3"),
        (lambda: drop().add_body([BOX, "box"], mass=1), TypeError, "parts[1].shape: must be a shape like tumble.square(0.2), got 'box'"),
        (lambda: drop().add_body([], mass=1), ValueError, "parts: must have 1 to 1000 entries, got 0"),
        (lambda: drop().add_body([BOX, Part(BOX, material="wod")], mass=1), ValueError, "parts[1].material: must be the name of a material, got 'wod'"),
        (lambda: drop().add_body([BOX, Part(BOX, position=(0, NAN))], mass=1), ValueError, "parts[1].position[1]: must be in"),
        (lambda: drop().add_body(BOX, mass=1, wrenches=Wrench()), TypeError, "wrenches: must be a list of tumble.Wrench, got Wrench("),
        (lambda: drop().add_body(BOX, mass=1, wrenches=[(0, (1, 0), 0)]), TypeError, "wrenches[0]: must be a tumble.Wrench, got (0, (1, 0), 0)"),
        (lambda: drop().add_body(BOX, mass=1, wrenches=[Wrench(force=(0, NAN))]), ValueError, "wrenches[0].force[1]: must be in [-1e+60, 1e+60] N, got nan"),
        (lambda: drop().add_body(BOX, mass=1, wrenches=[Wrench(1), Wrench(1)]), ValueError, "wrenches[1].time: must be later than 1 s"),
        (lambda: drop().add_kinematic(BOX, motion=[Knot(1), Knot(0)]), ValueError, "motion[1].time: must be later than 1 s"),
        (lambda: drop().add_kinematic(BOX, motion=[Knot(0)], velocity=(1, 0)), ValueError, "velocity: must be 0 for a body with motion"),
        (lambda: drop().add_kinematic(BOX, position=(1, 0), motion=[Knot(0, (2, 0))]), ValueError, "motion[0]: must be at the pose of the body"),
        (lambda: drop().add_kinematic(tumble.half_plane()), ValueError, "shape: a half-plane must belong to a fixed body"),
        (lambda: drop()["sqare"], ValueError, "body: must be the name of a body, got 'sqare'; did you mean 'square'?"),
        (lambda: drop()[2], IndexError, "body: must be in [-2, 1], got 2"),
        (lambda: drop()[1.5], TypeError, "body: must be a name or an index, got 1.5"),
    ],
)  # fmt: skip
def test_bad_input_is_refused_in_one_line(call, error: type[Exception], message: str) -> None:
    refuse_in_one_line(call, error, message)


def test_a_refused_body_leaves_the_scene_as_it_was() -> None:
    scene = Scene()
    before = scene.copy()
    for bad in ({"mass": -1}, {"mass": 1, "wrenches": [Wrench(torque=NAN)]}, {"mass": 1, "angular_damping": -1}):
        with pytest.raises(ValueError):
            scene.add_body(BOX, name="box", **bad)
        assert scene == before
    scene.add_material("default", friction=0.1)  # the name is free: no body has been added
    scene.add_body(BOX, name="box", mass=1)
    with pytest.raises(ValueError, match="bodies without a material have it already"):
        other = Scene()
        other.add_body(BOX, mass=1)
        other.add_material("default")


def test_a_scene_is_looked_through() -> None:
    scene = drop()
    assert scene.check() == []
    scene.add_body(BOX, mass=1, name="buried", position=(5, 0))
    scene.add_body(BOX, mass=1, name="bullet", position=(9, 5), velocity=(1000, 0))
    lines = scene.check()
    assert len(lines) == 2 and "buried" in lines[0] and "0.1 m" in lines[0] and "bullet" in lines[1]


def test_saving_replaces_whole_files_or_nothing(tmp_path: Path) -> None:
    target = tmp_path / "a.toml"
    target.write_text("mine")
    scene = drop()
    assert scene.save(target) == target and Scene.load(target) == scene
    with pytest.raises(OSError):
        scene.save(tmp_path / "none" / "a.toml")
    with pytest.raises(OSError):
        scene.save(tmp_path)
    assert [file.name for file in tmp_path.iterdir()] == ["a.toml"]


def test_any_name_of_a_file_will_do(tmp_path: Path) -> None:
    for name in ("büchse.toml", b"\xff.toml"):
        path = os.path.join(os.fsencode(tmp_path), os.fsencode(name))
        drop().save(os.fsdecode(path))
        assert Scene.load(path) == Scene.load(os.fsdecode(path)) == drop()
        with open(path, "w") as file:
            file.write("x")
        with pytest.raises(ValueError, match=r"\.toml:1:"):
            Scene.load(path)


def test_a_file_that_never_ends_is_refused() -> None:
    with pytest.raises(ValueError, match="/dev/zero"):
        Scene.load("/dev/zero")


def test_many_bodies_do_not_take_long() -> None:
    scene = Scene()
    for i in range(20_000):
        scene.add_body(BOX, density=1, position=(i, 0), name=f"box{i}")
    assert len(scene) == 20_000 and scene["box19999"].position == (19_999.0, 0.0)
