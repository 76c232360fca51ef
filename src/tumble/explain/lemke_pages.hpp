// Lemke's pivots as a textbook shows them: a tableau for each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tumble/lcp/lemke.hpp"

namespace tumble {

// One tableau, with the columns of basic variables, which are unit columns, left out. A row reads: basic variable + sum
// of entries times the variables above = value. Variables are numbered as in LemkePivot.
struct LemkePage {
  std::optional<int> entered, left;           // by the pivot that leads here; none: the start
  std::vector<int> basis;                     // n
  std::vector<int> columns;                   // the n + 1 others
  std::vector<double> entries;                // n x (n + 2): columns, value; round-off is shown as 0
  std::optional<int> entering, leaving;       // by the next pivot
  std::vector<std::optional<double>> ratios;  // n: how far `entering` can grow until the basic variable is 0; from the
                                              // second pivot on

  std::size_t n() const { return basis.size(); }
  double entry(std::size_t row, std::size_t column) const { return entries[row * (n() + 2) + column]; }
};

enum class LemkeEnd { no_pivot, solved, stopped, ray };

struct LemkePages {
  std::vector<LemkePage> pages;  // the start, then one for each pivot
  LemkeEnd end = LemkeEnd::no_pivot;
};

LemkePages lemke_pages(const LemkeTrace& trace, std::size_t n, const LemkeSettings& settings);

// "w1", "z1", "z0".
std::string lemke_variable(int variable, std::size_t n);

}  // namespace tumble
