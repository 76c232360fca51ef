#include <algorithm>
#include <array>

#include "tumble/sweep/models.hpp"

namespace tumble::sweep {
namespace {

constexpr std::array<const char*, 6> k_start_names = {"x", "y", "theta", "vx", "vy", "omega"};

// What the batch takes.
class Inputs {
 public:
  explicit Inputs(const SliceValues& values) : values_(values), q0_(rows(0)), v0_(rows(3)) {}

  batch::DropStarts<double> starts() const { return {q0_, v0_}; }
  batch::DropParameters parameters() const {
    return {of("l"), of("m"), of("mu"), of("eps"), of("dt"), of("delta"), of("g"), values_.spec.columns};
  }

 private:
  const std::vector<double>& of(std::string_view name) const {
    const auto found = std::find_if(values_.spec.quantities.begin(), values_.spec.quantities.end(),
                                    [&](const Quantity& quantity) { return quantity.name == name; });
    return values_.values[static_cast<std::size_t>(found - values_.spec.quantities.begin())];
  }

  // count x 3.
  std::vector<double> rows(std::size_t first_name) const {
    std::vector<double> result(3 * values_.count);
    for (std::size_t j = 0; j < 3; ++j) {
      const std::vector<double>& column = of(k_start_names[first_name + j]);
      for (std::size_t k = 0; k < values_.count; ++k) result[3 * k + j] = column[column.size() == 1 ? 0 : k];
    }
    return result;
  }

  const SliceValues& values_;
  std::vector<double> q0_, v0_;
};

}  // namespace

Rows simulate_drops(const SliceValues& values, const std::function<void()>& watch) {
  const Inputs inputs(values);
  batch::BatchSettings settings;
  settings.threads = 1;
  settings.measures = values.spec.measures;
  settings.watch = [&](std::size_t) { watch(); };
  Rows rows{std::vector<double>(3 * values.count), std::vector<batch::DropStatus>(values.count),
            std::vector<batch::DropMeasures>(values.count)};
  batch::DropResults<double> wanted;
  wanted.q = rows.pose;
  wanted.status = rows.status;
  wanted.measures = rows.measures;
  batch::simulate_batch(inputs.starts(), inputs.parameters(), settings, wanted);
  return rows;
}

Path drop_path(const SliceValues& values, int every) {
  const Inputs inputs(values);
  batch::BatchSettings settings;
  settings.threads = 1;
  settings.every = every;
  const std::size_t kept = batch::kept_columns(values.spec.columns, every);
  std::vector<double> q(3 * values.count * kept);
  batch::DropResults<double> wanted;
  wanted.q = q;
  batch::simulate_batch(inputs.starts(), inputs.parameters(), settings, wanted);
  q.resize(kept);
  std::vector<double> time(kept);
  const double step = batch::parameters_at(inputs.parameters(), 0).dt;
  for (std::size_t k = 0; k < kept; ++k) time[k] = static_cast<double>(k) * every * step;
  return {time, q};
}

}  // namespace tumble::sweep
