// Every solution of a small LCP, by trying all 2^n complementary bases: the oracle the other solvers are tested with.
#pragma once

#include <vector>

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble {

struct EnumerateSettings {
  double accepted_residual = 1e-9;  // [-] in (0, 0.01]: a basis counts as a solution up to this residual
};

// Throws std::invalid_argument for a setting outside its range.
void validate(const EnumerateSettings& settings);

inline constexpr std::size_t k_max_enumerate_size = 12;

// All vertex solutions of the problem, n <= 12, in the order of their bases read as binary numbers (z_0 the lowest
// bit), each once. A solution set that is not a point is the hull of its vertices here, plus rays; every LCP that has a
// solution has one at a vertex, so an empty list means that there is none, to the accuracy of double arithmetic: see
// `enumerate`. Singular bases are completed by rows whose w also vanishes. Throws std::invalid_argument where
// `validate` does, for n > 12, or for accepted_residual out of range.
std::vector<LcpResult> enumerate_solutions(const LcpProblem& problem, const EnumerateSettings& settings = {});

// The first of `enumerate_solutions`; `pivots` counts the bases tried. Status: solved; no_solution_proved if every
// basis fails by far more than round-off; numerical if none is a solution, but some is too close to one, or to
// singular, to tell.
LcpResult enumerate(const LcpProblem& problem, const EnumerateSettings& settings = {});

}  // namespace tumble
