// Lemke's complementary pivoting with a dense tableau.  [Lemke 1965; Cottle 1992, algorithm 4.4.1]
#pragma once

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble {

struct LemkeSettings {
  int max_pivots = 0;                // [-] >= 0; 0 means 100 n + 1000
  double pivot_tolerance = 1e-8;     // [-] in [0, 1): smallest pivot, relative to the largest entry of its column
  double accepted_residual = 1e-10;  // [-] in (0, 0.01]: `solved` means a residual no larger than this
};

// Throws std::invalid_argument for a setting outside its range.
void validate(const LemkeSettings& settings);

// One solution of the problem, if Lemke finds it: guaranteed (up to rounding) if M is copositive-plus and the problem
// feasible, and for the contact problems of this library, not for every M. For any n; about n pivots of n^2 operations
// each. Whatever way the pivots end, the z they leave is solved for anew from its basis and judged by `residual`; if
// they end at a z that is not right, they are walked once more without a tie rule. Status: solved, ray_unproven (the
// certificate is the ray's direction in z), iteration_limit or numerical. Throws std::invalid_argument where `validate`
// does, or for a setting outside its range.
LcpResult lemke(const LcpProblem& problem, const LemkeSettings& settings = {});

// One pivot of the method as a textbook shows it. Variables are numbered w = 0 .. n-1, z = n .. 2n-1, z0 = 2n.
struct LemkePivot {
  int entering;
  int leaving;
  std::vector<int> basis;       // after the pivot: the basic variable of each row
  std::vector<double> tableau;  // after the pivot: n x (2n + 2), row after row: w, z, z0, value; units of the problem
};

// The same solve, with every pivot written down. z0 is in the unit that makes the largest entry of its column in
// `start` -1; the others are powers of two, of the scaling. A second walk begins, from `start`, where z0 enters again.
struct LemkeTrace {
  LcpResult result;
  std::vector<double> start;  // the tableau of w - M z - d z0 = q, before the first pivot
  std::vector<LemkePivot> pivots;
};
LemkeTrace trace_lemke(const LcpProblem& problem, const LemkeSettings& settings = {});

}  // namespace tumble
