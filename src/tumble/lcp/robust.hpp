// The default solver: a ladder of methods, each checked against the input.
#pragma once

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"
#include "tumble/lcp/workspace.hpp"

namespace tumble {

struct RobustSettings {
  double accepted_residual = 1e-12;  // [-] in (0, 0.01]: `solved` means a residual no larger than this
  std::vector<std::uint8_t> start_basis =
      {};  // n, or empty: `basis` of the result of a problem like this one, tried first
};

// Throws std::invalid_argument for a setting outside its range.
void validate(const RobustSettings& settings);

// One solution, or the best that can be said. Methods are tried in the order of `LcpRung`, the fast ones first; the
// first z whose residual, computed from the problem, is accepted ends the ladder. If none is:
//   infeasible          `certificate` proves it
//   no_solution_proved  n <= 12, and every complementary basis fails clearly
//   ray_unproven, iteration_limit, numerical    otherwise; z is the best candidate met
// For a problem without row_sizes that is not made of contacts, rows are first judged by their own terms alone; only if
// no method satisfies that, with the sizes of `residual`.
// Throws std::invalid_argument where `validate` does, or for a setting outside its range.
LcpResult robust(const LcpProblem& problem, const RobustSettings& settings = {});

}  // namespace tumble
