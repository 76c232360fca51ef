// What sine and cosine are made of, for single numbers and for lanes: reduction of moderate angles to |r| <= pi/4
// [Cody & Waite 1980] and two polynomials. In double and in float; + - * alone. Not a public header.
#pragma once

#include "tumble/math/lanes.hpp"

namespace tumble {

// pi/2 = part_1 + part_2 + part_3. The first two are so short that n * part is exact for the n of moderate angles.
template <class Real>
struct HalfPi;

template <>
struct HalfPi<double> {
  static constexpr double inverse = 0x1.45f306dc9c883p-1, part_1 = 0x1.921fb544p+0, part_2 = 0x1.0b4611a6p-34,
                          part_3 = 0x1.3198a2e037073p-69;
  static constexpr double round_to_integer = 0x1.8p52;  // adding and subtracting it rounds to the nearest integer
  static constexpr double largest_angle = 0x1p19;       // |n| < 2^20, parts of 33 bits
};

template <>
struct HalfPi<float> {
  static constexpr float inverse = 0x1.45f306p-1f, part_1 = 0x1.92p+0f, part_2 = 0x1.fb4p-12f, part_3 = 0x1.4442d2p-24f;
  static constexpr float round_to_integer = 0x1.8p23f;
  static constexpr float largest_angle = 0x1p12f;  // |n| < 2^13, parts of 11 bits
};

// angle = n pi/2 + (r + tail), |r| <= pi/4 up to rounding. The two low bits of `n_bits` are those of n.
template <class L>
struct ReducedAngle {
  typename L::Value r, tail;
  typename L::Bits n_bits;
};

// |angle| < HalfPi::largest_angle.
template <class L>
TUMBLE_INLINE ReducedAngle<L> reduce_moderate_angle(typename L::Value angle) {
  using Parts = HalfPi<typename L::Real>;
  const auto shifted = angle * Parts::inverse + Parts::round_to_integer;
  const auto n = shifted - Parts::round_to_integer;
  const auto leading = angle - n * Parts::part_1;
  const auto second = n * Parts::part_2;
  const auto r = leading - second;
  const auto tail = ((leading - r) - second) - n * Parts::part_3;
  return {r, tail, L::bits(shifted)};
}

// Polynomials for |r| <= pi/4: best approximation, weighted for absolute error, coefficients rounded; their own error
// is below 4e-18 in double and 2e-9 in float. Summed in pairs (Estrin), which halves the chain of operations that wait
// for each other.
template <class L>
TUMBLE_INLINE typename L::Value sin_polynomial(typename L::Value r, typename L::Value tail) {
  using Real = typename L::Real;
  const auto r2 = r * r;
  const auto r4 = r2 * r2;
  if constexpr (sizeof(Real) == 8) {
    const auto low = -0x1.5555555555549p-3 + 0x1.111111110f8cbp-7 * r2;
    const auto middle = -0x1.a01a019c19d28p-13 + 0x1.71de357dcae5dp-19 * r2;
    const auto high = -0x1.ae5e6a68775aep-26 + 0x1.5d9416fb7da6cp-33 * r2;
    const auto sum = low + r4 * (middle + r4 * high);
    return r + (r * r2 * sum + tail * (1.0 - 0.5 * r2));
  } else {
    const auto sum = (-0x1.555554p-3f + 0x1.1105aap-7f * r2) + r4 * -0x1.98d7b4p-13f;
    return r + (r * r2 * sum + tail * (1.0f - 0.5f * r2));
  }
}

template <class L>
TUMBLE_INLINE typename L::Value cos_polynomial(typename L::Value r, typename L::Value tail) {
  using Real = typename L::Real;
  const auto r2 = r * r;
  const auto r4 = r2 * r2;
  const auto half = Real(0.5) * r2;
  const auto leading = Real(1) - half;
  if constexpr (sizeof(Real) == 8) {
    const auto low = 0x1.555555555554ep-5 + -0x1.6c16c16c1551cp-10 * r2;
    const auto middle = 0x1.a01a019d00903p-16 + -0x1.27e4f83cbdd1dp-22 * r2;
    const auto high = 0x1.1eea0b3e6b4ecp-29 + -0x1.8fbd8542a4514p-37 * r2;
    const auto sum = low + r4 * (middle + r4 * high);
    return leading + (((Real(1) - leading) - half) + (r4 * sum - r * tail));
  } else {
    const auto sum = (0x1.55554ap-5f + -0x1.6c0c86p-10f * r2) + r4 * 0x1.9a00e4p-16f;
    return leading + (((Real(1) - leading) - half) + (r4 * sum - r * tail));
  }
}

}  // namespace tumble
