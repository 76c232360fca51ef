#include "tumble/lcp/residual.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "tumble/lcp/equilibrate.hpp"

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

LcpResidual residual(const LcpProblem& problem, std::span<const double> z) {
  validate(problem);
  const std::size_t n = problem.size();
  if (z.size() != n) {
    throw std::invalid_argument(fmt::format("z: must have {} entries like q, got {}", n, z.size()));
  }
  const std::vector<double> w = complement(problem, z);
  std::vector<double> d = problem.row_sizes.empty() ? round_off_sizes(problem) : problem.row_sizes;
  for (std::size_t i = 0; i < n; ++i) {
    d[i] += std::abs(problem.q[i]);
    for (std::size_t j = 0; j < n; ++j) d[i] += std::abs(problem(i, j) * z[j]);
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!std::all_of(d.begin(), d.end(), [](double x) { return std::isfinite(x); })) {
    return {infinity, infinity, infinity};
  }
  LcpResidual parts;
  for (std::size_t i = 0; i < n; ++i) {
    const double relative_w = d[i] > 0.0 ? w[i] / d[i] : 0.0;
    parts.negative_w = std::max(parts.negative_w, -relative_w);
    double relative_z = 0.0;  // |z_i| / s_i
    for (std::size_t j = 0; j < n; ++j) {
      if (d[j] > 0.0) relative_z = std::max(relative_z, std::abs(problem(j, i) * z[i]) / d[j]);
    }
    if (z[i] < 0.0) {
      // A negative z_i that reaches no row is not a matter of round-off.
      parts.negative_z = std::max(parts.negative_z, relative_z > 0.0 ? relative_z : infinity);
    } else {
      parts.complementarity = std::max(parts.complementarity, std::min(relative_w, relative_z));
    }
  }
  return parts;
}

}  // namespace tumble
