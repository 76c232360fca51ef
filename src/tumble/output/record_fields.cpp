#include "tumble/output/record_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"

namespace tumble::output {
namespace {

using drop::Parameters;
using drop::Record;
using drop::StepRecord;

constexpr int k_format_version = 1;
constexpr int k_mode_count = 4;
constexpr int k_status_count = static_cast<int>(k_lcp_statuses.size());

struct ScalarField {
  const char* name;
  const char* unit;
  double Parameters::*member;
};

constexpr std::array<ScalarField, 7> k_scalars = {{{"l", "m", &Parameters::l},
                                                   {"m", "kg", &Parameters::m},
                                                   {"mu", "", &Parameters::mu},
                                                   {"eps", "", &Parameters::eps},
                                                   {"dt", "s", &Parameters::dt},
                                                   {"delta", "m", &Parameters::delta},
                                                   {"g", "m/s^2", &Parameters::g}}};

constexpr std::array<const char*, 6> k_step_fields = {"gap", "corner", "z", "mode", "status", "residual"};

// One value per column.
template <class Value, class Get>
std::vector<Value> collect(const Record& record, Get get) {
  std::vector<Value> values;
  values.reserve(record.steps.size());
  for (int k = 0; k < record.trajectory.columns; ++k) values.push_back(static_cast<Value>(get(k)));
  return values;
}

// ---- Reading ----

class Reader {
 public:
  Reader(const std::map<std::string, NumberArray>& fields, const std::string& name) : fields_(fields), name_(name) {}

  [[noreturn]] void refuse(std::string_view field, std::string_view why) const {
    throw std::invalid_argument(tumble::format("{}: {}: {}", name_, field, why));
  }

  bool has(const std::string& field) const { return fields_.contains(field); }

  const NumberArray& get(const std::string& field) const {
    const auto found = fields_.find(field);
    if (found == fields_.end())
      refuse(field, "is missing; a record of the drop has q, v, l, m, mu, eps, dt, delta and g");
    return found->second;
  }

  double scalar(const std::string& field) const {
    const NumberArray& array = get(field);
    if (array.values.size() != 1) refuse(field, tumble::format("must be one number, got {}", array.values.size()));
    return array.values[0];
  }

  // `columns` 0 takes any number of columns.
  const std::vector<double>& rows(const std::string& field, std::size_t rows, std::size_t columns) const {
    const NumberArray& array = get(field);
    std::vector<std::size_t> expected = {columns};
    if (rows > 1) expected.insert(expected.begin(), rows);
    if (columns == 0 && array.shape.size() == expected.size()) expected.back() = array.shape.back();
    if (array.shape != expected) {
      refuse(field, tumble::format("must have shape ({}), got ({})", tumble::join(expected, ", "),
                                   tumble::join(array.shape, ", ")));
    }
    return array.values;
  }

  int code(std::string_view field, double value, int count) const {
    if (!(value >= 0.0 && value < count && value == std::floor(value))) {
      refuse(field, tumble::format("must be a whole number in [0, {}], got {}", count - 1, value));
    }
    return static_cast<int>(value);
  }

 private:
  const std::map<std::string, NumberArray>& fields_;
  const std::string& name_;
};

Parameters read_parameters(const Reader& reader, const std::string& name, std::size_t columns) {
  Parameters parameters;
  for (const ScalarField& field : k_scalars) parameters.*field.member = reader.scalar(field.name);
  parameters.columns = static_cast<int>(columns);
  if (reader.has("columns")) {
    const double asked = reader.scalar("columns");
    parameters.columns = reader.code("columns", asked, drop::k_max_columns + 1);
    if (asked < static_cast<double>(columns)) {
      reader.refuse("columns", tumble::format("must be at least the {} columns of q, got {}", columns, asked));
    }
  }
  try {
    validate(parameters);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(tumble::format("{}: {}", name, error.what()));
  }
  return parameters;
}

void require_finite(const Reader& reader, const char* field, const std::vector<double>& values, std::size_t columns) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    reader.refuse(field,
                  tumble::format("must be finite, got {} in row {}, column {}", values[i], i / columns, i % columns));
  }
}

std::vector<StepRecord> read_steps(const Reader& reader, std::size_t columns) {
  const std::vector<double>& gap = reader.rows("gap", 1, columns);
  const std::vector<double>& corner = reader.rows("corner", 1, columns);
  const std::vector<double>& z = reader.rows("z", 4, columns);
  const std::vector<double>& mode = reader.rows("mode", 1, columns);
  const std::vector<double>& status = reader.rows("status", 1, columns);
  const std::vector<double>& residual = reader.rows("residual", 1, columns);
  std::vector<StepRecord> steps(columns);
  for (std::size_t k = 0; k < columns; ++k) {
    StepRecord& step = steps[k];
    step.gap = gap[k];
    step.corner = reader.code("corner", corner[k], 4);
    for (std::size_t i = 0; i < 4; ++i) step.z[i] = z[i * columns + k];
    step.mode = static_cast<ContactMode>(reader.code("mode", mode[k], k_mode_count));
    step.status = static_cast<LcpStatus>(reader.code("status", status[k], k_status_count));
    step.residual = residual[k];
    // The numbers of a failed step mean nothing and may be anything.
    if (step.status == LcpStatus::solved &&
        !(std::isfinite(step.gap) && all_finite(step.z) && std::isfinite(step.residual))) {
      reader.refuse("gap, z, residual", tumble::format("must be finite where the status is solved, column {}", k));
    }
  }
  return steps;
}

}  // namespace

void check_record(const Record& record) {
  const auto columns = static_cast<std::size_t>(record.trajectory.columns);
  validate(record.parameters);
  if (record.trajectory.columns < 1 || record.trajectory.columns > record.parameters.columns) {
    throw std::invalid_argument(
        tumble::format("record: trajectory.columns must be in [1, parameters.columns = {}], got {}",
                       record.parameters.columns, record.trajectory.columns));
  }
  if (record.trajectory.q.size() != 3 * columns || record.trajectory.v.size() != 3 * columns ||
      record.steps.size() != columns) {
    throw std::invalid_argument(
        tumble::format("record: q and v must have 3 x {} values and steps {}, got {}, {} and {}", columns, columns,
                       record.trajectory.q.size(), record.trajectory.v.size(), record.steps.size()));
  }
}

double kinetic_at(const Record& record, int column) {
  return kinetic_energy(record.trajectory.v_at(column), record.parameters);
}

double potential_at(const Record& record, int column) {
  return potential_energy(record.trajectory.q_at(column), record.parameters);
}

std::vector<Field> to_fields(const Record& record) {
  check_record(record);
  const auto& [parameters, trajectory, steps] = record;
  const auto T = static_cast<std::size_t>(trajectory.columns);
  using Codes = std::vector<std::int32_t>;
  const auto at = [&](int k) -> const StepRecord& { return record.steps[static_cast<std::size_t>(k)]; };

  std::vector<double> z(4 * T);
  for (std::size_t k = 0; k < T; ++k) {
    for (std::size_t i = 0; i < 4; ++i) z[i * T + k] = steps[k].z[i];
  }
  std::vector<Field> fields = {
      {"format_version", "", {}, Codes{k_format_version}},
      {"q", "m, m, rad", {3, T}, trajectory.q},
      {"v", "m/s, m/s, rad/s", {3, T}, trajectory.v},
      {"t", "s", {T}, collect<double>(record, [&](int k) { return k * record.parameters.dt; })},
      {"gap", "m", {T}, collect<double>(record, [&](int k) { return at(k).gap; })},
      {"corner", "", {T}, collect<std::int32_t>(record, [&](int k) { return at(k).corner; })},
      {"z", "N, N, N, m/s", {4, T}, std::move(z)},
      {"mode", "", {T}, collect<std::int32_t>(record, [&](int k) { return static_cast<int>(at(k).mode); })},
      {"status", "", {T}, collect<std::int32_t>(record, [&](int k) { return static_cast<int>(at(k).status); })},
      {"residual", "", {T}, collect<double>(record, [&](int k) { return at(k).residual; })},
      {"kinetic", "J", {T}, collect<double>(record, [&](int k) { return kinetic_at(record, k); })},
      {"potential", "J", {T}, collect<double>(record, [&](int k) { return potential_at(record, k); })},
      {"columns", "", {}, Codes{parameters.columns}},
      {"trajectory_status", "", {}, Codes{static_cast<int>(trajectory.status)}},
      {"mode_names", "", {k_mode_count}, names_of_codes<ContactMode>(k_mode_count)},
      {"status_names", "", {k_status_count}, names_of_codes<LcpStatus>(k_status_count)}};
  for (const ScalarField& scalar : k_scalars) {
    fields.push_back({scalar.name, scalar.unit, {}, std::vector<double>{parameters.*scalar.member}});
  }
  return fields;
}

std::vector<std::string> field_names_read() {
  std::vector<std::string> names = {"format_version", "q", "v", "columns", "trajectory_status"};
  for (const ScalarField& scalar : k_scalars) names.emplace_back(scalar.name);
  names.insert(names.end(), k_step_fields.begin(), k_step_fields.end());
  return names;
}

std::size_t max_values_read() { return 4 * static_cast<std::size_t>(drop::k_max_columns); }

Record from_fields(const std::map<std::string, NumberArray>& fields, const std::string& name) {
  const Reader reader(fields, name);
  if (reader.has("format_version") && reader.scalar("format_version") != k_format_version) {
    reader.refuse("format_version",
                  tumble::format("must be {}, got {}", k_format_version, reader.scalar("format_version")));
  }
  Record record;
  record.trajectory.q = reader.rows("q", 3, 0);
  const std::size_t columns = record.trajectory.q.size() / 3;
  if (columns < 1 || columns > drop::k_max_columns) {
    reader.refuse("q", tumble::format("must have 1 to {} columns, got {}", drop::k_max_columns, columns));
  }
  record.trajectory.v = reader.rows("v", 3, columns);
  require_finite(reader, "q", record.trajectory.q, columns);
  require_finite(reader, "v", record.trajectory.v, columns);
  record.trajectory.columns = static_cast<int>(columns);
  record.parameters = read_parameters(reader, name, columns);
  if (reader.has("trajectory_status")) {
    const int code = reader.code("trajectory_status", reader.scalar("trajectory_status"), k_status_count);
    record.trajectory.status = static_cast<LcpStatus>(code);
  }
  if (std::all_of(k_step_fields.begin(), k_step_fields.end(), [&](const char* field) { return reader.has(field); })) {
    record.steps = read_steps(reader, columns);
    return record;
  }
  record.steps.reserve(columns);
  for (int k = 0; k < record.trajectory.columns; ++k) {
    const Vector3 q = record.trajectory.q_at(k);
    record.steps.push_back(step_with_record(q, record.trajectory.v_at(k), record.parameters).record);
  }
  return record;
}

}  // namespace tumble::output
