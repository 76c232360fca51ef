// Every solution of a small LCP, by trying all 2^n complementary bases: the oracle the other solvers are tested with.
#pragma once

#include <vector>

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"
#include "tumble/lcp/solution_face.hpp"

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
// basis is regular and fails by far more than round-off, or, where one is not or does not, if exact arithmetic finds
// none either; numerical if the numbers are too long for that, or the exact solution is none in double.
LcpResult enumerate(const LcpProblem& problem, const EnumerateSettings& settings = {});

// The whole solution set: a union of polyhedra, `faces`, each the hull of its vertices plus the cone of its rays.
struct SolutionSet {
  LcpStatus status = LcpStatus::numerical;  // as `enumerate`
  std::vector<LcpResult> vertices;          // as `enumerate_solutions`
  std::vector<std::vector<double>> rays;    // directions in z, the largest entry 1
  std::vector<SolutionFace> faces;          // the largest ones
};

// As `enumerate_solutions`, with rays and faces. What counts as 0 there is z_i and w_i up to accepted_residual of the
// scales in residual.hpp. Without tolerances: `exact_solution_set`.
SolutionSet solution_set(const LcpProblem& problem, const EnumerateSettings& settings = {});

}  // namespace tumble
