#include "tumble/lcp/equilibrate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tumble {
namespace {

// log2(x) for x > 0, linear between powers of two: exact there, off by at most 0.09, the same bits everywhere.
double rough_log2(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // in [1/2, 1)
  return exponent + 2.0 * mantissa - 2.0;
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
  // Alternating least squares. A dense matrix is done after one sweep; contact matrices settle to a fraction of a bit
  // within ten, which is all that a scale rounded to a power of two can use.
  constexpr int num_sweeps = 10;
  const std::size_t n = problem.size();
  std::vector<double> logs(n * n, 0.0);
  for (std::size_t k = 0; k < n * n; ++k) {
    if (problem.M[k] != 0.0) logs[k] = rough_log2(std::abs(problem.M[k]));
  }
  std::vector<double> row(n, 0.0);
  std::vector<double> column(n, 0.0);
  const auto fit = [&](std::vector<double>& unknown, const std::vector<double>& known, std::size_t own_stride,
                       std::size_t other_stride) {
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0.0;
      int count = 0;
      for (std::size_t j = 0; j < n; ++j) {
        const std::size_t k = i * own_stride + j * other_stride;
        if (problem.M[k] == 0.0) continue;
        sum += logs[k] + known[j];
        ++count;
      }
      unknown[i] = count > 0 ? -sum / count : 0.0;
    }
  };
  for (int sweep = 0; sweep < num_sweeps; ++sweep) {
    fit(row, column, n, 1);
    fit(column, row, 1, n);
  }
  Equilibration scales{std::vector<int>(n), std::vector<int>(n), {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    scales.row[i] = static_cast<int>(std::lround(row[i]));
    scales.column[i] = static_cast<int>(std::lround(column[i]));
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

std::vector<double> typical_row_sizes(const LcpProblem& problem) {
  const Equilibration scales = equilibrate(problem);
  const std::vector<double> largest = block_sizes(problem, scales);
  std::vector<double> sizes(problem.size());
  for (std::size_t i = 0; i < problem.size(); ++i) sizes[i] = std::ldexp(largest[scales.row_block[i]], -scales.row[i]);
  return sizes;
}

}  // namespace tumble
