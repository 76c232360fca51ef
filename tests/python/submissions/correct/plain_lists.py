"""No numpy at all in the student's part: lists and the math module."""
import math

from assignment_3_helper import LCPSolve, assignment_3_render

l = 0.2
m = 0.3
mu = 0.3
eps = 0.5
g = [0, -9.81, 0]
dt = 0.01
delta = 0.001
inertia = m * l ** 2 / 6


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def get_contacts(q):
    x, y, th = q
    s, c = math.sin(th), math.cos(th)
    best = None
    for sx in (-1, 1):
        for sy in (-1, 1):
            rx = c * sx * l / 2 - s * sy * l / 2
            ry = s * sx * l / 2 + c * sy * l / 2
            if best is None or ry < best[1]:
                best = (rx, ry)
    rx, ry = best
    return [[1, 0], [0, 1], [-ry, rx]], y + ry


def form_lcp(J, v):
    Jt = [row[0] for row in J]
    Jn = [row[1] for row in J]
    minv = [1 / m, 1 / m, 1 / inertia]
    rows = [Jn, [-a for a in Jt], Jt]
    V = []
    for i in range(3):
        V.append([dt * sum(a * w * b for a, w, b in zip(rows[i], minv, rows[j])) for j in range(3)])
        V[i].append(0 if i == 0 else 1)
    V.append([mu, -1, -1, 0])
    free = [v[k] + dt * g[k] for k in range(3)]
    p = [dot(Jn, [(1 + eps) * v[k] + dt * g[k] for k in range(3)]), -dot(Jt, free), dot(Jt, free), 0]
    return V, p


def solve_LCP(V, p):
    w, z, code = LCPSolve(V, p)
    return z[:3]


def step(q, v):
    J, phi = get_contacts(q)
    vn = [v[k] + dt * g[k] for k in range(3)]
    lift = 0
    if phi < delta:
        fn, f1, f2 = solve_LCP(*form_lcp(J, v))
        minv = [1 / m, 1 / m, 1 / inertia]
        for k in range(3):
            vn[k] += dt * minv[k] * (J[k][1] * fn - J[k][0] * f1 + J[k][0] * f2)
        lift = delta
    qn = [q[0] + dt * vn[0], q[1] + dt * vn[1] + lift, q[2] + dt * vn[2]]
    return qn, vn


def simulate(q0, v0):
    qs, vs = [list(q0)], [list(v0)]
    while len(qs) < 150:
        q, v = step(qs[-1], vs[-1])
        qs.append(q)
        vs.append(v)
    return [list(row) for row in zip(*qs)], [list(row) for row in zip(*vs)]


if __name__ == "__main__":
    assignment_3_render(simulate([0, 1.5, math.pi / 6], [0, -0.2, 0])[0])
