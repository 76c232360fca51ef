// Range reduction and rational approximations of fdlibm (e_exp.c, e_log.c), [Sun Microsystems 1993].
#include "tumble/math/exp_log.hpp"

#include <bit>
#include <cstdint>
#include <limits>

#include "tumble/math/bit_cast.hpp"

namespace tumble {
namespace {

// ln 2 = high + low; `high` has 33 bits, so that k high is exact for |k| < 2^20.
constexpr double k_ln2_high = 0x1.62e42feep-1;
constexpr double k_ln2_low = 0x1.a39ef35793c76p-33;

double power_of_two(int exponent) { return bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52); }

}  // namespace

double exp(double x) {
  constexpr double overflow = 0x1.62e42fefa39efp+9;
  constexpr double underflow = -0x1.74910d52d3051p+9;  // e^x rounds to 0 below it
  if (x != x) return x;
  if (x > overflow) return std::numeric_limits<double>::infinity();
  if (x < underflow) return 0.0;

  // x = k ln 2 + r, |r| <= ln 2 / 2, r = high - low.
  constexpr double round_to_integer = 0x1.8p52;
  const double k = (x * 0x1.71547652b82fep+0 + round_to_integer) - round_to_integer;
  const double high = x - k * k_ln2_high;
  const double low = k * k_ln2_low;
  const double r = high - low;
  const double r2 = r * r;
  const double even =
      r2 * (0x1.555555555553ep-3 +
            r2 * (-0x1.6c16c16bebd93p-9 +
                  r2 * (0x1.1566aaf25de2cp-14 + r2 * (-0x1.bbd41c5d26bf1p-20 + r2 * 0x1.6376972bea4dp-25))));
  const double c = r - even;
  const double e = 1.0 - ((low - (r * c) / (2.0 - c)) - high);
  // In two factors, as 2^k itself may be out of range.
  const int exponent = static_cast<int>(k);
  const int half = exponent / 2;
  return e * power_of_two(half) * power_of_two(exponent - half);
}

double log(double x) {
  if (x != x || x < 0.0) return std::numeric_limits<double>::quiet_NaN();
  if (x == 0.0) return -std::numeric_limits<double>::infinity();
  if (x > std::numeric_limits<double>::max()) return x;
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    exponent = -54;
  }

  // x = 2^k (1 + f), sqrt(2) / 2 < 1 + f < sqrt(2).
  const auto bits = bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52) - 1023;
  double mantissa = bit_cast<double>((bits & 0xfffffffffffffu) | 0x3ff0000000000000u);
  if (mantissa > 0x1.6a09e667f3bcdp+0) {
    mantissa *= 0.5;
    ++exponent;
  }
  const double f = mantissa - 1.0;
  const double k = exponent;
  const double s = f / (2.0 + f);
  const double s2 = s * s;
  const double s4 = s2 * s2;
  const double odd = s4 * (0x1.999999997fa04p-2 + s4 * (0x1.c71c51d8e78afp-3 + s4 * 0x1.39a09d078c69fp-3));
  const double even = s2 * (0x1.5555555555593p-1 +
                            s4 * (0x1.2492494229359p-2 + s4 * (0x1.7466496cb03dep-3 + s4 * 0x1.2f112df3e5244p-3)));
  const double half_f2 = 0.5 * f * f;
  return k * k_ln2_high - ((half_f2 - (s * (half_f2 + (odd + even)) + k * k_ln2_low)) - f);
}

}  // namespace tumble
