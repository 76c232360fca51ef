// The closed form of one contact for several contacts side by side, in the lanes of vector registers. One translation
// unit per instruction set (one_contact_lanes_*.cpp) makes the same template; all give the bits of `solve_one_contact`.
// Not a public header.
#pragma once

#include <cstdint>

#include "tumble/lcp/one_contact.hpp"
#include "tumble/math/instruction_set.hpp"

namespace tumble::one_contact {

constexpr double k_accepted_residual = 1e-10;  // round-off of a few operations, times the condition of A up to 1e5

// Solves the 64 contacts from `first` on; is_done[k] (64 bytes) tells whether contact first + k is done, and the value
// whether all are. The others, for which the residual is not the simple one of `judge` in one_contact.cpp, are left to
// `solve_one_contact`.
using BlockSolver = bool (*)(const OneContactArrays& contacts, const OneContactSolutionArrays& solutions,
                             std::size_t first, std::uint8_t* is_done);

bool solve_block_baseline(const OneContactArrays&, const OneContactSolutionArrays&, std::size_t, std::uint8_t*);
bool solve_block_avx2(const OneContactArrays&, const OneContactSolutionArrays&, std::size_t, std::uint8_t*);
bool solve_block_avx512(const OneContactArrays&, const OneContactSolutionArrays&, std::size_t, std::uint8_t*);

// nullptr for scalar.
inline BlockSolver block_solver(InstructionSet set) {
#if TUMBLE_HAS_X86_SETS
  if (set == InstructionSet::avx512) return solve_block_avx512;
  if (set == InstructionSet::avx2) return solve_block_avx2;
#endif
  return set == InstructionSet::scalar ? nullptr : solve_block_baseline;
}

}  // namespace tumble::one_contact
