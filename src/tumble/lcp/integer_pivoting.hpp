// Lemke's method, the first phase of the simplex method and single bases, in whole numbers. Not a public header.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tumble/lcp/integer_lcp.hpp"

namespace tumble {

// Feasibility of  x >= 0, s = A x + a >= 0.
struct Phase1 {
  LcpStatus status = LcpStatus::iteration_limit;  // solved: feasible; infeasible
  std::vector<Rational> x;                        // k
  std::vector<Rational> y;                        // m; y >= 0, A'y <= 0, a.y < 0
};

// `entries` is m x (k + 1), row after row: A, and a in the last column.
Phase1 find_feasible_point(std::size_t m, std::size_t k, const std::vector<Integer>& entries);

struct RationalResult {
  LcpStatus status = LcpStatus::iteration_limit;
  std::vector<Rational> z;            // in the units of the problem
  std::vector<Rational> certificate;  // as in ExactResult
  std::vector<std::uint8_t> basis;
  int pivots = 0;
};

RationalResult run_lemke(const IntegerLcp& problem);
RationalResult run_basis(const IntegerLcp& problem, std::span<const std::uint8_t> basis);

// A certificate y for w', in whole numbers for w.
std::vector<Rational> in_units(std::vector<Rational> y, const IntegerLcp& problem);

}  // namespace tumble
