#include "tumble/sweep/drop_chunk.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace tumble::sweep {
namespace {

constexpr std::array<const char*, 6> k_start_names = {"x", "y", "theta", "vx", "vy", "omega"};

// The values of a slice by the names of the quantities; of constants, one.
class Inputs {
 public:
  Inputs(const Spec& spec, const Slice& slice) : spec_(spec), values_(spec.quantities.size()) {
    for (std::size_t k = 0; k < values_.size(); ++k) {
      values_[k].resize(is_swept(spec.quantities[k]) ? slice.count : 1);
      fill_values(spec, k, slice.first, values_[k]);
    }
  }

  const std::vector<double>& of(std::string_view name) const {
    const auto found = std::find_if(spec_.quantities.begin(), spec_.quantities.end(),
                                    [&](const Quantity& quantity) { return quantity.name == name; });
    return values_[static_cast<std::size_t>(found - spec_.quantities.begin())];
  }

  // count x 3.
  std::vector<double> rows(std::size_t first_name, std::size_t count) const {
    std::vector<double> result(3 * count);
    for (std::size_t j = 0; j < 3; ++j) {
      const std::vector<double>& column = of(k_start_names[first_name + j]);
      for (std::size_t k = 0; k < count; ++k) result[3 * k + j] = column[column.size() == 1 ? 0 : k];
    }
    return result;
  }

  std::vector<double>& at(std::size_t quantity) { return values_[quantity]; }

 private:
  const Spec& spec_;
  std::vector<std::vector<double>> values_;
};

std::vector<double> collect(std::size_t count, const auto& value_of) {
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k) values[k] = value_of(k);
  return values;
}

}  // namespace

std::vector<Column> simulate_slice(const Spec& spec, const Slice& slice, const std::function<void()>& watch) {
  // At least two: an array of one value would hold for all drops, and be refused where a drop alone is `invalid`.
  const std::size_t count = std::max(slice.count, std::size_t{2});
  Inputs inputs(spec, {slice.first, count});
  const std::vector<double> q0 = inputs.rows(0, count);
  const std::vector<double> v0 = inputs.rows(3, count);
  const batch::DropParameters parameters = {inputs.of("l"),  inputs.of("m"),     inputs.of("mu"), inputs.of("eps"),
                                            inputs.of("dt"), inputs.of("delta"), inputs.of("g"),  spec.columns};
  batch::BatchSettings settings;
  settings.threads = 1;
  settings.measures = spec.measures;
  settings.watch = [&](std::size_t) { watch(); };
  std::vector<double> q(3 * count);
  std::vector<double> v(3 * count);
  std::vector<batch::DropStatus> status(count);
  std::vector<std::int32_t> columns(count);
  std::vector<batch::DropMeasures> measures(count);
  batch::simulate_batch<double>({q0, v0}, parameters, settings, {q, v, status, columns, measures});

  std::vector<Column> results = empty_columns(spec);
  std::size_t next = 0;
  for (std::size_t k = 0; k < spec.quantities.size(); ++k) {
    if (is_swept(spec.quantities[k])) results[next++].values = std::move(inputs.at(k));
  }
  const auto is_invalid = [&](std::size_t k) { return status[k] == batch::DropStatus::invalid; };
  const auto put = [&](const auto& value_of, double otherwise) {
    results[next++].values =
        collect(count, [&](std::size_t k) { return is_invalid(k) ? otherwise : static_cast<double>(value_of(k)); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::size_t j : {0u, 1u, 2u}) put([&](std::size_t k) { return q[3 * k + j]; }, nan);
  put([&](std::size_t k) { return measures[k].face; }, -1.0);
  put([&](std::size_t k) { return measures[k].rest_time; }, nan);
  put([&](std::size_t k) { return measures[k].last_contact; }, nan);
  put([&](std::size_t k) { return measures[k].impacts; }, -1.0);
  put([&](std::size_t k) { return measures[k].max_impulse; }, nan);
  put([&](std::size_t k) { return measures[k].energy_lost; }, nan);
  put([&](std::size_t k) { return measures[k].escape_time; }, nan);
  results[next].values = collect(count, [&](std::size_t k) { return static_cast<double>(status[k]); });
  for (Column& column : results) column.values.resize(slice.count);
  return results;
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
