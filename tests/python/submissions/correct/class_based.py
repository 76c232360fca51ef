"""Everything in a class; the documented functions only pass on."""
from dataclasses import dataclass

import numpy as np
from LCPSolve import LCPSolve


@dataclass
class Params:
    side: float = 0.4
    mass: float = 0.3
    friction: float = 0.3
    restitution: float = 0.5
    time_step: float = 0.01
    threshold: float = 0.001
    gravity: float = 9.81


class Square:
    def __init__(self, params):
        self.p = params
        self.M = np.diag([params.mass, params.mass, params.mass * params.side ** 2 / 6])
        self.f_e = self.M @ np.array([0, -params.gravity, 0])

    def corners(self, q):
        h = self.p.side / 2
        body = np.array([[-h, -h], [h, -h], [h, h], [-h, h]])
        c, s = np.cos(q[2]), np.sin(q[2])
        return body @ np.array([[c, s], [-s, c]])

    def contacts(self, q):
        r = self.corners(q)
        k = r[:, 1].argmin()
        J = np.eye(3, 2)
        J[2] = [-r[k, 1], r[k, 0]]
        return J, q[1] + r[k, 1]

    def lcp(self, J, v):
        D = np.column_stack([J[:, 1], -J[:, 0], J[:, 0]])
        V = np.zeros((4, 4))
        V[:3, :3] = D.T @ np.linalg.solve(self.M, D) * self.p.time_step
        V[1:3, 3] = 1
        V[3] = [self.p.friction, -1, -1, 0]
        free = v + self.p.time_step * np.linalg.solve(self.M, self.f_e)
        p = np.append(D.T @ free, 0)
        p[0] += self.p.restitution * (J[:, 1] @ v)
        return V, p

    def advance(self, q, v):
        J, phi = self.contacts(q)
        force, lift = self.f_e.copy(), np.zeros(3)
        if phi < self.p.threshold:
            V, p = self.lcp(J, v)
            f = LCPSolve(V, p)[1]
            force += J[:, 1] * f[0] + J[:, 0] * (f[2] - f[1])
            lift[1] = self.p.threshold
        v = v + self.p.time_step * np.linalg.solve(self.M, force)
        return q + self.p.time_step * v + lift, v

    def run(self, q, v, n=150):
        states = [(q, v)]
        for _ in range(n - 1):
            states.append(self.advance(*states[-1]))
        return tuple(np.transpose(x) for x in zip(*states))


square = Square(Params())


def get_contacts(q):
    return square.contacts(q)


def form_lcp(J, v):
    return square.lcp(J, v)


def solve_LCP(V, p):
    return LCPSolve(V, p)[1][:3]


step = square.advance


def simulate(q0, v0):
    return square.run(q0, v0)
