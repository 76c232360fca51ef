#include "tumble/lcp/row_sizes.hpp"

#include <algorithm>

namespace tumble {

bool find_row_sizes(const LcpProblem& problem, ContactStructure& contacts, Equilibration& scales, RowSizes& sizes) {
  const bool has_contacts = find_contacts(problem, contacts);
  if (has_contacts) {
    contact_row_sizes(problem, contacts.places, sizes.of_q);
    sizes.round_off = sizes.of_q;
  } else {
    equilibrate(problem, scales);
    row_sizes_of_q(problem, scales, sizes.of_q);
    share_for_round_off(sizes.of_q, sizes.round_off);
  }
  sizes.is_guess = !has_contacts && problem.row_sizes.empty();
  if (problem.row_sizes.empty()) return has_contacts;
  sizes.round_off = problem.row_sizes;
  for (std::size_t i = 0; i < problem.size(); ++i) sizes.of_q[i] = std::max(sizes.of_q[i], sizes.round_off[i]);
  return has_contacts;
}

}  // namespace tumble
