#include "tumble/output/csv_reader.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"

namespace tumble::output {
namespace {

// Where the cell ends that starts at `at`: at a comma or at the end of the line; npos if its quotes are broken.
std::size_t end_of_cell(std::string_view line, std::size_t at) {
  if (at == line.size() || line[at] != '"') return std::min(line.find(',', at), line.size());
  for (;;) {
    at = line.find('"', at + 1);
    if (at == std::string_view::npos) return at;
    if (++at == line.size() || line[at] == ',') return at;
    if (line[at] != '"') return std::string_view::npos;
  }
}

// The cell there, with its quotes; if these are broken, all the rest.
std::string_view cell_at(std::string_view line, std::size_t at) {
  return line.substr(at, std::min(end_of_cell(line, at), line.size()) - at);
}

}  // namespace

std::string quoted(std::string_view word) {
  std::string shown;
  for (const char c : word.substr(0, 30)) shown += (c > 31 && c < 127) ? c : '?';
  return tumble::format("'{}{}'", shown, word.size() > 30 ? "..." : "");
}

std::string_view LineReader::next(std::string_view expected) {
  ++line_;
  const std::size_t end = rest_.find('\n');
  if (end == std::string_view::npos) {
    refuse(rest_.size() + 1, tumble::format("the file ends here, expected {} and an end of line", expected));
  }
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

void LineReader::expect(std::string_view line) {
  const std::string_view got = next(tumble::format("'{}'", line));
  if (got != line) refuse(1, tumble::format("expected '{}', got {}", line, quoted(got)));
}

void LineReader::expect_columns(std::string_view line) {
  const std::string_view got = next("the line of column names");
  if (got == line) return;
  std::size_t at = 0, at_got = 0;
  for (std::size_t column = 1;; ++column) {
    const bool is_over = at > line.size(), is_got_over = at_got > got.size();
    const std::string_view name = is_over ? "" : cell_at(line, at), name_got = is_got_over ? "" : cell_at(got, at_got);
    if (is_over || is_got_over || name != name_got) {
      refuse(std::min(at_got, got.size()) + 1, tumble::format("column {}: expected {}, got {}", column,
                                                              is_over ? "no more" : tumble::format("'{}'", name),
                                                              is_got_over ? "no more" : quoted(name_got)));
    }
    at += name.size() + 1;
    at_got += name_got.size() + 1;
  }
}

void LineReader::expect_end(std::size_t rows) {
  if (rest_.empty()) return;
  next("nothing");
  refuse(1, tumble::format("expected the end of the file after {} rows", rows));
}

void LineReader::check_room(std::string_view field, std::size_t rows, std::size_t columns) const {
  const std::size_t min_row_bytes = 2 * columns;  // one character and one separator each
  if (rest_.size() / min_row_bytes >= rows) return;
  refuse(1,
         tumble::format("{}: {} rows are announced, but the file is too short for them: was it cut off?", field, rows));
}

// The text between "# name = " and the unit.
std::string_view LineReader::value(std::string_view name, std::string_view unit, std::size_t& column) {
  const std::string before = tumble::format("# {} = ", name);
  const std::string after = unit.empty() ? "" : tumble::format(" {}", unit);
  const std::string expected = tumble::format("'{}VALUE{}'", before, after);
  std::string_view line = next(expected);
  if (!line.starts_with(before) || !line.substr(before.size()).ends_with(after)) {
    refuse(1, tumble::format("expected {}, got {}", expected, quoted(line)));
  }
  column = before.size() + 1;
  line.remove_prefix(before.size());
  line.remove_suffix(after.size());
  return line;
}

double LineReader::number(std::string_view name, std::string_view unit) {
  std::size_t column = 1;
  const std::string_view text = value(name, unit, column);
  if (const std::optional<double> number = parse_number(text)) return *number;
  refuse(column, tumble::format("{}: expected a number, got {}", name, quoted(text)));
}

bool LineReader::yes_or_no(std::string_view name) {
  std::size_t column = 1;
  const std::string_view text = value(name, "", column);
  if (text == "yes" || text == "no") return text == "yes";
  refuse(column, tumble::format("{}: must be one of yes, no, got {}", name, quoted(text)));
}

void LineReader::refuse(std::size_t column, std::string_view why) const {
  throw std::invalid_argument(tumble::format("{}:{}:{}: {}", name_, line_, column, why));
}

std::vector<std::string> column_names(std::string_view line) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at <= line.size();) {
    const std::string_view cell = cell_at(line, at);
    const std::string name = unquoted(cell);
    names.push_back(name.ends_with(']') ? name.substr(0, name.rfind(" [")) : name);
    at += cell.size() + 1;
  }
  return names;
}

Row::Row(const LineReader& lines, const std::vector<std::string>& names, std::string_view line)
    : lines_(lines), names_(names), line_(line) {
  std::size_t cells = 0;
  for (std::size_t at = 0; at <= line.size(); ++cells) {
    const std::size_t end = end_of_cell(line, at);
    if (end == std::string_view::npos) lines.refuse(at + 1, "a cell starts with a quote and does not end with one");
    at = end + 1;
  }
  if (cells != names.size()) lines.refuse(1, tumble::format("expected {} columns, got {}", names.size(), cells));
}

Row::Cell Row::next() {
  const std::size_t start = at_, end = end_of_cell(line_, at_);
  at_ = end + 1;
  return {names_[index_++], line_.substr(start, end - start), start + 1};
}

double Row::number(bool any) {
  const Cell cell = next();
  const std::optional<double> value = parse_number(cell.text);
  if (!value) refuse(cell, "expected a number");
  if (!any && !std::isfinite(*value)) refuse(cell, "must be finite");
  return *value;
}

void Row::time(double expected, std::string_view formula) {
  constexpr double k_tolerance = 1e-9;  // of the time
  const Cell cell = next();
  const std::optional<double> t = parse_number(cell.text);
  if (!t || !(std::abs(*t - expected) <= k_tolerance * expected)) {
    refuse(cell, tumble::format("must be {} = {}", formula, expected));
  }
}

void Row::refuse(const Cell& cell, std::string_view why) const {
  lines_.refuse(cell.column, tumble::format("{}: {}, got {}", cell.name, why, quoted(cell.text)));
}

std::string unquoted(std::string_view cell) {
  if (!cell.starts_with('"')) return std::string(cell);
  std::string text;
  for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
    text += cell[i];
    if (cell[i] == '"') ++i;
  }
  return text;
}

}  // namespace tumble::output
