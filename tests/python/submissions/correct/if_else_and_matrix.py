"""Corners by if/else over the quadrant, np.matrix inside, many prints."""
import math
import numpy as np
from LCPSolve import *
from assignment_3_render import *

length = 0.2
mass = 0.3
MU = 0.3
EPSILON = 0.5
G = 9.81
DT = 0.01
D = 0.001
DELTA = D
half_diag = length / math.sqrt(2)

def get_contacts(q):
    theta = q[2]
    while theta < 0:
        theta = theta + 2 * math.pi
    while theta >= 2 * math.pi:
        theta = theta - 2 * math.pi
    if theta < math.pi / 2:
        a = theta + 5 * math.pi / 4
    elif theta < math.pi:
        a = theta + 3 * math.pi / 4
    elif theta < 3 * math.pi / 2:
        a = theta + math.pi / 4
    else:
        a = theta - math.pi / 4
    rx = half_diag * math.cos(a)
    ry = half_diag * math.sin(a)
    phi = float(q[1] + ry)
    print("phi", phi)
    return np.matrix([[1.0, 0.0], [0.0, 1.0], [-ry, rx]]), phi

def form_lcp(J, v):
    J = np.matrix(J)
    v = np.matrix(v).reshape(3, 1)
    Minv = np.matrix(np.diag([1 / mass, 1 / mass, 6 / (mass * length * length)]))
    fe = np.matrix([[0], [-mass * G], [0]])
    Jt = J[:, 0]
    Jn = J[:, 1]
    Jh = np.hstack([Jn, -Jt, Jt])
    A = Jh.T * Minv * Jh * DT
    V = np.zeros((4, 4))
    V[:3, :3] = A
    V[1, 3] = V[2, 3] = 1
    V[3, 0] = MU
    V[3, 1] = V[3, 2] = -1
    p1 = Jn.T * ((1 + EPSILON) * v + DT * Minv * fe)
    p2 = -Jt.T * (v + DT * Minv * fe)
    p3 = Jt.T * (v + DT * Minv * fe)
    p = np.array([p1[0, 0], p2[0, 0], p3[0, 0], 0.0])
    print(V, p)
    return np.asmatrix(V), p

def solve_LCP(V, p):
    w, z, r = LCPSolve(np.asarray(V), p)
    return z[0:3]

def step(q, v):
    J, phi = get_contacts(q)
    J = np.asarray(J)
    qt = q.copy().reshape(3, 1)
    vt = v.copy().reshape(3, 1)
    Minv = np.diag([1 / mass, 1 / mass, 6 / (mass * length ** 2)])
    fe = np.array([[0], [-mass * G], [0]])
    if phi >= DELTA:
        vt = vt + DT * Minv.dot(fe)
        qt = qt + DT * vt
    else:
        print("contact!")
        V, p = form_lcp(J, v)
        f = solve_LCP(V, p)
        vt = vt + DT * Minv.dot(fe + J[:, [1]] * f[0] - J[:, [0]] * f[1] + J[:, [0]] * f[2])
        qt = qt + DT * vt + np.array([[0], [DELTA], [0]])
    return qt.flatten(), vt.flatten()

def simulate(q0, v0):
    q = np.array(q0).reshape(3, 1)
    v = np.array(v0).reshape(3, 1)
    for i in range(149):
        qn, vn = step(q[:, -1], v[:, -1])
        q = np.hstack((q, qn.reshape(3, 1)))
        v = np.hstack((v, vn.reshape(3, 1)))
    return q, v

if __name__ == '__main__':
    q, v = simulate(np.array([0, 1.5, math.pi / 6]), np.array([0, -0.2, 0]))
    render(q)
