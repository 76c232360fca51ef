"""tumble.lcp.contact_problem and solve_contacts: bodies, contacts and impulses from Python."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tumble import lcp

BALL = {"J_n": [[0, 1, 0]], "J_t": [[1, 0, 0.1]], "inverse_mass": [0.5, 0.5, 100.0]}  # 0.1 m above the ground
ROUND_OFF = 1e-12  # of sums of a few terms


def random_system(seed: int, num_bodies: int, num_contacts: int) -> dict[str, np.ndarray]:
    """Contacts between neighbours in a row of bodies, or with the world."""
    random = np.random.default_rng(seed)
    J = np.zeros((2, num_contacts, 3 * num_bodies))
    for i in range(num_contacts):
        body = random.integers(num_bodies)
        J[:, i, 3 * body : 3 * body + 3] = random.standard_normal((2, 3))
        if body + 1 < num_bodies and random.random() < 0.7:
            J[:, i, 3 * body + 3 : 3 * body + 6] = random.standard_normal((2, 3))
    return {
        "J_n": J[0],
        "J_t": J[1],
        "inverse_mass": np.exp(random.uniform(-3, 3, 3 * num_bodies)),
        "velocity": random.standard_normal(3 * num_bodies),
        "friction": random.uniform(0, 1, num_contacts),
        "offset": random.uniform(-0.1, 0.1, num_contacts),
    }


@given(st.integers(0, 10**6), st.integers(1, 4), st.integers(1, 6))
@settings(max_examples=100, deadline=None, derandomize=True)
def test_the_lcp_is_that_of_the_jacobians(seed: int, num_bodies: int, num_contacts: int) -> None:
    system = random_system(seed, num_bodies, num_contacts)
    M, q, row_sizes = lcp.contact_problem(**system)
    k = num_contacts
    E = np.kron(np.eye(k), [[1.0], [1.0]])
    D = np.kron(np.eye(k), [[1.0], [-1.0]]) @ system["J_t"]
    W = np.diag(system["inverse_mass"])
    J_n, v, mu = system["J_n"], system["velocity"], np.diag(system["friction"])
    expected = np.block(
        [
            [J_n @ W @ J_n.T, J_n @ W @ D.T, np.zeros((k, k))],
            [D @ W @ J_n.T, D @ W @ D.T, E],
            [mu, -E.T, np.zeros((k, k))],
        ]
    )
    np.testing.assert_allclose(M, expected, rtol=ROUND_OFF, atol=ROUND_OFF * np.abs(expected).max())
    np.testing.assert_allclose(q, np.concatenate([J_n @ v + system["offset"], D @ v, np.zeros(k)]), atol=ROUND_OFF)
    assert row_sizes.shape == (4 * k,) and (row_sizes > 0).all()


@given(st.integers(0, 10**6), st.integers(1, 4), st.integers(1, 6))
@settings(max_examples=200, deadline=None, derandomize=True)
def test_the_laws_of_contact_hold(seed: int, num_bodies: int, num_contacts: int) -> None:
    system = random_system(seed, num_bodies, num_contacts)
    contacts = lcp.solve_contacts(**system)
    if contacts.result.status != "solved":  # offsets may ask for what no impulse can do
        return
    f_n, f_t, mu = contacts.normal_impulse, contacts.friction_impulse, system["friction"]
    impulse = system["J_n"].T @ f_n + system["J_t"].T @ f_t
    # The size of all terms that are summed: round-off is proportional to it.
    weight = np.abs(system["J_n"]).T @ np.abs(f_n) + np.abs(system["J_t"]).T @ np.abs(f_t)
    size = 1 + np.abs(system["inverse_mass"] * weight).max()
    np.testing.assert_allclose(contacts.velocity, system["velocity"] + system["inverse_mass"] * impulse, atol=ROUND_OFF * size)
    u_n, u_t = system["J_n"] @ contacts.velocity + system["offset"], system["J_t"] @ contacts.velocity
    tolerance = 10 * ROUND_OFF * size
    assert (f_n >= 0).all() and (u_n >= -tolerance).all()
    assert (np.abs(f_t) <= mu * f_n + 10 * ROUND_OFF * (f_n.max() + np.abs(f_t).max())).all()
    for i, mode in enumerate(contacts.mode):
        if mode == "open":
            assert f_n[i] == 0
        else:
            assert abs(u_n[i]) <= tolerance
        if mode == "stick":
            assert abs(u_t[i]) <= tolerance
        if mode.startswith("slip"):
            sign = -1 if mode == "slip left" else 1
            assert sign * u_t[i] >= -tolerance
            assert f_t[i] == pytest.approx(-sign * mu[i] * f_n[i], abs=10 * ROUND_OFF * (1 + f_n.max()))
            assert contacts.slip_speed[i] == pytest.approx(abs(u_t[i]), abs=tolerance)


@pytest.mark.parametrize(
    ("velocity", "friction", "mode"),
    [
        ([0, 1, 5], 0.2, "open"),
        ([0, -1, 5], 0.2, "stick"),
        ([0, -1, 50], 0.2, "slip right"),
        ([0, -1, -50], 0.2, "slip left"),
        ([0, -1, 5], 0.0, "slip right"),
    ],
)
def test_a_spinning_ball(velocity: list[float], friction: float, mode: str) -> None:
    hit = lcp.solve_contacts(**BALL, velocity=velocity, friction=friction)
    assert hit.mode == [mode] and hit.result.status == "solved"
    assert hit.normal_impulse[0] == (0.0 if mode == "open" else 2.0) and hit.velocity[1] == max(velocity[1], 0.0)
    if mode.startswith("slip"):
        assert abs(hit.friction_impulse[0]) == friction * 2.0


def test_restitution_and_gaps_are_offsets() -> None:
    hit = lcp.solve_contacts(**BALL, velocity=[0, -1, 0], friction=0.2, offset=-0.5)
    assert hit.velocity[1] == 0.5 and hit.normal_impulse[0] == 3.0
    assert lcp.solve_contacts(**BALL, velocity=[0, -1, 0], friction=0.2, offset=2.0).mode == ["open"]


def test_the_last_step_starts_the_next() -> None:
    system = random_system(3, 4, 6)
    for start in (first := lcp.solve_contacts(**system), first.result, first.result.basis):
        again = lcp.solve_contacts(**system, start=start)
        assert again.result.pivots <= first.result.pivots and again.result.rung == "warm_start"
        np.testing.assert_allclose(again.velocity, first.velocity, atol=ROUND_OFF)
    assert lcp.solve_contacts(**system, method="lemke").result.rung == "lemke"


BALL_ROLLS = {**BALL, "velocity": [1, -1, 0], "friction": 0.5}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"J_n": [[0, 1]]}, r"J_n: must have shape \(k, 3 b\) = \(k, 3\), got \(1, 2\)"),
        ({"inverse_mass": 1.0}, r"inverse_mass: must have shape \(3 b,\), got \(\)"),
        ({"J_t": [[1, 0, 0], [1, 0, 0]]}, r"J_t: must have shape \(1, 3\), got \(2, 3\)"),
        ({"inverse_mass": [1, 1]}, "inverse_mass: must have 3 entries for each body, got 2"),
        ({"velocity": [1, -1, 0, 0, 0, 0]}, r"velocity: must have shape \(3,\), got \(6,\)"),
        ({"friction": [0.5, 0.5]}, r"friction: must have shape \(1,\), got \(2,\)"),
        ({"friction": -0.5}, "^friction: must be finite and >= 0, got -0.5 at contact 0"),
        ({"friction": [-0.5]}, "^friction: must be finite and >= 0, got -0.5 at contact 0"),
        ({"friction": np.nan}, "^friction: must be finite, got nan"),
        ({"friction": [np.nan]}, r"^friction\[0\]: must be finite, got nan"),
        ({"friction": "rough"}, "friction: must be a number, got 'rough'"),
        ({"offset": np.nan}, "^offset: must be finite, got nan"),
        ({"inverse_mass": [-1, 1, 1]}, r"inverse_mass\[0\]: must be >= 0, got -1"),
        ({"velocity": [1, np.inf, 0]}, r"velocity\[1\]: must be finite, got inf"),
        ({"J_n": [[0, np.nan, 0]]}, r"J_n\[0\]\[1\]: must be finite, got nan"),
        ({"J_n": [[0, 0, 0]], "J_t": [[0, 0, 0]]}, r"J_n\[0\], J_t\[0\]: must touch a body"),
        ({"J_n": np.zeros((0, 3)), "J_t": np.zeros((0, 3))}, "J_n: must have a row for each contact"),
    ],
)
def test_bad_systems_are_refused_by_name(change: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        lcp.solve_contacts(**{**BALL_ROLLS, **change})  # type: ignore[arg-type]


def test_a_contact_has_two_bodies_at_most() -> None:
    with pytest.raises(ValueError, match=r"J_n\[0\], J_t\[0\]: must touch at most two bodies, got 0, 1, 2"):
        lcp.contact_problem(np.ones((1, 9)), np.ones((1, 9)), np.ones(9), np.ones(9), 0.5)


@pytest.mark.parametrize("mass", [1.0, 1e9, 1e12, 1e15])
def test_a_heavy_ball_on_a_light_one(mass: float) -> None:
    J_n, J_t = [[0, 1, 0, 0, 0, 0], [0, -1, 0, 0, 1, 0]], [[1, 0, 0, 0, 0, 0], [-1, 0, 0, 1, 0, 0]]
    inverse_mass, velocity = [1.0] * 3 + [1 / mass] * 3, [0.03, -1.0, 0, -0.07, -1.1, 0]
    balls = lcp.solve_contacts(J_n, J_t, inverse_mass, velocity, 0.5)
    assert balls.result.status == "solved"
    # 1e-13 of the speed is what the correction promises.
    np.testing.assert_allclose(balls.normal_impulse, [1.1 * mass + 1.0, 1.1 * mass], rtol=2e-13)
    np.testing.assert_allclose(balls.velocity, 0.0, atol=2e-13)


BOX = {
    "J_n": [[0, 1, -0.5], [0, 1, 0.5]],
    "J_t": [[1, 0, 0.25], [1, 0, 0.25]],
    "inverse_mass": [1.0, 1.0, 10.0],
    "velocity": [0.1, -1.0, 0.0],
    "friction": 0.5,
}


def test_a_box_has_one_motion_and_many_impulses() -> None:
    box = lcp.solve_contacts(**BOX, motions=True)
    M, q, row_sizes = lcp.contact_problem(**BOX)
    assert len(lcp.all_solutions(M, q)) > 1
    assert box.motions is not None and box.motions.is_unique and box.motions.status == "solved"
    same = lcp.contact_motions(M, q, row_sizes)
    assert same.is_unique
    for motion in (box.motions.motions[0], same.motions[0]):
        J = np.stack([BOX["J_n"], BOX["J_t"]])
        np.testing.assert_allclose(motion.velocities, (J @ box.velocity).T, atol=ROUND_OFF)
        assert motion.z.shape == (8,) and len(motion.modes) == 2
    assert lcp.solve_contacts(**BOX).motions is None


def test_motions_of_an_lcp_are_in_the_order_of_its_contacts() -> None:
    for friction in ([0, 0.5], [0.5, 0], [0, 0]):
        system = {**BOX, "J_t": [[1, 0, 0.25], [-1, 0, -0.25]], "friction": friction}
        box = lcp.solve_contacts(**system, motions=True).motions
        same = lcp.contact_motions(*lcp.contact_problem(**system))
        assert box is not None and len(box.motions) == len(same.motions) > 0
        for one, other in zip(box.motions, same.motions):
            assert one.modes == other.modes and np.array_equal(one.velocities, other.velocities)


def test_a_wedge_has_a_continuum_of_motions() -> None:
    opposed = {"J_n": [[1, 0, 0], [-1, 0, 0]], "J_t": [[0, -1, 0], [0, 1, 0]], "inverse_mass": [1, 1, 1]}
    wedge = lcp.solve_contacts(**opposed, velocity=[0, -1, 0], friction=0.5, motions=True).motions
    assert wedge is not None and wedge.has_between and not wedge.is_unique
    assert sorted(motion.modes for motion in wedge.motions) == [["open", "open"], ["stick", "stick"]]


def test_motions_are_for_few_contacts() -> None:
    system = random_system(0, 2, 4)
    with pytest.raises(ValueError, match="^motions: must be False for more than 3 contacts, got 4$"):
        lcp.solve_contacts(**system, motions=True)
    with pytest.raises(ValueError, match="M: must be the matrix of planar contacts"):
        lcp.contact_motions([[2, 1], [1, 2]], [-5, -6])


def test_single_contacts_side_by_side_are_those_of_solve() -> None:
    random = np.random.default_rng(7)
    count = 300
    root = random.standard_normal((count, 2, 2))
    A = root @ root.transpose(0, 2, 1) + 0.01 * np.eye(2)
    b, friction = random.standard_normal((count, 2)), random.uniform(0, 2, count)
    found = lcp.solve_one_contacts(A[:, 0, 0], A[:, 0, 1], A[:, 1, 1], b[:, 0], b[:, 1], friction)
    assert (found.status == "solved").all() and (found.residual < ROUND_OFF).all()
    assert set(found.mode) == {"open", "stick", "slip left", "slip right"}
    for i in range(count):
        n, t, s = A[i, 0, 0], A[i, 0, 1], A[i, 1, 1]
        M = [[n, t, -t, 0], [t, s, -s, 1], [-t, -s, s, 1], [friction[i], -1, -1, 0]]
        f_n, plus, minus, slip_speed = lcp.solve(M, [b[i, 0], b[i, 1], -b[i, 1], 0]).z
        # A has a condition of up to 1e3 here.
        np.testing.assert_allclose([found.f_n[i], found.f_t[i], found.slip_speed[i]], [f_n, plus - minus, slip_speed], atol=1e-12)


def test_single_contacts_report_what_is_none() -> None:
    found = lcp.solve_one_contacts([1, np.nan], [0, 0], [1, 1], [-1, -1], [0, 0], [0.5, 0.5])
    assert found.status.tolist() == ["solved", "numerical"] and found.f_n.tolist() == [1.0, 0.0]
    empty = lcp.solve_one_contacts([], [], [], [], [], [])
    assert empty.f_n.shape == empty.mode.shape == (0,)
    with pytest.raises(ValueError, match=r"b_t: must have shape \(2,\), got \(1,\)"):
        lcp.solve_one_contacts([1, 1], [0, 0], [1, 1], [-1, -1], [0], [0.5, 0.5])
