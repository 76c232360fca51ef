// The instruction sets that code is compiled for, and which of them this processor has. Contraction is off in all of
// them (cmake/TumbleTarget.cmake), so their results are equal bit for bit. Not a public header.
#pragma once

// TUMBLE_INSTRUCTION_SETS before a function: one copy per instruction set, picked when the program is loaded. For loops
// that the compiler turns into vector code; what is written in vectors needs a translation unit per set.
// g++ only: programs of clang 14 with such copies end in an illegal instruction. A macro, as attributes have no other
// way to be shared.
#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define TUMBLE_INSTRUCTION_SETS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define TUMBLE_INSTRUCTION_SETS
#endif

namespace tumble {

enum class InstructionSet { baseline, avx2, avx512 };

inline bool has_instruction_set(InstructionSet set) {
#if TUMBLE_HAS_X86_SETS
  if (set == InstructionSet::avx512) return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2");
#endif
  return set == InstructionSet::baseline;
}

// The widest one.
inline InstructionSet instruction_set() {
  if (has_instruction_set(InstructionSet::avx512)) return InstructionSet::avx512;
  return has_instruction_set(InstructionSet::avx2) ? InstructionSet::avx2 : InstructionSet::baseline;
}

}  // namespace tumble
