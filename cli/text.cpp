#include "text.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"

namespace tumble::cli {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& expected, const std::string& text) {
  throw std::invalid_argument(tumble::format("{}: must be {}, got '{}'", option, expected, text));
}

}  // namespace

double number(const std::string& option, const std::string& text) {
  const auto value = parse_number(text);
  if (!value || !std::isfinite(*value)) refuse(option, "a finite number", text);
  return *value;
}

int whole_number(const std::string& option, const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) refuse(option, "a whole number", text);
  return value;
}

double angle(const std::string& option, const std::string& text) {
  const bool in_degrees = text.ends_with("deg");
  const auto value = parse_number(in_degrees ? text.substr(0, text.size() - 3) : text);
  if (!value || !std::isfinite(*value)) refuse(option, "a finite angle like 0.5 (rad) or 30deg", text);
  return in_degrees ? *value * (std::numbers::pi / 180.0) : *value;
}

Vector3 planar_triple(const std::string& option, const std::string& text) {
  std::array<std::string, 3> parts;
  std::size_t count = 0;
  for (std::size_t at = 0; count < 4; ++count) {
    const std::size_t comma = text.find(',', at);
    if (count < 3) parts[count] = text.substr(at, comma - at);
    if (comma == std::string::npos) break;
    at = comma + 1;
  }
  if (count != 2) refuse(option, "three numbers a,b,c (the last one may end in deg)", text);
  return {number(option, parts[0]), number(option, parts[1]), angle(option, parts[2])};
}

ContactSolver contact_solver(const std::string& option, const std::string& text) {
  if (text == "exact") return ContactSolver::exact;
  if (text == "fast") return ContactSolver::fast;
  refuse(option, "exact or fast", text);
}

}  // namespace tumble::cli
