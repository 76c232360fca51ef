// Scales, powers of two, that bring the entries of an LCP matrix near 1 without rounding any of them.
#pragma once

#include <vector>

#include "tumble/lcp/problem.hpp"

namespace tumble {

// M_ij * 2^(row[i] + column[j]) has magnitude near 1 where the entry counts. row[i] - column[i] is the same for all i, so
// that the products w_i z_i keep their relative sizes: in a problem of mechanics all of them bear one unit (a power, a
// work), and this covers every change of the units of mass, length and time.
struct Equilibration {
  std::vector<int> row;
  std::vector<int> column;

  // Rows and columns that are coupled by entries other than 0, directly or through others, bear the same block number in
  // 0 .. 2 n - 1. Blocks are problems of their own, each with its own size.
  std::vector<std::size_t> row_block;
  std::vector<std::size_t> column_block;
};

// Least squares fit of log2 |M_ij| + x_i + x_j to 0 over the entries that are not 0, rounded to integers; the geometric
// scaling of [Fulkerson & Wolfe 1962], kept symmetric. Entries that come out below 2^-40 of the largest of
// their row and of their column do not count; they are left out and the fit is made again.
Equilibration equilibrate(const LcpProblem& problem);

// The largest |q_k| 2^row[k] of each block (2 n values), the size of what is to be solved there.
std::vector<double> block_sizes(const LcpProblem& problem, const Equilibration& scales);

// The largest |q_k| seen from row i, in the unit of w_i, as `equilibrate` relates the rows that are coupled to each
// other: what an LcpProblem without row_sizes is taken to mean. n entries >= 0.
std::vector<double> typical_row_sizes(const LcpProblem& problem);

}  // namespace tumble
