#include "tumble/sweep/sweep_plots.hpp"

#include <filesystem>
#include <set>

#include "../temporary_folder.hpp"
#include "sample_columns.hpp"
#include <gtest/gtest.h>

#include "tumble/output/file.hpp"

namespace tumble::sweep {
namespace {

// Statistics, their summary, and a fan of a few lines.
struct Sample {
  Sample(const Layout& layout, const std::vector<Column>& columns) : statistics(layout) {
    statistics.add(columns);
    summary = summarise(statistics, {"A sweep", {"theta: 0 to 1.375 rad, 12 values", "mu: 0.1 to 0.9"}, 0.2, true});
    for (int k = 0; k < 50; ++k) fan.time.push_back(0.02 * k);
    for (int i = 0; i < 30; ++i) {
      fan.lines.emplace_back();
      for (int k = 0; k < 50; ++k) fan.lines.back().push_back(0.01 * (i - 10) * k);
    }
  }

  PlotSource source() const { return {statistics, summary, &fan}; }

  Statistics statistics;
  Summary summary;
  Fan fan{"x", "m", {}, {}};
};

const std::vector<std::string> k_kinds = {"overview", "faces",     "map",         "fan",        "final_x",
                                          "impacts",  "rest_time", "map final_x", "map impacts"};

// Width and height of a PNG, from its header.
std::pair<int, int> size_of(const std::string& png) {
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = 256 * value + static_cast<unsigned char>(png.at(at + k));
    return value;
  };
  EXPECT_EQ(png.substr(1, 3), "PNG");
  return {number(16), number(20)};
}

TEST(SweepPlots, EachKindIsAPictureOfItsOwn) {
  const Sample sample(sample_layout(), sample_columns(3'000));
  std::set<std::string> pictures;
  for (const std::string& kind : k_kinds) {
    const std::string png = to_plot_png(sample.source(), {kind});
    EXPECT_EQ(png, to_plot_png(sample.source(), {kind})) << kind;
    pictures.insert(png);
    const std::string svg = to_plot_svg(sample.source(), {kind});
    EXPECT_NE(svg.find("<svg"), std::string::npos) << kind;
    EXPECT_EQ(svg.find("nan"), std::string::npos) << kind;
  }
  EXPECT_EQ(pictures.size(), k_kinds.size());
}

TEST(SweepPlots, AnySizeIsKept) {
  const Sample sample(sample_layout(), sample_columns(1'000));
  for (const std::string& kind : k_kinds) {
    for (const auto& [width, height] : {std::pair{160, 160}, {160, 900}, {900, 160}, {333, 444}, {4096, 300}}) {
      const auto size = size_of(to_plot_png(sample.source(), {kind, width, height}));
      EXPECT_EQ(size, (std::pair{width, height})) << kind;
    }
  }
  EXPECT_EQ(size_of(to_plot_png(sample.source(), {"faces", 320})).second, 220);
  EXPECT_THROW(to_plot_png(sample.source(), {"faces", 159}), std::invalid_argument);
  EXPECT_THROW(to_plot_svg(sample.source(), {"faces", 0, 4097}), std::invalid_argument);
}

// Sweeps that leave a naive chart without a range, or with one that no double can divide.
TEST(SweepPlots, OddSweepsCanBeDrawn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::pair<Layout, std::vector<Column>>> odd;
  for (const std::size_t rows : {1, 2, 40}) odd.emplace_back(sample_layout(), sample_columns(rows));
  for (const double value : {0.0, 1.0, 1e15, -1e15, 1e-12, 1e200, nan}) {
    std::vector<Column> columns = sample_columns(40);
    std::fill(columns[2].values.begin(), columns[2].values.end(), value);
    odd.emplace_back(sample_layout(), columns);
    if (value == 1e15) columns[2].values[20] += 0.125;
    odd.emplace_back(sample_layout(), columns);
  }
  std::vector<Column> columns = sample_columns(40);
  std::fill(columns[6].values.begin(), columns[6].values.end(), 2.0);  // all invalid
  odd.emplace_back(sample_layout(), columns);
  odd.emplace_back(Layout{sample_layout().measures, {}}, sample_columns(40));
  odd.emplace_back(Layout{sample_layout().measures, {sample_layout().axes[1]}}, sample_columns(40));
  odd.emplace_back(sample_layout(1), sample_columns(40, 1, 1));
  for (std::size_t k = 0; k < odd.size(); ++k) {
    Sample sample(odd[k].first, odd[k].second);
    for (std::vector<double>& line : sample.fan.lines)
      std::fill(line.begin() + 20, line.end(), k % 2 == 0 ? nan : 1e15);
    for (const std::string& kind : k_kinds) {
      const std::string svg = to_plot_svg(sample.source(), {kind});
      EXPECT_EQ(svg.find("nan"), std::string::npos) << k << " " << kind;
      EXPECT_EQ(svg.find("inf"), std::string::npos) << k << " " << kind;
      EXPECT_LT(svg.size(), 1'000'000u) << k << " " << kind;
    }
  }
}

TEST(SweepPlots, LogarithmicAxesCanBeDrawn) {
  for (const auto& [low, high] : {std::pair{0.1, 0.9}, {0.1, 0.11}, {1e-9, 1e9}}) {
    Layout layout = sample_layout();
    layout.axes[1] = cells_of_range("mu", "", low, high, true);
    ASSERT_TRUE(std::is_sorted(layout.axes[1].edges.begin(), layout.axes[1].edges.end()));
    const Sample sample(layout, sample_columns(1'000));
    EXPECT_EQ(to_plot_svg(sample.source(), {"map"}).find("nan"), std::string::npos);
  }
}

TEST(SweepPlots, WhatIsWrongIsNamed) {
  const Sample sample(sample_layout(), sample_columns(10));
  try {
    to_plot_png(sample.source(), {"face"});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(
        error.what(),
        "plot: must be one of overview, faces, map, fan, final_x, rest_time, impacts, or 'map' and the name of a "
        "measure, got 'face'");
  }
  EXPECT_THROW(to_plot_png({sample.statistics, sample.summary}, {"fan"}), std::invalid_argument);
  EXPECT_THROW(write_plot(sample.source(), "plot.gif", {}, false), std::invalid_argument);
  EXPECT_THROW(write_plot(sample.source(), "/absent/plot.png", {}, false), std::invalid_argument);
}

TEST(SweepPlots, AFileIsWrittenOnce) {
  const Sample sample(sample_layout(), sample_columns(10));
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "plot.svg";
  write_plot(sample.source(), path, {}, false);
  EXPECT_EQ(output::read_file(path, 1u << 24), to_plot_svg(sample.source(), {}));
  EXPECT_THROW(write_plot(sample.source(), path, {}, false), std::invalid_argument);
  write_plot(sample.source(), path, {"faces"}, true);
}

}  // namespace
}  // namespace tumble::sweep
