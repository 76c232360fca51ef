#include "tumble/math/numeric.hpp"

#include <array>
#include <limits>

#include "../random_contact.hpp"
#include <gtest/gtest.h>

namespace tumble {
namespace {

TEST(ParseNumber, TakesDecimalsAndSigns) {
  EXPECT_EQ(parse_number("1.5"), 1.5);
  EXPECT_EQ(parse_number("-2"), -2.0);
  EXPECT_EQ(parse_number("+1e-3"), 1e-3);
  EXPECT_EQ(parse_number("1e308"), 1e308);
}

TEST(ParseNumber, RefusesWhatIsNotOneNumber) {
  for (const char* text : {"", " ", "1 ", " 1", "1,5", "1.5m", "0x10", "--1", "+-1", "+", "e5", "1e999", "one"}) {
    EXPECT_FALSE(parse_number(text).has_value()) << text;
  }
}

TEST(ParseDegrees, GivesRadians) {
  EXPECT_EQ(parse_degrees("180 deg"), 3.14159265358979323846);
  EXPECT_EQ(parse_degrees("-90deg"), -1.57079632679489661923);
  EXPECT_EQ(parse_degrees("0.5 \t deg"), 0.5 / 180.0 * 3.14159265358979323846);
  for (const char* text :
       {"", "deg", " deg", "30", "30 degrees", "30 deg ", " 30 deg", "nan deg", "inf deg", "1 1 deg"}) {
    EXPECT_FALSE(parse_degrees(text).has_value()) << text;
  }
}

TEST(ToText, ReadsBackToTheSameBits) {
  test::Random random(4);
  for (int i = 0; i < 10000; ++i) {
    const double value = random.log_uniform(-300.0, 300.0);
    EXPECT_EQ(parse_number(to_text(value)), value);
  }
  EXPECT_EQ(parse_number(to_text(std::numeric_limits<double>::denorm_min())),
            std::numeric_limits<double>::denorm_min());
}

TEST(AllFinite, SeesNanAndInfinity) {
  EXPECT_TRUE(all_finite(std::array{1.0, -1e308}));
  EXPECT_FALSE(all_finite(std::array{1.0, std::numeric_limits<double>::infinity()}));
  EXPECT_FALSE(all_finite(std::array{std::numeric_limits<double>::quiet_NaN(), 1.0}));
}

}  // namespace
}  // namespace tumble
