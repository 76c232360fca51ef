"""The document's model as a student writes it: plain numpy, a loop, a tableau Lemke. What tumble is measured against.

The functions have the document's names; LCPSolve is the course's helper file as `tumble.course new` writes it.
"""

import numpy as np
from tumble.course.template.LCPSolve import LCPSolve

l = 0.2
m = 0.3
r_g2 = l**2 / 6
M = np.diag([m, m, m * r_g2])
mu = 0.3
eps = 0.5
dt = 0.01
delta = 0.001
g = np.array([0.0, -9.81, 0.0])
f_e = np.matmul(M, g)
corners = np.array([[-l / 2, -l / 2], [l / 2, -l / 2], [l / 2, l / 2], [-l / 2, l / 2]])


def get_contacts(q):
    R = np.array([[np.cos(q[2]), -np.sin(q[2])], [np.sin(q[2]), np.cos(q[2])]])
    r = np.matmul(corners, R.T)
    lowest = np.argmin(r[:, 1])
    J = np.array([[1.0, 0.0], [0.0, 1.0], [-r[lowest, 1], r[lowest, 0]]])
    return J, q[1] + r[lowest, 1]


def form_lcp(J, v):
    J_t, J_n = J[:, 0], J[:, 1]
    J_hat = np.array([J_n, -J_t, J_t])
    M_inv = np.linalg.inv(M)
    V = np.zeros((4, 4))
    V[:3, :3] = np.matmul(np.matmul(J_hat, M_inv), J_hat.T) * dt
    V[1:3, 3] = 1.0
    V[3] = [mu, -1.0, -1.0, 0.0]
    free = v + dt * np.matmul(M_inv, f_e)
    p = np.zeros(4)
    p[0] = np.matmul(J_n, (1 + eps) * v + dt * np.matmul(M_inv, f_e))
    p[1] = -np.matmul(J_t, free)
    p[2] = np.matmul(J_t, free)
    return V, p


def solve_LCP(V, p):
    w, z, retcode = LCPSolve(V, p)
    return z[:3]


def step(q, v):
    J, phi = get_contacts(q)
    M_inv = np.linalg.inv(M)
    if phi < delta:
        V, p = form_lcp(J, v)
        f_c = solve_LCP(V, p)
        v_next = v + dt * np.matmul(M_inv, f_e + J[:, 1] * f_c[0] - J[:, 0] * f_c[1] + J[:, 0] * f_c[2])
        q_next = q + dt * v_next + np.array([0.0, delta, 0.0])
    else:
        v_next = v + dt * np.matmul(M_inv, f_e)
        q_next = q + dt * v_next
    return q_next, v_next


def simulate(q0, v0):
    q = np.zeros((3, 150))
    v = np.zeros((3, 150))
    q[:, 0], v[:, 0] = q0, v0
    for t in range(149):
        q[:, t + 1], v[:, t + 1] = step(q[:, t], v[:, t])
    return q, v
