// The solvers and their settings by name, for programs that get both as words.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tumble/lcp/solve.hpp"

namespace tumble {

struct LcpMethod {
  std::string_view name;
  std::string_view summary;  // one line: what it does, and when it can be relied on
  LcpSettings defaults;
};

// All of them, the default first.
std::span<const LcpMethod> lcp_methods();

// Throws std::invalid_argument, with the list of names, if there is none of this name.
const LcpMethod& lcp_method(std::string_view name);

// A number; a word, for a choice; a list of numbers, 0 or 1 for a basis.
using SettingValue = std::variant<int, double, std::string, std::vector<double>>;

// A list as "0,1,1".
std::string to_text(const SettingValue& value);

struct NamedSetting {
  std::string_view name;  // of the field in the settings
  SettingValue value;
};

// The settings of one method, in a fixed order.
std::vector<NamedSetting> named_settings(const LcpSettings& settings);

// Thrown for a setting that the method does not have.
struct UnknownSetting : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

// Changes one setting. Numbers and lists may also come as text, "1e-8" and "0,1,1". Throws
// std::invalid_argument, naming the setting, for a value of another kind; the range is left to `validate`.
void set_by_name(LcpSettings& settings, std::string_view name, const SettingValue& value);

}  // namespace tumble
