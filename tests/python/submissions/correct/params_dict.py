"""A dictionary of parameters, inverses by numpy, einsum, phi as an array, J as float32-free stack."""
import numpy as np
from LCPSolve import LCPSolve

PARAMS = {"l": 0.3, "m": 0.7, "mu": 0.5, "eps": 0.2, "dt": 0.005, "delta": 0.002, "g": -9.81}
CORNERS = PARAMS["l"] / 2 * np.array([(i, j) for i in (-1, 1) for j in (-1, 1)]).T
M = np.diag([PARAMS["m"], PARAMS["m"], PARAMS["m"] * PARAMS["l"] ** 2 / 6])
M_inv = np.linalg.inv(M)


def get_contacts(q, params=PARAMS):
    rotation = np.array([[np.cos(q[2]), -np.sin(q[2])], [np.sin(q[2]), np.cos(q[2])]])
    world = rotation.dot(CORNERS) + np.reshape(q[:2], (2, 1))
    lowest = np.argsort(world[1])[:1]
    phi = world[1, lowest]
    r = world[:, lowest[0]] - q[:2]
    J = np.vstack((np.eye(2), [-r[1], r[0]]))
    return J, phi


def form_lcp(J, v, params=PARAMS):
    J_t, J_n = J.T
    J_hat = np.vstack([J_n, -J_t, J_t])
    block = np.einsum("ia,ab,jb->ij", J_hat, M_inv, J_hat) * params["dt"]
    V = np.block([[block, np.array([[0], [1], [1]])], [np.array([[params["mu"], -1, -1]]), np.zeros((1, 1))]])
    f_e = M @ [0, params["g"], 0]
    velocities = np.vstack([(1 + params["eps"]) * v, v, v]) + params["dt"] * M_inv @ f_e
    p = np.concatenate([np.einsum("ia,ia->i", J_hat, velocities), [0]])
    return V, p


def solve_LCP(V, p):
    return LCPSolve(V, p)[1][0:3]


def step(q, v, params=PARAMS):
    J, phi = get_contacts(q, params)
    contact = bool(phi < params["delta"])
    f_c = solve_LCP(*form_lcp(J, v, params)) if contact else np.zeros(3)
    f_e = M @ np.array([0, params["g"], 0])
    J_hat = np.vstack([J[:, 1], -J[:, 0], J[:, 0]])
    v_next = v + params["dt"] * M_inv @ (f_e + J_hat.T @ f_c)
    q_next = q + params["dt"] * v_next + contact * np.array([0, params["delta"], 0])
    return q_next, v_next


def simulate(q0, v0, steps=150):
    q, v = np.empty((3, steps)), np.empty((3, steps))
    q[:, 0], v[:, 0] = q0, v0
    for k in range(1, steps):
        q[:, k], v[:, k] = step(q[:, k - 1], v[:, k - 1])
    return q, v
