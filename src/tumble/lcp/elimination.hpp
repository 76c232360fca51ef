// The inner loop of the tableau methods. Not a public header.
#pragma once

namespace tumble {

// row_i -= factors[i] * pivot_row for all `rows` rows of `stride` entries with factors[i] != 0. Entry by entry, so that
// every instruction set gives the same bits.
void eliminate(double* entries, int rows, int stride, const double* pivot_row, const double* factors);

}  // namespace tumble
