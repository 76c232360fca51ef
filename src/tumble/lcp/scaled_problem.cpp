#include "tumble/lcp/scaled_problem.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tumble/math/bit_cast.hpp"

namespace tumble {
namespace {

// 2^exponent for -1022 <= exponent <= 1023.
double power_of_two(int exponent) { return bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52); }

constexpr int k_safe_exponent = 250;  // three factors and an entry of 1e+-60 stay within the range of normal numbers

bool is_safe(double x) { return x == 0.0 || (std::abs(x) > 1e-60 && std::abs(x) < 1e60); }

}  // namespace

double scaled_by(double x, int exponent) {
  return std::abs(exponent) <= k_safe_exponent && is_safe(x) ? x * power_of_two(exponent) : std::ldexp(x, exponent);
}

void scale(const LcpProblem& problem, ScaledProblem& scaled) {
  const std::size_t n = problem.size();
  equilibrate(problem, scaled.scales);
  const Equilibration& scales = scaled.scales;
  block_sizes(problem, scales, scaled.sizes);
  // The exponent of each block's q; a block without q of its own is as large as the largest.
  const double largest = *std::max_element(scaled.sizes.begin(), scaled.sizes.end());
  scaled.size_exponents.resize(2 * n);
  for (std::size_t block = 0; block < 2 * n; ++block) {
    std::frexp(scaled.sizes[block] > 0.0 ? scaled.sizes[block] : largest, &scaled.size_exponents[block]);
  }
  scaled.z_exponent.resize(n);
  scaled.w_exponent.resize(n);
  int largest_exponent = 0;
  for (std::size_t i = 0; i < n; ++i) {
    scaled.z_exponent[i] = scales.column[i] + scaled.size_exponents[scales.column_block[i]];
    scaled.w_exponent[i] = scales.row[i] - scaled.size_exponents[scales.row_block[i]];
    largest_exponent = std::max({largest_exponent, std::abs(scaled.z_exponent[i]), std::abs(scaled.w_exponent[i])});
  }
  scaled.q.resize(n);
  scaled.M.resize(n * n);
  const bool is_in_range = largest_exponent <= k_safe_exponent &&
                           std::all_of(problem.M.begin(), problem.M.end(), [](double x) { return is_safe(x); });
  for (std::size_t i = 0; i < n; ++i) {
    scaled.q[i] = scaled_by(problem.q[i], scaled.w_exponent[i]);
    const double* from = problem.M.data() + i * n;
    double* to = scaled.M.data() + i * n;
    if (is_in_range) {
      const double row_factor = power_of_two(scaled.w_exponent[i]);
      for (std::size_t j = 0; j < n; ++j) to[j] = from[j] * row_factor * power_of_two(scaled.z_exponent[j]);
    } else {
      for (std::size_t j = 0; j < n; ++j) to[j] = std::ldexp(from[j], scaled.w_exponent[i] + scaled.z_exponent[j]);
    }
  }
}

void unscale(const ScaledProblem& scaled, const std::vector<double>& z_scaled, std::vector<double>& z) {
  z.resize(z_scaled.size());
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = scaled_by(std::max(z_scaled[i], 0.0), scaled.z_exponent[i]);
}

}  // namespace tumble
