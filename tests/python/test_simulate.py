"""tumble.simulate: known answers, what it returns, and what it refuses."""

import signal
import time
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import tumble
from scene_samples import HEEDS_CTRL_C, ROOT, box_on_floor, load, refuse_in_one_line, run_python, shown_on_a_terminal, ticks_during
from tumble import Knot, Scene, Wrench, simulate

G = 9.81
NAN = float("nan")


# Known answers.


def test_a_body_without_contacts_falls_along_the_parabola() -> None:
    scene = Scene(gravity=(1.5, -G), duration=2)
    scene.add_body(tumble.square(0.2), mass=0.3, name="box", position=(1, 2), angle=0.3, velocity=(-3, 4), angular_velocity=5)
    trajectory = simulate(scene)
    t, box = trajectory.time, trajectory["box"]
    # (v + v') / 2 moves it: exact for constant forces, up to the round-off of 2000 sums.
    np.testing.assert_allclose(box.x, 1 - 3 * t + 1.5 * t**2 / 2, atol=1e-11)
    np.testing.assert_allclose(box.y, 2 + 4 * t - G * t**2 / 2, atol=1e-11)
    np.testing.assert_allclose(box.angle, 0.3 + 5 * t, atol=1e-11)
    np.testing.assert_allclose(box.vy, 4 - G * t, atol=1e-11)
    assert (box.omega == 5).all()


def test_a_box_slides_on_the_floor_with_mu_g() -> None:
    scene = box_on_floor(friction=0.5)
    scene.add_body(tumble.square(0.25), mass=1, name="slider", position=(1, 0.125), velocity=(4, 0), material="wood")
    slider = simulate(scene, duration=0.5)["slider"]
    assert slider.vx[-1] == pytest.approx(4 - 0.5 * G * 0.5, abs=1e-11)
    # In contact a step moves with the velocity at its end: t (t + h) / 2 in place of t^2 / 2.
    assert slider.x[-1] == pytest.approx(1 + 4 * 0.5 - 0.5 * G * 0.5 * 0.501 / 2, abs=1e-11)


def test_the_floor_carries_the_weight() -> None:
    trajectory = simulate(box_on_floor(), duration=0.1)
    rows = trajectory.contacts_of("box", "floor")
    assert set(rows["step"]) == set(range(1, 101)) and len(rows) == 200  # two corners in each of 100 steps
    weight = np.bincount(rows["step"] - 1, rows["normal_impulse"]) / trajectory.step_size
    np.testing.assert_allclose(weight, 2 * G, rtol=1e-12)
    assert (rows["body_a"] == 0).all() and (rows["body_b"] == 1).all()
    assert (rows["normal"] == [0, 1]).all() and (rows["mode"] == "stick").all()
    np.testing.assert_allclose(np.sort(rows["point_b"][:2, 0]), [-0.125, 0.125], atol=1e-15)
    assert (rows["law_friction"] == 0.5).all() and (rows["law_restitution"] == 0).all()
    np.testing.assert_allclose(rows["time"], rows["step"] * 1e-3, rtol=1e-15)


def test_impulses_are_the_change_of_momentum() -> None:
    scene = load("drop")
    trajectory = simulate(scene, duration=1)
    rows = trajectory.contacts_of("square")
    box = trajectory["square"]
    impulse = (rows["normal_impulse"][:, None] * rows["normal"]).sum(axis=0)
    impulse += (rows["friction_impulse"][:, None] * rows["normal"][:, ::-1] * [1, -1]).sum(axis=0)
    change = 0.3 * (box.velocity[-1, :2] - box.velocity[0, :2]) - [0, -0.3 * G * 1.0]
    np.testing.assert_allclose(impulse, change, atol=1e-12)


def test_energy_is_accounted_for() -> None:
    for name in ("drop", "conveyor", "pusher", "dominoes"):
        energy = simulate(load(name), duration=1, sample_every=7).energy
        total = energy.kinetic + energy.potential
        lost = energy.friction_loss + energy.impact_loss + energy.damping_loss
        gained = energy.external_work + energy.stabilisation_work
        scale = np.abs(total).max() + np.abs(gained).sum() + np.abs(lost).sum()
        np.testing.assert_allclose(np.diff(total), (gained - lost)[1:], atol=1e-12 * scale)


def test_what_the_scene_says_is_what_happens() -> None:
    scene = Scene(gravity=(0, 0), duration=2)
    scene.add_kinematic(tumble.disc(0.1), name="told", motion=[Knot(0.5, (0, 5)), Knot(1.5, (2, 5), "90 deg")])
    scene.add_body(tumble.disc(0.1), mass=2, name="pushed", wrenches=[Wrench(0.5, (4, 0)), Wrench(1.0)])
    scene.add_body(tumble.disc(0.1), mass=2, name="slowed", position=(0, -5), velocity=(1, 0), linear_damping=3)
    trajectory = simulate(scene)
    at = {t: int(np.flatnonzero(np.isclose(trajectory.time, t))[0]) for t in (0.25, 1.0, 2.0)}
    told, pushed, slowed = (trajectory[name] for name in ("told", "pushed", "slowed"))
    np.testing.assert_allclose(told.x[[at[0.25], at[1.0], at[2.0]]], [0, 1, 2], atol=1e-12)
    np.testing.assert_allclose(told.angle[[at[1.0], at[2.0]]], [np.pi / 4, np.pi / 2], atol=1e-12)
    assert pushed.vx[-1] == pytest.approx(4 / 2 * 0.5, rel=1e-12)
    assert slowed.vx[-1] == pytest.approx(np.exp(-6), rel=0.02)  # first order in the step size: 3 * 6 * 1e-3 / 2


# What comes back.


def test_shapes_types_and_views() -> None:
    scene = load("drop")
    trajectory = simulate(scene, duration=0.1, sample_every=3)
    T, B = 35, 2  # samples at steps 0, 3, ..., 99, 100
    assert trajectory.time.shape == (T,) and trajectory.time[-1] == pytest.approx(0.1)
    assert trajectory.pose.shape == (T, B, 3) and trajectory.velocity.shape == (T, B, 3)
    assert trajectory.energy.shape == (T,) and trajectory.energy.dtype.names[:2] == ("kinetic", "potential")
    assert trajectory.scene == scene and trajectory.scene is not scene
    assert (trajectory.num_steps, trajectory.status, trajectory.is_complete) == (100, "solved", True)
    assert trajectory.first_creation is None and trajectory.created_energy == 0.0
    box = trajectory["square"]
    assert box.x.base is not None and np.shares_memory(box.x, trajectory.pose)
    assert box.pose.tolist() == trajectory[1].pose.tolist() == trajectory[scene["square"]].pose.tolist()
    assert box.body == scene["square"] and box.time is trajectory.time
    assert trajectory.pose is trajectory.pose and np.shares_memory(trajectory.pose[0, 0, 2:], trajectory._core.pose())
    for array in (trajectory.time, trajectory.pose, trajectory.velocity, trajectory.energy, trajectory.contacts, box.x):
        assert not array.flags.writeable
    with pytest.raises(ValueError, match="read-only"):
        trajectory.pose[0, 0, 0] = 1.0
    assert repr(trajectory) == "<Trajectory: 2 bodies, 35 samples to 0.1 s, complete>"


def test_arrays_outlive_their_trajectory() -> None:
    trajectory = simulate(load("drop"), duration=0.2)
    t, energy = trajectory.time, trajectory.energy
    copies = t.copy(), energy.copy()
    del trajectory
    simulate(load("pile"), duration=0.05)
    assert np.array_equal(t, copies[0]) and np.array_equal(energy, copies[1])


def test_settings_take_the_place_of_the_scenes() -> None:
    scene = load("drop")
    trajectory = simulate(scene, step_size=0.003, duration=0.1)
    assert trajectory.num_steps == 34 and trajectory.time[-1] == pytest.approx(0.102)  # past the end by less than a step
    assert trajectory.step_size == 0.003 and scene.step_size == 0.001
    assert simulate(scene, step_size=10, duration=1e-3).num_steps == 1


def test_the_scene_may_change_after_its_simulation() -> None:
    scene = load("drop")
    trajectory = simulate(scene, duration=0.01)
    scene.add_body(tumble.disc(1), density=1)
    assert len(trajectory.scene) == 2 and trajectory.pose.shape[1] == 2


def test_a_scene_without_bodies_is_simulated() -> None:
    trajectory = simulate(Scene(duration=0.01))
    assert trajectory.pose.shape == (11, 0, 3) and len(trajectory.contacts) == 0 and trajectory.is_complete


def test_contacts_are_kept_on_request() -> None:
    trajectory = simulate(box_on_floor(), duration=0.01, contacts=False)
    with pytest.raises(AttributeError, match="contacts: were not kept; simulate with contacts=True"):
        trajectory.contacts
    assert np.array_equal(trajectory.pose, simulate(box_on_floor(), duration=0.01).pose)


def test_the_same_bits_every_time() -> None:
    first, second = (simulate(load("dominoes"), duration=0.5) for _ in range(2))
    assert np.array_equal(first.pose, second.pose) and np.array_equal(first.velocity, second.velocity)


@pytest.mark.filterwarnings("ignore::tumble.SimulationWarning")  # a few sweeps leave energy behind
def test_the_fast_solver_is_near_the_exact_one() -> None:
    for name, num_contacts in ("stack", 20), ("pyramid", 72):  # up to 50 are solved exactly
        exact, fast = (simulate(load(name), duration=0.2, solver=solver) for solver in ("exact", "fast"))
        assert (exact.contacts["step"] == exact.num_steps).sum() == num_contacts
        assert fast.is_complete and np.abs(exact.pose - fast.pose).max() < 1e-3  # bricks of 0.25 m
        assert (fast.residual > exact.residual) == (num_contacts > 50)


def test_created_energy_is_warned_of() -> None:
    """Newton's restitution with friction can create energy where a rod hits at a slant."""
    cases = 0
    for angle in range(20, 80, 5):
        for vx in (-4, -2, 2, 4):
            scene = Scene(gravity=(0, 0), duration=0.3)
            scene.add_material("m", friction=1.0, restitution=1.0)
            scene.add_fixed(tumble.half_plane(), material="m")
            rod = {"angle": f"{angle} deg", "velocity": (vx, -2), "material": "m"}
            scene.add_body(tumble.capsule(1.0, 0.01), mass=1, position=(0, 0.6), **rod)
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                trajectory = simulate(scene)
            energy = trajectory.energy.kinetic
            grew = energy.max() > energy[0] * (1 + 1e-9)
            assert grew == (trajectory.num_creating_steps > 0) == bool(caught)
            if grew:
                cases += 1
                assert caught[0].category is tumble.SimulationWarning and "created" in str(caught[0].message)
                assert caught[0].filename == __file__
                assert trajectory.created_energy == pytest.approx(energy.max() - energy[0], rel=1e-6)
                assert 0 < trajectory.first_creation < 0.3
    assert cases > 0, "no case created energy: the test has lost its point"


# Interrupts, threads, terminals.

INTERRUPTED = """
import threading, _thread, time, tumble
scene = tumble.Scene.load({scene!r})
threading.Timer(0.5, _thread.interrupt_main).start()
start = time.monotonic()
try:
    tumble.simulate(scene, duration=1e5, sample_every=1000)
    print("no interrupt")
except tumble.Interrupted as stop:
    t = stop.trajectory
    print(time.monotonic() - start < 30, t.is_complete, t.status, len(t.time) == len(t.pose) > 1, 0 < t.time[-1] < 1e5)
    print(isinstance(stop, KeyboardInterrupt), ".trajectory" in str(stop))
"""


def test_ctrl_c_keeps_what_was_computed() -> None:
    done = run_python(HEEDS_CTRL_C + INTERRUPTED.format(scene=str(ROOT / "scenes/drop.toml")))
    assert done.stdout == "True False solved True True\nTrue True\n", done.stderr


def test_other_threads_run_meanwhile() -> None:
    ticks, seconds = ticks_during(lambda: simulate(load("pile"), duration=0.5, contacts=False))
    assert ticks > 5 or seconds < 0.1


def test_runs_side_by_side_are_those_one_after_the_other() -> None:
    scene = load("dominoes")
    steps = [1e-3, 2e-3, 3e-3, 4e-3] * 3
    with ThreadPoolExecutor(4) as pool:
        runs = list(pool.map(lambda h: simulate(scene, step_size=h, duration=0.3), steps))
    for h, run in zip(steps, runs):
        assert np.array_equal(run.pose, simulate(scene, step_size=h, duration=0.3).pose)


PROGRESS = """
import tumble, tumble._progress as module
module._SECONDS_BEFORE_PROGRESS = module._SECONDS_BETWEEN_LINES = 0.0
tumble.simulate(tumble.Scene.load({scene!r}), duration=200, progress=True, contacts=False)
"""


def test_progress_is_shown_on_a_terminal_only() -> None:
    shown = shown_on_a_terminal(PROGRESS.format(scene=str(ROOT / "scenes/drop.toml")))
    assert b" %  " in shown and b" s left" in shown and shown.endswith(b"\r\x1b[K"), shown


# What is refused.


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda: simulate("drop.toml"), TypeError, "scene: must be a tumble.Scene, got str; a file is read by tumble.Scene.load"),
        (lambda: simulate(load("drop"), step_size=0), ValueError, "step_size: must be in [1e-12, 1000000000000] s, got 0"),
        (lambda: simulate(load("drop"), step_size=-1), ValueError, "step_size: must be in [1e-12, 1000000000000] s, got -1"),
        (lambda: simulate(load("drop"), step_size=NAN), ValueError, "step_size: must be in [1e-12, 1000000000000] s, got nan"),
        (lambda: simulate(load("drop"), step_size="1"), ValueError, "step_size: must be a number, got '1'"),
        (lambda: simulate(load("drop"), duration=0), ValueError, "duration: must be in [1e-12, 1000000000000] s, got 0"),
        (lambda: simulate(load("drop"), duration=np.inf), ValueError, "duration: must be in [1e-12, 1000000000000] s, got inf"),
        (lambda: simulate(load("drop"), duration=1e9), ValueError, "duration: must be at most 1e+09 steps of 0.001 s, got 1000000000 s"),
        (lambda: simulate(load("drop"), sample_every=0), ValueError, "sample_every: must be a whole number in [1, 2147483647], got 0"),
        (lambda: simulate(load("drop"), sample_every=1.5), ValueError, "sample_every: must be a whole number in [1, 2147483647], got 1.5"),
        (lambda: simulate(load("drop"), sample_every=True), ValueError, "sample_every: must be a whole number in [1, 2147483647], got True"),
        (lambda: simulate(load("drop"), sample_every=2**70), ValueError, "sample_every: must be a whole number in [1, 2147483647], got 1180591620717411303424"),
        (lambda: simulate(load("drop"), solver="exat"), ValueError, "solver: must be the name of a solver, got 'exat'; did you mean 'exact'?"),
        (lambda: simulate(load("drop"), solver=3), TypeError, "solver: must be text, got 3"),
        (lambda: simulate(load("drop"), num_sweeps=0), ValueError, "num_sweeps: must be a whole number in [1, 2147483647], got 0"),
        (lambda: simulate(load("drop"), contacts="yes"), TypeError, "contacts: must be True or False, got 'yes'"),
        (lambda: simulate(load("drop"), 0.01), TypeError, "positional"),
        (lambda: simulate(load("drop"), duration=0.01)["sqare"], ValueError, "body: must be the name of a body, got 'sqare'; did you mean 'square'?"),
        (lambda: simulate(load("drop"), duration=0.01)[7], IndexError, "body: must be in [-2, 1], got 7"),
        (lambda: simulate(load("drop"), duration=0.01)[1.0], TypeError, "body: must be a name or an index, got 1.0"),
        (lambda: simulate(load("drop"), duration=0.01).contacts_of("flor"), ValueError, "did you mean 'floor'?"),
    ],
)  # fmt: skip
def test_bad_input_is_refused_in_one_line(call, error: type[Exception], message: str) -> None:
    refuse_in_one_line(call, error, message)


def test_interrupts_leave_no_handler_behind() -> None:
    before = signal.getsignal(signal.SIGINT)
    simulate(load("drop"), duration=0.1)
    assert signal.getsignal(signal.SIGINT) is before
