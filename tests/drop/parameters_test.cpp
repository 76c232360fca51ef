#include "tumble/drop/parameters.hpp"

#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "tumble/drop/drop.hpp"

namespace tumble::drop {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double k_infinity = std::numeric_limits<double>::infinity();

std::string error_of(const Parameters& parameters) {
  try {
    validate(parameters);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Parameters, DefaultsAreTheDocuments) {
  const Parameters p;
  EXPECT_EQ(p, (Parameters{
                   .l = 0.2, .m = 0.3, .mu = 0.3, .eps = 0.5, .dt = 0.01, .delta = 0.001, .g = 9.81, .columns = 150}));
  EXPECT_EQ(error_of(p), "");
  EXPECT_EQ(error_of({.l = 0.4}), "");
}

TEST(Parameters, TakeTheEndsOfTheirRanges) {
  EXPECT_EQ(error_of({.mu = 0.0, .eps = 0.0, .delta = 0.0, .g = 0.0, .columns = 2}), "");
  EXPECT_EQ(error_of({.eps = 1.0, .g = -9.81, .columns = k_max_columns}), "");
}

TEST(Parameters, NameFieldRangeAndValueOfWhatIsWrong) {
  EXPECT_EQ(error_of({.l = 0.0}), "l: must be finite and > 0, got 0 m");
  EXPECT_EQ(error_of({.m = -1.0}), "m: must be finite and > 0, got -1 kg");
  EXPECT_EQ(error_of({.mu = -0.1}), "mu: must be finite and >= 0, got -0.1");
  EXPECT_EQ(error_of({.eps = 1.5}), "eps: must be in [0, 1], got 1.5");
  EXPECT_EQ(error_of({.dt = 0.0}), "dt: must be finite and > 0, got 0 s");
  EXPECT_EQ(error_of({.delta = -1e-3}), "delta: must be finite and >= 0, got -0.001 m");
  EXPECT_EQ(error_of({.columns = 0}), "columns: must be in [2, 10000000], got 0");
  EXPECT_EQ(error_of({.columns = 1}), "columns: must be in [2, 10000000], got 1");
  EXPECT_EQ(error_of({.columns = k_max_columns + 1}), "columns: must be in [2, 10000000], got 10000001");
  for (const double bad : {k_nan, k_infinity, -k_infinity}) {
    EXPECT_NE(error_of({.l = bad}), "");
    EXPECT_NE(error_of({.m = bad}), "");
    EXPECT_NE(error_of({.mu = bad}), "");
    EXPECT_NE(error_of({.eps = bad}), "");
    EXPECT_NE(error_of({.dt = bad}), "");
    EXPECT_NE(error_of({.delta = bad}), "");
    EXPECT_NE(error_of({.g = bad}), "");
  }
  EXPECT_NE(error_of({.l = 1e-200}), "") << "the moment of inertia would be 0";
  EXPECT_NE(error_of({.l = 1e200, .m = 1e-250}), "") << "l^2 is beyond double, although m l^2 is not";
}

TEST(Parameters, AreCheckedByEveryFunction) {
  const Parameters bad{.m = -1.0};
  EXPECT_THROW(get_contacts({}, bad), std::invalid_argument);
  EXPECT_THROW(corner_index({}, bad), std::invalid_argument);
  EXPECT_THROW(corner_positions({}, bad), std::invalid_argument);
  EXPECT_THROW(form_lcp({}, {}, bad), std::invalid_argument);
  EXPECT_THROW(step({}, {}, bad), std::invalid_argument);
  EXPECT_THROW(step_with_record({}, {}, bad), std::invalid_argument);
  EXPECT_THROW(simulate({}, {}, bad), std::invalid_argument);
  EXPECT_THROW(simulate_with_record({}, {}, bad), std::invalid_argument);
}

TEST(States, AreRefusedWhereTheyAreNotFinite) {
  for (const double bad : {k_nan, k_infinity}) {
    EXPECT_THROW(get_contacts({0, bad, 0}), std::invalid_argument);
    EXPECT_THROW(form_lcp({{1, 0, bad}, {0, 1, 0}}, {}), std::invalid_argument);
    EXPECT_THROW(form_lcp({}, {bad, 0, 0}), std::invalid_argument);
    EXPECT_THROW(step({0, 1, bad}, {}), std::invalid_argument);
    EXPECT_THROW(simulate({0, 1, 0}, {0, 0, bad}), std::invalid_argument);
    EXPECT_THROW(solve_LCP({}, {bad, 0, 0, 0}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace tumble::drop
