// The principal pivoting method of Cottle and Dantzig.  [Cottle & Dantzig 1968; Cottle 1992, section 4.3]
#pragma once

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble {

struct DantzigSettings {
  int max_pivots = 0;                // [-] >= 0; 0 means 100 n + 1000
  double pivot_tolerance = 1e-12;    // [-] in [0, 1): smallest pivot, relative to the largest entry of its column
  double accepted_residual = 1e-10;  // [-] in (0, 0.01]: `solved` means a residual no larger than this
};

// Throws std::invalid_argument for a setting outside its range.
void validate(const DantzigSettings& settings);

// One row after the other. With |q| in place of q, z = 0 is a solution. Then, for each row r with q_r < 0 in turn, the
// constant of row r is lowered from |q_r| to q_r. On the way all variables but w_r stay >= 0 and complementary: z_r,
// the driving variable, grows; a variable that reaches 0 blocks, and its complement drives on; the row is done when w_r
// reaches 0. (The usual form starts from q and lets rows that wait their turn be as negative as a common bound; here
// each has a bound of its own, q_r - |q_r|.)
// Guaranteed, up to rounding and ties:
//   M a P-matrix                 the solution
//   M positive semidefinite,     a solution, or a proof that there is none (`infeasible`): such an M is row sufficient,
//   symmetric or not             so a row whose w_r cannot reach 0 contradicts the others
// At a tie the variable with the least index blocks [Chang 1979]. Some 2 n pivots; each factors its basis afresh, (k +
// 1)^3 / 3 operations for k basic z. M of frictional contacts is semidefinite only for friction 0; with friction the
// method may end on a ray where a solution exists.
// Status: solved; infeasible (`certificate`, checked); ray_unproven (the certificate is the ray's direction in z);
// iteration_limit; numerical (a singular basis, or the residual is too large). Throws std::invalid_argument where
// `validate` does, or for a setting outside its range.
LcpResult dantzig(const LcpProblem& problem, const DantzigSettings& settings = {});

}  // namespace tumble
