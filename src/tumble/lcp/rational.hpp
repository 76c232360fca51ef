// Integers and fractions of any length, and their way from and to text and double. Not a public header.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

namespace tumble {

// Without expression templates, so that sums of products are of the type they look like.
using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
using Rational =
    boost::multiprecision::number<boost::multiprecision::rational_adaptor<boost::multiprecision::cpp_int_backend<>>,
                                  boost::multiprecision::et_off>;

// Limits of a decimal in text: 1e999999 would fill the memory.
inline constexpr std::size_t k_max_file_digits = 1000;       // of problems in files
inline constexpr std::size_t k_max_result_digits = 100'000;  // of numbers passed as text, longer than any result
inline constexpr int k_max_number_exponent = 1000;           // power of ten, either sign

// A decimal ("-0.1", "1e-3") or a fraction of two ("1/3"), meaning exactly that. Throws std::invalid_argument with what
// is expected instead, without the text itself.
Rational parse_rational(std::string_view text, std::size_t max_digits);

// x must be finite. Exact: every double is a fraction.
Rational rational_of(double x);

// "p/q" in lowest terms, "p" for a whole number.
std::string to_text(const Rational& value);
std::vector<std::string> to_text(const std::vector<Rational>& values);

// The double nearest to the value, ties to even; infinite beyond the range of double.
double nearest_double(const Rational& value);
std::vector<double> nearest_doubles(const std::vector<Rational>& values);

// The same direction by the smallest whole numbers.
std::vector<Rational> in_lowest_terms(std::vector<Rational> direction);

// Number of binary digits of |x|; 0 for 0.
std::size_t num_bits(const Integer& x);

}  // namespace tumble
