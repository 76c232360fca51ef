// How far a vector z is from solving an LCP, judged by the problem alone and free of units.
#pragma once

#include <span>
#include <vector>

#include "tumble/lcp/problem.hpp"

namespace tumble {

// Each part is >= 0 and has no unit; 0 is exact, round-off is about 1e-16, 1 is nonsense.
struct LcpResidual {
  double negative_w = 0.0;       // largest  -w_i / d_i
  double negative_z = 0.0;       // largest  -z_i / s_i
  double complementarity = 0.0;  // largest  min(w_i / d_i, z_i / s_i)

  double largest() const;  // of the three; infinity where z is not finite
};

// Terms M_ij z_j count up to this multiple of the size of q in their row: what cancels by more digits proves nothing.
inline constexpr double k_largest_growth = 1e7;

// The residual of z (n entries), with w = M z + q and, as round-off in row i is proportional to the terms summed there,
//   d_i = |q_i| + min(sum_j |M_ij z_j|, 1e7 size of q) + row size i,      1 / s_i = max_j |M_ji| / d_j.
// The size of q is the largest |q_k| that row i is coupled with, in the unit of w_i; without that bound a z of 1e13
// would solve every problem that a change of M in its last digit can solve. It does not change when rows or columns are
// rescaled, that is, with the units of mass, length and time, if `row_sizes` are given in those units. Derivation:
// docs/theory/lcp.md. Throws std::invalid_argument where `validate` does or if z has another length than q.
LcpResidual residual(const LcpProblem& problem, std::span<const double> z);

// What `residual` takes where a problem has no row_sizes (n values >= 0). If the problem is made of frictional
// contacts, the sizes that a contact model gives: the largest abs(q_k) for velocities, that over the contact's own
// response for its friction cone. Else 1e-6 of the largest abs(q_k) that row i is coupled with, in the unit of w_i.
std::vector<double> default_row_sizes(const LcpProblem& problem);

// M z + q, each row summed from the first column to the last.
std::vector<double> complement(const LcpProblem& problem, std::span<const double> z);

}  // namespace tumble
