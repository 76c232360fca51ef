#include "tumble/output/csv.hpp"

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"
#include "tumble/output/csv_reader.hpp"
#include "tumble/output/record_fields.hpp"
#include "tumble/output/trajectory_fields.hpp"

namespace tumble::output {
namespace {

using drop::Parameters;
using drop::Record;
using drop::StepRecord;

constexpr std::string_view k_first_line = "# tumble drop 1";
constexpr std::string_view k_names =
    "k,t [s],x [m],y [m],theta [rad],vx [m/s],vy [m/s],omega [rad/s],gap [m],corner,f_n [N],f_t1 [N],f_t2 "
    "[N],"
    "lambda [m/s],mode,status,residual,kinetic [J],potential [J]";

Parameters parse_parameters(LineReader& lines) {
  Parameters parameters;
  const auto read = [&](double& value, std::string_view name, std::string_view unit) {
    value = lines.number(name, unit);
    try {
      validate(parameters);  // the other values are defaults or read already: the fault is in this line
    } catch (const std::invalid_argument& error) {
      lines.refuse(1, error.what());
    }
  };
  read(parameters.l, "l", "m");
  read(parameters.m, "m", "kg");
  read(parameters.mu, "mu", "");
  read(parameters.eps, "eps", "");
  read(parameters.dt, "dt", "s");
  read(parameters.delta, "delta", "m");
  read(parameters.g, "g", "m/s^2");
  parameters.columns = lines.whole("columns", 1, drop::k_max_columns);
  return parameters;
}

void parse_row(Row row, int k, Record& record) {
  const auto columns = static_cast<std::size_t>(record.trajectory.columns);
  const auto at = static_cast<std::size_t>(k);
  row.whole(k, k);
  row.time(k * record.parameters.dt, "k dt");
  for (std::size_t i = 0; i < 3; ++i) record.trajectory.q[i * columns + at] = row.number();
  for (std::size_t i = 0; i < 3; ++i) record.trajectory.v[i * columns + at] = row.number();

  // The status stands behind the numbers it vouches for; those of a failed step mean nothing and may be
  // anything.
  StepRecord& step = record.steps[at];
  Row ahead = row;
  for (int skipped = 0; skipped < 7; ++skipped) ahead.next();
  step.status = ahead.word(k_lcp_statuses);
  const bool has_failed = step.status != LcpStatus::solved;
  step.gap = row.number(has_failed);
  step.corner = row.whole(0, 3);
  for (double& value : step.z) value = row.number(has_failed);
  step.mode = row.word(k_contact_modes);
  row.next();
  step.residual = row.number(has_failed);
  row.number(true);  // the energies follow from q and v, and may overflow where these do not
  row.number(true);
}

}  // namespace

std::string csv_header(const Record& record) {
  check_record(record);
  const Parameters& p = record.parameters;
  return tumble::format(
      "{}\n# l = {} m\n# m = {} kg\n# mu = {}\n# eps = {}\n# dt = {} s\n# delta = {} m\n# g = {} m/s^2\n"
      "# columns = {}\n# rows = {}\n# status = {}\n{}\n",
      k_first_line, to_text(p.l), to_text(p.m), to_text(p.mu), to_text(p.eps), to_text(p.dt), to_text(p.delta),
      to_text(p.g), p.columns, record.trajectory.columns, to_string(record.trajectory.status), k_names);
}

std::string csv_rows(const Record& record, int first, int last) {
  std::string text;
  for (int k = first; k < last; ++k) {
    const StepRecord& step = record.steps[static_cast<std::size_t>(k)];
    text += tumble::format("{},{}", k, to_text(k * record.parameters.dt));
    const auto add = [&](double value) { text.append(",").append(to_text(value)); };
    for (const double value : record.trajectory.q_at(k)) add(value);
    for (const double value : record.trajectory.v_at(k)) add(value);
    add(step.gap);
    text += tumble::format(",{}", step.corner);
    for (const double value : step.z) add(value);
    text.append(",").append(to_string(step.mode)).append(",").append(to_string(step.status));
    add(step.residual);
    add(kinetic_at(record, k));
    add(potential_at(record, k));
    text += '\n';
  }
  return text;
}

std::string to_csv(const Record& record) {
  std::string text = csv_header(record);  // first: it checks the record
  text += csv_rows(record, 0, record.trajectory.columns);
  return text;
}

Record parse_record_csv(std::string_view text, const std::string& name) {
  LineReader lines(text, name);
  lines.expect(k_first_line);
  Record record;
  record.parameters = parse_parameters(lines);
  const int rows = lines.whole("rows", 1, drop::k_max_columns);
  if (rows > record.parameters.columns) {
    lines.refuse(1, tumble::format("rows: must be at most columns = {}, got {}", record.parameters.columns, rows));
  }
  const std::vector<std::string> names = column_names(k_names);
  const auto columns = static_cast<std::size_t>(rows);
  lines.check_room("rows", columns, names.size());
  record.trajectory.columns = rows;
  record.trajectory.q.resize(3 * columns);
  record.trajectory.v.resize(3 * columns);
  record.steps.resize(columns);
  record.trajectory.status = lines.word("status", k_lcp_statuses);
  lines.expect(k_names);
  for (int k = 0; k < rows; ++k) {
    parse_row(Row(lines, names, lines.next(tumble::format("row {} of {}", k + 1, rows))), k, record);
  }
  lines.expect_end(columns);
  return record;
}

}  // namespace tumble::output
