#include "lcp_trace.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tumble/explain/lemke_pages.hpp"
#include "tumble/math/format.hpp"

namespace tumble::cli {
namespace {

using Index = std::size_t;

// Four digits, or as many of them as fit: tableaus of k_max_trace_size rows stay within 120 columns.
std::string number(double x) {
  if (std::abs(x) >= 1e4 && std::abs(x) < 9e6) return tumble::format("{:.0f}", x);
  std::string text;
  for (int digits = 4; digits > 0 && (text.empty() || text.size() > 8); --digits) {
    text = tumble::format("{:.{}g}", x == 0.0 ? 0.0 : x, digits);
  }
  return text;
}

// Header and rows, cell by cell.
std::vector<std::vector<std::string>> cells(const LemkePage& page, bool with_ratios) {
  const Index n = page.n();
  std::vector<std::vector<std::string>> rows(n + 1);
  rows[0] = {"basis"};
  for (const int variable : page.columns) rows[0].push_back(lemke_variable(variable, n));
  rows[0].push_back("value");
  if (with_ratios) rows[0].push_back("ratio");
  for (Index row = 0; row < n; ++row) {
    rows[row + 1] = {lemke_variable(page.basis[row], n)};
    for (Index column = 0; column < n + 2; ++column) rows[row + 1].push_back(number(page.entry(row, column)));
    if (with_ratios) rows[row + 1].push_back(page.ratios[row] ? number(*page.ratios[row]) : "-");
  }
  return rows;
}

std::string table_text(const std::vector<std::vector<std::string>>& rows, Index width) {
  std::string text;
  for (const std::vector<std::string>& row : rows) {
    text += tumble::format("  {:<5}", row.front());
    for (Index column = 1; column < row.size(); ++column) text += tumble::format("  {:>{}}", row[column], width);
    text += '\n';
  }
  return text;
}

std::string pivot_text(const LemkePage& before, const LemkePage& after, Index k) {
  const Index n = before.n();
  std::string text = tumble::format("\nPivot {}: {} enters", k, lemke_variable(*after.entered, n));
  const std::string leaving = lemke_variable(*after.left, n);
  if (k == 1) return text + tumble::format(", {} leaves: its value is the most negative.\n", leaving);
  const auto row =
      static_cast<Index>(std::find(before.basis.begin(), before.basis.end(), *after.left) - before.basis.begin());
  text += tumble::format(", the complement of {}. {} leaves", lemke_variable(*before.left, n), leaving);
  const std::optional<double> ratio = before.ratios[row];
  return text + (ratio ? tumble::format(": the smallest ratio, {}.\n", number(*ratio)) : ".\n");
}

}  // namespace

std::string trace_text(const LemkeTrace& trace, std::size_t n, const LemkeSettings& settings) {
  const auto [pages, end] = lemke_pages(trace, n, settings);
  if (end == LemkeEnd::no_pivot) return "q >= 0: z = 0 is a solution, no pivot is needed\n";
  Index width = 5;
  for (const LemkePage& page : pages) {
    for (const auto& row : cells(page, true)) {
      for (Index column = 1; column < row.size(); ++column) width = std::max(width, row[column].size());
    }
  }
  std::string text =
      "w - M z - d z0 = q. A row reads: basic variable + sum of entries times the variables above = value.\n"
      "Basic variables have unit columns, which are left out.\n\nStart: all w are basic.\n";
  text += table_text(cells(pages.front(), false), width);
  for (Index k = 1; k < pages.size(); ++k) {
    text += pivot_text(pages[k - 1], pages[k], k);
    text += table_text(cells(pages[k], pages[k].entering.has_value()), width);
  }
  if (end == LemkeEnd::solved)
    return text + "\nz0 has left: of each pair one variable is basic, and the values solve the problem.\n";
  if (end == LemkeEnd::stopped) return text + "\nStopped at the allowed number of pivots.\n";
  return text + tumble::format("\n{} enters, the complement of {}. No row limits it: a ray, and no solution found.\n",
                               lemke_variable(*pages.back().entering, n), lemke_variable(*pages.back().left, n));
}

}  // namespace tumble::cli
