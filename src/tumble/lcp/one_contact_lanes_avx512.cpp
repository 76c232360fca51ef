namespace {
constexpr int k_num_lanes = 8;
}
#include "tumble/lcp/one_contact_lanes_impl.hpp"

bool tumble::one_contact::solve_block_avx512(const OneContactArrays& contacts,
                                             const OneContactSolutionArrays& solutions, std::size_t first,
                                             std::uint8_t* is_done) {
  return solve_block(contacts, solutions, first, is_done);
}
