#include "tumble/sweep/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace tumble::sweep {
namespace {

TEST(Histogram, ValuesLieBetweenTheEndsOfTheirBin) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 100'000; ++i) {
    const double size =
        std::ldexp(1.0 + static_cast<double>(random() >> 12) * 0x1p-52, static_cast<int>(random() % 60) - 30);
    for (const double x : {size, -size}) {
      const auto [low, high] = ends_of(bin_of(x));
      ASSERT_LE(low, x);
      ASSERT_LE(x, high);
      ASSERT_LE(high - low, std::abs(x) / 511.0);
    }
  }
  for (const double x : {0.0, -0.0, 1e-10, -1e-10}) EXPECT_EQ(bin_of(x), 0);
  EXPECT_EQ(bin_of(1e300), k_last_bin);
  EXPECT_EQ(bin_of(-1e300), -k_last_bin);
  for (const int bin : {-5000, -2, -1, 1, 2, 5000, k_last_bin - 1}) {
    const auto [low, high] = ends_of(bin);
    EXPECT_EQ(bin_of(0.5 * low + 0.5 * high), bin);
    EXPECT_EQ(bin_of(bin > 0 ? low : high), bin);
  }
}

TEST(Histogram, QuantilesAreGoodToABin) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.3, 1.0);
  std::vector<double> values(20'000);
  for (double& value : values) value = normal(random);
  const Histogram histogram = make_histogram(values);
  std::sort(values.begin(), values.end());
  EXPECT_EQ(total(histogram), 20'000);
  for (const double p : {0.001, 0.05, 0.25, 0.4, 0.5, 0.75, 0.95, 0.999}) {
    // Between the two values that have this share below them, up to a bin.
    const auto rank = static_cast<std::size_t>(p * 20'000.0);
    const double found = quantile(histogram, p, values.front(), values.back(), false);
    EXPECT_GE(found, values[rank - 1] - std::abs(values[rank - 1]) / 511.0) << p;
    EXPECT_LE(found, values[rank] + std::abs(values[rank]) / 511.0) << p;
  }
  EXPECT_EQ(quantile(histogram, 0.0, values.front(), values.back(), false), values.front());
  EXPECT_EQ(quantile(histogram, 1.0, values.front(), values.back(), false), values.back());
}

TEST(Histogram, QuantilesOfFewValues) {
  EXPECT_TRUE(std::isnan(quantile({}, 0.5, 0.0, 0.0, false)));
  EXPECT_EQ(quantile(make_histogram(std::vector<double>{-2.7}), 0.5, -2.7, -2.7, false), -2.7);
  const std::vector<double> whole = {3.0, 3.0, 3.0, 7.0, 12.0};
  EXPECT_EQ(quantile(make_histogram(whole), 0.5, 3.0, 12.0, true), 3.0);
  EXPECT_EQ(quantile(make_histogram(whole), 0.75, 3.0, 12.0, true), 7.0);
  EXPECT_EQ(quantile(make_histogram(whole), 0.95, 3.0, 12.0, true), 12.0);
}

TEST(Histogram, MergedItIsThatOfAllValues) {
  const std::vector<double> first = {-1.0, 0.0, 2.0, 2.0}, second = {-3.0, 0.0, 2.0, 5.0};
  std::vector<double> all = first;
  all.insert(all.end(), second.begin(), second.end());
  Histogram merged = make_histogram(first);
  merge(merged, make_histogram(second));
  EXPECT_EQ(merged.bins, make_histogram(all).bins);
  EXPECT_EQ(merged.counts, make_histogram(all).counts);
  merge(merged, {});
  EXPECT_EQ(total(merged), 8);
}

TEST(Histogram, NewBinsHoldAllValues) {
  std::mt19937 random(7);
  std::vector<double> values(50'000), edges;
  for (double& value : values) value = -1.0 + 4.0 * static_cast<double>(random()) / 4294967296.0;
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  for (int k = 0; k <= 40; ++k) edges.push_back(-1.0 + 0.1 * k);
  const std::vector<double> counts = rebin(make_histogram(values), edges, *min, *max, false);
  EXPECT_NEAR(std::accumulate(counts.begin(), counts.end(), 0.0), 50'000.0, 1e-6);
  // 1250 each; six deviations of the drawing, and what the sharing by length moves.
  for (const double count : counts) EXPECT_NEAR(count, 1250.0, 6.0 * std::sqrt(1250.0));
  EXPECT_EQ(
      rebin(make_histogram(std::vector<double>{2.0, 3.0, 3.0}), std::vector<double>{1.5, 2.5, 3.5}, 2.0, 3.0, true),
      (std::vector<double>{1.0, 2.0}));
}

}  // namespace
}  // namespace tumble::sweep
