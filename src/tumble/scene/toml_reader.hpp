// Tables of a TOML text, read key by key with their places. The one header that includes toml++, for scene_toml.cpp and
// spec_toml.cpp alone: it takes seconds to compile.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"
#include "tumble/scene/check.hpp"
#include "tumble/scene/suggestion.hpp"
#include "tumble/scene/toml_guard.hpp"
#include "tumble/scene/toml_plus_plus.hpp"

namespace tumble::toml_reading {

// An error that has its place already.
struct PlacedError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

[[noreturn]] inline void refuse(const std::string& name, const toml::source_position& at, const std::string& why) {
  // Nodes without a place of their own stand on the first line.
  throw PlacedError(tumble::format("{}:{}:{}: {}", name, std::max(at.line, toml::source_index{1}),
                                   std::max(at.column, toml::source_index{1}), why));
}

// Throws a PlacedError for text that is no TOML.
inline toml::table parse_table(std::string_view text, const std::string& name) {
  guard_toml(text, name);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    std::string message(error.description());
    if (!is_plain_text(message)) message = "no TOML";
    refuse(name, error.source().begin, message);
  }
}

// A value, the path that messages call it by, and the name of the text.
class Value {
 public:
  Value(const toml::node& node, std::string path, const std::string& name)
      : node_(&node), path_(std::move(path)), name_(&name) {}

  const std::string& path() const { return path_; }

  [[noreturn]] void refuse_with(const std::string& why) const {
    refuse(*name_, node_->source().begin, path_.empty() ? why : path_ + ": " + why);
  }

  // Calls `function`, and puts place and path before the message of what it throws, unless that has them.
  template <class Function>
  auto checked(Function function, std::string_view joint = ".") const {
    std::string message;
    try {
      return function();
    } catch (const PlacedError&) {
      throw;
    } catch (const std::invalid_argument& error) {
      message = error.what();
    }
    refuse(*name_, node_->source().begin, path_.empty() ? message : tumble::format("{}{}{}", path_, joint, message));
  }

  double number(const Range& range) const {
    if (!node_->is_number()) refuse_type("a number");
    const double value = *node_->value<double>();
    check_range(range, value);
    return value;
  }

  std::int64_t integer(std::int64_t low, std::int64_t high) const {
    if (!node_->is_integer()) refuse_type("a whole number");
    const std::int64_t value = *node_->value<std::int64_t>();
    if (value < low || value > high) refuse_with(tumble::format("must be in [{}, {}], got {}", low, high, value));
    return value;
  }

  std::string text() const {
    if (!node_->is_string()) refuse_type("a string");
    return *node_->value<std::string>();
  }

  // Radians, or "30 deg".
  double angle() const {
    if (!node_->is_string()) {
      if (!node_->is_number()) refuse_type("a number in rad or a string like \"30 deg\"");
      return number(k_angle_range);
    }
    const std::string whole = text();
    const std::optional<double> value = parse_degrees(whole);
    if (!value)
      refuse_with(tumble::format("must be a number in rad or a string like \"30 deg\", got {}", shown(whole)));
    check_range(k_angle_range, *value);
    return *value;
  }

  Vector2 vector(const Range& range_x, const Range& range_y) const {
    const std::vector<Value> entries = list(2, 2);
    return {entries[0].number(range_x), entries[1].number(range_y)};
  }
  Vector2 vector(const Range& range) const { return vector(range, range); }

  std::vector<Vector2> points(std::size_t least, std::size_t most) const {
    std::vector<Vector2> result;
    for (const Value& point : list(least, most)) result.push_back(point.vector(k_coordinate_range));
    return result;
  }

  bool is_list() const { return node_->is_array(); }
  bool is_table() const { return node_->is_table(); }

  std::vector<Value> list(std::size_t least, std::size_t most) const {
    const toml::array* array = node_->as_array();
    if (array == nullptr) refuse_type("a list in brackets");
    if (array->size() < least || array->size() > most) {
      refuse_with(least == most ? tumble::format("must have {} entries, got {}", least, array->size())
                                : tumble::format("must have {} to {} entries, got {}", least, most, array->size()));
    }
    std::vector<Value> entries;
    entries.reserve(array->size());
    for (std::size_t i = 0; i < array->size(); ++i) {
      entries.emplace_back((*array)[i], tumble::format("{}[{}]", path_, i), *name_);
    }
    return entries;
  }

  // The value of a key, if it is there. The value itself must be a table.
  std::optional<Value> find(std::string_view key) const {
    const toml::node* found = table().get(key);
    if (found == nullptr) return std::nullopt;
    return Value(*found, path_.empty() ? std::string(key) : tumble::format("{}.{}", path_, key), *name_);
  }

  Value at(std::string_view key) const {
    std::optional<Value> found = find(key);
    if (!found) refuse_with(tumble::format("must have the key '{}'", key));
    return *found;
  }

  // Throws for a key that is none of these.
  void allow_keys(std::initializer_list<std::string_view> known) const {
    for (auto&& [key, value] : table()) {
      if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
      refuse(*name_, key.source().begin,
             tumble::format("{}{}: unknown key{}", path_.empty() ? "" : path_ + ".", shown(key.str()),
                            suggestion(key.str(), known)));
    }
  }

  // Names and values of a table in the order of the text.
  std::vector<std::pair<std::string, Value>> entries() const {
    std::vector<std::pair<std::string, Value>> result;
    std::vector<std::pair<toml::source_position, std::size_t>> order;
    for (auto&& [key, value] : table()) {
      order.push_back({key.source().begin, result.size()});
      const std::string word(key.str());
      const std::string last = is_plain_text(word) ? word : shown(word);
      result.push_back({word, Value(value, path_.empty() ? last : tumble::format("{}.{}", path_, last), *name_)});
    }
    std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
      return a.first.line != b.first.line ? a.first.line < b.first.line : a.first.column < b.first.column;
    });
    std::vector<std::pair<std::string, Value>> sorted;
    for (const auto& [place, index] : order) sorted.push_back(result[index]);
    return sorted;
  }

  double number_or(std::string_view key, const Range& range, double otherwise) const {
    const std::optional<Value> found = find(key);
    return found ? found->number(range) : otherwise;
  }
  double angle_or(std::string_view key, double otherwise) const {
    const std::optional<Value> found = find(key);
    return found ? found->angle() : otherwise;
  }
  Vector2 vector_or(std::string_view key, const Range& range, Vector2 otherwise) const {
    const std::optional<Value> found = find(key);
    return found ? found->vector(range) : otherwise;
  }
  std::string text_or(std::string_view key, const std::string& otherwise) const {
    const std::optional<Value> found = find(key);
    return found ? found->text() : otherwise;
  }
  std::vector<Value> list_or_none(std::string_view key, std::size_t most) const {
    const std::optional<Value> found = find(key);
    return found ? found->list(0, most) : std::vector<Value>{};
  }

 private:
  [[noreturn]] void refuse_type(std::string_view wanted) const {
    refuse_with(tumble::format("must be {}, got {}", wanted, type_name()));
  }

  std::string_view type_name() const {
    switch (node_->type()) {
      case toml::node_type::table: return "a table";
      case toml::node_type::array: return "a list";
      case toml::node_type::string: return "a string";
      case toml::node_type::integer: return "a whole number";
      case toml::node_type::floating_point: return "a number";
      case toml::node_type::boolean: return "true or false";
      default: return "a date or time";
    }
  }

  void check_range(const Range& range, double value) const {
    checked([&] { require_in(range, "", value); }, "");
  }

  const toml::table& table() const {
    const toml::table* found = node_->as_table();
    if (found == nullptr) refuse_type("a table");
    return *found;
  }

  const toml::node* node_;
  std::string path_;
  const std::string* name_;
};

}  // namespace tumble::toml_reading
