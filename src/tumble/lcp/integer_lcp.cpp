#include "tumble/lcp/integer_lcp.hpp"

#include <algorithm>
#include <stdexcept>

#include "tumble/math/format.hpp"

namespace tumble {
namespace {

using boost::multiprecision::denominator;
using boost::multiprecision::gcd;
using boost::multiprecision::lcm;
using boost::multiprecision::numerator;

}  // namespace

Rational parse_entry(const std::string& text, const std::string& name) {
  try {
    return parse_rational(text, k_max_result_digits);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(tumble::format("{}: {}, got '{}'", name, error.what(), text.substr(0, 30)));
  }
}

RationalLcp rationals_of(const ExactLcp& problem) {
  const std::size_t n = problem.size();
  if (n == 0) throw std::invalid_argument("q: must have at least 1 entry, got 0");
  if (problem.M.size() != n * n) {
    throw std::invalid_argument(
        tumble::format("M: must be {0} x {0} for q of length {0}, got {1} entries", n, problem.M.size()));
  }
  RationalLcp rationals;
  for (std::size_t i = 0; i < n * n; ++i) {
    rationals.M.push_back(parse_entry(problem.M[i], tumble::format("M[{}][{}]", i / n, i % n)));
  }
  for (std::size_t i = 0; i < n; ++i) rationals.q.push_back(parse_entry(problem.q[i], tumble::format("q[{}]", i)));
  return rationals;
}

RationalLcp rationals_of(const LcpProblem& problem) {
  RationalLcp rationals;
  for (const double x : problem.M) rationals.M.push_back(rational_of(x));
  for (const double x : problem.q) rationals.q.push_back(rational_of(x));
  return rationals;
}

// Rows are multiplied by their common denominator, then columns and rows divided by their common factors. Units that
// differ by powers of two, row from row and column from column, leave no trace.
IntegerLcp integers_of(const RationalLcp& problem) {
  IntegerLcp integers;
  const std::size_t n = integers.n = problem.size();
  const std::size_t stride = n + 1;
  const auto at = [&](std::size_t i, std::size_t j) -> const Rational& {
    return j < n ? problem.M[i * n + j] : problem.q[i];
  };
  std::vector<Rational> row_factor(n);
  for (std::size_t i = 0; i < n; ++i) {
    Integer common = 1;
    for (std::size_t j = 0; j < stride; ++j) common = lcm(common, denominator(at(i, j)));
    for (std::size_t j = 0; j < stride; ++j) {
      integers.entries.push_back(numerator(at(i, j)) * (common / denominator(at(i, j))));
    }
    row_factor[i] = common;
  }
  const auto divide = [&](std::size_t first, std::size_t count, std::size_t step) {
    Integer factor = 0;
    for (std::size_t k = 0; k < count; ++k) factor = gcd(factor, integers.entries[first + k * step]);
    if (factor == 0) return Integer(1);
    for (std::size_t k = 0; k < count; ++k) integers.entries[first + k * step] /= factor;
    return factor;
  };
  std::vector<Integer> column_divisor;
  for (std::size_t j = 0; j < stride; ++j) column_divisor.push_back(divide(j, n, stride));
  for (std::size_t i = 0; i < n; ++i) row_factor[i] /= Rational(divide(i * stride, stride, 1));
  const Rational q_divisor = column_divisor[n];
  for (std::size_t i = 0; i < n; ++i) {
    integers.z_unit.push_back(q_divisor / Rational(column_divisor[i]));
    integers.w_unit.push_back(q_divisor / row_factor[i]);
  }
  for (const Integer& entry : integers.entries) integers.num_bits = std::max(integers.num_bits, num_bits(entry));
  return integers;
}

void require_exact_limits(const IntegerLcp& problem, std::size_t max_size) {
  if (problem.n > max_size) {
    throw std::invalid_argument(
        tumble::format("q: exact arithmetic takes at most {} entries here, got {}", max_size, problem.n));
  }
  if (problem.n * problem.num_bits > k_max_exact_bits) {
    throw std::invalid_argument(tumble::format(
        "M, q: brought to whole numbers, n times their binary digits must be at most {}, got {} times {}",
        k_max_exact_bits, problem.n, problem.num_bits));
  }
}

}  // namespace tumble
