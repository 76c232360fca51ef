// Text by fmt, whose formatting of numbers is compiled once, in format.cpp: as a header alone it would be compiled anew
// in each file that has a message, some 5 s for each. Not a public header.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include <fmt/core.h>

namespace tumble {

// What the templates below hand their arguments to. Throws fmt::format_error if `text` and arguments do not match.
std::string format_arguments(fmt::string_view text, fmt::format_args arguments);
void print_arguments(std::FILE* file, fmt::string_view text, fmt::format_args arguments);

// fmt::format and fmt::print, which throws std::system_error if the file takes no more. `text` is checked against the
// arguments when it is compiled.
template <class... Arguments>
std::string format(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  return format_arguments(text, fmt::make_format_args(arguments...));
}

template <class... Arguments>
void print(std::FILE* file, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  print_arguments(file, text, fmt::make_format_args(arguments...));
}

template <class... Arguments>
void print(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  print_arguments(stdout, text, fmt::make_format_args(arguments...));
}

// The items, each written by `item_text`, which is not checked before it runs, with `separator` between them.
template <class Range>
std::string join(const Range& items, std::string_view separator, std::string_view item_text = "{}") {
  std::string text;
  for (bool is_first = true; const auto& item : items) {
    if (!is_first) text += separator;
    text += format_arguments(item_text, fmt::make_format_args(item));
    is_first = false;
  }
  return text;
}

}  // namespace tumble
