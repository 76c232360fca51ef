#include "tumble/sweep/slice.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "tumble/sweep/models.hpp"

namespace tumble::sweep {
namespace {

std::vector<double> collect(std::size_t count, const auto& value_of) {
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k) values[k] = value_of(k);
  return values;
}

}  // namespace

SliceValues::SliceValues(const Spec& of_spec, const Slice& slice)
    : spec(of_spec), count(std::max(slice.count, std::size_t{2})), values(of_spec.quantities.size()) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    values[k].resize(is_swept(spec.quantities[k]) ? count : 1);
    fill_values(spec, k, slice.first, values[k]);
  }
}

std::vector<Column> simulate_slice(const Spec& spec, const Slice& slice, const std::function<void()>& watch) {
  SliceValues values(spec, slice);
  const auto [pose, status, measures] = spec.scene ? simulate_scenes(values, watch) : simulate_drops(values, watch);

  std::vector<Column> results = empty_columns(spec);
  std::size_t next = 0;
  for (std::size_t k = 0; k < spec.quantities.size(); ++k) {
    if (is_swept(spec.quantities[k])) results[next++].values = std::move(values.values[k]);
  }
  const auto put = [&](const auto& value_of, double otherwise) {
    results[next++].values = collect(values.count, [&](std::size_t k) {
      return status[k] == batch::DropStatus::invalid ? otherwise : static_cast<double>(value_of(k));
    });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::size_t j : {0u, 1u, 2u}) put([&](std::size_t k) { return pose[3 * k + j]; }, nan);
  put([&](std::size_t k) { return measures[k].face; }, -1.0);
  put([&](std::size_t k) { return measures[k].rest_time; }, nan);
  put([&](std::size_t k) { return measures[k].last_contact; }, nan);
  put([&](std::size_t k) { return measures[k].impacts; }, -1.0);
  put([&](std::size_t k) { return measures[k].max_impulse; }, nan);
  put([&](std::size_t k) { return measures[k].energy_lost; }, nan);
  put([&](std::size_t k) { return measures[k].escape_time; }, nan);
  results[next].values = collect(values.count, [&](std::size_t k) { return static_cast<double>(status[k]); });
  for (Column& column : results) column.values.resize(slice.count);
  return results;
}

Path simulate_path(const Spec& spec, std::uint64_t instance, int every) {
  const SliceValues values(spec, {instance, 1});
  return spec.scene ? scene_path(values, every) : drop_path(values, every);
}

std::vector<Column> empty_columns(const Spec& spec) {
  std::vector<Column> columns;
  for (const Quantity& quantity : spec.quantities) {
    if (is_swept(quantity)) columns.push_back({quantity.name, quantity.unit, {}});
  }
  for (const auto& [name, unit] : {std::pair{"final_x", "m"}, {"final_y", "m"}, {"final_theta", "rad"}}) {
    columns.push_back({name, unit, {}});
  }
  columns.push_back({"face", "", {}, true});
  columns.push_back({"rest_time", "s", {}});
  columns.push_back({"last_contact", "s", {}});
  columns.push_back({"impacts", "", {}, true});
  columns.push_back({"max_impulse", "N s", {}});
  columns.push_back({"energy_lost", "J", {}});
  columns.push_back({"escape_time", "s", {}});
  columns.push_back({"status", "", {}, true});
  return columns;
}

}  // namespace tumble::sweep
