#include "tumble/lcp/rational.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tumble/math/format.hpp"

namespace tumble {
namespace {

using boost::multiprecision::abs;
using boost::multiprecision::denominator;
using boost::multiprecision::gcd;
using boost::multiprecision::lcm;
using boost::multiprecision::msb;
using boost::multiprecision::numerator;
using boost::multiprecision::pow;

[[noreturn]] void refuse_word() { throw std::invalid_argument("expected a number like 1e-3 or 1/3"); }

[[noreturn]] void refuse_length(std::size_t max_digits) {
  throw std::invalid_argument(
      tumble::format("must have at most {} digits and an exponent within +-{}", max_digits, k_max_number_exponent));
}

bool is_digit(char c) { return '0' <= c && c <= '9'; }

// Takes the sign at the front of `text`, if any; true for a minus.
bool take_sign(std::string_view& text) {
  const bool is_minus = text.starts_with('-');
  if (is_minus || text.starts_with('+')) text.remove_prefix(1);
  return is_minus;
}

std::string_view take_digits(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
  const std::string_view digits = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(digits.size());
  return digits;
}

// The power of ten behind an 'e', all of `text`.
int parse_exponent(std::string_view text, std::size_t max_digits) {
  const bool is_minus = take_sign(text);
  const std::string_view digits = take_digits(text);
  if (digits.empty() || !text.empty()) refuse_word();
  int exponent = 0;
  for (const char c : digits) {
    exponent = 10 * exponent + (c - '0');
    if (exponent > k_max_number_exponent) refuse_length(max_digits);
  }
  return is_minus ? -exponent : exponent;
}

Rational parse_decimal(std::string_view text, std::size_t max_digits) {
  const bool is_minus = take_sign(text);
  std::string digits(take_digits(text));
  int exponent = 0;
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    const std::string_view decimals = take_digits(text);
    digits += decimals;
    exponent = -static_cast<int>(std::min(decimals.size(), max_digits));
  }
  if (digits.empty()) refuse_word();
  if (digits.size() > max_digits) refuse_length(max_digits);
  if (text.starts_with('e') || text.starts_with('E')) {
    exponent += parse_exponent(text.substr(1), max_digits);
  } else if (!text.empty()) {
    refuse_word();
  }
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));  // a leading 0 would mean octal
  const Integer mantissa(digits);
  const Integer power = pow(Integer(10), static_cast<unsigned>(std::abs(exponent)));
  const Rational value = exponent < 0 ? Rational(mantissa, power) : Rational(mantissa * power);
  return is_minus ? Rational(-value) : value;
}

}  // namespace

Rational parse_rational(std::string_view text, std::size_t max_digits) {
  const std::size_t slash = text.find('/');
  const Rational value = parse_decimal(text.substr(0, slash), max_digits);
  if (slash == std::string_view::npos) return value;
  const Rational divisor = parse_decimal(text.substr(slash + 1), max_digits);
  if (divisor == 0) throw std::invalid_argument("must be finite");
  return value / divisor;
}

Rational rational_of(double x) {
  int exponent = 0;
  const Integer mantissa(static_cast<long long>(std::ldexp(std::frexp(x, &exponent), 53)));
  exponent -= 53;
  const Integer power = Integer(1) << static_cast<unsigned>(std::abs(exponent));
  return exponent < 0 ? Rational(mantissa, power) : Rational(mantissa * power);
}

std::string to_text(const Rational& value) { return value.str(); }

std::vector<std::string> to_text(const std::vector<Rational>& values) {
  std::vector<std::string> texts;
  for (const Rational& value : values) texts.push_back(to_text(value));
  return texts;
}

std::size_t num_bits(const Integer& x) { return x == 0 ? 0 : msb(abs(x)) + 1; }

double nearest_double(const Rational& value) {
  if (value == 0) return 0.0;
  const Integer top = abs(numerator(value));
  const Integer bottom = denominator(value);
  // |value| is in (2^(exponent - 1), 2^(exponent + 1)). A double's last digit is worth 2^-1074 or more.
  const auto exponent = static_cast<long>(num_bits(top)) - static_cast<long>(num_bits(bottom));
  const double sign = value < 0 ? -1.0 : 1.0;
  if (exponent > 1025) return sign * std::numeric_limits<double>::infinity();
  long last_digit = std::max(exponent - 53, -1074L);
  const auto scaled = [](const Integer& x, long shift) { return shift > 0 ? x << static_cast<unsigned>(shift) : x; };
  Integer quotient = scaled(top, -last_digit) / scaled(bottom, last_digit);
  if (num_bits(quotient) > 53) {  // 54 digits: the power of two above was the larger one
    ++last_digit;
    quotient = scaled(top, -last_digit) / scaled(bottom, last_digit);
  }
  const Integer twice_rest = 2 * (scaled(top, -last_digit) - quotient * scaled(bottom, last_digit));
  const int half = twice_rest.compare(scaled(bottom, last_digit));
  if (half > 0 || (half == 0 && (quotient & 1) != 0)) ++quotient;
  return sign * std::ldexp(static_cast<double>(static_cast<long long>(quotient)), static_cast<int>(last_digit));
}

std::vector<double> nearest_doubles(const std::vector<Rational>& values) {
  std::vector<double> doubles;
  for (const Rational& value : values) doubles.push_back(nearest_double(value));
  return doubles;
}

std::vector<Rational> in_lowest_terms(std::vector<Rational> direction) {
  Integer multiple = 1;
  Integer factor = 0;
  for (const Rational& x : direction) multiple = lcm(multiple, denominator(x));
  for (Rational& x : direction) factor = gcd(factor, numerator(x *= multiple));
  if (factor == 0) return direction;
  for (Rational& x : direction) x /= factor;
  return direction;
}

}  // namespace tumble
