// Proofs that a problem has no z >= 0 with M z + q >= 0.
#pragma once

#include <span>
#include <vector>

#include "tumble/lcp/problem.hpp"

namespace tumble {

// True if y (n values) proves that the problem is infeasible: y >= 0, M'y <= 0 and q'y < 0 leave no room for
// y'(M z + q) >= 0 with z >= 0. [Farkas 1902; Cottle 1992, 2.7.9] M'y may exceed 0 by the round-off of its terms, 1e-13
// of them; q'y must be negative by 1e-6 of its terms, so that round-off cannot make a certificate.
bool is_infeasibility_certificate(const LcpProblem& problem, std::span<const double> y);

// A y as above, its largest entry 1; empty if none was found, as for every feasible problem. The residual of the least
// squares problem min |M z - w + q| over z, w >= 0, in equilibrated units, is one. [Lawson & Hanson 1974, ch. 23]
// About n factorisations of n^3 operations: for problems that no method solves. The problem must be valid.
std::vector<double> find_infeasibility(const LcpProblem& problem);

}  // namespace tumble
