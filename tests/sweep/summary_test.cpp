#include "tumble/sweep/summary.hpp"

#include <cmath>
#include <sstream>

#include "sample_columns.hpp"
#include <gtest/gtest.h>

namespace tumble::sweep {
namespace {

TEST(Intervals, SharesAsTabulated) {
  // 81 of 263 [Newcombe 1998, table I, method 3] and 15 of 148, 0 of 20, 1 of 29 there.
  const auto expect = [](std::int64_t count, std::int64_t total, double low, double high) {
    const Interval interval = interval_of_share(count, total);
    EXPECT_NEAR(interval.low, low, 5e-5) << count << " of " << total;
    EXPECT_NEAR(interval.high, high, 5e-5) << count << " of " << total;
  };
  expect(81, 263, 0.2553, 0.3662);
  expect(15, 148, 0.0624, 0.1605);
  expect(0, 20, 0.0, 0.1611);
  expect(1, 29, 0.0061, 0.1718);
}

TEST(Intervals, SharesAtTheEnds) {
  for (const std::int64_t n : {1, 2, 10, 1'000'000'000}) {
    const Interval none = interval_of_share(0, n), all = interval_of_share(n, n);
    EXPECT_EQ(none.low, 0.0);
    EXPECT_EQ(all.high, 1.0);
    // z^2 / (n + z^2)
    EXPECT_NEAR(none.high, 3.841458820694124 / (static_cast<double>(n) + 3.841458820694124), 1e-12);
    EXPECT_NEAR(all.low, 1.0 - none.high, 1e-12);
  }
  EXPECT_TRUE(std::isnan(interval_of_share(0, 0).low));
}

// Against the roots of the regularised incomplete beta function, found with 40 digits. The bound is the first term that
// the expansion leaves out, at its smallest n.
TEST(Intervals, StudentsTAsExact) {
  const std::pair<std::int64_t, double> exact[] = {
      {1, 12.706204736174705},   {2, 4.302652729749464},    {3, 3.1824463052837095},  {10, 2.228138851986275},
      {29, 2.0452296421327043},  {30, 2.042272456301238},   {31, 2.0395134463964086}, {50, 2.008559112100761},
      {100, 1.9839715185235522}, {1000, 1.9623390808264085}};
  for (const auto& [degrees, t] : exact) EXPECT_NEAR(student_t_95(degrees), t, 2e-8 * t) << degrees;
  EXPECT_NEAR(student_t_95(1'000'000'000'000), 1.959963984540054, 1e-11);
}

TEST(Intervals, OfTheMean) {
  // 1, 2, 3: deviation 1, t = 4.302653.
  const Interval interval = interval_of_mean(3, 2.0, 2.0);
  EXPECT_NEAR(interval.high - 2.0, 4.302653 / std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(interval.low + interval.high, 4.0, 1e-12);
  EXPECT_TRUE(std::isnan(interval_of_mean(1, 2.0, 0.0).low));
}

Summary summary_of(const std::vector<Column>& columns) {
  Statistics statistics(sample_layout());
  statistics.add(columns);
  return summarise(statistics, {"A title with \"quotes\"", {}, 0.2, true});
}

TEST(Summary, CountsAddUp) {
  const Summary summary = summary_of(sample_columns(10'000));
  EXPECT_EQ(summary.instances, 10'000);
  EXPECT_EQ(summary.solved + summary.numerical + summary.invalid, 10'000);
  std::int64_t counts = 0;
  double shares = 0.0;
  for (const Share& share : summary.shares) {
    counts += share.count;
    shares += share.share;
    EXPECT_LE(share.interval.low, share.share);
    EXPECT_GE(share.interval.high, share.share);
  }
  EXPECT_EQ(counts, summary.solved);
  EXPECT_NEAR(shares, 1.0, 1e-15 * 8);
  for (const MeasureSummary& m : summary.measures) {
    EXPECT_EQ(m.count + m.missing, summary.solved);
    EXPECT_LE(m.min, m.low);
    EXPECT_LE(m.low, m.first_quartile);
    EXPECT_LE(m.first_quartile, m.median);
    EXPECT_LE(m.median, m.third_quartile);
    EXPECT_LE(m.third_quartile, m.high);
    EXPECT_LE(m.high, m.max);
  }
}

TEST(Summary, OfOneInstance) {
  std::vector<Column> columns = sample_columns(1);
  columns[2].values = {0.25};
  columns[3].values = {3.0};
  columns[4].values = {1.5};
  columns[6].values = {0.0};
  const Summary summary = summary_of(columns);
  EXPECT_EQ(summary.shares[3].share, 1.0);
  EXPECT_NEAR(summary.shares[3].interval.low, 0.2065, 1e-4);
  const MeasureSummary& x = summary.measures[0];
  EXPECT_EQ(x.mean, 0.25);
  EXPECT_EQ(x.median, 0.25);
  EXPECT_EQ(x.low, 0.25);
  EXPECT_TRUE(std::isnan(x.deviation));
  EXPECT_TRUE(std::isnan(x.interval.low));
  EXPECT_NE(to_text(summary).find("-x up                          1     100.0 %   20.7 to 100.0 %"), std::string::npos)
      << to_text(summary);
}

TEST(Summary, WithoutAnySolved) {
  std::vector<Column> columns = sample_columns(2);
  columns[6].values = {1.0, 2.0};
  const Summary summary = summary_of(columns);
  EXPECT_EQ(summary.solved, 0);
  const std::string text = to_text(summary);
  EXPECT_NE(text.find("2 instances, 0 solved\nleft out: 1 numerical"), std::string::npos);
  EXPECT_NE(text.find("left out: 1 invalid"), std::string::npos);
  for (const std::string& all : {text, to_csv(summary), to_json(summary)}) {
    EXPECT_EQ(all.find("nan"), std::string::npos) << all;
  }
}

TEST(Summary, CsvHasAsManyCellsInEachLine) {
  std::istringstream lines(to_csv(summary_of(sample_columns(500))));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 14) << line;
  }
  EXPECT_EQ(count, 1 + 7 + 3);
}

TEST(Summary, JsonQuotesTexts) {
  const std::string json = to_json(summary_of(sample_columns(500)));
  EXPECT_NE(json.find(R"("title": "A title with \"quotes\"",)"), std::string::npos) << json;
}

}  // namespace
}  // namespace tumble::sweep
