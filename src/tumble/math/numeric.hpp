// Finite checks and text <-> number conversions that depend neither on the locale nor on the compiler's library.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace tumble {

template <class Range>
bool all_finite(const Range& values) {
  for (const double value : values) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

// The whole of `text` as a finite or non-finite double ("1e-3", "-2", "nan"); nothing if any character is left over.
std::optional<double> parse_number(std::string_view text);

// The same, or two numbers with a '/' between them: their quotient, rounded once.
std::optional<double> parse_fraction(std::string_view text);

// An angle in degrees, written "30 deg", in rad; nothing for other text. 45, 90 and 180 deg are the nearest doubles.
std::optional<double> parse_degrees(std::string_view text);

// Shortest decimal text that reads back to the same bits.
std::string to_text(double value);

}  // namespace tumble
