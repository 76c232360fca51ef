#include "tumble/sweep/intervals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tumble::sweep {
namespace {

constexpr double k_z = 1.959963984540054;  // P(|Z| > z) = 0.05
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
  const double half = student_t_95(count - 1) * std::sqrt(squares / (n - 1.0) / n);
  return {mean - half, mean + half};
}

// The terms of the expansion about the normal distribution [Abramowitz & Stegun 1964, 26.7.5] with their values at z;
// for the first few degrees of freedom, where it is not exact enough, a table. No functions of libm, whose last bits
// differ.
double student_t_95(std::int64_t degrees) {
  constexpr std::array table = {
      12.706204736174705, 4.302652729749464,  3.1824463052837095, 2.7764451051977943, 2.5705818356363155,
      2.44691185114497,   2.3646242515927853, 2.3060041352041667, 2.2621571627982053, 2.228138851986275,
      2.2009851600916397, 2.178812829667229,  2.1603686564627926, 2.144786687917804,  2.1314495455597755,
      2.1199052992212546, 2.109815577833317,  2.1009220402410387, 2.0930240544083096, 2.085963447265865,
      2.0796138447276804, 2.0738730679040263, 2.0686576104190486, 2.063898561628026,  2.0595385527532977,
      2.055529438642873,  2.0518305164802855, 2.048407141795245,  2.0452296421327043};
  if (degrees <= static_cast<std::int64_t>(table.size())) return table[static_cast<std::size_t>(degrees - 1)];
  const double n = static_cast<double>(degrees);
  return k_z + (2.372271230298563 + (2.8224986157396117 + (2.5558496795077232 + 1.5895340533938236 / n) / n) / n) / n;
}

}  // namespace tumble::sweep
