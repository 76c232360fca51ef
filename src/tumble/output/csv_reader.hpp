// Reads tables as they are written here: comment lines "# name = value unit", a line of column names, rows. Every
// refusal is std::invalid_argument "name:line:column: field: what is allowed, what is there"; columns count bytes
// from 1.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "tumble/math/format.hpp"

namespace tumble::output {

// The word for a message: short, and without bytes that a terminal would act on.
std::string quoted(std::string_view word);

template <class Enum, std::size_t n>
std::string names_of(const std::array<Enum, n>& values) {
  std::string names;
  for (const Enum value : values) names += (names.empty() ? "" : ", ") + std::string(to_string(value));
  return names;
}

template <class Enum, std::size_t n>
std::optional<Enum> find_by_name(const std::array<Enum, n>& values, std::string_view name) {
  for (const Enum value : values) {
    if (name == to_string(value)) return value;
  }
  return std::nullopt;
}

template <class Whole>
std::optional<Whole> parse_whole(std::string_view text) {
  Whole value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Hands out the text line by line and refuses with the place.
class LineReader {
 public:
  LineReader(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  // The next line without its end; a line without an end was cut off.
  std::string_view next(std::string_view expected);
  // The next line must be this one.
  void expect(std::string_view line);
  // The same for a line of column names: the refusal names the first that differs.
  void expect_columns(std::string_view line);
  // Refuses anything behind the rows.
  void expect_end(std::size_t rows);
  // Refuses a table for which the rest is too short: before anything is allocated. `field` announced its rows.
  void check_room(std::string_view field, std::size_t rows, std::size_t columns) const;
  bool is_at_end() const { return rest_.empty(); }

  // Values of the lines "# name = value unit".
  double number(std::string_view name, std::string_view unit);  // non-finite ones, too
  template <class Whole>
  Whole whole(std::string_view name, Whole low, Whole high) {
    std::size_t column = 1;
    const std::string_view text = value(name, "", column);
    const std::optional<Whole> parsed = parse_whole<Whole>(text);
    if (parsed && *parsed >= low && *parsed <= high) return *parsed;
    refuse(column, tumble::format("{}: must be a whole number in [{}, {}], got {}", name, low, high, quoted(text)));
  }
  template <class Enum, std::size_t n>
  Enum word(std::string_view name, const std::array<Enum, n>& values) {
    std::size_t column = 1;
    const std::string_view text = value(name, "", column);
    if (const auto found = find_by_name(values, text)) return *found;
    refuse(column, tumble::format("{}: must be one of {}, got {}", name, names_of(values), quoted(text)));
  }
  bool yes_or_no(std::string_view name);

  [[noreturn]] void refuse(std::size_t column, std::string_view why) const;

 private:
  std::string_view value(std::string_view name, std::string_view unit, std::size_t& column);

  std::string_view rest_;
  const std::string& name_;
  std::size_t line_ = 0;
};

// The columns that the cells of a line of names stand for, quotes and units taken away.
std::vector<std::string> column_names(std::string_view line);

// The cells of one line, each refused by its name and place. A cell may be in quotes, with commas in it and quotes
// doubled [RFC 4180]; it does not reach over the end of the line.
class Row {
 public:
  struct Cell {
    std::string_view name;
    std::string_view text;  // quotes included
    std::size_t column;
  };

  // Refuses a line that has not as many cells as there are names.
  Row(const LineReader& lines, const std::vector<std::string>& names, std::string_view line);

  // At most as often as there are names.
  Cell next();

  // Non-finite only if `any` is true.
  double number(bool any = false);

  template <class Whole>
  Whole whole(Whole low, Whole high) {
    const Cell cell = next();
    const std::optional<Whole> value = parse_whole<Whole>(cell.text);
    if (value && *value >= low && *value <= high) return *value;
    refuse(cell, low == high ? tumble::format("must be {}", low)
                             : tumble::format("must be a whole number in [{}, {}]", low, high));
  }

  template <class Enum, std::size_t n>
  Enum word(const std::array<Enum, n>& values) {
    const Cell cell = next();
    if (const auto found = find_by_name(values, cell.text)) return *found;
    refuse(cell, tumble::format("must be one of {}", names_of(values)));
  }

  // The time `expected`, which `formula` explains, up to the last digits: that of another program may be a sum of
  // steps.
  void time(double expected, std::string_view formula);

  [[noreturn]] void refuse(const Cell& cell, std::string_view why) const;

 private:
  const LineReader& lines_;
  const std::vector<std::string>& names_;
  std::string_view line_;
  std::size_t at_ = 0, index_ = 0;
};

// The text of a cell without its quotes.
std::string unquoted(std::string_view cell);

}  // namespace tumble::output
