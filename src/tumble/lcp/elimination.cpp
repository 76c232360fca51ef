#include "tumble/lcp/elimination.hpp"

// One copy per instruction set, picked when the program is loaded; baseline elsewhere. Contraction is off in all of
// them (cmake/TumbleTarget.cmake), so their results are equal bit for bit.
#if defined(__x86_64__) && defined(__ELF__) && defined(__has_attribute) && !defined(__SANITIZE_ADDRESS__)
#if __has_attribute(target_clones)
#define TUMBLE_INSTRUCTION_SETS __attribute__((target_clones("avx512f", "avx2", "default")))
#endif
#endif
#ifndef TUMBLE_INSTRUCTION_SETS
#define TUMBLE_INSTRUCTION_SETS
#endif

namespace tumble {

TUMBLE_INSTRUCTION_SETS
void eliminate(double* entries, int rows, int stride, const double* pivot_row, const double* factors) {
  for (int i = 0; i < rows; ++i) {
    const double factor = factors[i];
    if (factor == 0.0) continue;
    double* __restrict row = entries + static_cast<long>(i) * stride;
    const double* __restrict from = pivot_row;
    for (int j = 0; j < stride; ++j) row[j] -= factor * from[j];
  }
}

}  // namespace tumble
