// Loops that the compiler turns into vector code of several instruction sets. Not a public header.
#pragma once

// TUMBLE_INSTRUCTION_SETS before a function: one copy per instruction set, picked when the program is loaded. What is
// written in vectors needs a translation unit per set instead (instruction_set.hpp).
// g++ only: programs of clang 14 with such copies end in an illegal instruction. A macro, as attributes have no other
// way to be shared.
#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TUMBLE_INSTRUCTION_SETS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define TUMBLE_INSTRUCTION_SETS
#endif
