"""One step in contact by hand (get_contacts, form_lcp, solve_LCP), then by `step`. Twin: contact.cpp."""

import numpy as np
from tumble.drop import Parameters, form_lcp, get_contacts, solve_LCP, step

p = Parameters()
q = np.array([0.0, 0.13, 0.5])
v = np.array([1.0, -2.0, 0.0])

J, phi = get_contacts(q, p)
V, b = form_lcp(J, v, p)
f_n, f_t1, f_t2 = solve_LCP(V, b)
print(f"phi = {phi:.6f} m, f_n = {f_n:.6f} N, f_t1 = {f_t1:.6f} N, f_t2 = {f_t2:.6f} N")

mass = np.array([p.m, p.m, p.m * p.l**2 / 6])
f_e = np.array([0.0, -p.m * p.g, 0.0])
J_t, J_n = J.T
v_next = v + p.dt / mass * (f_e + J_n * f_n - J_t * f_t1 + J_t * f_t2)
q_next = q + p.dt * v_next + [0, p.delta, 0]
print("by hand: q = ({:.6f}, {:.6f}, {:.6f})".format(*q_next))
print("by step: q = ({:.6f}, {:.6f}, {:.6f})".format(*step(q, v, p)[0]))
