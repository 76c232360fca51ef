// The instruction sets that code in vectors is compiled for, and which of them this processor has. Contraction is off
// in all of them (cmake/TumbleTarget.cmake), so their results are equal bit for bit.
#pragma once

#include <string_view>
#include <vector>

namespace tumble {

enum class InstructionSet {
  scalar,    // no vectors
  baseline,  // vectors of 16 bytes, which every processor of the kind has: SSE2, NEON, WebAssembly's simd128
  avx2,
  avx512,
};

// "scalar", "sse2" or "neon" or "simd128", "avx2", "avx512".
std::string_view to_string(InstructionSet set);

// Those that this program has code for and this processor can run, the widest last.
std::vector<InstructionSet> instruction_sets();

bool has_instruction_set(InstructionSet set);

// The one of that name. Throws std::invalid_argument "field: must be one of ..." if it is none of `instruction_sets`.
InstructionSet instruction_set_named(std::string_view name, std::string_view field);

// The one used unless another is asked for: the widest, or that which the environment variable TUMBLE_INSTRUCTION_SET
// names. Throws std::invalid_argument if it names none, or one that is not there.
InstructionSet instruction_set();

}  // namespace tumble
