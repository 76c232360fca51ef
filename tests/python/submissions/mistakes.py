"""One mistake each, made in submissions/correct/documented_names.py, and what the grader must say about it."""

from __future__ import annotations

from typing import NamedTuple


class Mistake(NamedTuple):
    """Replacements of text that make the mistake, the part that loses points, and words of the feedback."""

    name: str
    part: int
    words: str
    replacements: tuple[tuple[str, str], ...]
    costs_at_most: float = 30.0
    most_messages: int = 1


def _mistake(name, part, words, *replacements, **limits):
    return Mistake(name, part, words, replacements, **limits)


R = "R = np.array([[np.cos(theta), -np.sin(theta)], [np.sin(theta), np.cos(theta)]])"
J_T = "J_t = np.array([1.0, 0.0, -r[1, k]])"
J_N = "J_n = np.array([0.0, 1.0, r[0, k]])"
PHI = "phi = q[1] + r[1, k]"
P_0 = "p[0] = np.matmul(J_n, (1 + eps) * v + fall)"
FALL = "fall = dt * np.matmul(M_inv, f_e)"
LAST_ROW = "V[3, :] = [mu, -1, -1, 0]"
DIRECTIONS = "D = np.array([J_n, -J_t, J_t])"
BLOCK = "V[:3, :3] = np.matmul(np.matmul(D, M_inv), D.T) * dt"
LIFT = "q_next = q + dt * v_next + np.array([0.0, delta, 0.0])"
FREE = "q_next = q + dt * v_next\n"
FREE_V = "v_next = v + dt * np.matmul(M_inv, f_e)\n"
PUSH = "f_e + J_n * f_n - J_t * f_t1 + J_t * f_t2"
LOOP = "for k in range(num_columns - 1):\n        q[:, k + 1], v[:, k + 1] = step(q[:, k], v[:, k])"
END_OF_SIMULATE = "    return q, v\n\n\ndef solve"
STEP = "def step(q, v):\n"
FORM_LCP = "def form_lcp(J, v):\n"


def _everywhere_in_lcp(new):
    return (FALL, FALL.replace("np.matmul(M_inv, f_e)", new))


PART_1 = (
    _mistake(
        "sign_of_J_t", 1, "J_t has the wrong sign in its third entry", (J_T, J_T.replace("-r", "r")), costs_at_most=9.0
    ),
    _mistake(
        "sign_of_J_n",
        1,
        "J_n has the wrong sign in its third entry",
        (J_N, J_N.replace("r[0", "-r[0")),
        costs_at_most=9.0,
    ),
    _mistake("highest_corner", 1, "highest corner", ("np.argmin", "np.argmax")),
    _mistake("degrees", 1, "in degrees", ("theta = q[2]", "theta = np.degrees(q[2])")),
    _mistake("to_radians", 1, "in radians already", ("theta = q[2]", "theta = np.radians(q[2])")),
    _mistake("turned_back", 1, "the corners turn the wrong way", ("np.matmul(R, corners)", "np.matmul(R.T, corners)")),
    _mistake("not_turned", 1, "forgets to turn", ("np.matmul(R, corners)", "corners")),
    _mistake("whole_side", 1, "it is l / 2", ("0.5 * l *", "l *")),
    _mistake(
        "body_frame",
        1,
        "r is in the body frame",
        (J_T, J_T.replace("r[", "corners[")),
        (J_N, J_N.replace("r[", "corners[")),
        costs_at_most=18.0,
    ),
    _mistake(
        "all_in_body_frame",
        1,
        "J is in the body frame",
        ("J = np.column_stack([J_t, J_n])", "J = np.column_stack([J_t, J_n]); J[:2] = np.matmul(R.T, J[:2])"),
        costs_at_most=18.0,
    ),
    _mistake(
        "position_for_r",
        1,
        "uses the position of the corner",
        (J_T, J_T.replace("-r[1, k]", "-q[1] - r[1, k]")),
        (J_N, J_N.replace("r[0, k]", "q[0] + r[0, k]")),
    ),
    _mistake(
        "no_turning",
        1,
        "third row of J is zero",
        (J_T, J_T.replace("-r[1, k]", "0")),
        (J_N, J_N.replace("r[0, k]", "0")),
    ),
    _mistake(
        "columns_swapped", 1, "columns of J are swapped", ("column_stack([J_t, J_n])", "column_stack([J_n, J_t])")
    ),
    _mistake("same_corner", 1, "always takes the same corner", ("k = np.argmin(r[1])", "k = 2")),
    _mistake("phi_absolute", 1, "absolute value", (PHI, "phi = abs(q[1] + r[1, k])")),
    _mistake("phi_cut_off", 1, "cut it off at 0", (PHI, "phi = max(q[1] + r[1, k], 0)")),
    _mistake("phi_of_centre", 1, "height of the centre of mass", (PHI, "phi = q[1]")),
    _mistake("phi_without_angle", 1, "phi ignores the angle", (PHI, "phi = q[1] - l / 2")),
    _mistake("order_swapped", 1, "returns phi, J", ("return J, phi", "return phi, J"), costs_at_most=1.0),
    _mistake("J_transposed", 1, "returns J transposed", ("return J, phi", "return J.T, phi"), costs_at_most=1.0),
    _mistake(
        "J_deep",
        1,
        "wrong shape: J must be an array of shape (3, 2), got (3, 2, 1)",
        ("return J, phi", "return J.reshape(3, 2, 1), phi"),
        costs_at_most=1.0,
    ),
    _mistake("three_values", 1, "returns 3 values", ("return J, phi", "return J, phi, k"), costs_at_most=1.0),
    _mistake(
        "changes_q", 1, "changes its first argument in place", (PHI, "q[1] += r[1, k]; phi = q[1]"), costs_at_most=1.0
    ),
    _mistake(
        "one_corner_wrong",
        1,
        "except where corner (+,-) of the body is the lowest",
        (PHI, PHI + " + (k == 1) * 0.01"),
        costs_at_most=3.0,
    ),
    _mistake(
        "depends_on_calls",
        1,
        "called again",
        ("def get_contacts(q):\n", "seen = []\n\ndef get_contacts(q):\n    seen.append(1)\n"),
        (PHI, PHI + " + (len(seen) > 10) * 0.5"),
        most_messages=3,
    ),
)

PART_2 = (
    _mistake("no_restitution", 2, "(1 + eps) is missing", (P_0, P_0.replace("(1 + eps) * v", "v")), costs_at_most=8.0),
    _mistake(
        "restitution_of_gravity",
        2,
        "restitution multiplies gravity too",
        (P_0, P_0.replace("(1 + eps) * v + fall", "(1 + eps) * (v + fall)")),
        costs_at_most=8.0,
    ),
    _mistake("eps_v", 2, "eps v where (1 + eps) v belongs", (P_0, P_0.replace("(1 + eps)", "eps"))),
    _mistake(
        "restitution_everywhere",
        2,
        "first row of p only",
        ("J_t, v + fall", "J_t, (1 + eps) * v + fall"),
        costs_at_most=6.0,
    ),
    _mistake("no_dt_in_V", 2, "dt is missing in V", (BLOCK, BLOCK.removesuffix(" * dt")), costs_at_most=11.0),
    _mistake("dt_squared_in_V", 2, "dt is squared in V", (BLOCK, BLOCK + "**2")),
    _mistake("no_dt_in_p", 2, "dt is missing in p", (FALL, FALL.replace("dt * ", "")), costs_at_most=14.0),
    _mistake("f_e_is_g", 2, "f_e = M g, not g", (FALL, FALL.replace("f_e", "g")), costs_at_most=14.0),
    _mistake("no_inverse_mass", 2, "M^-1 is missing before f_e", _everywhere_in_lcp("f_e")),
    _mistake("gravity_up", 2, "gravity points the wrong way", _everywhere_in_lcp("(-g)")),
    _mistake("no_gravity", 2, "gravity is missing in p", (FALL, "fall = np.zeros(3)")),
    _mistake("M_for_inverse", 2, "multiplies by M", (BLOCK, BLOCK.replace("M_inv", "M"))),
    _mistake("no_mass", 2, "V lacks M^-1", (BLOCK, BLOCK.replace("np.matmul(D, M_inv)", "D"))),
    _mistake(
        "inertia_without_m",
        2,
        "l^2 / 6, without m",
        (BLOCK, BLOCK.replace("M_inv", "np.diag([1 / m, 1 / m, 6 / l**2])")),
    ),
    _mistake("inertia_12", 2, "m l^2 / 12", (BLOCK, BLOCK.replace("M_inv", "np.diag([1 / m, 1 / m, 12 / m / l**2])"))),
    _mistake("inertia_is_m", 2, "the moment of inertia is m;", (BLOCK, BLOCK.replace("M_inv", "np.eye(3) / m"))),
    _mistake(
        "r_g_for_its_square",
        2,
        "r_g instead of r_g^2",
        (BLOCK, BLOCK.replace("M_inv", "np.diag([1 / m, 1 / m, np.sqrt(6) / (m * l)])")),
    ),
    _mistake(
        "tangents_swapped",
        2,
        "f_t1 and f_t2 are swapped",
        (DIRECTIONS, "D = np.array([J_n, J_t, -J_t])"),
        ("p[1] = -", "p[1] = "),
        ("p[2] = np", "p[2] = -np"),
        costs_at_most=17.0,
    ),
    _mistake(
        "p_rows_swapped",
        2,
        "rows 2 and 3 of p are swapped",
        ("p[1] = -", "p[1] = "),
        ("p[2] = np", "p[2] = -np"),
        costs_at_most=6.0,
    ),
    _mistake(
        "columns_mixed",
        2,
        "J_t and J_n are swapped",
        (FORM_LCP + "    J_t, J_n", FORM_LCP + "    J_n, J_t"),
        most_messages=3,
    ),
    _mistake(
        "no_minus",
        2,
        "minus signs of J_t are missing",
        (DIRECTIONS, "D = np.array([J_n, J_t, J_t])"),
        costs_at_most=11.0,
    ),
    _mistake(
        "no_ones", 2, "ones in the last column of V are missing", ("V[:3, 3] = [0, 1, 1]", "pass"), costs_at_most=6.0
    ),
    _mistake("too_many_ones", 2, "a one in row 1 too", ("[0, 1, 1]", "[1, 1, 1]"), costs_at_most=5.0),
    _mistake(
        "no_last_row", 2, "last row of V must be mu, -1, -1, 0: it is missing", (LAST_ROW, "pass"), costs_at_most=2.0
    ),
    _mistake(
        "signs_of_last_row",
        2,
        "last row of V must be mu, -1, -1, 0: signs",
        (LAST_ROW, LAST_ROW.replace("-1", "1")),
        costs_at_most=2.0,
    ),
    _mistake(
        "dt_in_all_of_V",
        2,
        "dt",
        ("V[3, :] = [mu, -1, -1, 0]", "V[3, :] = [mu, -1, -1, 0]; V[:, 3] *= dt; V[3] *= dt"),
        most_messages=2,
    ),
    _mistake("V_order", 2, "returns p, V", ("return V, p", "return p, V"), costs_at_most=1.0),
    _mistake(
        "p_column",
        2,
        "wrong shape: p must be an array of shape (4,), got (4, 1)",
        ("return V, p", "return V, p.reshape(4, 1)"),
        costs_at_most=1.0,
    ),
    _mistake("p_short", 2, "p must be an array of shape (4,), got (3,)", ("return V, p", "return V, p[:3]")),
    _mistake(
        "changes_v",
        2,
        "changes its second argument in place",
        (P_0, P_0 + "; v += fall"),
        ("J_t, v + fall", "J_t, v"),
        costs_at_most=1.0,
    ),
    _mistake(
        "global_matrix",
        2,
        "called again",
        (FORM_LCP, "total = np.zeros(4)\n\n" + FORM_LCP),
        ("return V, p", "total[:] += p; return V, total"),
        most_messages=4,
    ),
)

PART_3 = (
    _mistake("at_delta", 3, "not <=", ("phi < delta", "phi <= delta"), costs_at_most=1.0),
    _mistake("at_zero", 3, "not at phi < 0", ("phi < delta", "phi < 0")),
    _mistake("wrong_way_round", 3, "wrong way round", ("phi < delta", "phi > delta")),
    _mistake("size_of_phi", 3, "takes the size of phi", ("phi < delta", "abs(phi) < delta")),
    _mistake("always_contact", 3, "every state as contact", ("phi < delta", "True")),
    _mistake("never_contact", 3, "no state as contact", ("phi < delta", "False")),
    _mistake("no_lift", 3, "the lift is missing", (LIFT, FREE.strip()), costs_at_most=6.0),
    _mistake("lift_always", 3, "belongs to contact only", (FREE, LIFT + "\n"), costs_at_most=4.0),
    _mistake("lift_if_pushed", 3, "only where the corner is pushed", (LIFT, LIFT + " * (f_n > 0)"), costs_at_most=2.0),
    _mistake("lift_if_below", 3, "only below the ground", (LIFT, LIFT + " * (phi < 0)"), costs_at_most=3.0),
    _mistake("lift_down", 3, "the lift points down", (LIFT, LIFT.replace("delta", "-delta"))),
    _mistake("lift_in_x", 3, "the lift goes to x", (LIFT, LIFT.replace("[0.0, delta, 0.0]", "[delta, 0.0, 0.0]"))),
    _mistake(
        "lift_in_all", 3, "the lift goes to all of q", (LIFT, LIFT.replace("np.array([0.0, delta, 0.0])", "delta"))
    ),
    _mistake("lift_is_phi", 3, "the lift is -phi", (LIFT, LIFT.replace("delta", "-phi"))),
    _mistake("old_velocity", 3, "with the old velocity", ("q + dt * v_next", "q + dt * v"), costs_at_most=10.0),
    _mistake("mean_velocity", 3, "mean of the old and the new", ("q + dt * v_next", "q + dt * (v + v_next) / 2")),
    _mistake("half_g_dt2", 3, "extra g dt^2 / 2", ("q + dt * v_next", "q + dt * v_next + g * dt**2 / 2")),
    _mistake("no_dt_in_q", 3, "dt is missing where q moves", ("q + dt * v_next", "q + v_next")),
    _mistake(
        "angle_wrapped",
        3,
        "wrapped into one turn",
        ("    return q_next, v_next", "    q_next[2] %= 2 * np.pi\n    return q_next, v_next"),
    ),
    _mistake(
        "angle_wrapped_both_ways",
        3,
        "wrapped into one turn",
        (
            "    return q_next, v_next",
            "    q_next[2] = np.arctan2(np.sin(q_next[2]), np.cos(q_next[2]))\n    return q_next, v_next",
        ),
    ),
    _mistake("q_stays", 3, "q does not move", ("q + dt * v_next", "q + 0")),
    _mistake(
        "signs_of_f_t",
        3,
        "f_t1 and f_t2 have the wrong signs",
        (PUSH, "f_e + J_n * f_n + J_t * f_t1 - J_t * f_t2"),
        costs_at_most=10.0,
    ),
    _mistake("f_t1_added", 3, "f_t1 must be subtracted", (PUSH, "f_e + J_n * f_n + J_t * f_t1 + J_t * f_t2")),
    _mistake("no_friction", 3, "friction is missing", (PUSH, "f_e + J_n * f_n")),
    _mistake(
        "no_normal_force", 3, "normal force is missing", (PUSH, "f_e - J_t * f_t1 + J_t * f_t2"), costs_at_most=13.0
    ),
    _mistake(
        "impulses",
        3,
        "dt is missing before the contact forces",
        (PUSH, "f_e + (J_n * f_n - J_t * f_t1 + J_t * f_t2) / dt"),
        costs_at_most=13.0,
    ),
    _mistake(
        "J_mixed",
        3,
        "J_t and J_n are swapped",
        (STEP + "    J, phi = get_contacts(q)\n    J_t, J_n", STEP + "    J, phi = get_contacts(q)\n    J_n, J_t"),
    ),
    _mistake(
        "no_inverse_mass_in_step",
        3,
        "M^-1 is missing before the contact forces",
        ("np.matmul(M_inv, " + PUSH + ")", "(" + PUSH.replace("f_e", "g") + ")"),
        costs_at_most=13.0,
    ),
    _mistake(
        "inertia_in_step", 3, "m l^2 / 12", (PUSH, "f_e + np.array([1, 1, 2]) * (J_n * f_n - J_t * f_t1 + J_t * f_t2)")
    ),
    _mistake(
        "f_e_is_g_in_step",
        3,
        "f_e = M g, not g",
        (FREE_V, FREE_V.replace("f_e", "g")),
        (PUSH, PUSH.replace("f_e", "g")),
    ),
    _mistake(
        "no_gravity_in_step", 3, "gravity is missing", (FREE_V, "v_next = v + 0\n"), (PUSH, PUSH.replace("f_e + ", ""))
    ),
    _mistake("no_gravity_in_contact", 3, "gravity is missing", (PUSH, PUSH.replace("f_e + ", "")), costs_at_most=10.0),
    _mistake(
        "no_dt_of_gravity",
        3,
        "dt is missing before gravity",
        (FREE_V, FREE_V.replace("dt * ", "")),
        (PUSH, PUSH.replace("f_e", "f_e / dt")),
    ),
    _mistake(
        "bounced_again",
        3,
        "applied once more",
        (
            "        q_next = q + dt * v_next + np",
            "        v_next = (1 + eps) * v_next\n        q_next = q + dt * v_next + np",
        ),
    ),
    _mistake("step_order", 3, "returns v, q", ("return q_next, v_next", "return v_next, q_next"), costs_at_most=1.0),
    _mistake(
        "step_column",
        3,
        "wrong shape: q must be an array of shape (3,), got (3, 1)",
        ("return q_next, v_next", "return q_next.reshape(3, 1), v_next.reshape(3, 1)"),
        costs_at_most=1.0,
        most_messages=2,
    ),
    _mistake(
        "changes_q_and_v",
        3,
        "changes its first and second argument in place",
        ("    return q_next, v_next", "    q[:], v[:] = q_next, v_next\n    return q, v"),
        costs_at_most=1.0,
    ),
)

PART_4 = (
    _mistake(
        "start_missing",
        4,
        "the state after the first step",
        (LOOP, "for k in range(num_columns):\n        q0, v0 = step(q0, v0)\n        q[:, k], v[:, k] = q0, v0"),
        costs_at_most=3.0,
    ),
    _mistake(
        "start_left_zero",
        4,
        "left at zero",
        (END_OF_SIMULATE, "    q[:, 0] = v[:, 0] = 0\n" + END_OF_SIMULATE),
        costs_at_most=6.0,
        most_messages=2,
    ),
    _mistake(
        "columns_149", 4, "149 columns; it must have 150", ("num_columns = 150", "num_columns = 149"), costs_at_most=3.1
    ),
    _mistake(
        "columns_151", 4, "151 columns; it must have 150", ("num_columns = 150", "num_columns = 151"), costs_at_most=1.0
    ),
    _mistake(
        "rows", 4, "one row per step", (END_OF_SIMULATE, END_OF_SIMULATE.replace("q, v", "q.T, v.T")), costs_at_most=1.0
    ),
    _mistake(
        "order_of_results",
        4,
        "returns v, q",
        (END_OF_SIMULATE, END_OF_SIMULATE.replace("q, v", "v, q")),
        costs_at_most=1.0,
    ),
    _mistake(
        "last_missing",
        4,
        "last column was left at zero",
        ("range(num_columns - 1)", "range(num_columns - 2)"),
        costs_at_most=2.1,
    ),
    _mistake(
        "never_moves",
        4,
        "all columns are the initial state",
        (LOOP, "for k in range(num_columns):\n        q[:, k], v[:, k] = q0, v0"),
    ),
    _mistake(
        "always_first_step",
        4,
        "every step starts from the initial state",
        (LOOP, LOOP.replace("step(q[:, k], v[:, k])", "step(q0, v0)")),
    ),
    _mistake("q_only", 4, "must return two values, q and v", (END_OF_SIMULATE, END_OF_SIMULATE.replace("q, v", "q"))),
    _mistake(
        "changes_start",
        4,
        "changes its first and second argument in place",
        (
            LOOP,
            "for k in range(1, num_columns):\n        q0[:], v0[:] = step(q0, v0)\n        q[:, k], v[:, k] = q0, v0",
        ),
        costs_at_most=1.0,
    ),
    _mistake(
        "third_dimension",
        4,
        "wrong shape",
        (END_OF_SIMULATE, END_OF_SIMULATE.replace("q, v", "q.reshape(3, 1, -1), v.reshape(3, 1, -1)")),
        costs_at_most=1.0,
        most_messages=2,
    ),
    _mistake(
        "stops_on_the_ground",
        4,
        "is not one step after",
        ("(q[:, k], v[:, k])", "(q[:, k], v[:, k]) if q[1, k] > 0.2 else (q[:, k], v[:, k])"),
    ),
)

ALL = (*PART_1, *PART_2, *PART_3, *PART_4)
