// Columns of a made-up sweep.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tumble/sweep/statistics.hpp"

namespace tumble::sweep {

// Rows of a sweep over theta (a grid of `thetas` values) and mu in [0.1, 0.9], of which one in 50 is numerical, one in
// 50 invalid and one in 10 still moving.
inline std::vector<Column> sample_columns(std::size_t rows, unsigned seed = 1, std::size_t thetas = 12) {
  std::mt19937 random(seed);
  const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Column> columns = {{"theta", "rad", {}},    {"mu", "", {}},         {"final_x", "m", {}},
                                 {"face", "", {}, true},  {"rest_time", "s", {}}, {"impacts", "", {}, true},
                                 {"status", "", {}, true}};
  for (std::size_t i = 0; i < rows; ++i) {
    const double theta = static_cast<double>(i * thetas / rows) / static_cast<double>(thetas) * 1.5;
    const double mu = 0.1 + 0.8 * share();
    const double kind = share();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const bool is_invalid = kind < 0.02;
    const bool is_solved = kind >= 0.04;
    const double turn = std::floor(4.0 * std::fmod(theta / 1.5 + 0.3 * share() + 0.3 * mu, 1.0));
    const double x = 0.4 * std::cos(3.0 * theta) + mu * (share() + share() - 1.0);
    columns[0].values.push_back(theta);
    columns[1].values.push_back(mu);
    columns[2].values.push_back(is_invalid ? nan : x);
    columns[3].values.push_back(is_solved ? turn : -1.0);
    columns[4].values.push_back(!is_solved || kind > 0.9 ? nan : 0.5 + share() + mu * share());
    columns[5].values.push_back(is_invalid ? -1.0 : std::floor(3.0 + 9.0 * share()));
    columns[6].values.push_back(is_invalid ? 2.0 : is_solved ? 0.0 : 1.0);
  }
  return columns;
}

inline Layout sample_layout(std::size_t thetas = 12) {
  Axis theta{"theta", "rad", {}};
  for (std::size_t k = 0; k < thetas; ++k) {
    theta.values.push_back(static_cast<double>(k) / static_cast<double>(thetas) * 1.5);
  }
  return {{{"final_x", "m"}, {"rest_time", "s"}, {"impacts", "", true}},
          {cells_of_values(theta), cells_of_range("mu", "", 0.1, 0.9)}};
}

// Rows first to last - 1.
inline std::vector<Column> rows_of(const std::vector<Column>& columns, std::size_t first, std::size_t last) {
  std::vector<Column> rows = columns;
  for (Column& column : rows) {
    column.values.assign(column.values.begin() + static_cast<std::ptrdiff_t>(first),
                         column.values.begin() + static_cast<std::ptrdiff_t>(last));
  }
  return rows;
}

}  // namespace tumble::sweep
