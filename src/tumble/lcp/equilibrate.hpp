// Row and column scales, powers of two, that bring the entries of an LCP matrix near 1 without rounding any of them.
#pragma once

#include <vector>

#include "tumble/lcp/problem.hpp"

namespace tumble {

// M_ij * 2^(row[i] + column[j]) has magnitude near 1 wherever M_ij is not 0.
struct Equilibration {
  std::vector<int> row;
  std::vector<int> column;
};

// Least squares fit of log2 |M_ij| + row_i + column_j to 0 over the nonzero entries, rounded to integers:
// the geometric scaling of [Fulkerson & Wolfe 1962]. The fit does not depend on the units of the problem.
Equilibration equilibrate(const LcpProblem& problem);

// The largest |q_k| seen from row i, in the unit of w_i, as `equilibrate` relates the rows that are coupled to each
// other: what an LcpProblem without row_sizes is taken to mean. n entries >= 0.
std::vector<double> typical_row_sizes(const LcpProblem& problem);

}  // namespace tumble
