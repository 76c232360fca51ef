#include "tumble/lcp/equilibrate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace tumble {
namespace {

// log2(x) for x > 0, linear between powers of two: exact there, off by at most 0.09, the same bits everywhere.
double rough_log2(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // in [1/2, 1)
  return exponent + 2.0 * mantissa - 2.0;
}

// The logarithms of the entries that count; the others are marked by -infinity.
class Logarithms {
 public:
  explicit Logarithms(const LcpProblem& problem) : n_(problem.size()), logs_(n_ * n_, k_none) {
    for (std::size_t k = 0; k < n_ * n_; ++k) {
      if (problem.M[k] != 0.0) logs_[k] = rough_log2(std::abs(problem.M[k]));
    }
  }

  std::size_t size() const { return n_; }
  bool counts(std::size_t i, std::size_t j) const { return logs_[i * n_ + j] != k_none; }
  double operator()(std::size_t i, std::size_t j) const { return logs_[i * n_ + j]; }

  void leave_out_tiny_entries(const std::vector<double>& x) {
    constexpr double tiny = -40.0;
    std::vector<double> row_largest(n_, k_none);
    std::vector<double> column_largest(n_, k_none);
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) {
        const double scaled = (*this)(i, j) + x[i] + x[j];
        row_largest[i] = std::max(row_largest[i], scaled);
        column_largest[j] = std::max(column_largest[j], scaled);
      }
    }
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) {
        const double scaled = (*this)(i, j) + x[i] + x[j];
        if (scaled < std::min(row_largest[i], column_largest[j]) + tiny) logs_[i * n_ + j] = k_none;
      }
    }
  }

 private:
  static constexpr double k_none = -std::numeric_limits<double>::infinity();
  std::size_t n_;
  std::vector<double> logs_;
};

// A start that moves with the units: from the diagonal, or where it is 0 from neighbours that have one.
std::vector<double> start_of_fit(const Logarithms& logs) {
  const std::size_t n = logs.size();
  std::vector<double> x(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (logs.counts(i, i)) x[i] = -0.5 * logs(i, i);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (logs.counts(i, i)) continue;
    double sum = 0.0;
    int count = 0;
    for (std::size_t j = 0; j < n; ++j) {
      if (!logs.counts(j, j) || !logs.counts(i, j)) continue;
      sum += logs(i, j) + x[j];
      ++count;
    }
    if (count > 0) x[i] = -sum / count;
  }
  return x;
}

// Gauss-Seidel on the normal equations of the fit; a few sweeps give the fraction of a bit that a rounded exponent needs.
std::vector<double> fit_exponents(const Logarithms& logs) {
  constexpr int num_sweeps = 10;
  const std::size_t n = logs.size();
  std::vector<double> x = start_of_fit(logs);
  for (int sweep = 0; sweep < num_sweeps; ++sweep) {
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0.0;
      int weight = 0;
      for (std::size_t j = 0; j < n; ++j) {
        if (i == j) continue;
        for (const auto& [row, column] : {std::pair(i, j), std::pair(j, i)}) {
          if (!logs.counts(row, column)) continue;
          sum += logs(row, column) + x[j];
          ++weight;
        }
      }
      if (logs.counts(i, i)) {  // 2 (log + 2 x_i) in the derivative
        sum += 2.0 * logs(i, i);
        weight += 4;
      }
      if (weight > 0) x[i] = -sum / weight;
    }
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
  Logarithms logs(problem);
  logs.leave_out_tiny_entries(fit_exponents(logs));
  Equilibration scales;
  const std::vector<double> x = fit_exponents(logs);
  const int common = static_cast<int>(std::lround(2.0 * x[0]));  // an odd power of two that all entries share goes here
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

std::vector<double> typical_row_sizes(const LcpProblem& problem) {
  const Equilibration scales = equilibrate(problem);
  const std::vector<double> largest = block_sizes(problem, scales);
  std::vector<double> sizes(problem.size());
  for (std::size_t i = 0; i < problem.size(); ++i) sizes[i] = std::ldexp(largest[scales.row_block[i]], -scales.row[i]);
  return sizes;
}

}  // namespace tumble
