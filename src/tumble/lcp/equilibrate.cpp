#include "tumble/lcp/equilibrate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "tumble/math/bit_cast.hpp"

namespace tumble {
namespace {

// log2(x) for x > 0, linear between powers of two: exact there, off by at most 0.09, the same bits everywhere.
double rough_log2(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // in [1/2, 1)
  return exponent + 2.0 * mantissa - 2.0;
}

// Floor of log2 |x|, from the bits: cheaper than frexp. A denormal counts as the smallest normal number, 0 as less.
int exponent_of(double x) {
  const auto bits = bit_cast<std::uint64_t>(x);
  const int exponent = static_cast<int>(bits >> 52 & 0x7ff);
  return (bits << 1) == 0 ? -4000 : exponent - 1023;
}

// True if M_ii is a size to scale by: not 0, and not dwarfed, by 2^-40, by entries beside it (never so in a
// semidefinite matrix, where M_ij M_ji <= M_ii M_jj).
bool has_diagonal(const LcpProblem& problem, const std::vector<int>& diagonal, std::size_t i) {
  if (problem(i, i) == 0.0) return false;
  for (std::size_t j = 0; j < problem.size(); ++j) {
    if (problem(j, j) == 0.0) continue;
    const int beside = exponent_of(problem(i, j)) + exponent_of(problem(j, i));
    if (diagonal[i] + diagonal[j] + 80 < beside) return false;
  }
  return true;
}

// x with M_ij 2^(x_i + x_j) near 1 on the diagonal.
void find_exponents(const LcpProblem& problem, Equilibration& scales) {
  const std::size_t n = problem.size();
  std::vector<double>& x = scales.exponents;
  std::vector<int>& diagonal = scales.diagonal_exponent;
  constexpr double unknown = std::numeric_limits<double>::infinity();
  x.assign(n, unknown);
  diagonal.resize(n);
  for (std::size_t i = 0; i < n; ++i) diagonal[i] = exponent_of(problem(i, i));
  for (std::size_t i = 0; i < n; ++i) {
    if (has_diagonal(problem, diagonal, i)) x[i] = -0.5 * rough_log2(std::abs(problem(i, i)));
  }
  // Rows without a diagonal follow those with one. The loop reads only the latter, marked by `diagonal` from here on.
  for (std::size_t i = 0; i < n; ++i) diagonal[i] = x[i] != unknown;
  for (std::size_t i = 0; i < n; ++i) {
    if (diagonal[i]) continue;
    double largest = -unknown;
    for (std::size_t j = 0; j < n; ++j) {
      if (!diagonal[j]) continue;
      const double size = std::max(std::abs(problem(i, j)), std::abs(problem(j, i)));
      if (size > 0.0) largest = std::max(largest, rough_log2(size) + x[j]);
    }
    x[i] = std::isfinite(largest) ? -largest : 0.0;
  }
}

void find_blocks(const LcpProblem& problem, Equilibration& scales) {
  const std::size_t n = problem.size();
  std::vector<std::size_t>& parent = scales.row_block;  // rows, then columns; split at the end
  parent.resize(2 * n);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  std::size_t num_blocks = 2 * n;
  for (std::size_t i = 0; i < n && num_blocks > 1; ++i) {
    std::size_t row_root = root(i);
    for (std::size_t j = 0; j < n; ++j) {
      if (problem(i, j) == 0.0) continue;
      const std::size_t column_root = root(n + j);
      if (column_root == row_root) continue;
      parent[row_root] = column_root;
      row_root = column_root;
      --num_blocks;
    }
  }
  scales.column_block.resize(n);
  for (std::size_t i = 0; i < n; ++i) scales.column_block[i] = root(n + i);
  for (std::size_t i = 0; i < n; ++i) parent[i] = root(i);
  parent.resize(n);
}

}  // namespace

void equilibrate(const LcpProblem& problem, Equilibration& scales) {
  const std::size_t n = problem.size();
  find_exponents(problem, scales);
  const std::vector<double>& x = scales.exponents;
  const int common = static_cast<int>(std::lround(2.0 * x[0]));  // an odd power of two that all entries share goes here
  scales.row.resize(n);
  scales.column.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    scales.column[i] = static_cast<int>(std::lround(x[i] - x[0]));
    scales.row[i] = scales.column[i] + common;
  }
  find_blocks(problem, scales);
}

Equilibration equilibrate(const LcpProblem& problem) {
  Equilibration scales;
  equilibrate(problem, scales);
  return scales;
}

void block_sizes(const LcpProblem& problem, const Equilibration& scales, std::vector<double>& sizes) {
  sizes.assign(2 * problem.size(), 0.0);
  for (std::size_t i = 0; i < problem.size(); ++i) {
    double& size = sizes[scales.row_block[i]];
    size = std::max(size, std::ldexp(std::abs(problem.q[i]), scales.row[i]));
  }
}

std::vector<double> block_sizes(const LcpProblem& problem, const Equilibration& scales) {
  std::vector<double> sizes;
  block_sizes(problem, scales, sizes);
  return sizes;
}

void row_sizes_of_q(const LcpProblem& problem, const Equilibration& scales, std::vector<double>& sizes) {
  block_sizes(problem, scales, sizes);
  // sizes[block] is needed until the last row of the block is done: the row's own size waits behind the blocks.
  const std::size_t n = problem.size();
  sizes.resize(3 * n);
  for (std::size_t i = 0; i < n; ++i) sizes[2 * n + i] = std::ldexp(sizes[scales.row_block[i]], -scales.row[i]);
  sizes.erase(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(2 * n));
}

void share_for_round_off(const std::vector<double>& of_q, std::vector<double>& round_off) {
  // A rounding error of the block, 1e-16 of its size, then counts as a residual of 1e-10; a violation of 1e-12 of it as
  // 1e-6, which no solver accepts.
  constexpr double share = 1e-6;
  round_off.resize(of_q.size());
  for (std::size_t i = 0; i < of_q.size(); ++i) round_off[i] = share * of_q[i];
}

}  // namespace tumble
