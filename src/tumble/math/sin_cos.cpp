// Range reduction to |r| <= pi/4, two polynomials, then the quadrant swaps and signs them.
// Reduction: [Cody & Waite 1980] below 2^19, [Payne & Hanek 1983] beyond. Keys: docs/references.bib.
#include "tumble/math/sin_cos.hpp"

#include <array>
#include <cstdint>
#include <cstring>

namespace tumble {
namespace {

// angle = quadrant * pi/2 + (r + r_tail), |r| <= pi/4 up to rounding. Only the two low bits of `quadrant` count.
struct ReducedAngle {
  double r;
  double r_tail;
  std::int64_t quadrant;
};

constexpr double k_two_over_pi = 0x1.45f306dc9c883p-1;
constexpr double k_largest_cody_waite_angle = 0x1p19;

// pi/2 = part_1 + part_2 + part_3. The first two hold 33 bits, so n * part is exact for |n| < 2^20.
constexpr double k_half_pi_part_1 = 0x1.921fb544p+0;
constexpr double k_half_pi_part_2 = 0x1.0b4611a6p-34;
constexpr double k_half_pi_part_3 = 0x1.3198a2e037073p-69;

ReducedAngle reduce_cody_waite(double angle) {
  constexpr double round_to_integer = 0x1.8p52;  // adding and subtracting it rounds to the nearest integer
  const double n = (angle * k_two_over_pi + round_to_integer) - round_to_integer;
  const double leading = angle - n * k_half_pi_part_1;
  const double second = n * k_half_pi_part_2;
  const double r = leading - second;
  const double r_tail = ((leading - r) - second) - n * k_half_pi_part_3;
  return {r, r_tail, static_cast<std::int64_t>(n)};
}

// Bits of 2/pi, most significant first, behind one word of zeros: word 1 starts at weight 1/2.
constexpr std::array<std::uint64_t, 20> k_two_over_pi_bits = {
    0x0000000000000000, 0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561,
    0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484, 0xe99c7026b45f7e41,
    0x3991d639835339f4, 0x9c845f8bbdf9283b, 0x1ff897ffde05980f, 0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7,
    0x4f463f669e5fea2d, 0x7527bac7ebe5f17b, 0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab};

std::uint64_t two_over_pi_word(int first_bit) {
  const auto word = static_cast<std::size_t>(first_bit / 64);
  const int shift = first_bit % 64;
  if (shift == 0) return k_two_over_pi_bits[word];
  return (k_two_over_pi_bits[word] << shift) | (k_two_over_pi_bits[word + 1] >> (64 - shift));
}

// |angle| = mantissa * 2^exponent. Bits of 2/pi whose product with it is a multiple of 4 turns of pi/2 are skipped;
// the next 192 bits give quadrant and fraction with more than 64 good bits left.
ReducedAngle reduce_payne_hanek(double angle) {
  __extension__ using Uint128 = unsigned __int128;
  __extension__ using Int128 = __int128;
  std::uint64_t bits;
  std::memcpy(&bits, &angle, sizeof bits);
  const int exponent = static_cast<int>((bits >> 52) & 0x7ff) - 1075;
  if (exponent == 0x7ff - 1075) return {angle - angle, 0.0, 0};  // NaN or infinity: NaN
  const std::uint64_t mantissa = (bits & 0xfffffffffffff) | 0x10000000000000;

  const int first_bit = 64 + exponent - 2;
  const std::uint64_t high = two_over_pi_word(first_bit);
  const std::uint64_t middle = two_over_pi_word(first_bit + 64);
  const std::uint64_t low = two_over_pi_word(first_bit + 128);

  // Upper 128 bits of mantissa * (high, middle, low) modulo 2^192; unit: 4 quadrants.
  const Uint128 carry = (static_cast<Uint128>(mantissa) * low) >> 64;
  Uint128 product = (static_cast<Uint128>(mantissa * high) << 64) + static_cast<Uint128>(mantissa) * middle + carry;

  auto quadrant = static_cast<std::int64_t>(product >> 126);
  product <<= 2;                                       // fraction of a quadrant, unit 2^-128
  const auto fraction = static_cast<Int128>(product);  // as signed: fractions above 1/2 turn negative
  if (fraction < 0) ++quadrant;
  double r = static_cast<double>(fraction) * 0x1p-128 * 0x1.921fb54442d18p+0;
  if (angle < 0.0) {
    r = -r;
    quadrant = -quadrant;
  }
  return {r, 0.0, quadrant};
}

// Polynomials for |r| <= pi/4: best approximation, weighted for absolute error, coefficients rounded to double; their
// own error is below 4e-18. `tail` is the part of the angle that did not fit into r. Summed in pairs (Estrin), which
// halves the chain of operations that wait for each other.
double sin_polynomial(double r, double tail) {
  const double r2 = r * r;
  const double r4 = r2 * r2;
  const double low = -0x1.5555555555549p-3 + 0x1.111111110f8cbp-7 * r2;
  const double middle = -0x1.a01a019c19d28p-13 + 0x1.71de357dcae5dp-19 * r2;
  const double high = -0x1.ae5e6a68775aep-26 + 0x1.5d9416fb7da6cp-33 * r2;
  const double sum = low + r4 * (middle + r4 * high);
  return r + (r * r2 * sum + tail * (1.0 - 0.5 * r2));
}

double cos_polynomial(double r, double tail) {
  const double r2 = r * r;
  const double r4 = r2 * r2;
  const double low = 0x1.555555555554ep-5 + -0x1.6c16c16c1551cp-10 * r2;
  const double middle = 0x1.a01a019d00903p-16 + -0x1.27e4f83cbdd1dp-22 * r2;
  const double high = 0x1.1eea0b3e6b4ecp-29 + -0x1.8fbd8542a4514p-37 * r2;
  const double sum = low + r4 * (middle + r4 * high);
  const double half = 0.5 * r2;
  const double leading = 1.0 - half;
  return leading + (((1.0 - leading) - half) + (r4 * sum - r * tail));
}

}  // namespace

SinCos sin_cos(double angle) {
  const bool is_moderate = -k_largest_cody_waite_angle < angle && angle < k_largest_cody_waite_angle;
  const auto [r, tail, quadrant] = is_moderate ? reduce_cody_waite(angle) : reduce_payne_hanek(angle);
  const double s = sin_polynomial(r, tail);
  const double c = cos_polynomial(r, tail);
  const bool swap = (quadrant & 1) != 0;
  const double sine = swap ? c : s;
  const double cosine = swap ? s : c;
  return {(quadrant & 2) != 0 ? -sine : sine, ((quadrant + 1) & 2) != 0 ? -cosine : cosine};
}

}  // namespace tumble
