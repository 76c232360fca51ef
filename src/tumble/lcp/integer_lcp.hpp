// An LCP brought to whole numbers. Not a public header.
#pragma once

#include <string>
#include <vector>

#include "tumble/lcp/exact.hpp"
#include "tumble/lcp/rational.hpp"

namespace tumble {

struct RationalLcp {
  std::vector<Rational> M;  // n x n, row after row
  std::vector<Rational> q;  // n

  std::size_t size() const { return q.size(); }
};

// A number passed as text. Throws std::invalid_argument "<name>: <what is expected>, got <text>".
Rational parse_entry(const std::string& text, const std::string& name);

// Throws std::invalid_argument naming the entry for a text that is no number, wrong lengths, or n = 0.
RationalLcp rationals_of(const ExactLcp& problem);

RationalLcp rationals_of(const LcpProblem& problem);  // a valid one

// The same problem with rows and columns multiplied by positive factors such that all entries are whole and small:
//   w' = M' z' + q',      z_i = z_unit[i] z'_i,      w_i = w_unit[i] w'_i.
struct IntegerLcp {
  std::size_t n = 0;
  std::vector<Integer> entries;  // n x (n + 1), row after row: M', and q' in the last column
  std::vector<Rational> z_unit, w_unit;
  std::size_t num_bits = 0;  // of the longest entry
};

IntegerLcp integers_of(const RationalLcp& problem);

// Throws std::invalid_argument if n is above `max_size`, or the numbers are too long (k_max_exact_bits).
void require_exact_limits(const IntegerLcp& problem, std::size_t max_size);

// The set of solutions, shared by `exact_solution_set` and the enumeration in double.
struct RationalSolutionSet {
  bool is_complete = true;  // false: more than k_max_exact_generators
  std::vector<std::vector<Rational>> z, w;
  std::vector<std::vector<Rational>> rays;
  std::vector<std::uint32_t> bases;
  std::vector<SolutionFace> faces;
};
RationalSolutionSet rational_solution_set(const IntegerLcp& problem);

}  // namespace tumble
