// Lemke's complementary pivoting with a dense tableau.  [Lemke 1965; Cottle 1992, algorithm 4.4.1]
#pragma once

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble {

struct LemkeSettings {
  int max_pivots = 0;               // [-] >= 0; 0 means 100 n + 1000
  double pivot_tolerance = 1e-8;    // [-] in [0, 1): smallest pivot, relative to the largest entry of its column
  double accepted_residual = 1e-8;  // [-] in (0, 0.01]: `solved` means a residual no larger than this
};

// One solution of the problem, if Lemke finds it: guaranteed (up to rounding) if M is copositive-plus and the problem
// feasible, and for the contact problems of this library, not for every M. For any n; about n pivots of n^2 operations
// each. Whatever way the pivots end, the z they leave is solved for anew from its basis and judged by `residual`.
// Status: solved, ray_unproven, iteration_limit or numerical.
// Throws std::invalid_argument where `validate` does, or for a setting outside its range.
LcpResult lemke(const LcpProblem& problem, const LemkeSettings& settings = {});

}  // namespace tumble
