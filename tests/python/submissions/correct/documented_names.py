"""The template, filled in."""
import numpy as np
from assignment_3_render import render
from LCPSolve import LCPSolve

l = 0.2
m = 0.3
mu = 0.3
eps = 0.5
dt = 0.01
delta = 0.001
g = np.array([0.0, -9.81, 0.0])
num_columns = 150
r_g_squared = l**2 / 6
M = np.diag([m, m, m * r_g_squared])


def get_contacts(q):
    theta = q[2]
    R = np.array([[np.cos(theta), -np.sin(theta)], [np.sin(theta), np.cos(theta)]])
    corners = 0.5 * l * np.array([[-1, 1, 1, -1], [-1, -1, 1, 1]])
    r = np.matmul(R, corners)
    k = np.argmin(r[1])
    phi = q[1] + r[1, k]
    J_t = np.array([1.0, 0.0, -r[1, k]])
    J_n = np.array([0.0, 1.0, r[0, k]])
    J = np.column_stack([J_t, J_n])
    return J, phi


def form_lcp(J, v):
    J_t, J_n = J[:, 0], J[:, 1]
    M_inv = np.linalg.inv(M)
    f_e = np.matmul(M, g)
    D = np.array([J_n, -J_t, J_t])
    V = np.zeros((4, 4))
    V[:3, :3] = np.matmul(np.matmul(D, M_inv), D.T) * dt
    V[:3, 3] = [0, 1, 1]
    V[3, :] = [mu, -1, -1, 0]
    fall = dt * np.matmul(M_inv, f_e)
    p = np.zeros(4)
    p[0] = np.matmul(J_n, (1 + eps) * v + fall)
    p[1] = -np.matmul(J_t, v + fall)
    p[2] = np.matmul(J_t, v + fall)
    return V, p


def step(q, v):
    J, phi = get_contacts(q)
    J_t, J_n = J[:, 0], J[:, 1]
    M_inv = np.linalg.inv(M)
    f_e = np.matmul(M, g)
    if phi < delta:
        V, p = form_lcp(J, v)
        f_n, f_t1, f_t2 = solve_LCP(V, p)
        v_next = v + dt * np.matmul(M_inv, f_e + J_n * f_n - J_t * f_t1 + J_t * f_t2)
        q_next = q + dt * v_next + np.array([0.0, delta, 0.0])
    else:
        v_next = v + dt * np.matmul(M_inv, f_e)
        q_next = q + dt * v_next
    return q_next, v_next


def simulate(q0, v0):
    q = np.zeros((3, num_columns))
    v = np.zeros((3, num_columns))
    q[:, 0] = q0
    v[:, 0] = v0
    for k in range(num_columns - 1):
        q[:, k + 1], v[:, k + 1] = step(q[:, k], v[:, k])
    return q, v


def solve_LCP(V, p):
    w, z, retcode = LCPSolve(V, p)
    return z[:3]


if __name__ == "__main__":
    q, v = simulate(np.array([0.0, 1.5, np.deg2rad(30.0)]), np.array([0.0, -0.2, 0.0]))
    render(q)
