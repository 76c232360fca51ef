#include "tumble/lcp/methods.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"

namespace tumble {
namespace {

// A new method is one row here. A setting of a new name is one line in `visit_settings`.
const std::array k_methods = {
    LcpMethod{"robust", "a ladder of methods, each checked against M and q; the one to use", RobustSettings{}},
    LcpMethod{"lemke", "Lemke's pivots on a tableau; finds a solution if M is copositive-plus and w >= 0 is possible",
              LemkeSettings{}},
    LcpMethod{"lemke_lu", "Lemke's pivots on LU factors; for nearly singular and for large problems; can start warm",
              LemkeLuSettings{}},
    LcpMethod{"enumerate", "all 2^n bases, n <= 12; the first solution, or proof that there is none",
              EnumerateSettings{}},
    LcpMethod{"murty", "least-index pivots, for comparison; guaranteed for P-matrices, in up to 2^n pivots",
              MurtySettings{}},
    LcpMethod{"dantzig", "principal pivots, row after row; for P- and semidefinite M a solution or a proof of none",
              DantzigSettings{}},
    LcpMethod{"newton", "semismooth Newton on min(w, z) = 0, for comparison; guaranteed for P-matrices",
              NewtonSettings{}},
    LcpMethod{"pgs", "projected Gauss-Seidel, for teaching; for positive definite M, not for friction", PgsSettings{}},
    LcpMethod{"nlgs", "block Gauss-Seidel, each contact solved exactly; many contacts, loose tolerance, start from z",
              NlgsSettings{}},
};

// Calls visit(name, field) for every field that these settings have.
template <class Settings, class Visit>
void visit_settings(Settings& settings, const Visit& visit) {
  if constexpr (requires { settings.max_pivots; }) visit("max_pivots", settings.max_pivots);
  if constexpr (requires { settings.max_exchanges; }) visit("max_exchanges", settings.max_exchanges);
  if constexpr (requires { settings.max_iterations; }) visit("max_iterations", settings.max_iterations);
  if constexpr (requires { settings.max_sweeps; }) visit("max_sweeps", settings.max_sweeps);
  if constexpr (requires { settings.relaxation; }) visit("relaxation", settings.relaxation);
  if constexpr (requires { settings.pivot_tolerance; }) visit("pivot_tolerance", settings.pivot_tolerance);
  if constexpr (requires { settings.accepted_residual; }) visit("accepted_residual", settings.accepted_residual);
  if constexpr (requires { settings.precision; }) visit("precision", settings.precision);
  if constexpr (requires { settings.cover; }) visit("cover", settings.cover);
  if constexpr (requires { settings.ridge; }) visit("ridge", settings.ridge);
  if constexpr (requires { settings.start_basis; }) visit("start_basis", settings.start_basis);
  if constexpr (requires { settings.start_z; }) visit("start_z", settings.start_z);
}

constexpr std::array<std::pair<std::string_view, Precision>, 2> k_precisions = {
    {{"double", Precision::double_precision}, {"quad", Precision::quad_precision}}};

SettingValue as_value(int field) { return field; }
SettingValue as_value(double field) { return field; }
template <class Number>
SettingValue as_value(const std::vector<Number>& field) {
  return std::vector<double>(field.begin(), field.end());
}
SettingValue as_value(Precision field) {
  const auto has_value = [&](const auto& choice) { return choice.second == field; };
  return std::string(std::find_if(k_precisions.begin(), k_precisions.end(), has_value)->first);
}

[[noreturn]] void refuse(std::string_view name, std::string_view expected, const SettingValue& value) {
  const char* quote = std::holds_alternative<std::string>(value) ? "'" : "";
  throw std::invalid_argument(tumble::format("{0}: must be {1}, got {2}{3}{2}", name, expected, quote, to_text(value)));
}

void assign(std::string_view name, double& field, const SettingValue& value) {
  std::optional<double> number;
  if (const auto* count = std::get_if<int>(&value)) number = *count;
  if (const auto* x = std::get_if<double>(&value)) number = *x;
  if (const auto* word = std::get_if<std::string>(&value)) number = parse_number(*word);
  if (!number) refuse(name, "a number", value);
  field = *number;
}

void assign(std::string_view name, int& field, const SettingValue& value) {
  double number = 0.0;
  assign(name, number, value);
  if (!(std::abs(number) <= std::numeric_limits<int>::max()) || number != std::trunc(number)) {
    refuse(name, "a whole number", value);
  }
  field = static_cast<int>(number);
}

void assign(std::string_view name, Precision& field, const SettingValue& value) {
  const auto* word = std::get_if<std::string>(&value);
  const auto has_name = [&](const auto& choice) { return word != nullptr && choice.first == *word; };
  const auto found = std::find_if(k_precisions.begin(), k_precisions.end(), has_name);
  if (found == k_precisions.end()) refuse(name, "double or quad", value);
  field = found->second;
}

std::vector<double> as_list(std::string_view name, const SettingValue& value) {
  if (const auto* list = std::get_if<std::vector<double>>(&value)) return *list;
  const auto* word = std::get_if<std::string>(&value);
  if (word == nullptr) refuse(name, "a list of numbers", value);
  std::vector<double> list;
  for (std::size_t at = 0; at <= word->size();) {
    const std::size_t comma = std::min(word->find(',', at), word->size());
    const auto number = parse_number(word->substr(at, comma - at));
    if (!number) refuse(name, "numbers separated by commas", value);
    list.push_back(*number);
    at = comma + 1;
  }
  return list;
}

// Numbers, or the zeros and ones of a basis.
template <class Number>
void assign(std::string_view name, std::vector<Number>& field, const SettingValue& value) {
  field.clear();
  for (const double x : as_list(name, value)) {
    if (std::is_same_v<Number, std::uint8_t> && x != 0.0 && x != 1.0) refuse(name, "zeros and ones", x);
    field.push_back(static_cast<Number>(x));
  }
}

}  // namespace

std::span<const LcpMethod> lcp_methods() { return k_methods; }

const LcpMethod& lcp_method(std::string_view name) {
  std::vector<std::string_view> names;
  for (const LcpMethod& method : k_methods) {
    if (method.name == name) return method;
    names.push_back(method.name);
  }
  throw std::invalid_argument(tumble::format("method: must be one of {}, got '{}'", tumble::join(names, ", "), name));
}

std::string to_text(const SettingValue& value) {
  struct AsText {
    std::string operator()(int x) const { return tumble::format("{}", x); }
    std::string operator()(double x) const { return to_text(x); }
    std::string operator()(const std::string& word) const { return word; }
    std::string operator()(const std::vector<double>& list) const { return tumble::join(list, ","); }
  };
  return std::visit(AsText(), value);
}

std::vector<NamedSetting> named_settings(const LcpSettings& settings) {
  std::vector<NamedSetting> named;
  const auto add = [&](std::string_view name, const auto& field) { named.push_back({name, as_value(field)}); };
  std::visit([&](const auto& chosen) { visit_settings(chosen, add); }, settings);
  return named;
}

void set_by_name(LcpSettings& settings, std::string_view name, const SettingValue& value) {
  std::vector<std::string_view> names;
  bool is_found = false;
  const auto set = [&](std::string_view field_name, auto& field) {
    names.push_back(field_name);
    if (field_name != name) return;
    assign(name, field, value);
    is_found = true;
  };
  std::visit([&](auto& chosen) { visit_settings(chosen, set); }, settings);
  if (is_found) return;
  throw UnknownSetting(
      tumble::format("{}: is not a setting of this method, which has {}", name, tumble::join(names, ", ")));
}

}  // namespace tumble
