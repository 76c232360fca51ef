// Solvers and settings by name.
#include "tumble/lcp/methods.hpp"

#include <set>
#include <type_traits>

#include <gtest/gtest.h>

namespace tumble {
namespace {

// A settings struct without a row could not be reached from the command line or from Python.
TEST(Methods, EverySolverHasOneName) {
  std::set<std::size_t> kinds;
  std::set<std::string_view> names;
  for (const LcpMethod& method : lcp_methods()) {
    kinds.insert(method.defaults.index());
    names.insert(method.name);
    EXPECT_EQ(&lcp_method(method.name), &method);
    EXPECT_LE(method.name.size() + method.summary.size(), 100u) << method.name;
  }
  EXPECT_EQ(kinds.size(), std::variant_size_v<LcpSettings>);
  EXPECT_EQ(names.size(), lcp_methods().size());
  EXPECT_EQ(lcp_methods().front().defaults.index(), LcpSettings().index());
}

struct Anything {
  template <class T>
  operator T() const;
};

// The number of fields of an aggregate: the most initializers that it takes.
template <class Aggregate, class... Initializers>
constexpr std::size_t num_fields() {
  if constexpr (requires { Aggregate{Initializers{}..., Anything{}}; }) {
    return num_fields<Aggregate, Initializers..., Anything>();
  } else {
    return sizeof...(Initializers);
  }
}

TEST(Methods, NoFieldOfTheSettingsIsLeftOut) {
  for (const LcpMethod& method : lcp_methods()) {
    const auto count = [](const auto& settings) { return num_fields<std::decay_t<decltype(settings)>>(); };
    EXPECT_EQ(named_settings(method.defaults).size(), std::visit(count, method.defaults)) << method.name;
  }
}

TEST(Methods, EverySettingCanBeReadAndSet) {
  for (const LcpMethod& method : lcp_methods()) {
    LcpSettings settings = method.defaults;
    EXPECT_FALSE(named_settings(settings).empty()) << method.name;
    for (const NamedSetting& setting : named_settings(settings)) {
      set_by_name(settings, setting.name, setting.value);
    }
    EXPECT_NO_THROW(validate(settings)) << method.name;
  }
}

TEST(Methods, ValuesReachTheirFields) {
  LcpSettings settings = LemkeLuSettings{};
  set_by_name(settings, "max_pivots", 7.0);
  set_by_name(settings, "pivot_tolerance", std::string("1e-5"));
  set_by_name(settings, "precision", std::string("quad"));
  set_by_name(settings, "start_basis", std::string("0,1,1"));
  const auto& set = std::get<LemkeLuSettings>(settings);
  EXPECT_EQ(set.max_pivots, 7);
  EXPECT_EQ(set.pivot_tolerance, 1e-5);
  EXPECT_EQ(set.precision, Precision::quad_precision);
  EXPECT_EQ(set.start_basis, (std::vector<std::uint8_t>{0, 1, 1}));
  std::string text;
  for (const NamedSetting& setting : named_settings(settings)) text += to_text(setting.value) + ' ';
  EXPECT_EQ(text, "7 40 1e-05 1e-10 quad 0 0 0,1,1 ");
}

template <class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(Methods, MistakesAreNamed) {
  LcpSettings settings = LemkeLuSettings{};
  const auto set = [&](std::string_view name, const SettingValue& value) {
    return message_of([&] { set_by_name(settings, name, value); });
  };
  EXPECT_EQ(set("max_pivots", 1.5), "max_pivots: must be a whole number, got 1.5");
  EXPECT_EQ(set("max_pivots", 1e300), "max_pivots: must be a whole number, got 1e+300");
  EXPECT_EQ(set("max_pivots", std::string("many")), "max_pivots: must be a number, got 'many'");
  EXPECT_EQ(set("ridge", std::vector{1.0, 2.0}), "ridge: must be a number, got 1,2");
  EXPECT_EQ(set("precision", std::string("half")), "precision: must be double or quad, got 'half'");
  EXPECT_EQ(set("precision", 2.0), "precision: must be double or quad, got 2");
  EXPECT_EQ(set("start_basis", std::string("0,1,2")), "start_basis: must be zeros and ones, got 2");
  EXPECT_EQ(set("start_basis", std::string("0,,1")), "start_basis: must be numbers separated by commas, got '0,,1'");
  EXPECT_EQ(set("start_basis", 1.0), "start_basis: must be a list of numbers, got 1");
  EXPECT_EQ(message_of([] { lcp_method("simplex"); }).substr(0, 36), "method: must be one of robust, lemke");
  settings = EnumerateSettings{};
  EXPECT_THROW(set_by_name(settings, "ridge", 0.0), UnknownSetting);
  EXPECT_EQ(set("ridge", 0.0), "ridge: is not a setting of this method, which has accepted_residual");
}

}  // namespace
}  // namespace tumble
