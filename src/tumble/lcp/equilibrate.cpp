#include "tumble/lcp/equilibrate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tumble {
namespace {

// log2(x) for x > 0, linear between powers of two: exact there, off by at most 0.09, the same bits everywhere.
double rough_log2(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // in [1/2, 1)
  return exponent + 2.0 * mantissa - 2.0;
}

// True if M_ii is a size to scale by: not 0, and not dwarfed by entries beside it (never so in a semidefinite matrix).
bool has_diagonal(const LcpProblem& problem, std::size_t i) {
  constexpr double dwarfed = 0x1p-40;
  const double M_ii = std::abs(problem(i, i));
  if (M_ii == 0.0) return false;
  for (std::size_t j = 0; j < problem.size(); ++j) {
    const double M_jj = std::abs(problem(j, j));
    if (M_jj == 0.0) continue;
    const double beside = std::sqrt(std::abs(problem(i, j))) * std::sqrt(std::abs(problem(j, i)));
    if (std::sqrt(M_ii) * std::sqrt(M_jj) < dwarfed * beside) return false;
  }
  return true;
}

// x with M_ij 2^(x_i + x_j) near 1 on the diagonal.
std::vector<double> scaling_exponents(const LcpProblem& problem) {
  const std::size_t n = problem.size();
  std::vector<double> x(n, 0.0);
  std::vector<bool> is_scaled(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    is_scaled[i] = has_diagonal(problem, i);
    if (is_scaled[i]) x[i] = -0.5 * rough_log2(std::abs(problem(i, i)));
  }
  const std::vector<bool> by_diagonal = is_scaled;
  for (std::size_t i = 0; i < n; ++i) {
    if (is_scaled[i]) continue;
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < n; ++j) {
      const double size = std::max(std::abs(problem(i, j)), std::abs(problem(j, i)));
      if (by_diagonal[j] && size > 0.0) largest = std::max(largest, rough_log2(size) + x[j]);
    }
    if (std::isfinite(largest)) x[i] = -largest;
  }
  return x;
}

void find_blocks(const LcpProblem& problem, Equilibration& scales) {
  const std::size_t n = problem.size();
  std::vector<std::size_t> parent(2 * n);  // rows, then columns
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (problem(i, j) != 0.0) parent[root(i)] = root(n + j);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    scales.row_block.push_back(root(i));
    scales.column_block.push_back(root(n + i));
  }
}

}  // namespace

Equilibration equilibrate(const LcpProblem& problem) {
  const std::vector<double> x = scaling_exponents(problem);
  const int common = static_cast<int>(std::lround(2.0 * x[0]));  // an odd power of two that all entries share goes here
  Equilibration scales;
  for (const double x_i : x) {
    scales.column.push_back(static_cast<int>(std::lround(x_i - x[0])));
    scales.row.push_back(scales.column.back() + common);
  }
  find_blocks(problem, scales);
  return scales;
}

std::vector<double> block_sizes(const LcpProblem& problem, const Equilibration& scales) {
  std::vector<double> largest(2 * problem.size(), 0.0);
  for (std::size_t i = 0; i < problem.size(); ++i) {
    double& size = largest[scales.row_block[i]];
    size = std::max(size, std::ldexp(std::abs(problem.q[i]), scales.row[i]));
  }
  return largest;
}

std::vector<double> round_off_sizes(const LcpProblem& problem) {
  // A rounding error of the block, 1e-16 of its size, then counts as a residual of 1e-10; a violation of 1e-12 of it as
  // 1e-6, which no solver accepts.
  constexpr double share = 1e-6;
  const Equilibration scales = equilibrate(problem);
  const std::vector<double> largest = block_sizes(problem, scales);
  std::vector<double> sizes(problem.size());
  for (std::size_t i = 0; i < problem.size(); ++i) {
    sizes[i] = std::ldexp(share * largest[scales.row_block[i]], -scales.row[i]);
  }
  return sizes;
}

}  // namespace tumble
