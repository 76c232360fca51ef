// A run whose numbers are known to the bit, to tell whether a machine and a build compute what all others do.
#pragma once

#include <cstdint>

#include "tumble/math/instruction_set.hpp"

namespace tumble::batch {

// A 64-bit hash (FNV-1a) over the states every 10 columns and the measures of 2000 drops of 301 columns, all parameters
// and starts drawn by counter, some angles of millions of turns; first in double, where the states are those of
// drop::simulate, then in single precision. Takes some milliseconds.
std::uint64_t reference_hash(InstructionSet set);

// What it is, everywhere.
inline constexpr std::uint64_t k_reference_hash = 0xb4cb468096fafe01;

}  // namespace tumble::batch
