"""Assignment 3: a square falls, bounces and slides. Fill in the four functions marked with a blank.

State of the square: q = (x, y, theta), its centre of mass [m] and angle [rad], and v = (vx, vy, omega) [m/s, rad/s].
The ground is the line y = 0. Normal +y, tangent +x, angles counter-clockwise.
"""

import numpy as np
from assignment_3_render import render
from LCPSolve import LCPSolve

# The parameters. Use these names in your code, not their values: your script may be run with other values.
l = 0.2  # side of the square [m]
m = 0.3  # mass [kg]
mu = 0.3  # coefficient of friction [-]
eps = 0.5  # coefficient of restitution [-]
dt = 0.01  # time step [s]
delta = 0.001  # the square is in contact if phi < delta [m]
g = np.array([0.0, -9.81, 0.0])  # acceleration by gravity [m/s^2, m/s^2, rad/s^2]
num_columns = 150  # columns of a trajectory, the initial state included

r_g_squared = l**2 / 6  # square of the radius of gyration [m^2]
M = np.diag([m, m, m * r_g_squared])  # inertia matrix [kg, kg, kg m^2]


def get_contacts(q):
    """Part 1: where the lowest corner is, and how it moves.

    Parameters
    ----------
    q : ndarray, shape (3,)
        Pose of the square.

    Returns
    -------
    J : ndarray, shape (3, 2)
        Contact Jacobian of the lowest corner in the world frame, columns [J_t, J_n].
    phi : float
        Distance of that corner from the ground [m], negative if it is below.
    """
    raise NotImplementedError("part 1 is still blank")


def form_lcp(J, v):
    """Part 2: the linear complementarity problem of the contact forces.

    Parameters
    ----------
    J : ndarray, shape (3, 2)
        Contact Jacobian, columns [J_t, J_n].
    v : ndarray, shape (3,)
        Velocity of the square.

    Returns
    -------
    V : ndarray, shape (4, 4)
    p : ndarray, shape (4,)
        For the unknowns (f_n, f_t1, f_t2, lambda): V times the unknowns plus p must be >= 0.
    """
    raise NotImplementedError("part 2 is still blank")


def step(q, v):
    """Part 3: the state one time step later.

    Parameters
    ----------
    q, v : ndarray, shape (3,)
        Pose and velocity now.

    Returns
    -------
    q_next, v_next : ndarray, shape (3,)
        Pose and velocity after the time dt.
    """
    raise NotImplementedError("part 3 is still blank")


def simulate(q0, v0):
    """Part 4: a trajectory.

    Parameters
    ----------
    q0, v0 : ndarray, shape (3,)
        Pose and velocity at the start.

    Returns
    -------
    q, v : ndarray, shape (3, num_columns)
        One column per time step; column 0 is the start.
    """
    raise NotImplementedError("part 4 is still blank")


def solve_LCP(V, p):
    """The contact forces. This function is complete: leave it as it is.

    Parameters
    ----------
    V : ndarray, shape (4, 4)
    p : ndarray, shape (4,)
        As `form_lcp` returns them.

    Returns
    -------
    f_c : ndarray, shape (3,)
        (f_n, f_t1, f_t2) [N].
    """
    w, z, retcode = LCPSolve(V, p)
    if retcode[0] != 1:
        raise ValueError(f"solve_LCP: no solution found for V =\n{V}\np = {p}")
    return z[:3]


if __name__ == "__main__":
    q_start = np.array([0.0, 1.5, np.deg2rad(30.0)])
    v_start = np.array([0.0, -0.2, 0.0])
    q, v = simulate(q_start, v_start)
    render(q)
