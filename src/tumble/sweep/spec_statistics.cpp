#include "tumble/sweep/spec_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "tumble/sweep/drop_chunk.hpp"
#include "tumble/sweep/plan.hpp"

namespace tumble::sweep {
namespace {

constexpr int k_most_times = 500;  // of a fan

// The axis of a map; without bins if the quantity takes one value.
struct AxisOf {
  CellAxis operator()(const Constant&) const { return {}; }
  CellAxis operator()(const Grid& grid) const {
    const auto [low, high] = std::minmax_element(grid.values.begin(), grid.values.end());
    return *low < *high ? cells_of_values({quantity.name, quantity.unit, grid.values}) : CellAxis{};
  }
  CellAxis operator()(const Uniform& source) const { return range(source.low, source.high); }
  CellAxis operator()(const Normal& source) const {
    const double half = 3.0 * source.deviation;  // all but 0.3 %
    return range(source.mean - half, source.mean + half);
  }
  CellAxis operator()(const LogUniform& source) const { return range(source.low, source.high, true); }

  CellAxis range(double low, double high, bool is_logarithmic = false) const {
    return low < high ? cells_of_range(quantity.name, quantity.unit, low, high, is_logarithmic) : CellAxis{};
  }

  const Quantity& quantity;
};

struct WordsOf {
  std::string operator()(const Constant& source) const { return fmt::format("{:.6g}{}", source.value, unit); }
  std::string operator()(const Grid& grid) const {
    const auto [low, high] = std::minmax_element(grid.values.begin(), grid.values.end());
    if (grid.values.size() == 1) return fmt::format("{:.6g}{}", *low, unit);
    return fmt::format("{} values, {:.6g} to {:.6g}{}", grid.values.size(), *low, *high, unit);
  }
  std::string operator()(const Uniform& source) const {
    return fmt::format("uniform, {:.6g} to {:.6g}{}", source.low, source.high, unit);
  }
  std::string operator()(const Normal& source) const {
    return fmt::format("normal, {:.6g} with deviation {:.6g}{}", source.mean, source.deviation, unit);
  }
  std::string operator()(const LogUniform& source) const {
    return fmt::format("log-uniform, {:.6g} to {:.6g}{}", source.low, source.high, unit);
  }

  std::string unit;
};

bool is_drawn(const Quantity& quantity) { return is_swept(quantity) && !std::holds_alternative<Grid>(quantity.source); }

// Evenly spread; fewer of long runs.
std::vector<std::uint64_t> instances_of_fan(const Spec& spec) {
  constexpr std::uint64_t k_most_steps = 20'000'000, k_fewest = 8;
  const std::uint64_t all = num_instances(spec);
  const std::uint64_t affordable = std::max(k_fewest, k_most_steps / static_cast<std::uint64_t>(spec.columns));
  const std::uint64_t count = std::min({all, k_fan_instances, affordable});
  std::vector<std::uint64_t> instances;
  // i all / count, without overflow.
  for (std::uint64_t i = 0; i < count; ++i) instances.push_back(i * (all / count) + i * (all % count) / count);
  return instances;
}

std::vector<double> values_of(const Spec& spec, std::string_view name, std::span<const std::uint64_t> instances) {
  const auto found = std::find_if(spec.quantities.begin(), spec.quantities.end(),
                                  [&](const Quantity& quantity) { return quantity.name == name; });
  const auto quantity = static_cast<std::size_t>(found - spec.quantities.begin());
  std::vector<double> values(instances.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    fill_values(spec, quantity, instances[i], std::span(values).subspan(i, 1));
  }
  return values;
}

std::vector<double> in_rows(const std::array<std::vector<double>, 3>& columns) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < columns[0].size(); ++i) {
    for (const std::vector<double>& column : columns) rows.push_back(column[i]);
  }
  return rows;
}

// Between the columns at `place`; NaN behind the last one.
double value_at(std::span<const double> columns, double place) {
  const double rounded = std::round(place);
  if (std::abs(place - rounded) < 1e-9 * (1.0 + rounded)) place = rounded;
  const double low = std::floor(place);
  if (low > static_cast<double>(columns.size() - 1)) return std::numeric_limits<double>::quiet_NaN();
  const auto k = static_cast<std::size_t>(low);
  if (place == low) return columns[k];
  if (k + 1 == columns.size()) return std::numeric_limits<double>::quiet_NaN();
  return columns[k] + (place - low) * (columns[k + 1] - columns[k]);
}

}  // namespace

Layout layout_of(const Spec& spec) {
  Layout layout;
  std::vector<std::string> others = {"face", "status"};
  for (const Quantity& quantity : spec.quantities) {
    if (!is_swept(quantity)) continue;
    others.push_back(quantity.name);
    CellAxis axis = std::visit(AxisOf{quantity}, quantity.source);
    if (!axis.edges.empty() && layout.axes.size() < 2) layout.axes.push_back(std::move(axis));
  }
  for (const Column& column : empty_columns(spec)) {
    if (std::find(others.begin(), others.end(), column.name) != others.end()) continue;
    layout.measures.push_back({column.name, column.unit, column.is_whole});
  }
  return layout;
}

Facts facts_of(const Spec& spec) {
  Facts facts{spec.title, {}, spec.measures.rest_speed, false};
  for (const Quantity& quantity : spec.quantities) {
    if (!is_swept(quantity)) continue;
    const std::string unit = quantity.unit.empty() ? "" : fmt::format(" {}", quantity.unit);
    facts.swept.push_back(fmt::format("{}: {}", quantity.name, std::visit(WordsOf{unit}, quantity.source)));
    facts.is_drawn = facts.is_drawn || is_drawn(quantity);
  }
  return facts;
}

Fan simulate_fan(const Spec& spec) {
  const std::vector<std::uint64_t> instances = instances_of_fan(spec);
  const std::size_t lines = instances.size();
  const auto values = [&](std::string_view name) { return values_of(spec, name, instances); };
  const std::vector<double> q0 = in_rows({values("x"), values("y"), values("theta")});
  const std::vector<double> v0 = in_rows({values("vx"), values("vy"), values("omega")});
  const std::array<std::vector<double>, 7> p = {values("l"),  values("m"),     values("mu"), values("eps"),
                                                values("dt"), values("delta"), values("g")};
  batch::BatchSettings settings;
  settings.every = (spec.columns - 1) / k_most_times + 1;
  const std::size_t kept = batch::kept_columns(spec.columns, settings.every);
  std::vector<double> q(lines * 3 * kept);
  batch::simulate_batch<double>({q0, v0}, {p[0], p[1], p[2], p[3], p[4], p[5], p[6], spec.columns}, settings,
                                {q, {}, {}, {}, {}});

  Fan fan{"x", "m", {}, {}};
  const std::vector<double>& dt = p[4];
  const double spacing = *std::max_element(dt.begin(), dt.end()) * settings.every;
  for (std::size_t k = 0; k < kept; ++k) fan.time.push_back(static_cast<double>(k) * spacing);
  for (std::size_t i = 0; i < lines; ++i) {
    const std::span<const double> x(q.data() + i * 3 * kept, kept);
    if (std::isnan(x[0])) continue;
    fan.lines.emplace_back();
    for (const double time : fan.time) fan.lines.back().push_back(value_at(x, time / (dt[i] * settings.every)));
  }
  return fan;
}

}  // namespace tumble::sweep
