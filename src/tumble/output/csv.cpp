#include "tumble/output/csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "tumble/math/numeric.hpp"
#include "tumble/output/record_fields.hpp"

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
constexpr std::size_t k_row_fields = 19;
constexpr std::size_t k_min_row_bytes = 2 * k_row_fields;  // one character and one separator each

constexpr std::array<ContactMode, 4> k_modes = {ContactMode::open, ContactMode::stick, ContactMode::slip_left,
                                                ContactMode::slip_right};

// The word for a message: short, and without bytes that a terminal would act on.
std::string quoted(std::string_view word) {
  std::string shown;
  for (const char c : word.substr(0, 30)) shown += (c > 31 && c < 127) ? c : '?';
  return fmt::format("'{}{}'", shown, word.size() > 30 ? "..." : "");
}

template <class Enum, std::size_t n>
std::string names_of(const std::array<Enum, n>& values) {
  std::string names;
  for (const Enum value : values) names += (names.empty() ? "" : ", ") + std::string(to_string(value));
  return names;
}

// Hands out the text line by line and refuses with the place.
class LineReader {
 public:
  LineReader(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  // The next line without its end; a line without an end was cut off.
  std::string_view next(std::string_view expected) {
    ++line_;
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) {
      refuse(rest_.size() + 1, fmt::format("the file ends here, expected {} and an end of line", expected));
    }
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  std::string_view rest() const { return rest_; }

  // Column from 1, in bytes.
  [[noreturn]] void refuse(std::size_t column, std::string_view why) const {
    throw std::invalid_argument(fmt::format("{}:{}:{}: {}", name_, line_, column, why));
  }

 private:
  std::string_view rest_;
  const std::string& name_;
  std::size_t line_ = 0;
};

std::optional<int> parse_count(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

// ---- Header ----

// The text between "# name = " and the unit.
std::string_view header_value(LineReader& lines, std::string_view name, std::string_view unit, std::size_t& column) {
  const std::string before = fmt::format("# {} = ", name);
  const std::string after = unit.empty() ? "" : fmt::format(" {}", unit);
  const std::string expected = fmt::format("'{}VALUE{}'", before, after);
  std::string_view line = lines.next(expected);
  if (!line.starts_with(before) || !line.substr(before.size()).ends_with(after)) {
    lines.refuse(1, fmt::format("expected {}, got {}", expected, quoted(line)));
  }
  column = before.size() + 1;
  line.remove_prefix(before.size());
  line.remove_suffix(after.size());
  return line;
}

double header_number(LineReader& lines, std::string_view name, std::string_view unit) {
  std::size_t column = 1;
  const std::string_view text = header_value(lines, name, unit, column);
  const std::optional<double> value = parse_number(text);
  if (!value) lines.refuse(column, fmt::format("{}: expected a number, got {}", name, quoted(text)));
  return *value;
}

int header_count(LineReader& lines, std::string_view name) {
  std::size_t column = 1;
  const std::string_view text = header_value(lines, name, "", column);
  const std::optional<int> value = parse_count(text);
  if (!value || *value < 1 || *value > drop::k_max_columns) {
    lines.refuse(column,
                 fmt::format("{}: must be a whole number in [1, {}], got {}", name, drop::k_max_columns, quoted(text)));
  }
  return *value;
}

Parameters parse_parameters(LineReader& lines) {
  Parameters parameters;
  const auto read = [&](double& value, std::string_view name, std::string_view unit) {
    value = header_number(lines, name, unit);
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
  parameters.columns = header_count(lines, "columns");
  return parameters;
}

// ---- Rows ----

// The cells of one line, each refused by its name and place.
class Row {
 public:
  Row(const LineReader& lines, std::string_view line)
      : lines_(lines), names_(k_names), rest_(line), line_bytes_(line.size()) {
    const auto fields = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
    if (fields != k_row_fields) lines.refuse(1, fmt::format("expected {} columns, got {}", k_row_fields, fields));
  }

  struct Cell {
    std::string_view name;
    std::string_view text;
    std::size_t column;
  };

  // At most k_row_fields times.
  Cell next() {
    const std::size_t column = line_bytes_ - rest_.size() + 1;
    const std::string_view name = cut(names_);
    return {name.substr(0, name.find(' ')), cut(rest_), column};
  }

  // Non-finite only if `any` is true.
  double number(bool any = false) {
    const Cell cell = next();
    const std::optional<double> value = parse_number(cell.text);
    if (!value) refuse(cell, "expected a number");
    if (!any && !std::isfinite(*value)) refuse(cell, "must be finite");
    return *value;
  }

  int count(int low, int high) {
    const Cell cell = next();
    const std::optional<int> value = parse_count(cell.text);
    if (!value || *value < low || *value > high) {
      refuse(cell, low == high ? fmt::format("must be {}", low)
                               : fmt::format("must be a whole number in [{}, {}]", low, high));
    }
    return *value;
  }

  template <class Enum, std::size_t n>
  Enum word(const std::array<Enum, n>& values) {
    const Cell cell = next();
    for (const Enum value : values) {
      if (cell.text == to_string(value)) return value;
    }
    refuse(cell, fmt::format("must be one of {}", names_of(values)));
  }

  [[noreturn]] void refuse(const Cell& cell, std::string_view why) const {
    lines_.refuse(cell.column, fmt::format("{}: {}, got {}", cell.name, why, quoted(cell.text)));
  }

 private:
  static std::string_view cut(std::string_view& rest) {
    const std::string_view text = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(text.size() + 1, rest.size()));
    return text;
  }

  const LineReader& lines_;
  std::string_view names_;
  std::string_view rest_;
  std::size_t line_bytes_;
};

void parse_row(Row row, int k, Record& record) {
  const auto columns = static_cast<std::size_t>(record.trajectory.columns);
  const auto at = static_cast<std::size_t>(k);
  row.count(k, k);
  const Row::Cell time = row.next();
  const std::optional<double> t = parse_number(time.text);
  const double expected = k * record.parameters.dt;
  constexpr double k_time_tolerance = 1e-9;  // of a step per step: t of another program may be a sum of dt
  if (!t || !(std::abs(*t - expected) <= k_time_tolerance * expected)) {
    row.refuse(time, fmt::format("must be k dt = {}", expected));
  }
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
  step.corner = row.count(0, 3);
  for (double& value : step.z) value = row.number(has_failed);
  step.mode = row.word(k_modes);
  row.next();
  step.residual = row.number(has_failed);
  row.number(true);  // the energies follow from q and v, and may overflow where these do not
  row.number(true);
}

}  // namespace

std::string csv_header(const Record& record) {
  check_record(record);
  const Parameters& p = record.parameters;
  return fmt::format(
      "{}\n# l = {} m\n# m = {} kg\n# mu = {}\n# eps = {}\n# dt = {} s\n# delta = {} m\n# g = {} m/s^2\n"
      "# columns = {}\n# rows = {}\n# status = {}\n{}\n",
      k_first_line, to_text(p.l), to_text(p.m), to_text(p.mu), to_text(p.eps), to_text(p.dt), to_text(p.delta),
      to_text(p.g), p.columns, record.trajectory.columns, to_string(record.trajectory.status), k_names);
}

std::string csv_rows(const Record& record, int first, int last) {
  std::string text;
  for (int k = first; k < last; ++k) {
    const StepRecord& step = record.steps[static_cast<std::size_t>(k)];
    text += fmt::format("{},{}", k, to_text(k * record.parameters.dt));
    const auto add = [&](double value) { text.append(",").append(to_text(value)); };
    for (const double value : record.trajectory.q_at(k)) add(value);
    for (const double value : record.trajectory.v_at(k)) add(value);
    add(step.gap);
    text += fmt::format(",{}", step.corner);
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
  const std::string_view first = lines.next(fmt::format("'{}'", k_first_line));
  if (first != k_first_line) lines.refuse(1, fmt::format("expected '{}', got {}", k_first_line, quoted(first)));
  Record record;
  record.parameters = parse_parameters(lines);
  const int rows = header_count(lines, "rows");
  if (rows > record.parameters.columns) {
    lines.refuse(1, fmt::format("rows: must be at most columns = {}, got {}", record.parameters.columns, rows));
  }
  const auto columns = static_cast<std::size_t>(rows);
  // Before anything is allocated: the text must be long enough for so many rows.
  if (lines.rest().size() / k_min_row_bytes < columns) {
    lines.refuse(1,
                 fmt::format("rows: {} rows are announced, but the file is too short for them: was it cut off?", rows));
  }
  record.trajectory.columns = rows;
  record.trajectory.q.resize(3 * columns);
  record.trajectory.v.resize(3 * columns);
  record.steps.resize(columns);

  std::size_t at = 1;
  const std::string_view status = header_value(lines, "status", "", at);
  bool is_known = false;
  for (const LcpStatus value : k_lcp_statuses) {
    if (status != to_string(value)) continue;
    record.trajectory.status = value;
    is_known = true;
  }
  if (!is_known)
    lines.refuse(at, fmt::format("status: must be one of {}, got {}", names_of(k_lcp_statuses), quoted(status)));
  const std::string_view names = lines.next("the line of column names");
  if (names != k_names) lines.refuse(1, fmt::format("expected the column names '{}', got {}", k_names, quoted(names)));

  for (int k = 0; k < rows; ++k) {
    parse_row(Row(lines, lines.next(fmt::format("row {} of {}", k + 1, rows))), k, record);
  }
  if (!lines.rest().empty()) {
    lines.next("nothing");
    lines.refuse(1, fmt::format("expected the end of the file after {} rows", rows));
  }
  return record;
}

}  // namespace tumble::output
