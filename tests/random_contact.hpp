// Random contacts of single planar bodies, with the same numbers on every machine.
#pragma once

#include <cstdint>

#include "tumble/lcp/one_contact.hpp"

namespace tumble::test {

// SplitMix64: a full-period counter, mixed. The standard's distributions differ between libraries; this does not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  // Uniform in [low, high).
  double uniform(double low, double high) {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t x = state_;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    x ^= x >> 31;
    return low + (high - low) * (static_cast<double>(x >> 11) * 0x1p-53);
  }

  // 2^x for x uniform, over [low, high), piecewise linear between powers of two so that no libm is involved.
  double log_uniform(double low_exponent, double high_exponent) {
    double exponent = uniform(low_exponent, high_exponent);
    double value = 1.0;
    for (; exponent >= 1.0; exponent -= 1.0) value *= 2.0;
    for (; exponent < 0.0; exponent += 1.0) value *= 0.5;
    return value * (1.0 + exponent);
  }

 private:
  std::uint64_t state_;
};

// A body with its contact point at r from the centre of mass, moving with v, ground below: A and b of its LCP.
// Masses 1e-3 to 1e3 kg, sizes 1 cm to 10 m, steps 1e-6 to 0.1 s; friction 0 in one of eight.
inline OneContact random_contact(Random& random, double max_friction) {
  const double mass = random.log_uniform(-10.0, 10.0);
  const double size = random.log_uniform(-6.6, 3.3);
  const double radius_of_gyration = size * random.uniform(0.3, 1.0);
  const double r_x = size * random.uniform(-1.0, 1.0);
  const double r_y = -size * random.uniform(0.0, 1.0);
  const double step = random.log_uniform(-20.0, -3.3);
  const double inverse_inertia = 1.0 / (mass * radius_of_gyration * radius_of_gyration);
  const double speed = random.log_uniform(-20.0, 6.0);
  const double u_n = speed * random.uniform(-1.0, 0.4);
  const double u_t = speed * random.uniform(-1.0, 1.0);
  const double friction = random.uniform(0.0, 8.0) < 1.0 ? 0.0 : random.uniform(0.0, max_friction);
  return {step * (1.0 / mass + r_x * r_x * inverse_inertia),
          -step * r_x * r_y * inverse_inertia,
          step * (1.0 / mass + r_y * r_y * inverse_inertia),
          u_n,
          u_t,
          friction};
}

}  // namespace tumble::test
