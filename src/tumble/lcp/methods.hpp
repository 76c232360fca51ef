// The solvers and their settings by name, for programs that get both as words.
#pragma once

#include <cstdint>
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

// A number; a word, for a choice; a basis, n entries 0 or 1.
using SettingValue = std::variant<int, double, std::string, std::vector<std::uint8_t>>;

// A basis as zeros and ones.
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

// Changes one setting. A number may also come as text ("1e-8"), a basis as zeros and ones ("0110"). Throws
// std::invalid_argument, naming the setting, for a value of another kind; the range is left to `validate`.
void set_by_name(LcpSettings& settings, std::string_view name, const SettingValue& value);

}  // namespace tumble
