// Random numbers with the same bits on every machine.
#pragma once

#include <cstdint>

namespace tumble::problems {

// About 2^x: exact at whole x, linear between, so that no libm is involved.
inline double power_of_two(double exponent) {
  double value = 1.0;
  for (; exponent >= 1.0; exponent -= 1.0) value *= 2.0;
  for (; exponent < 0.0; exponent += 1.0) value *= 0.5;
  return value * (1.0 + exponent);
}

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

  // `power_of_two` of x uniform in [low_exponent, high_exponent).
  double log_uniform(double low_exponent, double high_exponent) {
    return power_of_two(uniform(low_exponent, high_exponent));
  }

  // One of 0 .. count - 1.
  int below(int count) { return static_cast<int>(uniform(0.0, count)); }

  // True once in `count` times, on average.
  bool one_in(int count) { return below(count) == 0; }

 private:
  std::uint64_t state_;
};

}  // namespace tumble::problems
