#include "tumble/sweep/describe.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tumble/math/format.hpp"
#include "tumble/sweep/plan.hpp"
#include "tumble/sweep/slice.hpp"

namespace tumble::sweep {
namespace {

constexpr double k_shown_deviations = 3.0;

CellAxis cells_of(const Quantity& quantity) {
  const auto& [name, unit, source, draw, target] = quantity;
  if (const auto* grid = std::get_if<Grid>(&source)) return cells_of_values({name, unit, grid->values});
  if (const auto* normal = std::get_if<Normal>(&source)) {
    const double reach = k_shown_deviations * normal->deviation;
    return cells_of_range(name, unit, normal->mean - reach, normal->mean + reach);
  }
  if (const auto* uniform = std::get_if<Uniform>(&source)) {
    return cells_of_range(name, unit, uniform->low, uniform->high);
  }
  const auto& ends = std::get<LogUniform>(source);
  return cells_of_range(name, unit, ends.low, ends.high, true);
}

std::string in_unit(const std::string& unit) { return unit.empty() ? "" : " " + unit; }

struct SweptText {
  std::string operator()(const Constant&) const { return ""; }
  std::string operator()(const Grid& grid) const {
    const auto [low, high] = std::minmax_element(grid.values.begin(), grid.values.end());
    return tumble::format("{:.6g} to {:.6g}{}, {} value{}", *low, *high, in_unit(unit), grid.values.size(),
                          grid.values.size() == 1 ? "" : "s");
  }
  std::string operator()(const Uniform& source) const {
    return tumble::format("{:.6g} to {:.6g}{}, uniform", source.low, source.high, in_unit(unit));
  }
  std::string operator()(const Normal& source) const {
    return tumble::format("{:.6g}{}, normal, standard deviation {:.6g}{}", source.mean, in_unit(unit), source.deviation,
                          in_unit(unit));
  }
  std::string operator()(const LogUniform& source) const {
    return tumble::format("{:.6g} to {:.6g}{}, log-uniform", source.low, source.high, in_unit(unit));
  }

  const std::string& unit;
};

bool is_grid(const Quantity& quantity) { return std::holds_alternative<Grid>(quantity.source); }

bool has_region(const Spec& spec) { return std::isfinite(spec.measures.x_min) || std::isfinite(spec.measures.x_max); }

}  // namespace

Layout layout_of(const Spec& spec) {
  Layout layout;
  for (const Column& column : empty_columns(spec)) {
    const bool is_input = std::any_of(spec.quantities.begin(), spec.quantities.end(),
                                      [&](const Quantity& quantity) { return quantity.name == column.name; });
    if (is_input || column.name == "face" || column.name == "status") continue;
    if (column.name == "escape_time" && !has_region(spec)) continue;
    layout.measures.push_back({column.name, column.unit, column.is_whole});
  }
  for (const bool wants_grids : {true, false}) {
    for (const Quantity& quantity : spec.quantities) {
      if (layout.axes.size() == 2) return layout;
      if (is_swept(quantity) && is_grid(quantity) == wants_grids) layout.axes.push_back(cells_of(quantity));
    }
  }
  return layout;
}

Facts facts_of(const Spec& spec) {
  Facts facts{spec.title, {}, spec.measures.rest_speed, false};
  for (const Quantity& quantity : spec.quantities) {
    if (!is_swept(quantity)) continue;
    facts.swept.push_back(
        tumble::format("{}: {}", quantity.name, std::visit(SweptText{quantity.unit}, quantity.source)));
    facts.is_drawn = facts.is_drawn || !is_grid(quantity);
  }
  return facts;
}

std::optional<Fan> fan_of(const Spec& spec) {
  constexpr std::uint64_t most_lines = 200;
  constexpr int most_times = 400;
  constexpr double most_steps = 20e6;      // of drops, in all: a second
  constexpr double most_body_steps = 2e5;  // of scenes: seconds
  for (const Quantity& quantity : spec.quantities) {
    if (quantity.name == "dt" && is_swept(quantity)) return std::nullopt;
  }
  double steps = spec.columns - 1;
  double affordable = most_steps / steps;
  if (spec.scene) {
    const Scene& scene = spec.scene->scene;
    steps = scene.duration / scene.step_size;
    affordable = most_body_steps / (steps * static_cast<double>(scene.bodies.size()));
  }
  const std::uint64_t lines = std::min({num_instances(spec), most_lines, static_cast<std::uint64_t>(affordable) + 1});
  const int every = static_cast<int>(steps) / most_times + 1;
  Fan fan{"x", "m", {}, {}};
  for (std::uint64_t k = 0; k < lines; ++k) {
    Path path = simulate_path(spec, num_instances(spec) / lines * k, every);
    fan.time = std::move(path.time);
    fan.lines.push_back(std::move(path.x));
  }
  return fan;
}

}  // namespace tumble::sweep
