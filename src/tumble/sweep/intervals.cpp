#include "tumble/sweep/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tumble::sweep {
namespace {

constexpr double k_tails = 0.05;
constexpr double k_z = 1.959963984540054;  // P(|Z| > z) = k_tails
constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Interval interval_of_share(std::int64_t count, std::int64_t total) {
  if (total <= 0) return {k_nan, k_nan};
  const auto n = static_cast<double>(total);
  const double p = static_cast<double>(count) / n;
  const double scale = 1.0 / (1.0 + k_z * k_z / n);
  const double middle = scale * (p + 0.5 * k_z * k_z / n);
  const double half = scale * k_z * std::sqrt(p * (1.0 - p) / n + 0.25 * k_z * k_z / (n * n));
  // At the ends the formula gives 0 and 1 but for rounding.
  return {count == 0 ? 0.0 : std::max(0.0, middle - half), count == total ? 1.0 : std::min(1.0, middle + half)};
}

Interval interval_of_mean(std::int64_t count, double mean, double squares) {
  if (count < 2) return {k_nan, k_nan};
  const double n = static_cast<double>(count);
  const double half = student_t_95(n - 1.0) * std::sqrt(squares / (n - 1.0) / n);
  return {mean - half, mean + half};
}

double student_t_95(double n) {
  if (n < 1.5) return 1.0 / std::tan(0.5 * std::numbers::pi * k_tails);
  if (n < 2.5) return std::sqrt(2.0 / (k_tails * (2.0 - k_tails)) - 2.0);
  const double a = 1.0 / (n - 0.5);
  const double b = 48.0 / (a * a);
  double c = ((20700.0 * a / b - 98.0) * a - 16.0) * a + 96.36;
  const double d = ((94.5 / (b + c) - 3.0) / b + 1.0) * std::sqrt(0.5 * a * std::numbers::pi) * n;
  double y = std::pow(d * k_tails, 2.0 / n);
  if (y > 0.05 + a) {  // an expansion about the normal distribution
    const double x = -k_z;
    y = x * x;
    if (n < 5.0) c += 0.3 * (n - 4.5) * (x + 0.6);
    c += (((0.05 * d * x - 5.0) * x - 7.0) * x - 2.0) * x + b;
    y = (((((0.4 * y + 6.3) * y + 36.0) * y + 94.5) / c - y - 3.0) / b + 1.0) * x;
    y = std::expm1(a * y * y);
  } else {
    y = ((1.0 / (((n + 6.0) / (n * y) - 0.089 * d - 0.822) * (n + 2.0) * 3.0) + 0.5 / (n + 4.0)) * y - 1.0) *
            (n + 1.0) / (n + 2.0) +
        1.0 / y;
  }
  return std::sqrt(n * y);
}

}  // namespace tumble::sweep
