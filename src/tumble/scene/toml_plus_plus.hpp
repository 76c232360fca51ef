// toml++, and before it what it needs of <charconv> and the library of emscripten 3.1.6 does not have: numbers of type
// double. Without these toml++ reads them through streams, whose locales are a third of the browser's module.
#pragma once

#include <charconv>

#ifndef __cpp_lib_to_chars

#include <string_view>
#include <system_error>

#include "tumble/math/numeric.hpp"

#define TOML_FLOAT_CHARCONV 1
#define TOML_INT_CHARCONV 1

// In std, since toml++ names them so; each is a declaration of the standard that is missing there [charconv.syn].
namespace std {

// toml++ hands in a whole number and nothing else.
inline from_chars_result from_chars(const char* first, const char* last, double& value, chars_format) {
  const optional<double> number = tumble::parse_number({first, static_cast<size_t>(last - first)});
  if (!number) return {last, errc::result_out_of_range};  // toml++ has looked at every character
  value = *number;
  return {last, errc{}};
}
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  return from_chars(first, last, value, chars_format::general);
}

// toml++ prints nothing here.
template <class Number>
requires is_floating_point_v<Number> to_chars_result to_chars(char*, char* last, Number) {
  return {last, errc::value_too_large};
}
template <class Number>
requires is_floating_point_v<Number> to_chars_result to_chars(char*, char* last, Number, chars_format, int = 0) {
  return {last, errc::value_too_large};
}

}  // namespace std

#endif

#include <toml++/toml.h>
