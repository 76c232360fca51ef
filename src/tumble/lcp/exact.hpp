// LCPs in rational arithmetic: answers without tolerances, and proofs.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"
#include "tumble/lcp/solution_face.hpp"

namespace tumble {

// A problem whose numbers are fractions, as text: "-3", "25/37", and also "0.1", which is 1/10 here. Results are in
// lowest terms with a positive denominator. Text, so that no header of a library for long numbers is needed.
struct ExactLcp {
  std::vector<std::string> M;  // n x n, row after row
  std::vector<std::string> q;  // n

  std::size_t size() const { return q.size(); }
};

// Work grows with n and with the length of the numbers. Both are limited by the functions below, which throw
// std::invalid_argument beyond: the digits of the problem brought to whole numbers, times n, are at most
// k_max_exact_bits. Doubles whose sizes spread over 60 powers of ten stay below it at n = 40.
inline constexpr std::size_t k_max_exact_size = 40;
inline constexpr std::size_t k_max_exact_enumerate_size = 12;
inline constexpr std::size_t k_max_exact_bits = 12'000;

// Every double is a fraction. Throws as `validate`. row_sizes are left behind: exact answers need none.
ExactLcp as_exact(const LcpProblem& problem);

// Each number as the nearest double.
LcpProblem as_doubles(const ExactLcp& problem);
std::vector<double> as_doubles(const std::vector<std::string>& numbers);

// True if `problem` is within the limits above, n <= k_max_exact_size.
bool is_within_exact_limits(const LcpProblem& problem);

struct ExactResult {
  LcpStatus status = LcpStatus::numerical;
  std::vector<std::string> z, w;         // n, or empty if there are none
  std::vector<std::uint8_t> basis;       // n; 1 where w_i = 0 by choice, 0 where z_i = 0
  std::vector<std::string> certificate;  // infeasible: y (n); ray_unproven: the direction of the ray in z (n); else
                                         // empty
  int pivots = 0;
};

// The z of one complementary basis: M_BB z_B = -q_B, z = 0 elsewhere. Status: solved if it solves the problem, else
// no_solution_proved: none with this basis does. If M_BB is regular, z and w are those of the basis either way. If it
// is singular, some solution if there is one with this basis, else empty. iteration_limit: see `exact_feasibility`.
ExactResult exact_solution(const ExactLcp& problem, std::span<const std::uint8_t> basis);

// Lemke's method with cover e and a lexicographic rule, which excludes cycles [Cottle 1992, algorithm 4.4.1,
// section 4.9]. Status: solved; infeasible, with y; ray_unproven, with a ray that is one; iteration_limit after 100 n +
// 1000 pivots.
ExactResult exact_lemke(const ExactLcp& problem);

// The same for the doubles of a problem, each answer rounded to the nearest double at the end. w and the residual are
// those of the rounded z; numerical, with z = 0, for a solution beyond the range of double. A rounded certificate may
// miss M'y <= 0 by its round-off: `proves_infeasible` tells.
LcpResult exact_lemke(const LcpProblem& problem);

// One solution, or the best proof that there is none: `exact_lemke` and, where that ends without either and n <= 12,
// `exact_solution_set`, of which the first vertex is taken. For n > 12 the status may be ray_unproven or
// iteration_limit.
ExactResult solve_exactly(const ExactLcp& problem);

// The whole solution set: a union of polyhedra, `faces`, each the hull of its vertices plus the cone of its rays. It is
// a union of faces of the polyhedron z >= 0, M z + q >= 0, and these are the largest of them.
struct ExactSolutionSet {
  // solved; infeasible, with a certificate; or no_solution_proved: there are points z >= 0, w >= 0, but none of them
  // is complementary. All three are proofs. iteration_limit: more than k_max_exact_generators vertices and rays were
  // met.
  LcpStatus status = LcpStatus::numerical;
  std::vector<ExactResult> vertices;           // ordered by basis, {z_i > 0}, as a binary number, z_0 the lowest bit
  std::vector<std::vector<std::string>> rays;  // directions in z
  std::vector<SolutionFace> faces;
  std::vector<std::string> certificate;  // infeasible: y (n)
};

inline constexpr std::size_t k_max_exact_generators = 10'000;

// n <= k_max_exact_enumerate_size. By the double description method, which keeps complementary generators only
// [Motzkin 1953; De Schutter & De Moor 1995]: singular bases need no care.
ExactSolutionSet exact_solution_set(const ExactLcp& problem);

// True if y proves that no z >= 0 has M z + q >= 0: y >= 0, M'y <= 0, q.y < 0, in exact arithmetic. [Farkas 1902]
// Throws std::invalid_argument if y has another length than q.
bool proves_infeasible(const ExactLcp& problem, const std::vector<std::string>& y);
bool proves_infeasible(const LcpProblem& problem, std::span<const double> y);

struct ExactFeasibility {
  LcpStatus status = LcpStatus::numerical;  // solved: `point` is feasible; infeasible; iteration_limit
  std::vector<std::string> point;           // z >= 0 with M z + q >= 0; empty unless solved
  std::vector<std::string> certificate;     // y of `proves_infeasible`; empty unless infeasible
};

// Decides whether any z >= 0 has w >= 0, by the first phase of the simplex method with Bland's rule [Bland 1977]. It
// always ends, but after exponentially many pivots in contrived cases: iteration_limit after 10 000.
ExactFeasibility exact_feasibility(const ExactLcp& problem);

}  // namespace tumble
