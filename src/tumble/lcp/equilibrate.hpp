// Scales, powers of two, that bring the diagonal of an LCP matrix near 1 without rounding any entry.
#pragma once

#include <vector>

#include "tumble/lcp/problem.hpp"

namespace tumble {

// M_ij * 2^(row[i] + column[j]) has magnitude near 1 for i = j. row[i] - column[i] is the same for all i, so that the
// products w_i z_i keep their relative sizes: in a problem of mechanics all of them bear one unit (a power, a work),
// and this covers every change of the units of mass, length and time.
struct Equilibration {
  std::vector<int> row;
  std::vector<int> column;

  // Rows and columns that are coupled by entries other than 0, directly or through others, bear the same block number
  // in 0 .. 2 n - 1. Blocks are problems of their own, each with its own size.
  std::vector<std::size_t> row_block;
  std::vector<std::size_t> column_block;

  std::vector<double> exponents;       // scratch: before rounding
  std::vector<int> diagonal_exponent;  // scratch
};

// Jacobi's scaling. A row without a diagonal entry (the friction cones of contacts) is scaled by its largest entry
// whose partner is scaled already. For a positive semidefinite M no scaled entry exceeds 4.
Equilibration equilibrate(const LcpProblem& problem);
void equilibrate(const LcpProblem& problem, Equilibration& scales);  // the same, without allocating once warm

// The largest |q_k| 2^row[k] of each block (2 n values), the size of what is to be solved there.
std::vector<double> block_sizes(const LcpProblem& problem, const Equilibration& scales);
void block_sizes(const LcpProblem& problem, const Equilibration& scales, std::vector<double>& sizes);

// The largest |q_k| of the block of row i, in the unit of w_i. n entries >= 0.
void row_sizes_of_q(const LcpProblem& problem, const Equilibration& scales, std::vector<double>& sizes);

// For a problem without row_sizes: 1e-6 of those. Small, so that a row may be far smaller than its neighbours and still
// count; not 0, so that the round-off of the neighbours does not count as an error of 1 in a row whose own terms all
// vanish.
void share_for_round_off(const std::vector<double>& of_q, std::vector<double>& round_off);

}  // namespace tumble
