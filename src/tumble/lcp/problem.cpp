#include "tumble/lcp/problem.hpp"

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "tumble/math/bit_cast.hpp"
#include "tumble/math/format.hpp"
#include "tumble/math/target_clones.hpp"

namespace tumble {

namespace {

// Exponent bits of a NaN or an infinity are all 1. Written so that it becomes vector code.
TUMBLE_INSTRUCTION_SETS
bool is_all_finite(const double* values, std::size_t count) {
  constexpr std::uint64_t exponent = 0x7ff0000000000000u;
  std::uint64_t is_bad = 0;
  for (std::size_t i = 0; i < count; ++i) is_bad |= (bit_cast<std::uint64_t>(values[i]) & exponent) == exponent;
  return is_bad == 0;
}

}  // namespace

void validate(const LcpProblem& problem) {
  const std::size_t n = problem.size();
  if (n == 0) throw std::invalid_argument("q: must have at least 1 entry, got 0");
  if (problem.M.size() != n * n) {
    throw std::invalid_argument(
        tumble::format("M: must be {0} x {0} for q of length {0}, got {1} entries", n, problem.M.size()));
  }
  const bool is_finite = is_all_finite(problem.M.data(), n * n);
  for (std::size_t i = 0; i < n * n && !is_finite; ++i) {
    if (!std::isfinite(problem.M[i])) {
      throw std::invalid_argument(tumble::format("M[{}][{}]: must be finite, got {}", i / n, i % n, problem.M[i]));
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(problem.q[i])) {
      throw std::invalid_argument(tumble::format("q[{}]: must be finite, got {}", i, problem.q[i]));
    }
  }
  if (problem.row_sizes.empty()) return;
  if (problem.row_sizes.size() != n) {
    throw std::invalid_argument(
        tumble::format("row_sizes: must be empty or have {} entries, got {}", n, problem.row_sizes.size()));
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!(std::isfinite(problem.row_sizes[i]) && problem.row_sizes[i] >= 0.0)) {
      throw std::invalid_argument(
          tumble::format("row_sizes[{}]: must be finite and >= 0, got {}", i, problem.row_sizes[i]));
    }
  }
}

}  // namespace tumble
