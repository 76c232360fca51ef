#include "tumble/math/numeric.hpp"

#include <charconv>
#include <system_error>
#include <version>

#include "tumble/math/format.hpp"

#ifndef __cpp_lib_to_chars
#include <cerrno>
#include <cstdlib>
#endif

namespace tumble {

std::optional<double> parse_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (!text.empty() && text.front() == '-') return std::nullopt;
  }
  if (text.empty()) return std::nullopt;
#ifdef __cpp_lib_to_chars
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
#else
  // libc++ 14 (emscripten) has no from_chars for double; its strtod knows only the C locale.
  const std::string copy(text);
  if (copy.front() == ' ' || copy.find_first_of("xX") != std::string::npos) return std::nullopt;
  char* end = nullptr;
  errno = 0;
  const double value = std::strtod(copy.c_str(), &end);
  if (end != copy.c_str() + copy.size()) return std::nullopt;
  if (errno == ERANGE && (value == 0.0 || !std::isfinite(value))) return std::nullopt;  // as from_chars
  return value;
#endif
}

std::optional<double> parse_fraction(std::string_view text) {
  const std::size_t slash = text.find('/');
  const std::optional<double> numerator = parse_number(text.substr(0, slash));
  if (!numerator || slash == std::string_view::npos) return numerator;
  const std::optional<double> denominator = parse_number(text.substr(slash + 1));
  return denominator ? std::optional(*numerator / *denominator) : std::nullopt;
}

std::optional<double> parse_degrees(std::string_view text) {
  if (!text.ends_with("deg")) return std::nullopt;
  text.remove_suffix(3);
  text = text.substr(0, text.find_last_not_of(" \t") + 1);
  const std::optional<double> degrees = parse_number(text);
  if (!degrees || !std::isfinite(*degrees)) return std::nullopt;
  constexpr double k_pi = 3.14159265358979323846;
  return *degrees / 180.0 * k_pi;
}

std::string to_text(double value) { return tumble::format("{}", value); }

}  // namespace tumble
