"""Own LCP solver by cases, star imports that bring an unrelated `e`, rotations by complex numbers."""
from cmath import exp
from math import *

from numpy import *

epsilon = 0.5
l = 0.4
side = l
m, mu, dt, delta = 0.3, 0.3, 0.01, 1e-3
gravity = array([[0.0], [-9.81], [0.0]])
Minv = diag([1 / m, 1 / m, 6 / (m * l ** 2)])


def get_contacts(q):
    points = [complex(a, b) * l / 2 * complex(cos(q[2]), sin(q[2])) for a in (-1, 1) for b in (-1, 1)]
    r = min(points, key=lambda z: z.imag)
    return array([[1, 0], [0, 1], [-r.imag, r.real]]), q[1] + r.imag


def form_lcp(J, v):
    Jt, Jn = J[:, 0:1], J[:, 1:2]
    D = hstack((Jn, -Jt, Jt))
    V = zeros((4, 4))
    V[:3, :3] = D.T @ Minv @ D * dt
    V[:3, 3] = 0, 1, 1
    V[3, :3] = mu, -1, -1
    column = v.reshape(3, 1)
    p = vstack((D.T @ (column + dt * gravity), [[0]]))
    p[0] += epsilon * Jn.T @ column[:, 0]
    return V, p.ravel()


def solve_LCP(V, p):
    """Open, stick, slide left, slide right: the first whose signs are right."""
    tiny = 1e-12 * abs(p).max()
    if p[0] >= 0:
        return zeros(3)
    A = array([[V[0, 0], V[0, 2]], [V[2, 0], V[2, 2]]])
    fn, ft = linalg.solve(A, -p[[0, 2]])
    if fn >= 0 and abs(ft) <= mu * fn + tiny:
        return array([fn, max(-ft, 0), max(ft, 0)])
    for sign in (1, -1):
        fn = -p[0] / (A[0, 0] + sign * mu * A[0, 1])
        slip = p[2] + A[1, 0] * fn + A[1, 1] * sign * mu * fn
        if fn >= 0 and sign * slip <= tiny:
            return array([fn, mu * fn * (sign < 0), mu * fn * (sign > 0)])
    raise ArithmeticError("no case fits")


def step(q, v):
    J, phi = get_contacts(q)
    vn = v + dt * gravity[:, 0]
    qp = zeros(3)
    if phi < delta:
        V, p = form_lcp(J, v)
        f = solve_LCP(V, p)
        vn = vn + dt * Minv @ (J @ array([f[2] - f[1], f[0]]))
        qp[1] = delta
    return q + dt * vn + qp, vn


def simulate(q0, v0):
    q, v = zeros([3, 150]), zeros([3, 150])
    for k in range(150):
        q[:, k], v[:, k] = q0, v0
        q0, v0 = step(q0, v0)
    return q, v
