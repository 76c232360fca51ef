"""tumble.rollout: the bits of simulate, what it returns, and what it refuses."""

import time
import warnings
from typing import Any

import numpy as np
import pytest
import tumble
from scene_samples import HEEDS_CTRL_C, ROOT, load, refuse_in_one_line, run_python, shown_on_a_terminal, ticks_during
from tumble import Rollout, Scene, rollout, simulate

NAN = float("nan")
N = 30


def make_scene(
    pose: Any = (0, 0.6, 0.3),
    velocity: Any = (0.5, 0, 2),
    *,
    mass: float = 0.3,
    friction: float = 0.4,
    restitution: float = 0.3,
    pair_friction: float | None = None,
    gravity: Any = (0, -9.81),
) -> Scene:
    """A box over the ground beside a ledge, a kinematic platform, built by hand with these values."""
    scene = Scene(step_size=0.004, duration=0.8, gravity=gravity)
    scene.add_material("wood", friction=friction, restitution=restitution)
    scene.add_material("ice", friction=0.05, restitution=0.1)
    scene.add_pair("wood", "ice", friction=pair_friction)
    scene.add_fixed(tumble.half_plane(), name="ground", material="wood")
    scene.add_body(
        tumble.rectangle(0.2, 0.1), mass=mass, name="box", material="wood", position=pose[:2], angle=pose[2],
        velocity=velocity[:2], angular_velocity=velocity[2],
    )  # fmt: skip
    scene.add_fixed(tumble.rectangle(1, 0.2), name="ledge", material="ice", position=(0.8, 0.1))
    scene.add_kinematic(tumble.disc(0.1), name="platform", material="ice", position=(-0.5, 0.05), velocity=(0.1, 0))
    return scene


def random_starts(seed: int = 1) -> tuple[Any, Any, np.random.Generator]:
    random = np.random.default_rng(seed)
    poses = random.uniform([-0.2, 0.2, -3], [0.2, 0.6, 3], (N, 3))
    velocities = random.uniform([-2, -1, -5], [2, 1, 5], (N, 3))
    return poses, velocities, random


def simulate_quietly(scene: Scene, **settings: Any) -> tumble.Trajectory:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", tumble.SimulationWarning)
        return simulate(scene, **settings)


def final(scene: Scene, body: str = "box") -> tuple[Any, Any]:
    course = simulate_quietly(scene)[body]
    return course.pose[-1], course.velocity[-1]


# The bits of simulate.


def test_it_gives_what_scenes_built_by_hand_do() -> None:
    poses, velocities, random = random_starts()
    mass, friction, restitution = random.uniform([[0.1], [0], [0]], [[2], [1], [0.9]], (3, N))
    gravity = random.uniform([-1, -12], [1, -5], (N, 2))
    result = rollout(
        make_scene(), {"box": poses}, {"box": velocities}, mass=mass, friction={"wood": friction}, restitution={"wood": restitution},
        gravity=gravity, threads=2,
    )  # fmt: skip
    for i in range(N):
        by_hand = make_scene(
            poses[i], velocities[i], mass=mass[i], friction=friction[i], restitution=restitution[i], gravity=gravity[i],
            # Of the first scene: a pair that is not named keeps its law.
            pair_friction=make_scene()._core.law("wood", "ice")[0],
        )  # fmt: skip
        pose, velocity = final(result.scene_of(i))
        assert (result["box"].pose[i] == pose).all() and (result["box"].velocity[i] == velocity).all()
        # All but the restitution of the pair, which was mixed when the scene was built.
        assert by_hand["box"] == result.scene_of(i)["box"] and by_hand.gravity == result.scene_of(i).gravity
        assert by_hand.materials == result.scene_of(i).materials


def test_one_value_holds_for_all_materials_and_pairs() -> None:
    result = rollout(make_scene(), friction=[0.1, 0.2], restitution=0.25)
    for i, friction in enumerate([0.1, 0.2]):
        scene = result.scene_of(i)
        for a, b in (("wood", "wood"), ("ice", "ice"), ("wood", "ice")):
            assert scene._core.law(a, b) == (friction, friction, 0.25)
        pose, velocity = final(scene)
        assert (result["box"].pose[i] == pose).all() and (result["box"].velocity[i] == velocity).all()


def test_laws_of_pairs_and_static_friction() -> None:
    law = {"wood": [0.1, 0.2], ("ice", "wood"): 0.3}
    scene = rollout(make_scene(), friction=law, static_friction={"wood": 0.7}).scene_of(1)
    assert scene._core.law("wood", "wood")[:2] == (0.2, 0.7)
    assert scene._core.law("wood", "ice")[:2] == (0.3, 0.3)
    assert scene._core.law("ice", "ice")[:2] == (0.05, 0.05)


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_the_number_of_threads_changes_nothing(threads: int) -> None:
    poses, velocities, _ = random_starts(2)
    one = rollout(make_scene(), {"box": poses}, {"box": velocities}, threads=1, every=3)
    other = rollout(make_scene(), {"box": poses}, {"box": velocities}, threads=threads, every=3)
    assert one.pose.tobytes() == other.pose.tobytes() and one.velocity.tobytes() == other.velocity.tobytes()
    for name in ("rest_time", "last_contact", "impacts", "max_impulse", "energy_lost", "residual"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


@pytest.mark.parametrize("every", [1, 7, 1000])
def test_samples_are_those_of_simulate(every: int) -> None:
    poses, velocities, _ = random_starts(3)
    result = rollout(make_scene(), {"box": poses}, {"box": velocities}, every=every)
    for i in range(0, N, 5):
        course = simulate(result.scene_of(i), sample_every=every)
        assert (result.time == course.time).all()
        for b, body in enumerate(result.bodies):
            assert (result.pose[i, b] == course[body].pose.T).all()
            assert (result.velocity[i, b] == course[body].velocity.T).all()
    assert result.pose.shape == (N, 2, 3, len(result.time)) and result.pose.flags.c_contiguous
    assert (result["box"].x == result.pose[:, 0, 0]).all()


def test_whole_arrays_and_dicts_say_the_same() -> None:
    poses, velocities, _ = random_starts(4)
    scene = make_scene()
    whole = np.empty((N, 2, 3))
    whole[:, 0], whole[:, 1] = poses, [-0.5, 0.05, 0]
    a = rollout(scene, whole, velocities=[[0, 0, 0], [0.2, 0, 1]])
    b = rollout(scene, {"box": poses}, {0 + 1: [0, 0, 0], "platform": (0.2, 0, 1)})
    assert a.pose.tobytes() == b.pose.tobytes()
    # The platform moves by the velocity that it was given.
    np.testing.assert_allclose(a["platform"].x, -0.5 + 0.2 * 0.8, rtol=1e-12)


# What comes out.


def test_what_is_told() -> None:
    scene = make_scene()
    result = rollout(scene, {"box": [[0, 0.6, 0], [0, 0.05, 0], [0, 9, 0], [NAN, 0, 0]]}, {"box": (3, 0, 0)}, friction=0.5, region=(-1, 1.1))
    assert [body.name for body in result.bodies] == ["box", "platform"]
    assert result.status.tolist() == ["solved", "solved", "solved", "bad_input"]
    assert result.num_steps.tolist() == [200, 200, 200, 0]
    assert len(result) == 4 and "3 solved" in repr(result)
    assert result.time.tolist() == [0.8] and result.pose.shape == (4, 2, 3)
    assert result.impacts[2] == 0 and np.isnan(result.last_contact[2]) and result.max_impulse[2] == 0
    assert result.escape_time[2] == pytest.approx(1.1 / 3, abs=0.004)
    energy = simulate(result.scene_of(0)).energy
    assert result.energy_lost[0] == energy.kinetic[0] + energy.potential[0] - (energy.kinetic[-1] + energy.potential[-1])
    # The same sums in another order: samples are added to by numpy pairwise.
    assert result.energy.friction_loss[0] == pytest.approx(energy.friction_loss.sum(), rel=1e-12)
    assert np.isnan(result.energy_lost[3]) and np.isnan(result.pose[3]).all() and np.isnan(result.energy.kinetic[3])
    assert result.why(3) == "bodies[1] 'box': pose.position.x: must be in [-1000000000000, 1000000000000] m, got nan"
    assert result.why(0) == ""


def test_a_bad_instance_changes_no_other() -> None:
    poses, velocities, random = random_starts(5)
    mass = random.uniform(0.1, 1, N)
    good = rollout(make_scene(), {"box": poses}, {"box": velocities}, mass=mass)
    poses[3, 1], velocities[11, 2], mass[20] = np.inf, NAN, -1
    result = rollout(make_scene(), {"box": poses}, {"box": velocities}, mass=mass)
    bad = np.isin(np.arange(N), [3, 11, 20])
    assert (result.status == np.where(bad, "bad_input", "solved")).all()
    assert result.pose[~bad].tobytes() == good.pose[~bad].tobytes()
    assert np.isnan(result.pose[bad]).all()


def test_a_run_that_ends_early_has_the_status_of_its_last_step() -> None:
    # A square between two walls that close in, or do not: nothing keeps it out of both in the end.
    scene = Scene(duration=0.3, gravity=(0, 0))
    scene.add_body(tumble.square(0.2), mass=1, name="square")
    for name, x in (("left", -0.2), ("right", 0.2)):
        scene.add_kinematic(tumble.rectangle(0.1, 1), name=name, position=(x, 0))
    speeds = np.array([0.0, 0.2, 0.4, 0.8])
    closing = np.outer(speeds, [1, 0, 0])
    result = rollout(scene, velocities={"left": closing, "right": -closing}, every=10)
    assert result.status.tolist() == ["solved", "infeasible", "infeasible", "infeasible"]
    for i in range(4):
        run = simulate_quietly(result.scene_of(i), sample_every=10)
        assert result.status[i] == run.status and result.num_steps[i] == run.num_steps
        reached = len(run.time)
        assert (result.pose[i, :, :, :reached] == run.pose.transpose(1, 2, 0)).all()
        assert np.isnan(result.pose[i, :, :, reached:]).all()
    last = rollout(scene, velocities={"left": closing, "right": -closing})
    assert (last.pose[3] == simulate_quietly(last.scene_of(3)).pose[-1]).all()


def test_later_changes_of_arrays_and_scene_do_not_reach_the_result() -> None:
    poses, _, _ = random_starts(6)
    scene = make_scene()
    result = rollout(scene, {"box": poses})
    first = tuple(poses[0])
    poses[:] = NAN
    scene.gravity = (1, 0)
    assert (*result.scene_of(0)["box"].position, result.scene_of(0)["box"].angle) == first
    assert result.scene_of(0).gravity == (0.0, -9.81)


def test_no_instances_and_no_bodies() -> None:
    assert rollout(make_scene(), {"box": np.empty((0, 3))}).pose.shape == (0, 2, 3)
    assert len(rollout(make_scene())) == 1
    empty = Scene()
    empty.add_fixed(tumble.half_plane())
    assert rollout(empty, gravity=np.zeros((3, 2))).pose.shape == (3, 0, 3)


MEMORY = """
import resource, numpy as np, tumble
scene = tumble.Scene(step_size=1e-3, duration=0.5)
scene.add_fixed(tumble.half_plane())
scene.add_body(tumble.square(0.2), mass=1, name="box", position=(0, 0.3), angle=0.1)
peak = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024  # MiB
tumble.rollout(scene, mass=np.ones(10))
before = peak()
tumble.rollout(scene, mass=np.ones(2000))
print(peak() - before)
"""


def test_final_states_take_no_memory_for_samples() -> None:
    # 2000 x 500 samples of 6 numbers would be 46 MiB; the results are 2000 x 250 bytes, 0.5 MiB.
    assert float(run_python(MEMORY).stdout) < 10


# Interrupts, threads, terminals.

INTERRUPTED = """
import threading, _thread, time, tumble
scene = tumble.Scene.load({scene!r})
began = []
def stop():
    began.append(time.monotonic())
    _thread.interrupt_main()
threading.Timer(0.5, stop).start()
try:
    tumble.rollout(scene, friction=[0.1] * {count}, duration={duration}, threads={threads})
    print("no interrupt")
except KeyboardInterrupt:
    print(time.monotonic() - began[0] < 1)
print(len(tumble.rollout(scene, duration=0.1)))
"""


@pytest.mark.parametrize(("count", "duration"), [(2, 1e5), (1_000_000, 1)])
@pytest.mark.parametrize("threads", [1, 2])
def test_ctrl_c_works_within_a_second(count: int, duration: float, threads: int) -> None:
    scene = str(ROOT / "scenes/drop.toml")
    done = run_python(HEEDS_CTRL_C + INTERRUPTED.format(scene=scene, count=count, duration=duration, threads=threads))
    assert done.stdout == "True\n1\n", done.stderr


def test_other_threads_run_meanwhile() -> None:
    ticks, seconds = ticks_during(lambda: rollout(load("drop"), friction=[0.1] * 100, threads=1))
    assert ticks > seconds / 0.05  # at least a tenth of what it would be alone


PROGRESS = """
import tumble, tumble._progress as module
module._SECONDS_BEFORE_PROGRESS = module._SECONDS_BETWEEN_LINES = 0.0
tumble.rollout(tumble.Scene.load({scene!r}), friction=[0.1] * 100, duration=8, threads=1, progress=True)
"""


def test_progress_is_shown_on_a_terminal_only() -> None:
    shown = shown_on_a_terminal(PROGRESS.format(scene=str(ROOT / "scenes/drop.toml")))
    assert b" of 100  " in shown and b" s left" in shown and shown.endswith(b"\r\x1b[K"), shown


def test_what_the_progress_raises_comes_out(monkeypatch: pytest.MonkeyPatch) -> None:
    class Stop(Exception):
        pass

    class Line:
        def show(self, share: float, text: str) -> None:
            raise Stop(text)

        def clear(self) -> None:
            pass

    monkeypatch.setattr("tumble._rollout.ProgressLine", Line)
    with pytest.raises(Stop, match="of 2"):
        rollout(load("drop"), friction=[0.1, 0.2], duration=1e4, progress=True)


# What is refused.

REFUSED = [
    ({"poses": np.zeros((5, 3, 3))}, "poses: must have shape (N, 2, 3), or (2, 3) for all, got (5, 3, 3)"),
    ({"poses": np.zeros((5, 3))}, "poses: must have shape (N, 2, 3), or (2, 3) for all, got (5, 3)"),
    ({"poses": {"box": np.zeros((5, 2))}}, "poses['box']: must have shape (N, 3), or (3,) for all, got (5, 2)"),
    ({"poses": {"box": [0, NAN, 0]}, "mass": [1, 2]}, "bodies[1] 'box': pose.position.y: must be in"),
    ({"poses": {"boxx": [0, 1, 0]}}, "body: must be the name of a body, got 'boxx'"),
    ({"velocities": {"ground": [0, 1, 0]}}, "velocities['ground']: must be of a dynamic body"),
    ({"poses": {"box": np.zeros((5, 3))}, "mass": [1, 2]}, "mass: must have 5 entries as poses['box'], or one, got 2"),
    ({"mass": -1}, "bodies[1] 'box': mass: must be in [1e-60, 1e+60] kg, got -1"),
    ({"mass": "heavy"}, "mass: must be a number, got 'heavy'"),
    ({"mass": [[1, 2]]}, "mass: must have shape (N,), or be a number, got (1, 2)"),
    ({"mass": {"platform": 1}}, "only dynamic bodies have one, got it for a kinematic one"),
    ({"friction": NAN}, "materials[0].friction: must be in [0, 1000000], got nan"),
    ({"friction": {"wod": 0.1}}, "friction['wod']: must be the name of a material, got 'wod'; did you mean 'wood'?"),
    ({"friction": {("wood", "wood"): 0.1}}, "must be of two materials that Scene.add_pair has made a pair"),
    ({"friction": {("wood", "ice", "wood"): 0.1}}, "must be of a material, or of a pair of them"),
    ({"static_friction": {"wood": 0.1}}, "static_friction: must be >= friction, which is 0.4, got 0.1"),
    ({"restitution": 1.5}, "restitution: must be in [0, 1], got 1.5"),
    ({"gravity": [1, 2, 3]}, "gravity: must have shape (2,), got (3,)"),
    ({"step_size": 0}, "step_size: must be in"),
    ({"duration": NAN}, "duration: must be in"),
    ({"every": -1}, "every: must be a whole number in [0, 2147483647], got -1"),
    ({"every": 1.5}, "every: must be a whole number in [0, 2147483647], got 1.5"),
    ({"threads": 2000}, "threads: must be a whole number in [0, 1024], got 2000"),
    ({"rest_speed": -1}, "rest_speed: must be >= 0 m/s, got -1"),
    ({"region": (1, 0)}, "region: must be (x_min, x_max) [m] with x_min <= x_max, got (1, 0)"),
    ({"solver": "exakt"}, "solver: must be the name of a solver, got 'exakt'; did you mean 'exact'?"),
]


@pytest.mark.parametrize(("arguments", "message"), REFUSED)
def test_it_refuses_in_one_line(arguments: dict[str, Any], message: str) -> None:
    refuse_in_one_line(lambda: rollout(make_scene(), **arguments), ValueError, message)


def test_it_refuses_what_is_no_scene_and_no_instance() -> None:
    refuse_in_one_line(lambda: rollout("drop.toml"), TypeError, "scene: must be a tumble.Scene")  # type: ignore[arg-type]
    two = tumble.Scene()
    for name in "ab":
        two.add_body(tumble.disc(1), mass=1, name=name)
    refuse_in_one_line(lambda: rollout(two, mass=1), ValueError, "mass: must be a dict of bodies")
    result: Rollout = rollout(make_scene())
    refuse_in_one_line(lambda: result.scene_of(1), IndexError, "instance: must be in [-1, 0], got 1")
    refuse_in_one_line(lambda: result["ground"], ValueError, "body: must be one that moves freely")
