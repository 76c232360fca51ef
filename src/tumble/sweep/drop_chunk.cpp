#include "tumble/sweep/drop_chunk.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace tumble::sweep {
namespace {

constexpr std::array<const char*, 6> k_start_names = {"x", "y", "theta", "vx", "vy", "omega"};

// What the batch takes for a slice; of constants one value.
class Inputs {
 public:
  // At least two instances: an array of one value would hold for all drops, and be refused where a drop alone is
  // `invalid`.
  Inputs(const Spec& spec, const Slice& slice)
      : spec_(spec), count_(std::max(slice.count, std::size_t{2})), values_(spec.quantities.size()) {
    for (std::size_t k = 0; k < values_.size(); ++k) {
      values_[k].resize(is_swept(spec.quantities[k]) ? count_ : 1);
      fill_values(spec, k, slice.first, values_[k]);
    }
    q0_ = rows(0);
    v0_ = rows(3);
  }

  std::size_t count() const { return count_; }
  batch::DropStarts<double> starts() const { return {q0_, v0_}; }
  batch::DropParameters parameters() const {
    return {of("l"), of("m"), of("mu"), of("eps"), of("dt"), of("delta"), of("g"), spec_.columns};
  }

  std::vector<double>& at(std::size_t quantity) { return values_[quantity]; }

 private:
  const std::vector<double>& of(std::string_view name) const {
    const auto found = std::find_if(spec_.quantities.begin(), spec_.quantities.end(),
                                    [&](const Quantity& quantity) { return quantity.name == name; });
    return values_[static_cast<std::size_t>(found - spec_.quantities.begin())];
  }

  // count x 3.
  std::vector<double> rows(std::size_t first_name) const {
    std::vector<double> result(3 * count_);
    for (std::size_t j = 0; j < 3; ++j) {
      const std::vector<double>& column = of(k_start_names[first_name + j]);
      for (std::size_t k = 0; k < count_; ++k) result[3 * k + j] = column[column.size() == 1 ? 0 : k];
    }
    return result;
  }

  const Spec& spec_;
  std::size_t count_;
  std::vector<std::vector<double>> values_;
  std::vector<double> q0_, v0_;
};

std::vector<double> collect(std::size_t count, const auto& value_of) {
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k) values[k] = value_of(k);
  return values;
}

}  // namespace

std::vector<Column> simulate_slice(const Spec& spec, const Slice& slice, const std::function<void()>& watch) {
  Inputs inputs(spec, slice);
  const std::size_t count = inputs.count();
  batch::BatchSettings settings;
  settings.threads = 1;
  settings.measures = spec.measures;
  settings.watch = [&](std::size_t) { watch(); };
  std::vector<double> q(3 * count);
  std::vector<batch::DropStatus> status(count);
  std::vector<batch::DropMeasures> measures(count);
  batch::DropResults<double> wanted;
  wanted.q = q;
  wanted.status = status;
  wanted.measures = measures;
  batch::simulate_batch(inputs.starts(), inputs.parameters(), settings, wanted);

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

std::vector<double> simulate_path(const Spec& spec, std::uint64_t instance, int every) {
  const Inputs inputs(spec, {instance, 1});
  batch::BatchSettings settings;
  settings.threads = 1;
  settings.every = every;
  const std::size_t kept = batch::kept_columns(spec.columns, every);
  std::vector<double> q(3 * inputs.count() * kept);
  batch::DropResults<double> wanted;
  wanted.q = q;
  batch::simulate_batch(inputs.starts(), inputs.parameters(), settings, wanted);
  q.resize(kept);
  return q;
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
