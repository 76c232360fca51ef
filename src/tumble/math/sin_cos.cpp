// Range reduction to |r| <= pi/4, two polynomials, then the quadrant swaps and signs them. Reduction: below 2^19 that of
// sin_cos_reduced.hpp, [Payne & Hanek 1983] beyond. Keys: docs/references.bib.
#include "tumble/math/sin_cos.hpp"

#include <array>
#include <cstdint>
#include <cstring>

#include "tumble/math/sin_cos_reduced.hpp"

namespace tumble {
namespace {

using Alone = Lanes<double, 1>;

// angle = quadrant * pi/2 + (r + tail). Only the two low bits of `quadrant` count.
struct Quadrant {
  double r;
  double tail;
  std::int64_t quadrant;
};

Quadrant reduce_cody_waite(double angle) {
  const auto [r, tail, n_bits] = reduce_moderate_angle<Alone>(angle);
  return {r, tail, n_bits};
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
Quadrant reduce_payne_hanek(double angle) {
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

}  // namespace

SinCos sin_cos(double angle) {
  constexpr double largest = HalfPi<double>::largest_angle;
  const bool is_moderate = -largest < angle && angle < largest;
  const auto [r, tail, quadrant] = is_moderate ? reduce_cody_waite(angle) : reduce_payne_hanek(angle);
  const double s = sin_polynomial<Alone>(r, tail);
  const double c = cos_polynomial<Alone>(r, tail);
  const bool swap = (quadrant & 1) != 0;
  const double sine = swap ? c : s;
  const double cosine = swap ? s : c;
  return {(quadrant & 2) != 0 ? -sine : sine, ((quadrant + 1) & 2) != 0 ? -cosine : cosine};
}

}  // namespace tumble
