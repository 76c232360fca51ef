// Nonlinear block Gauss-Seidel over contacts.  [Jean 1999; Moreau 1988]
#pragma once

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble {

struct NlgsSettings {
  int max_sweeps = 10000;            // [-] >= 1
  double accepted_residual = 1e-8;   // [-] in (0, 0.01]: `solved` means a residual no larger than this
  std::vector<double> start_z = {};  // n, or empty for 0; each >= 0: `z` of the result of a problem like this one
};

// Throws std::invalid_argument for a setting outside its range.
void validate(const NlgsSettings& settings);

// The solver of non-smooth contact dynamics, for problems with many contacts: sweep over the contacts, and solve each
// exactly, in closed form (`solve_one_contact`), for the impulses that the others have at the time. Contacts are
// recognised in (M, q) whatever the order of their unknowns; a normal without friction unknowns is a block of its own.
// Only entries of M other than 0 are visited, so that a sweep costs as many operations as M has of them, and memory for
// factors is never needed. Each sweep reduces the error by some factor: fine for a good start or a loose accepted
// residual, slow for stacks and for heavy bodies on light ones.
// Guaranteed to converge without friction (M symmetric, positive semidefinite, the problem feasible); with friction
// nothing is, but it does as a rule. Where a problem has several solutions, it converges to one of them.
// In a problem that is not made of contacts, each row is a block, which needs M_ii > 0: `pgs` with sparse rows. If some
// M_ii is not, the status is `numerical` after 0 sweeps, with z = start_z.
// Status: solved; iteration_limit; numerical. `pivots` counts the sweeps; z is the best candidate met. Throws
// std::invalid_argument where `validate` does, or for a setting outside its range.
LcpResult nlgs(const LcpProblem& problem, const NlgsSettings& settings = {});

}  // namespace tumble
