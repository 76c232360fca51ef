"""Drops the square from the course's start and prints its impacts. Twin: drop.cpp."""

import numpy as np
from tumble.drop import record

run = record([0, 1.5, np.deg2rad(30)], [0, -0.2, 0])
dt = run.params.dt

print("time [s]  gap [mm]  mode        impulse [N s]")
for k in np.flatnonzero(run.f_n[:-1] > 0):
    print(f"{run.t[k]:8.2f}  {1000 * run.gap[k]:8.2f}  {run.mode[k]:10}  {run.f_n[k] * dt:13.5f}")
x, y, theta = run.q[:, -1]
print(f"end: x = {x:.6f} m, y = {y:.6f} m, theta = {theta:.6f} rad")
