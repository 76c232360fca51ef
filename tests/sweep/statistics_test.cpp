#include "tumble/sweep/statistics.hpp"

#include <algorithm>
#include <cstring>

#include "sample_columns.hpp"
#include <gtest/gtest.h>

namespace tumble::sweep {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

// Bit for bit: all that files hold.
void expect_equal_bits(const Statistics& a, const Statistics& b) {
  const auto first = a.to_fields();
  const auto second = b.to_fields();
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(first[k].name, second[k].name);
    EXPECT_EQ(first[k].shape, second[k].shape);
    std::visit(
        [&](const auto& values) {
          const auto& others = std::get<std::remove_cvref_t<decltype(values)>>(second[k].values);
          ASSERT_EQ(values.size(), others.size()) << first[k].name;
          if constexpr (std::is_trivially_copyable_v<std::remove_cvref_t<decltype(values[0])>>) {
            EXPECT_TRUE(values.empty() ||
                        std::memcmp(values.data(), others.data(), values.size() * sizeof(values[0])) == 0)
                << first[k].name;
          }
        },
        first[k].values);
  }
}

TEST(Statistics, ChunksSharedOutInAnyWayGiveTheSameBits) {
  const std::vector<Column> all = sample_columns(10'000);
  Statistics in_a_row(sample_layout());
  std::vector<Statistics> alone;
  for (std::size_t first = 0; first < 10'000; first += 700) {
    const std::vector<Column> chunk = rows_of(all, first, std::min<std::size_t>(first + 700, 10'000));
    in_a_row.add(chunk);
    alone.emplace_back(sample_layout());
    alone.back().add(chunk);
  }
  Statistics merged(sample_layout());
  for (const Statistics& statistics : alone) {
    const Statistics from_file = Statistics::from_fields(sample_layout(), statistics.to_fields());
    expect_equal_bits(from_file, statistics);
    merged.merge(from_file);
  }
  expect_equal_bits(merged, in_a_row);
}

TEST(Statistics, CountsDoNotDependOnTheChunks) {
  const std::vector<Column> all = sample_columns(5'000);
  Statistics at_once(sample_layout());
  at_once.add(all);
  Statistics one_by_one(sample_layout());
  for (std::size_t i = 0; i < 5'000; i += 50) one_by_one.add(rows_of(all, i, i + 50));
  EXPECT_EQ(at_once.outcomes(), one_by_one.outcomes());
  for (std::size_t m = 0; m < 3; ++m) {
    EXPECT_EQ(at_once.histogram(m).bins, one_by_one.histogram(m).bins);
    EXPECT_EQ(at_once.histogram(m).counts, one_by_one.histogram(m).counts);
    EXPECT_EQ(at_once.moments(m).count, one_by_one.moments(m).count);
    EXPECT_EQ(at_once.moments(m).min, one_by_one.moments(m).min);
    // 100 merges, each rounded a few times.
    EXPECT_NEAR(at_once.moments(m).mean, one_by_one.moments(m).mean, 1e-13 * 10.0);
    EXPECT_NEAR(at_once.moments(m).squares / one_by_one.moments(m).squares, 1.0, 1e-12);
  }
}

TEST(Statistics, MeansAndVariancesAreThoseOfWhatWasSolved) {
  const std::vector<Column> columns = {{"x", "m", {1.0, 2.0, 4.0, 100.0, k_nan, k_nan}},
                                       {"face", "", {0.0, 3.0, 3.0, -1.0, -1.0, 2.0}},
                                       {"rest_time", "s", {1.0, 1.0, k_nan, k_nan, k_nan, 1.0}},
                                       {"status", "", {0.0, 0.0, 0.0, 1.0, 2.0, 0.0}}};
  Statistics statistics(Layout{{{"x", "m"}}, {}});
  statistics.add(columns);
  EXPECT_EQ(statistics.outcomes(), (OutcomeCounts{1, 0, 1, 1, 1, 1, 1}));
  const Moments& moments = statistics.moments(0);
  EXPECT_EQ(moments.count, 3);
  EXPECT_EQ(moments.missing, 1);
  EXPECT_DOUBLE_EQ(moments.mean, 7.0 / 3.0);
  EXPECT_DOUBLE_EQ(moments.squares, 14.0 / 3.0);
  EXPECT_EQ(moments.min, 1.0);
  EXPECT_EQ(moments.max, 4.0);
}

TEST(Statistics, FarFromZeroTheVarianceKeepsItsDigits) {
  std::vector<Column> columns = {{"x", "m", {}}, {"face", "", {}}, {"rest_time", "s", {}}, {"status", "", {}}};
  Statistics statistics(Layout{{{"x", "m"}}, {}});
  for (int chunk = 0; chunk < 4; ++chunk) {
    columns[0].values = {1e9 + chunk, 1e9 + chunk + 0.5};
    for (int k = 1; k < 4; ++k) columns[static_cast<std::size_t>(k)].values = {0.0, 0.0};
    statistics.add(columns);
  }
  // Of 0, 0.5, ..., 3.5: 8 (64 - 1) / 12 / 4.
  EXPECT_NEAR(statistics.moments(0).squares, 10.5, 1e-6);
}

TEST(Statistics, CellsAddUpToTheWhole) {
  Statistics statistics(sample_layout());
  statistics.add(sample_columns(10'000));
  OutcomeCounts sum{};
  for (std::size_t cell = 0; cell < statistics.layout().num_cells(); ++cell) {
    for (std::size_t k = 0; k < k_num_outcomes; ++k) sum[k] += statistics.outcomes_in(cell)[k];
  }
  EXPECT_EQ(sum, statistics.outcomes());
}

TEST(Statistics, ACellHoldsItsInstances) {
  const std::vector<Column> columns = {{"a", "", {1.0, 1.0, 3.0}},          {"b", "", {10.0, 20.0, 20.0}},
                                       {"x", "m", {5.0, 7.0, 9.0}},         {"face", "", {0.0, 1.0, 2.0}},
                                       {"rest_time", "s", {1.0, 1.0, 1.0}}, {"status", "", {0.0, 0.0, 0.0}}};
  Statistics statistics(
      Layout{{{"x", "m"}}, {cells_of_values({"a", "", {3.0, 1.0}}), cells_of_values({"b", "", {10.0, 20.0}})}});
  statistics.add(columns);
  EXPECT_EQ(statistics.mean_in(0, 0), 5.0);
  EXPECT_EQ(statistics.mean_in(1, 0), 7.0);
  EXPECT_TRUE(std::isnan(statistics.mean_in(2, 0)));
  EXPECT_EQ(statistics.mean_in(3, 0), 9.0);
  EXPECT_EQ(statistics.outcomes_in(3)[2], 1);
}

TEST(Statistics, EachValueOfAnAxisHasItsOwnBin) {
  const double next = std::nextafter(1.0, 2.0);
  const CellAxis axis = cells_of_values({"a", "", {5.0, 1.0, next, -2.0, 1.0}});
  ASSERT_EQ(axis.size(), 4u);
  EXPECT_TRUE(std::is_sorted(axis.edges.begin(), axis.edges.end()));
  EXPECT_LE(axis.edges[1], 1.0);
  EXPECT_GT(axis.edges[2], 1.0);
  EXPECT_LE(axis.edges[2], next);
  EXPECT_EQ(cells_of_values({"a", "", {0.0}}).edges, (std::vector<double>{-0.5, 0.5}));
  std::vector<double> many(1000);
  for (std::size_t k = 0; k < many.size(); ++k) many[k] = static_cast<double>(k);
  EXPECT_EQ(cells_of_values({"a", "", many}).size(), k_most_bins);
  EXPECT_EQ(cells_of_range("a", "", 2.0, 2.0).size(), 1u);
}

TEST(Statistics, WhatIsWrongWithColumnsIsNamed) {
  const auto message_of = [](std::vector<Column> columns) -> std::string {
    try {
      Statistics(sample_layout()).add(columns);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  std::vector<Column> columns = sample_columns(100);
  EXPECT_EQ(message_of(columns), "");
  columns[2].name = "end_x";
  EXPECT_EQ(message_of(columns), "columns: 'final_x' is missing");
  columns = sample_columns(100);
  columns[4].values.pop_back();
  EXPECT_EQ(message_of(columns), "rest_time: must have 100 rows like the first column, has 99");
  columns = sample_columns(100);
  columns[6].values[3] = 7.0;
  EXPECT_EQ(message_of(columns), "status: must be 0, 1 or 2, got 7");
}

TEST(Statistics, DamagedArraysAreNamed) {
  Statistics statistics(sample_layout());
  statistics.add(sample_columns(100));
  for (std::size_t k = 0; k < statistics.to_fields().size(); ++k) {
    std::vector<output::Field> fields = statistics.to_fields();
    const std::string name = fields[k].name;
    fields.erase(fields.begin() + static_cast<std::ptrdiff_t>(k));
    EXPECT_THROW(Statistics::from_fields(sample_layout(), fields), std::invalid_argument) << name;
  }
  std::vector<output::Field> fields = statistics.to_fields();
  std::get<std::vector<std::int32_t>>(fields[10].values)[0] = 100'000;
  EXPECT_THROW(Statistics::from_fields(sample_layout(), fields), std::invalid_argument);
}

}  // namespace
}  // namespace tumble::sweep
