#include "tumble/math/distributions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

namespace {

using namespace tumble;
using Exact = boost::multiprecision::cpp_bin_float_quad;

constexpr std::uint64_t k_seed = 20;
constexpr std::uint64_t k_count = 1'000'000;

template <class Function>
std::vector<double> sample(std::uint64_t number, Function value_of) {
  std::vector<double> values(k_count);
  for (std::uint64_t i = 0; i < k_count; ++i) values[i] = value_of(draw_word(k_seed, i, number));
  return values;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double variance(const std::vector<double>& values) {
  const double centre = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return sum / static_cast<double>(values.size());
}

// Kolmogorov's statistic sqrt(n) sup |F_n - F|; above 1.95 with probability 0.001 if F is right.
template <class Function>
double kolmogorov(std::vector<double> values, Function distribution) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double f = distribution(values[k]);
    largest =
        std::max({largest, std::abs(static_cast<double>(k) / n - f), std::abs(static_cast<double>(k + 1) / n - f)});
  }
  return std::sqrt(n) * largest;
}
constexpr double k_kolmogorov_bound = 1.95;

double normal_distribution(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// Printed by numpy 1.24: numpy.random.Philox(counter=[0, 1234, 0, 0], key=7).random_raw(6), and so on.
TEST(Distributions, WordsAreThoseOfNumpy) {
  constexpr std::array<std::uint64_t, 6> words = {0x01e3e8e02ffe9a24u, 0x70a32317cde49089u, 0x8d2663fcaf460485u,
                                                  0x87f3a59f64fbf34cu, 0x162ea2268747091eu, 0xfae86bd210ec38adu};
  for (std::uint64_t k = 0; k < words.size(); ++k) EXPECT_EQ(draw_word(7, 1234, k), words[k]);
}

TEST(Distributions, QuantilesAreExact) {
  // Newton's step from z in 113 bits is the error of z: P(z) - p over the density.
  std::vector<double> ps = {0x1p-53, 1e-12, 1e-5, 0.0749999, 0.0750001, 0.5 + 0x1p-53, 1.0 - 0x1p-53};
  for (int k = 1; k < 2000; ++k) ps.push_back(k / 2000.0);
  for (const double p : ps) {
    const Exact z = normal_quantile(p);
    const Exact below = boost::math::erfc(-z / sqrt(Exact(2))) / 2;
    const Exact density = exp(-z * z / 2) / sqrt(2 * boost::math::constants::pi<Exact>());
    const double error = ((below - Exact(p)) / density).convert_to<double>();
    // [Wichura 1988]: 1e-16 relative, to which the roundings of two polynomials, a quotient and sqrt(-log p) come.
    EXPECT_LE(std::abs(error), 1e-15 * std::abs(normal_quantile(p))) << p;
  }
  EXPECT_EQ(normal_quantile(0.5), 0.0);
  EXPECT_EQ(normal_quantile(0.25), -normal_quantile(0.75));
}

// A mean of n draws is off by 4 deviations / sqrt(n) with probability 6e-5; the variance likewise by its own deviation.
TEST(Distributions, UniformIsUniform) {
  const std::vector<double> values = sample(0, [](std::uint64_t word) { return uniform(word, -1.0, 3.0); });
  EXPECT_NEAR(mean(values), 1.0, 4.0 * (4.0 / std::sqrt(12.0)) / 1000.0);
  EXPECT_NEAR(variance(values), 16.0 / 12.0, 4.0 * 16.0 * std::sqrt(1.0 / 180.0) / 1000.0);
  EXPECT_LT(kolmogorov(values, [](double x) { return (x + 1.0) / 4.0; }), k_kolmogorov_bound);
  EXPECT_EQ(uniform(0, -1.0, 3.0), -1.0);
  EXPECT_LT(uniform(~std::uint64_t{0}, -1.0, 3.0), 3.0);
  EXPECT_EQ(uniform(~std::uint64_t{0}, 0.5, 0.5), 0.5);
}

TEST(Distributions, NormalIsNormal) {
  const std::vector<double> values = sample(1, [](std::uint64_t word) { return normal(word, 2.0, 0.5); });
  EXPECT_NEAR(mean(values), 2.0, 4.0 * 0.5 / 1000.0);
  EXPECT_NEAR(variance(values), 0.25, 4.0 * 0.25 * std::sqrt(2.0) / 1000.0);
  EXPECT_LT(kolmogorov(values, [](double x) { return normal_distribution((x - 2.0) / 0.5); }), k_kolmogorov_bound);
  EXPECT_TRUE(std::isfinite(normal(0, 0.0, 1.0)));
  EXPECT_EQ(normal(0, 0.0, 1.0), -normal(~std::uint64_t{0}, 0.0, 1.0));
}

TEST(Distributions, LogUniformIsUniformInItsLogarithm) {
  const std::vector<double> values = sample(2, [](std::uint64_t word) { return log_uniform(word, 1e-3, 1e2); });
  const auto distribution = [](double x) { return std::log(x / 1e-3) / std::log(1e5); };
  EXPECT_LT(kolmogorov(values, distribution), k_kolmogorov_bound);
  EXPECT_GE(log_uniform(0, 1e-3, 1e2), 1e-3);
  EXPECT_LE(log_uniform(~std::uint64_t{0}, 1e-3, 1e2), 1e2);
}

// Draws of an instance, and the same draw of neighbouring instances, have nothing to do with each other.
TEST(Distributions, DrawsAreIndependent) {
  const auto unit = [](std::uint64_t word) { return uniform(word, -1.0, 1.0); };
  const std::vector<double> first = sample(0, unit);
  const std::vector<double> second = sample(1, unit);
  const std::vector<double> fifth = sample(4, unit);
  double with_second = 0.0;
  double with_fifth = 0.0;
  double with_next = 0.0;
  for (std::size_t k = 0; k + 1 < first.size(); ++k) {
    with_second += first[k] * second[k];
    with_fifth += first[k] * fifth[k];
    with_next += first[k] * first[k + 1];
  }
  // A sum of n products of variance 1/9.
  for (const double sum : {with_second, with_fifth, with_next}) EXPECT_LT(std::abs(sum), 4.0 * 1000.0 / 3.0);
}

}  // namespace
