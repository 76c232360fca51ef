"""tumble.Simulation: the steps of simulate, with forces and motions from outside."""

import threading

import numpy as np
import pytest
import tumble
from scene_samples import HEEDS_CTRL_C, ROOT, box_on_floor, load, refuse_in_one_line, run_python
from tumble import Scene, Simulation, simulate

G = 9.81
NAN = float("nan")


def test_steps_are_those_of_simulate() -> None:
    for name in ("drop", "dominoes", "pusher", "tilting_table"):
        scene = load(name)
        trajectory, simulation = simulate(scene, duration=0.3), Simulation(scene)
        assert np.array_equal(simulation.pose, trajectory.pose[0])
        for k in range(1, 301):
            assert simulation.advance() == "solved"
            assert np.array_equal(simulation.pose, trajectory.pose[k])
        assert np.array_equal(simulation.velocity, trajectory.velocity[-1])
        assert simulation.time == trajectory.time[-1] and simulation.num_steps == 300
        mine = simulation.contacts[simulation.contacts["mode"] != "open"]
        theirs = trajectory.contacts[trajectory.contacts["step"] == 300]
        assert all(np.array_equal(mine[field], theirs[field]) for field in mine.dtype.names)


def test_many_steps_at_once_are_many_steps() -> None:
    one, many = Simulation(load("drop")), Simulation(load("drop"))
    for _ in range(700):
        one.advance()
    many.advance(700)
    assert np.array_equal(one.pose, many.pose)
    energy = many.energy
    lost = energy.impact_loss + energy.friction_loss - energy.stabilisation_work
    start = Simulation(load("drop")).energy
    assert start.kinetic + start.potential - lost == pytest.approx(energy.kinetic + energy.potential, abs=1e-12)


def test_reset_goes_back_to_the_start() -> None:
    simulation = Simulation(load("drop"))
    first = simulation.pose
    simulation.set_wrench("square", (1, 0))
    simulation.advance(100)
    pushed = simulation.pose
    simulation.reset()
    assert simulation.time == 0.0 and simulation.num_steps == 0 and np.array_equal(simulation.pose, first)
    simulation.advance(100)
    assert simulation["square"].x == 0.0 != pushed[1, 0]


def test_a_state_kept_and_set_again_takes_it_back() -> None:
    simulation = Simulation(load("dominoes"))
    simulation.advance(200)
    simulation.set_wrench(1, (0.1, 0))
    state = simulation.state
    simulation.advance(200)
    end = simulation.pose
    simulation.set_wrench(1, (5, 0))
    simulation.advance(10)
    simulation.state = state
    assert simulation.num_steps == 200 and state.time == pytest.approx(0.2)
    simulation.advance(200)
    assert np.array_equal(simulation.pose, end)


def test_orders_from_outside_are_obeyed() -> None:
    scene = Scene(gravity=(0, 0))
    scene.add_body(tumble.disc(0.1), mass=2, moment_of_inertia=0.5, name="ball")
    scene.add_kinematic(tumble.disc(0.1), name="hand", position=(0, 5), velocity=(1, 0))
    simulation = Simulation(scene)
    simulation.advance(500)
    assert simulation["hand"].x == pytest.approx(0.5, abs=1e-12)
    simulation.set_velocity("hand", (0, 2), angular_velocity=1)
    simulation.set_wrench("ball", (4, 0), 0.5)
    simulation.advance(500)
    assert simulation["hand"][:3] == pytest.approx((0.5, 6, 0.5), abs=1e-12)
    assert simulation["ball"] == pytest.approx((0.25, 0, 0.125, 1, 0, 0.5), abs=1e-12)
    simulation.set_wrench("ball")
    simulation.set_velocity("ball", angular_velocity=0)
    simulation.set_pose("ball", (1, 1), "90 deg")
    simulation.advance(1000)
    assert simulation["ball"] == pytest.approx((2, 1, np.pi / 2, 1, 0, 0), abs=1e-12)
    simulation.set_pose("hand", (7, 7))
    assert simulation["hand"][:2] == (7, 7)
    simulation.advance(500)
    assert simulation["hand"][:2] == pytest.approx((7, 8), abs=1e-12)


def test_a_velocity_set_between_steps_meets_the_contacts() -> None:
    simulation = Simulation(box_on_floor(friction=0.5))
    simulation.advance(10)
    simulation.set_velocity("box", (1, 0))
    simulation.advance(100)
    assert simulation["box"].vx == pytest.approx(1 - 0.5 * G * 0.1, abs=1e-11)
    assert set(simulation.contacts["mode"]) == {"slip right"}


def test_ctrl_c_leaves_a_simulation_where_it_is() -> None:
    code = """
import _thread, threading, tumble
scene = tumble.Scene.load({scene!r})
simulation = tumble.Simulation(scene)
threading.Timer(0.5, _thread.interrupt_main).start()
try:
    simulation.advance(2**31 - 1)
except KeyboardInterrupt:
    n = simulation.num_steps
    print(n > 0, abs(simulation.time - n * 1e-3) < 1e-9 * n, simulation.advance(), simulation.num_steps == n + 1)
"""
    done = run_python(HEEDS_CTRL_C + code.format(scene=str(ROOT / "scenes/drop.toml")))
    assert done.stdout == "True True solved True\n", done.stderr


def test_a_simulation_is_advanced_by_one_thread_at_a_time() -> None:
    simulation = Simulation(load("pile"))
    errors: list[str] = []

    def advance() -> None:
        try:
            simulation.advance(100)
        except RuntimeError as error:
            errors.append(str(error))

    threads = [threading.Thread(target=advance) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert simulation.num_steps in (100, 200)
    assert len(errors) == (simulation.num_steps == 100) and all("another thread" in text for text in errors)


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda: Simulation("drop"), TypeError, "scene: must be a tumble.Scene, got str"),
        (lambda: Simulation(load("drop"), step_size=0), ValueError, "step_size: must be in"),
        (lambda: Simulation(load("drop"), solver="?"), ValueError, "solver: must be the name of a solver, got '?'; allowed are exact, fast"),
        (lambda: Simulation(load("drop")).advance(0), ValueError, "steps: must be a whole number in [1, 2147483647], got 0"),
        (lambda: Simulation(load("drop")).advance(-3), ValueError, "steps: must be a whole number in [1, 2147483647], got -3"),
        (lambda: Simulation(load("drop")).set_wrench("floor", (1, 0)), ValueError, "force: only dynamic bodies feel it, got body 'floor'"),
        (lambda: Simulation(load("drop")).set_wrench("square", (1, NAN)), ValueError, "force[1]: must be in [-1e+60, 1e+60] N, got nan"),
        (lambda: Simulation(load("drop")).set_wrench("square", torque=NAN), ValueError, "torque: must be in [-1e+60, 1e+60] N m, got nan"),
        (lambda: Simulation(load("drop")).set_velocity("floor", (1, 0)), ValueError, "velocity: fixed bodies have none, got body 'floor'"),
        (lambda: Simulation(load("drop")).set_velocity("square", (1e10, 0)), ValueError, "velocity[0]: must be in [-1000000000, 1000000000] m/s, got 10000000000"),
        (lambda: Simulation(load("drop")).set_velocity("square", 1.0), ValueError, "velocity: must have shape (2,), got ()"),
        (lambda: Simulation(load("drop")).set_pose("floor", (1, 0)), ValueError, "pose: fixed bodies stay where they are, got body 'floor'"),
        (lambda: Simulation(load("drop")).set_pose("square", (1, NAN)), ValueError, "position[1]: must be in"),
        (lambda: Simulation(load("drop")).set_pose("square", angle="x"), ValueError, "angle: must be a number in rad or text like \"30 deg\", got 'x'"),
        (lambda: Simulation(load("drop")).set_pose("cube", (0, 0)), ValueError, "body: must be the name of a body, got 'cube'"),
        (lambda: setattr(Simulation(load("drop")), "state", 3), TypeError, "state: must be one that a Simulation gave, got int"),
        (lambda: setattr(Simulation(load("drop")), "state", Simulation(load("stack")).state), ValueError, "state: must be of a scene of 2 bodies, got 11"),
    ],
)  # fmt: skip
def test_bad_input_is_refused_in_one_line(call, error: type[Exception], message: str) -> None:
    refuse_in_one_line(call, error, message)
