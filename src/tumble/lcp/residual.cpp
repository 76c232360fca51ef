#include "tumble/lcp/residual.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tumble/lcp/judge.hpp"
#include "tumble/math/format.hpp"

namespace tumble {

double LcpResidual::largest() const { return std::max({negative_w, negative_z, complementarity}); }

std::vector<double> complement(const LcpProblem& problem, std::span<const double> z) {
  const std::size_t n = problem.size();
  std::vector<double> w(n);
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < n; ++j) sum += problem(i, j) * z[j];
    w[i] = sum + problem.q[i];
  }
  return w;
}

namespace {

// w = M z + q and d_i for R rows from `first` on, side by side: a sum from the first column to the last waits for each
// of its additions, R sums fill the time.
template <std::size_t R>
void sum_rows(const LcpProblem& problem, std::size_t first, const RowSizes& sizes, std::span<const double> z,
              std::vector<double>& w, JudgeBuffers& buffers) {
  const std::size_t n = problem.size();
  const double* rows = problem.M.data() + first * n;
  double sum[R] = {};
  double size[R] = {};
  for (const std::size_t j : buffers.columns) {
    for (std::size_t r = 0; r < R; ++r) {
      const double term = rows[r * n + j] * z[j];
      sum[r] += term;
      size[r] += std::abs(term);
    }
  }
  for (std::size_t r = 0; r < R; ++r) {
    const std::size_t i = first + r;
    w[i] = sum[r] + problem.q[i];
    const double bound = k_largest_growth * sizes.of_q[i];
    const double terms = bound > 0.0 && std::isfinite(size[r]) ? std::min(size[r], bound) : size[r];
    buffers.row_scales[i] = sizes.round_off[i] + std::abs(problem.q[i]) + terms;
  }
}

// |z_i| / s_i = max_j |M_ji z_i| / d_j.
double relative_step(const LcpProblem& problem, std::span<const double> z, const std::vector<double>& d,
                     std::size_t i) {
  double largest = 0.0;
  for (std::size_t j = 0; j < problem.size(); ++j) {
    if (d[j] > 0.0) largest = std::max(largest, std::abs(problem(j, i) * z[i]) / d[j]);
  }
  return largest;
}

}  // namespace

LcpResidual judge(const LcpProblem& problem, const RowSizes& sizes, std::span<const double> z, std::vector<double>& w,
                  JudgeBuffers& buffers) {
  const std::size_t n = problem.size();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  w.resize(n);
  buffers.row_scales.resize(n);
  buffers.columns.clear();
  for (std::size_t j = 0; j < n; ++j) {
    if (z[j] != 0.0) buffers.columns.push_back(j);
  }
  std::size_t first = 0;
  for (; first + 4 <= n; first += 4) sum_rows<4>(problem, first, sizes, z, w, buffers);
  for (; first < n; ++first) sum_rows<1>(problem, first, sizes, z, w, buffers);

  const std::vector<double>& d = buffers.row_scales;
  for (const double d_i : d) {
    if (!std::isfinite(d_i)) return {infinity, infinity, infinity};
  }
  LcpResidual parts;
  for (std::size_t i = 0; i < n; ++i) {
    const double relative_w = d[i] > 0.0 ? w[i] / d[i] : 0.0;
    parts.negative_w = std::max(parts.negative_w, -relative_w);
    if (z[i] < 0.0) {
      const double relative_z = relative_step(problem, z, d, i);
      // A negative z_i that reaches no row is not a matter of round-off.
      parts.negative_z = std::max(parts.negative_z, relative_z > 0.0 ? relative_z : infinity);
    } else if (z[i] > 0.0 && relative_w > parts.complementarity) {  // else the smaller of the two is no larger either
      parts.complementarity = std::max(parts.complementarity, std::min(relative_w, relative_step(problem, z, d, i)));
    }
  }
  return parts;
}

std::vector<double> default_row_sizes(const LcpProblem& problem) {
  LcpProblem without_sizes{problem.M, problem.q, {}};
  ContactStructure contacts;
  Equilibration scales;
  RowSizes sizes;
  find_row_sizes(without_sizes, contacts, scales, sizes);
  return sizes.round_off;
}

LcpResidual residual(const LcpProblem& problem, std::span<const double> z) {
  validate(problem);
  if (z.size() != problem.size()) {
    throw std::invalid_argument(tumble::format("z: must have {} entries like q, got {}", problem.size(), z.size()));
  }
  std::vector<double> w;
  JudgeBuffers buffers;
  ContactStructure contacts;
  Equilibration scales;
  RowSizes sizes;
  find_row_sizes(problem, contacts, scales, sizes);
  return judge(problem, sizes, z, w, buffers);
}

}  // namespace tumble
