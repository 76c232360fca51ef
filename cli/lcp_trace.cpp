#include "lcp_trace.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include <fmt/format.h>

namespace tumble::cli {
namespace {

using Index = std::size_t;

// One tableau, with the columns of basic variables left out, and the variable that enters next.
class Page {
 public:
  Page(Index n, const std::vector<int>& basis, const std::vector<double>& tableau, std::optional<int> entering)
      : n_(n), basis_(basis) {
    for (int variable = 0; variable <= static_cast<int>(2 * n); ++variable) {
      if (std::find(basis.begin(), basis.end(), variable) != basis.end()) continue;
      columns_.push_back(variable);
      if (variable == entering) entering_ = columns_.size() - 1;
    }
    for (Index row = 0; row < n; ++row) {
      for (const int variable : columns_) entries_.push_back(tableau[row * (2 * n + 2) + static_cast<Index>(variable)]);
      entries_.push_back(tableau[row * (2 * n + 2) + 2 * n + 1]);
    }
    show_round_off_as_zero();
  }

  std::string name(int variable) const {
    const int n = static_cast<int>(n_);
    return variable < n ? fmt::format("w{}", variable + 1)
                        : fmt::format("z{}", variable < 2 * n ? variable - n + 1 : 0);
  }

  // How far the entering variable can grow until the basic one of this row is 0.
  std::optional<double> ratio(Index row) const {
    if (!entering_ || !(entry(row, *entering_) > 0.0)) return std::nullopt;
    return std::max(entry(row, n_ + 1), 0.0) / entry(row, *entering_);
  }

  std::optional<double> ratio_of(int variable) const {
    return ratio(static_cast<Index>(std::find(basis_.begin(), basis_.end(), variable) - basis_.begin()));
  }

  // Header and rows, cell by cell.
  std::vector<std::vector<std::string>> cells(bool with_ratios) const {
    std::vector<std::vector<std::string>> rows(n_ + 1);
    rows[0] = {"basis"};
    for (const int variable : columns_) rows[0].push_back(name(variable));
    rows[0].push_back("value");
    if (with_ratios) rows[0].push_back("ratio");
    for (Index row = 0; row < n_; ++row) {
      rows[row + 1] = {name(basis_[row])};
      for (Index column = 0; column < n_ + 2; ++column) rows[row + 1].push_back(number(entry(row, column)));
      if (with_ratios) rows[row + 1].push_back(ratio(row) ? number(*ratio(row)) : "-");
    }
    return rows;
  }

  // Four digits, or as many of them as fit: tableaus of k_max_trace_size rows stay within 120 columns.
  static std::string number(double x) {
    if (std::abs(x) >= 1e4 && std::abs(x) < 9e6) return fmt::format("{:.0f}", x);
    std::string text;
    for (int digits = 4; digits > 0 && (text.empty() || text.size() > 8); --digits) {
      text = fmt::format("{:.{}g}", x == 0.0 ? 0.0 : x, digits);
    }
    return text;
  }

 private:
  double entry(Index row, Index column) const { return entries_[row * (n_ + 2) + column]; }

  // What is left of a sum that vanishes would draw the eye: beside the largest of its row and of its column it is
  // nothing.
  void show_round_off_as_zero() {
    constexpr double round_off = 1e-13;
    std::vector<double> of_row(n_, 0.0), of_column(n_ + 2, 0.0);
    for (Index i = 0; i < entries_.size(); ++i) {
      of_row[i / (n_ + 2)] = std::max(of_row[i / (n_ + 2)], std::abs(entries_[i]));
      of_column[i % (n_ + 2)] = std::max(of_column[i % (n_ + 2)], std::abs(entries_[i]));
    }
    for (Index i = 0; i < entries_.size(); ++i) {
      if (std::abs(entries_[i]) <= round_off * std::min(of_row[i / (n_ + 2)], of_column[i % (n_ + 2)])) {
        entries_[i] = 0.0;
      }
    }
  }

  Index n_;
  std::vector<int> basis_;
  std::vector<int> columns_;       // the nonbasic variables, n + 1
  std::optional<Index> entering_;  // its place among them
  std::vector<double> entries_;    // n x (n + 2): columns_, value
};

std::string table_text(const std::vector<std::vector<std::string>>& rows, Index width) {
  std::string text;
  for (const std::vector<std::string>& row : rows) {
    text += fmt::format("  {:<5}", row.front());
    for (Index column = 1; column < row.size(); ++column) text += fmt::format("  {:>{}}", row[column], width);
    text += '\n';
  }
  return text;
}

}  // namespace

std::string trace_text(const LemkeTrace& trace, std::size_t n, const LemkeSettings& settings) {
  const int num_variables = static_cast<int>(n), z0 = 2 * num_variables;
  const auto complement = [&](int variable) {
    return variable < num_variables ? variable + num_variables : variable - num_variables;
  };
  const Index num_pivots = trace.pivots.size();
  if (num_pivots == 0) return "q >= 0: z = 0 is a solution, no pivot is needed\n";
  const bool is_finished = trace.pivots.back().leaving == z0;
  const bool is_stopped =
      static_cast<int>(num_pivots) == settings.max_pivots || trace.result.status == LcpStatus::iteration_limit;

  std::vector<int> all_w(n);
  std::iota(all_w.begin(), all_w.end(), 0);
  std::vector<Page> pages = {Page(n, all_w, trace.start, std::nullopt)};
  for (Index k = 0; k < num_pivots; ++k) {
    const LemkePivot& pivot = trace.pivots[k];
    const bool is_last = k + 1 == num_pivots;
    std::optional<int> entering;
    if (!is_last || (!is_finished && !is_stopped)) entering = complement(pivot.leaving);
    pages.emplace_back(n, pivot.basis, pivot.tableau, entering);
  }
  Index width = 5;
  for (const Page& page : pages) {
    for (const auto& row : page.cells(true)) {
      for (Index column = 1; column < row.size(); ++column) width = std::max(width, row[column].size());
    }
  }

  std::string text =
      "w - M z - d z0 = q. A row reads: basic variable + sum of entries times the variables above = value.\n"
      "Basic variables have unit columns, which are left out.\n\nStart: all w are basic.\n";
  text += table_text(pages.front().cells(false), width);
  for (Index k = 0; k < num_pivots; ++k) {
    const auto& [entering, leaving, basis, tableau] = trace.pivots[k];
    const Page& before = pages[k];
    text += fmt::format("\nPivot {}: {} enters", k + 1, before.name(entering));
    if (k == 0) {
      text += fmt::format(", {} leaves: its value is the most negative.\n", before.name(leaving));
    } else {
      text += fmt::format(", the complement of {}. {} leaves", before.name(trace.pivots[k - 1].leaving),
                          before.name(leaving));
      const auto ratio = before.ratio_of(leaving);
      text += ratio ? fmt::format(": the smallest ratio, {}.\n", Page::number(*ratio)) : ".\n";
    }
    const bool is_last = k + 1 == num_pivots;
    text += table_text(pages[k + 1].cells(!is_last || (!is_finished && !is_stopped)), width);
  }
  const Page& last = pages.back();
  if (is_finished)
    return text + "\nz0 has left: of each pair one variable is basic, and the values solve the problem.\n";
  if (is_stopped) return text + "\nStopped at the allowed number of pivots.\n";
  return text + fmt::format("\n{} enters, the complement of {}. No row limits it: a ray, and no solution found.\n",
                            last.name(complement(trace.pivots.back().leaving)), last.name(trace.pivots.back().leaving));
}

}  // namespace tumble::cli
