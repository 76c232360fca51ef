#include "tumble/math/exp_log.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

namespace {

using Exact = boost::multiprecision::cpp_bin_float_quad;

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr int k_count = 20'000;

// In spacings of doubles at the exact value.
double error_in_ulps(double value, const Exact& exact) {
  const double near = std::abs(exact.convert_to<double>());
  const double spacing = std::nextafter(near, k_infinity) - near;
  return abs((Exact(value) - exact) / Exact(spacing)).convert_to<double>();
}

double largest_error_of_exp(double low, double high) {
  std::mt19937_64 generator(1);
  double largest = 0.0;
  for (int k = 0; k < k_count; ++k) {
    const double x = std::uniform_real_distribution(low, high)(generator);
    largest = std::max(largest, error_in_ulps(tumble::exp(x), exp(Exact(x))));
  }
  return largest;
}

double largest_error_of_log(double low, double high) {
  std::mt19937_64 generator(2);
  double largest = 0.0;
  for (int k = 0; k < k_count; ++k) {
    const double x = std::exp2(std::uniform_real_distribution(low, high)(generator));
    largest = std::max(largest, error_in_ulps(tumble::log(x), log(Exact(x))));
  }
  return largest;
}

TEST(ExpLog, ExpIsWithinOneUlp) {
  EXPECT_LT(largest_error_of_exp(-1.0, 1.0), 1.0);
  EXPECT_LT(largest_error_of_exp(-708.0, 709.78), 1.0);
  EXPECT_LT(largest_error_of_exp(-745.0, -708.0), 1.0);  // subnormal results
}

TEST(ExpLog, LogIsWithinOneUlp) {
  EXPECT_LT(largest_error_of_log(-1.0, 1.0), 1.0);
  EXPECT_LT(largest_error_of_log(-1e-6, 1e-6), 1.0);
  EXPECT_LT(largest_error_of_log(-1022.0, 1023.9), 1.0);
  EXPECT_LT(largest_error_of_log(-1074.0, -1022.0), 1.0);  // subnormal arguments
}

TEST(ExpLog, TheEndsAreRight) {
  EXPECT_EQ(tumble::exp(0.0), 1.0);
  EXPECT_EQ(tumble::exp(709.79), k_infinity);
  EXPECT_LT(tumble::exp(709.78), k_infinity);
  EXPECT_EQ(tumble::exp(-745.2), 0.0);
  EXPECT_EQ(tumble::exp(-745.1), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(tumble::exp(-k_infinity), 0.0);
  EXPECT_EQ(tumble::exp(k_infinity), k_infinity);
  EXPECT_TRUE(std::isnan(tumble::exp(std::nan(""))));
  EXPECT_EQ(tumble::log(1.0), 0.0);
  EXPECT_EQ(tumble::log(0.0), -k_infinity);
  EXPECT_EQ(tumble::log(k_infinity), k_infinity);
  EXPECT_TRUE(std::isnan(tumble::log(-1.0)));
  EXPECT_TRUE(std::isnan(tumble::log(std::nan(""))));
}

}  // namespace
