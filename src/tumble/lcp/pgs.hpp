// Projected Gauss-Seidel and successive over-relaxation.  [Cryer 1971; Cottle 1992, section 5.2]
#pragma once

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble {

struct PgsSettings {
  int max_sweeps = 10000;            // [-] >= 1
  double relaxation = 1.0;           // [-] in (0, 2): 1 is Gauss-Seidel, more leaps ahead, less is cautious
  double accepted_residual = 1e-8;   // [-] in (0, 0.01]: `solved` means a residual no larger than this
  std::vector<double> start_z = {};  // n, or empty for 0; each >= 0
};

// Throws std::invalid_argument for a setting outside its range.
void validate(const PgsSettings& settings);

// What most game engines do, with one unknown at a time: sweep over the rows, and in each choose z_i so that w_i = 0,
// or z_i = 0 if that would be negative. A sweep costs n^2 operations. The residual is looked at every tenth sweep; each
// sweep reduces it by some factor, which is close to 1 for stacks and for heavy bodies on light ones.
// Guaranteed to converge for a symmetric positive definite M with any relaxation in (0, 2) [Cryer 1971], and for an M
// with a positive diagonal that dominates its rows with relaxation <= 1.
// Every M_ii must be > 0: a row that does not respond to its own unknown cannot be solved for it. The cone rows of
// frictional contacts have M_ii = 0. So for problems of contacts with friction, as for any other M_ii <= 0, the status
// is `numerical` after 0 sweeps, with z = start_z; `nlgs` is for them. Status: solved; iteration_limit; numerical.
// `pivots` counts the sweeps; z is the best candidate met. Throws std::invalid_argument where `validate` does, or for a
// setting outside its range.
LcpResult pgs(const LcpProblem& problem, const PgsSettings& settings = {});

}  // namespace tumble
