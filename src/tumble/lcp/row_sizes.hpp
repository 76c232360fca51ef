// The sizes by which `residual` judges rows. Not a public header.
#pragma once

#include <vector>

#include "tumble/lcp/contact_structure.hpp"
#include "tumble/lcp/equilibrate.hpp"
#include "tumble/lcp/problem.hpp"

namespace tumble {

struct RowSizes {
  std::vector<double> round_off;  // n >= 0: what a row gets whose own terms all vanish
  std::vector<double> of_q;       // n >= 0: how large q is there, in the unit of w_i; 0 if it is 0 throughout the block
  bool is_guess = false;          // true if neither the caller nor contacts tell the sizes
};

// The caller's sizes, or those of contacts, or those of the blocks of an equilibrated matrix. Looks for contacts, into
// `contacts`, and returns whether there are any; `scales` is filled if there are none. Allocates nothing once warm.
bool find_row_sizes(const LcpProblem& problem, ContactStructure& contacts, Equilibration& scales, RowSizes& sizes);

}  // namespace tumble
