// Row and column scales, powers of two, that bring the entries of an LCP matrix near 1 without rounding any of them.
#pragma once

#include <vector>

#include "tumble/lcp/problem.hpp"

namespace tumble {

// M_ij * 2^(row[i] + column[j]) has magnitude near 1 wherever M_ij is not 0.
struct Equilibration {
  std::vector<int> row;
  std::vector<int> column;

  // Rows and columns that are coupled by nonzero entries, directly or through others, bear the same block number in
  // 0 .. 2 n - 1. Blocks do not see each other's size.
  std::vector<std::size_t> row_block;
  std::vector<std::size_t> column_block;
};

// Least squares fit of log2 |M_ij| + row_i + column_j to 0 over the nonzero entries, rounded to integers:
// the geometric scaling of [Fulkerson & Wolfe 1962]. The fit does not depend on the units of the problem.
Equilibration equilibrate(const LcpProblem& problem);

// The largest |q_k| 2^row[k] of each block (2 n values), the size of what is to be solved there.
std::vector<double> block_sizes(const LcpProblem& problem, const Equilibration& scales);

// The largest |q_k| seen from row i, in the unit of w_i, as `equilibrate` relates the rows that are coupled to each
// other: what an LcpProblem without row_sizes is taken to mean. n entries >= 0.
std::vector<double> typical_row_sizes(const LcpProblem& problem);

}  // namespace tumble
