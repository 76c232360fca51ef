#include "tumble/math/distributions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tumble/math/exp_log.hpp"
#include "tumble/math/philox.hpp"

namespace tumble {
namespace {

using Coefficients = std::array<double, 8>;

double polynomial(const Coefficients& c, double x) {
  double sum = c[7];
  for (std::size_t k = 7; k-- > 0;) sum = sum * x + c[k];
  return sum;
}

double quotient(const Coefficients& above, const Coefficients& below, double x) {
  return polynomial(above, x) / polynomial(below, x);
}

// In the middle of its interval of width 2^-52: neither 0 nor 1, and symmetric about 1/2.
double inner_fraction(std::uint64_t word) { return (static_cast<double>(word >> 12) + 0.5) * 0x1p-52; }

}  // namespace

double uniform(std::uint64_t word, double low, double high) {
  const double fraction = static_cast<double>(word >> 11) * 0x1p-53;
  return std::clamp(low + fraction * (high - low), low, high);
}

double normal(std::uint64_t word, double mean, double deviation) {
  return mean + deviation * normal_quantile(inner_fraction(word));
}

double log_uniform(std::uint64_t word, double low, double high) {
  return std::clamp(exp(uniform(word, log(low), log(high))), low, high);
}

double normal_quantile(double p) {
  // clang-format off
  static constexpr Coefficients a = {3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3, 1.3731693765509461125e4,
                                     4.5921953931549871457e4, 6.7265770927008700853e4, 3.3430575583588128105e4, 2.5090809287301226727e3};
  static constexpr Coefficients b = {1.0, 4.2313330701600911252e1, 6.8718700749205790830e2, 5.3941960214247511077e3,
                                     2.1213794301586595867e4, 3.9307895800092710610e4, 2.8729085735721942674e4, 5.2264952788528545610e3};
  static constexpr Coefficients c = {1.42343711074968357734e0, 4.63033784615654529590e0, 5.76949722146069140550e0, 3.64784832476320460504e0,
                                     1.27045825245236838258e0, 2.41780725177450611770e-1, 2.27238449892691845833e-2, 7.74545014278341407640e-4};
  static constexpr Coefficients d = {1.0, 2.05319162663775882187e0, 1.67638483018380384940e0, 6.89767334985100004550e-1,
                                     1.48103976427480074590e-1, 1.51986665636164571966e-2, 5.47593808499534494600e-4, 1.05075007164441684324e-9};
  static constexpr Coefficients e = {6.65790464350110377720e0, 5.46378491116411436990e0, 1.78482653991729133580e0, 2.96560571828504891230e-1,
                                     2.65321895265761230930e-2, 1.24266094738807843860e-3, 2.71155556874348757815e-5, 2.01033439929228813265e-7};
  static constexpr Coefficients f = {1.0, 5.99832206555887937690e-1, 1.36929880922735805310e-1, 1.48753612908506148525e-2,
                                     7.86869131145613259100e-4, 1.84631831751005468180e-5, 1.42151175831644588870e-7, 2.04426310338993978564e-15};
  // clang-format on
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) return q * quotient(a, b, 0.180625 - q * q);
  const double r = std::sqrt(-log(q < 0.0 ? p : 1.0 - p));
  const double z = r <= 5.0 ? quotient(c, d, r - 1.6) : quotient(e, f, r - 5.0);
  return q < 0.0 ? -z : z;
}

std::uint64_t draw_word(std::uint64_t seed, std::uint64_t instance, std::uint64_t number) {
  return philox({number / 4 + 1, instance, 0, 0}, {seed, 0})[number % 4];
}

}  // namespace tumble
