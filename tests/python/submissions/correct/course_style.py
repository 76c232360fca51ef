import numpy as np
from LCPSolve import LCPSolve
from assignment_3_render import render

# DEFINE GLOBAL PARAMETERS
L = 0.2
MU = 0.3
EP = 0.5
dt = 0.01
m = 0.3
g = np.array([0., -9.81, 0.])
rg = 1./12. * (2 * L * L)
M = np.array([[m, 0, 0], [0, m, 0], [0, 0, m * rg]])
Mi = np.array([[1./m, 0, 0], [0, 1./m, 0], [0, 0, 1./(m * rg)]])
DELTA = 0.001
T = 150


def get_contacts(q):
    R = np.array([[np.cos(q[2]), -np.sin(q[2])], [np.sin(q[2]), np.cos(q[2])]])
    corners = [np.array([L/2, L/2]), np.array([L/2, -L/2]), np.array([-L/2, -L/2]), np.array([-L/2, L/2])]
    phi = np.inf
    for c in corners:
        r = np.matmul(R, c)
        h = q[1] + r[1]
        if h < phi:
            phi = h
            rc = r
    n = np.array([0, 1])
    t = np.array([1, 0])
    jac_t = np.array([t[0], t[1], rc[0]*t[1] - rc[1]*t[0]])
    jac_n = np.array([n[0], n[1], rc[0]*n[1] - rc[1]*n[0]])
    jac = np.array([jac_t, jac_n]).T
    return jac, phi


def form_lcp(jac, v):
    jac_t = jac[:, 0]
    jac_n = jac[:, 1]
    jhat = np.array([jac_n, -jac_t, jac_t])
    V = np.zeros((4, 4))
    V[0:3, 0:3] = np.matmul(np.matmul(jhat, Mi), np.transpose(jhat)) * dt
    V[:, 3] = np.array([0, 1, 1, 0])
    V[3, :] = np.array([MU, -1, -1, 0])
    fe = np.matmul(M, g)
    p = np.zeros(4)
    p[0] = np.matmul(jac_n.T, (1 + EP) * v + dt * np.matmul(Mi, fe))
    p[1] = np.matmul(-jac_t.T, v + dt * np.matmul(Mi, fe))
    p[2] = np.matmul(jac_t.T, v + dt * np.matmul(Mi, fe))
    return V, p


def step(q, v):
    jac, phi = get_contacts(q)
    jac_t = jac[:, 0]
    jac_n = jac[:, 1]
    fe = np.matmul(M, g)
    qp = np.array([0, DELTA, 0])
    if phi < DELTA:
        V, p = form_lcp(jac, v)
        fc = solve_lcp(V, p)
        v_next = v + dt * np.matmul(Mi, fe + jac_n * fc[0] - jac_t * fc[1] + jac_t * fc[2])
        q_next = q + dt * v_next + qp
    else:
        v_next = v + dt * np.matmul(Mi, fe)
        q_next = q + dt * v_next
    return q_next, v_next


def simulate(q0, v0):
    q = np.zeros((3, T))
    v = np.zeros((3, T))
    q[:, 0] = q0
    v[:, 0] = v0
    for i in range(T - 1):
        q[:, i + 1], v[:, i + 1] = step(q[:, i], v[:, i])
    return q, v


def solve_lcp(V, p):
    sol = LCPSolve(V, p)
    f_r = sol[1][:3]
    return f_r


if __name__ == "__main__":
    q0 = np.array([0.0, 1.5, np.pi / 180. * 30.])
    v0 = np.array([0., -0.2, 0.])
    q, v = simulate(q0, v0)
    render(q)
