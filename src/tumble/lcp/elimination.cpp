#include "tumble/lcp/elimination.hpp"

#include "tumble/math/target_clones.hpp"

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
