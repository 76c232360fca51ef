#include "tumble/explain/lemke_pages.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tumble/math/format.hpp"

namespace tumble {
namespace {

using Index = std::size_t;

// What is left of a sum that vanishes would draw the eye: beside the largest of its row and of its column it is
// nothing.
void show_round_off_as_zero(LemkePage& page) {
  constexpr double round_off = 1e-13;
  const Index width = page.n() + 2;
  std::vector<double> of_row(page.n(), 0.0), of_column(width, 0.0);
  for (Index i = 0; i < page.entries.size(); ++i) {
    of_row[i / width] = std::max(of_row[i / width], std::abs(page.entries[i]));
    of_column[i % width] = std::max(of_column[i % width], std::abs(page.entries[i]));
  }
  for (Index i = 0; i < page.entries.size(); ++i) {
    if (std::abs(page.entries[i]) <= round_off * std::min(of_row[i / width], of_column[i % width]))
      page.entries[i] = 0.0;
  }
}

LemkePage page_of(Index n, const std::vector<int>& basis, const std::vector<double>& tableau,
                  std::optional<int> entering) {
  LemkePage page;
  page.basis = basis;
  page.entering = entering;
  for (int variable = 0; variable <= static_cast<int>(2 * n); ++variable) {
    if (std::find(basis.begin(), basis.end(), variable) == basis.end()) page.columns.push_back(variable);
  }
  for (Index row = 0; row < n; ++row) {
    for (const int variable : page.columns)
      page.entries.push_back(tableau[row * (2 * n + 2) + static_cast<Index>(variable)]);
    page.entries.push_back(tableau[row * (2 * n + 2) + 2 * n + 1]);
  }
  show_round_off_as_zero(page);
  page.ratios.resize(n);
  if (!entering) return page;
  const auto column =
      static_cast<Index>(std::find(page.columns.begin(), page.columns.end(), *entering) - page.columns.begin());
  for (Index row = 0; row < n; ++row) {
    const double entry = page.entry(row, column);
    if (entry > 0.0) page.ratios[row] = std::max(page.entry(row, n + 1), 0.0) / entry;
  }
  return page;
}

LemkeEnd end_of(const LemkeTrace& trace, int n, const LemkeSettings& settings) {
  if (trace.pivots.empty()) return LemkeEnd::no_pivot;
  if (trace.pivots.back().leaving == 2 * n) return LemkeEnd::solved;
  const bool is_stopped =
      static_cast<int>(trace.pivots.size()) == settings.max_pivots || trace.result.status == LcpStatus::iteration_limit;
  return is_stopped ? LemkeEnd::stopped : LemkeEnd::ray;
}

}  // namespace

LemkePages lemke_pages(const LemkeTrace& trace, std::size_t n, const LemkeSettings& settings) {
  const int num_variables = static_cast<int>(n);
  LemkePages result;
  result.end = end_of(trace, num_variables, settings);
  std::vector<int> all_w(n);
  std::iota(all_w.begin(), all_w.end(), 0);
  result.pages.push_back(page_of(n, all_w, trace.start, std::nullopt));
  for (const LemkePivot& pivot : trace.pivots) {
    LemkePage& before = result.pages.back();
    before.entering = pivot.entering;
    before.leaving = pivot.leaving;
    const bool is_last = &pivot == &trace.pivots.back();
    std::optional<int> entering;  // the complement of what left
    if (!is_last || result.end == LemkeEnd::ray) {
      entering = pivot.leaving < num_variables ? pivot.leaving + num_variables : pivot.leaving - num_variables;
    }
    LemkePage page = page_of(n, pivot.basis, pivot.tableau, entering);
    page.entered = pivot.entering;
    page.left = pivot.leaving;
    result.pages.push_back(std::move(page));
  }
  return result;
}

std::string lemke_variable(int variable, std::size_t n) {
  const int count = static_cast<int>(n);
  return variable < count ? tumble::format("w{}", variable + 1)
                          : tumble::format("z{}", variable < 2 * count ? variable - count + 1 : 0);
}

}  // namespace tumble
