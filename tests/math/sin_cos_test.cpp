#include "tumble/math/sin_cos.hpp"

#include <cmath>
#include <limits>

#include "../random_contact.hpp"
#include <gtest/gtest.h>

namespace tumble {
namespace {

// Largest error of sin_cos over random |angle| in [2^low, 2^high), against long double (64-bit mantissa on x86).
double largest_error(double low, double high, int count) {
  test::Random random(3);
  double largest = 0.0;
  for (int i = 0; i < count; ++i) {
    const double angle = random.log_uniform(low, high) * (i % 2 == 0 ? 1.0 : -1.0);
    const auto [s, c] = sin_cos(angle);
    const double sine_error = static_cast<double>(std::fabs(s - std::sin(static_cast<long double>(angle))));
    const double cosine_error = static_cast<double>(std::fabs(c - std::cos(static_cast<long double>(angle))));
    largest = std::fmax(largest, std::fmax(sine_error, cosine_error));
  }
  return largest;
}

TEST(SinCos, IsWithinItsBoundForModerateAngles) { EXPECT_LT(largest_error(-40.0, 19.0, 400000), 1.3e-16); }

TEST(SinCos, IsWithinItsBoundForEveryLargerAngle) { EXPECT_LT(largest_error(19.0, 1023.9, 400000), 2.3e-16); }

TEST(SinCos, IsWithinItsBoundNextToMultiplesOfTheQuarterTurn) {
  for (int k = -20000; k <= 20000; ++k) {
    const double angle = k * 1.5707963267948966;
    const auto [s, c] = sin_cos(angle);
    EXPECT_NEAR(s, static_cast<double>(std::sin(static_cast<long double>(angle))), 1.3e-16) << k;
    EXPECT_NEAR(c, static_cast<double>(std::cos(static_cast<long double>(angle))), 1.3e-16) << k;
  }
}

TEST(SinCos, IsExactAtZeroAndOddEven) {
  EXPECT_EQ(sin_cos(0.0).sin, 0.0);
  EXPECT_EQ(sin_cos(0.0).cos, 1.0);
  for (const double angle : {0.3, 1.0, 2.5, 100.0, 1e6, 1e300}) {
    EXPECT_EQ(sin_cos(-angle).sin, -sin_cos(angle).sin);
    EXPECT_EQ(sin_cos(-angle).cos, sin_cos(angle).cos);
  }
}

TEST(SinCos, GivesNanForAnAngleThatIsNotFinite) {
  for (const double angle : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(std::isnan(sin_cos(angle).sin));
    EXPECT_TRUE(std::isnan(sin_cos(angle).cos));
  }
}

}  // namespace
}  // namespace tumble
