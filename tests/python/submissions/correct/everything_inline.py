"""step does all the work itself and plots while imported; matplotlib with a window; a counter as harmless global data."""
import matplotlib
matplotlib.use("TkAgg")
import matplotlib.pyplot as plt
import numpy as np
from assignment_3_helper import *

g = 9.81
M_mass, MASS = None, 0.3
SIDE = 0.2
MU = 0.3
eps = 0.5
Dt = 0.01
phi_min = 0.001
calls = 0


class Names:
    pass


def get_contacts(q):
    global calls
    calls += 1
    a = SIDE / 2
    ys = [-a * np.sin(q[2]) - a * np.cos(q[2]), a * np.sin(q[2]) - a * np.cos(q[2]),
          a * np.sin(q[2]) + a * np.cos(q[2]), -a * np.sin(q[2]) + a * np.cos(q[2])]
    xs = [-a * np.cos(q[2]) + a * np.sin(q[2]), a * np.cos(q[2]) + a * np.sin(q[2]),
          a * np.cos(q[2]) - a * np.sin(q[2]), -a * np.cos(q[2]) - a * np.sin(q[2])]
    i = ys.index(min(ys))
    return np.array([[1, 0, -ys[i]], [0, 1, xs[i]]]).T, np.array([[q[1] + ys[i]]])


def form_LCP(J, v):
    I = MASS * (SIDE ** 2 + SIDE ** 2) / 12
    Mi = np.array([1 / MASS, 1 / MASS, 1 / I])
    Jn, Jt = J[:, 1], J[:, 0]
    nn, nt, tt = Dt * (Jn * Mi) @ Jn, Dt * (Jn * Mi) @ Jt, Dt * (Jt * Mi) @ Jt
    V = np.array([[nn, -nt, nt, 0], [-nt, tt, -tt, 1], [nt, -tt, tt, 1], [MU, -1, -1, 0]])
    vt = v[0] + Jt[2] * v[2]
    return V, np.array([Jn.dot(v) * (1 + eps) - Dt * g, -vt, vt, 0])


def solve_LCP(V, p):
    return LCPSolve(V, p)[1][:3]


def step(q, v):
    q, v = np.array(q), np.array(v)
    a = SIDE / 2
    c, s = np.cos(q[2]), np.sin(q[2])
    rs = np.array([[c, -s], [s, c]]) @ np.array([[a, a, -a, -a], [a, -a, a, -a]])
    r = rs[:, rs[1].argmin()]
    J = np.array([[1, 0], [0, 1], [-r[1], r[0]]])
    if q[1] + r[1] < phi_min:
        f = solve_LCP(*form_LCP(J, v))
        I = MASS * SIDE ** 2 / 6
        v += Dt / np.array([MASS, MASS, I]) * (J[:, 1] * f[0] + J[:, 0] * (f[2] - f[1]))
        q[1] += phi_min
    v[1] -= g * Dt
    q += Dt * v
    return np.array([q, v])


def simulate(q, v):
    out = [(q, v)]
    for _ in range(149):
        out.append(tuple(step(*out[-1])))
    return np.array(out).transpose(1, 2, 0)


q, v = simulate(np.array([0, 1.5, 0.5]), np.array([0, -0.2, 0]))
plt.ion()
plt.plot(q[1])
plt.pause(30)
plt.show()
assignment_3_render(q)
