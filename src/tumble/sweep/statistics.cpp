#include "tumble/sweep/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "tumble/batch/simulate_batch.hpp"
#include "tumble/math/exp_log.hpp"
#include "tumble/math/format.hpp"

namespace tumble::sweep {
namespace {

constexpr std::size_t k_outside = std::numeric_limits<std::size_t>::max();

const std::vector<double>& need(std::span<const Column> columns, const std::string& name, std::size_t rows) {
  const Column* column = find_column(columns, name);
  if (column == nullptr) throw std::invalid_argument(tumble::format("columns: '{}' is missing", name));
  if (column->values.size() != rows) {
    throw std::invalid_argument(
        tumble::format("{}: must have {} rows like the first column, has {}", name, rows, column->values.size()));
  }
  return column->values;
}

std::size_t rows_of(std::span<const Column> columns) { return columns.empty() ? 0 : columns[0].values.size(); }

Outcome outcome_of(double status, double face, double rest_time) {
  if (status == static_cast<double>(batch::DropStatus::invalid)) return Outcome::invalid;
  if (status == static_cast<double>(batch::DropStatus::numerical)) return Outcome::numerical;
  if (status != static_cast<double>(batch::DropStatus::solved)) {
    throw std::invalid_argument(tumble::format("status: must be 0, 1 or 2, got {}", status));
  }
  if (!(face == 0.0 || face == 1.0 || face == 2.0 || face == 3.0)) {
    throw std::invalid_argument(tumble::format("face: must be 0, 1, 2 or 3 of what was solved, got {}", face));
  }
  return std::isnan(rest_time) ? Outcome::moving : static_cast<Outcome>(static_cast<int>(face));
}

bool is_solved(Outcome outcome) { return static_cast<std::size_t>(outcome) < k_num_landed; }

std::vector<Outcome> outcomes_of(std::span<const Column> chunk) {
  const std::size_t rows = rows_of(chunk);
  const std::vector<double>& status = need(chunk, "status", rows);
  const std::vector<double>& face = need(chunk, "face", rows);
  const std::vector<double>& rest_time = need(chunk, "rest_time", rows);
  std::vector<Outcome> outcomes(rows);
  for (std::size_t i = 0; i < rows; ++i) outcomes[i] = outcome_of(status[i], face[i], rest_time[i]);
  return outcomes;
}

// In two passes, each in the order of the values.
Moments moments_of(std::span<const double> values) {
  Moments moments;
  moments.count = static_cast<std::int64_t>(values.size());
  if (values.empty()) return moments;
  moments.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  for (const double value : values) moments.squares += (value - moments.mean) * (value - moments.mean);
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  moments.min = *min;
  moments.max = *max;
  return moments;
}

// [Chan, Golub & LeVeque 1983, eq. 2.1].
void merge_moments(Moments& moments, const Moments& other) {
  const std::int64_t missing = moments.missing + other.missing;
  if (other.count > 0 && moments.count == 0) {
    moments = other;
  } else if (other.count > 0) {
    const auto n = static_cast<double>(moments.count);
    const auto k = static_cast<double>(other.count);
    const double step = other.mean - moments.mean;
    moments.mean += step * (k / (n + k));
    moments.squares += other.squares + step * step * (n * (k / (n + k)));
    moments.count += other.count;
    moments.min = std::min(moments.min, other.min);
    moments.max = std::max(moments.max, other.max);
  }
  moments.missing = missing;
}

void add_counts(OutcomeCounts& counts, const OutcomeCounts& other) {
  for (std::size_t k = 0; k < k_num_outcomes; ++k) counts[k] += other[k];
}

std::size_t bin_in(const CellAxis& axis, double value) {
  if (!(value >= axis.edges.front() && value <= axis.edges.back())) return k_outside;
  const auto next = std::upper_bound(axis.edges.begin(), axis.edges.end() - 1, value);
  return static_cast<std::size_t>(next - axis.edges.begin()) - 1;
}

// The edge of a bin of one value.
double half_width(double value) { return value == 0.0 ? 0.5 : 0.5 * std::abs(value); }

}  // namespace

CellAxis cells_of_values(const Axis& axis) {
  std::vector<double> values = axis.values;
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  const std::size_t bins = std::min(values.size(), k_most_bins);
  CellAxis cells{axis.name, axis.unit, {}};
  // The first and the last bin reach as far beyond their values as their other edges are away.
  for (std::size_t k = 1; k < bins; ++k) {
    const std::size_t next = k * values.size() / bins;
    const double middle = 0.5 * values[next - 1] + 0.5 * values[next];
    cells.edges.push_back(middle > values[next - 1] ? middle : values[next]);
  }
  const double low = values.front(), high = values.back();
  const double before = bins > 1 ? std::max(cells.edges.front() - low, 0.0) : half_width(low);
  const double after = bins > 1 ? std::max(high - cells.edges.back(), 0.0) : half_width(high);
  cells.edges.insert(cells.edges.begin(), low - before);
  cells.edges.push_back(high + after);
  return cells;
}

CellAxis cells_of_range(const std::string& name, const std::string& unit, double low, double high,
                        bool is_logarithmic) {
  if (!(low < high)) return cells_of_values({name, unit, {low}});
  CellAxis cells{name, unit, {}, is_logarithmic};
  const double ratio = is_logarithmic ? tumble::log(high / low) : 0.0;
  for (std::size_t k = 0; k <= k_drawn_bins; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(k_drawn_bins);
    const double edge = is_logarithmic ? low * tumble::exp(share * ratio) : low + share * (high - low);
    cells.edges.push_back(k == 0 ? low : k == k_drawn_bins ? high : edge);
  }
  return cells;
}

std::size_t Layout::num_cells() const {
  if (axes.empty()) return 0;
  return std::accumulate(axes.begin(), axes.end(), std::size_t{1},
                         [](std::size_t product, const CellAxis& axis) { return product * axis.size(); });
}

const Column* find_column(std::span<const Column> columns, const std::string& name) {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

Statistics::Statistics(Layout layout)
    : layout_(std::move(layout)),
      moments_(layout_.measures.size()),
      histograms_(layout_.measures.size()),
      cell_outcomes_(layout_.num_cells()),
      cell_sums_(layout_.num_cells() * layout_.measures.size()) {
  if (layout_.axes.size() > 2) {
    throw std::invalid_argument(tumble::format("axes: a map has one or two, got {}", layout_.axes.size()));
  }
}

void Statistics::add(std::span<const Column> chunk) {
  const std::vector<Outcome> outcomes = outcomes_of(chunk);
  Statistics alone(layout_);
  for (const Outcome outcome : outcomes) ++alone.outcomes_[static_cast<std::size_t>(outcome)];
  std::vector<double> values;
  for (std::size_t m = 0; m < layout_.measures.size(); ++m) {
    const std::vector<double>& all = need(chunk, layout_.measures[m].name, outcomes.size());
    values.clear();
    std::int64_t missing = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!is_solved(outcomes[i])) continue;
      if (std::isnan(all[i])) {
        ++missing;
      } else {
        values.push_back(all[i]);
      }
    }
    alone.moments_[m] = moments_of(values);
    alone.moments_[m].missing = missing;
    alone.histograms_[m] = make_histogram(values);
  }
  alone.add_cells(chunk, outcomes);
  merge(alone);
}

void Statistics::add_cells(std::span<const Column> chunk, std::span<const Outcome> outcomes) {
  if (layout_.axes.empty()) return;
  std::vector<std::size_t> cells(outcomes.size(), 0);
  for (const CellAxis& axis : layout_.axes) {
    const std::vector<double>& values = need(chunk, axis.name, outcomes.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::size_t bin = bin_in(axis, values[i]);
      cells[i] = bin == k_outside || cells[i] == k_outside ? k_outside : cells[i] * axis.size() + bin;
    }
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] != k_outside) ++cell_outcomes_[cells[i]][static_cast<std::size_t>(outcomes[i])];
  }
  for (std::size_t m = 0; m < layout_.measures.size(); ++m) {
    const std::vector<double>& values = need(chunk, layout_.measures[m].name, outcomes.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i] == k_outside || !is_solved(outcomes[i]) || std::isnan(values[i])) continue;
      Sum& sum = cell_sums_[at(cells[i], m)];
      ++sum.count;
      sum.sum += values[i];
    }
  }
}

void Statistics::merge(const Statistics& other) {
  add_counts(outcomes_, other.outcomes_);
  for (std::size_t m = 0; m < moments_.size(); ++m) {
    merge_moments(moments_[m], other.moments_[m]);
    sweep::merge(histograms_[m], other.histograms_[m]);
  }
  for (std::size_t cell = 0; cell < cell_outcomes_.size(); ++cell) {
    add_counts(cell_outcomes_[cell], other.cell_outcomes_[cell]);
  }
  for (std::size_t k = 0; k < cell_sums_.size(); ++k) {
    cell_sums_[k].count += other.cell_sums_[k].count;
    cell_sums_[k].sum += other.cell_sums_[k].sum;
  }
}

double Statistics::mean_in(std::size_t cell, std::size_t measure) const {
  const Sum& sum = cell_sums_[at(cell, measure)];
  return sum.count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum.sum / static_cast<double>(sum.count);
}

}  // namespace tumble::sweep
