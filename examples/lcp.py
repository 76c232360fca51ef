"""Solves one LCP and lists all solutions of another: w = M z + q >= 0, z >= 0, w . z = 0. Twin: lcp.cpp."""

from tumble import lcp

result = lcp.solve([[2, 1], [1, 2]], [-5, -6])
print(f"{result.status}: z = ({result.z[0]:.6f}, {result.z[1]:.6f})")

solutions = lcp.all_solutions([[-2, -1], [-1, -2]], [1, 1])
print(f"{len(solutions)} solutions:")
for s in solutions:
    print(f"z = ({s.z[0]:.6f}, {s.z[1]:.6f}), w = ({s.w[0]:.6f}, {s.w[1]:.6f})")
