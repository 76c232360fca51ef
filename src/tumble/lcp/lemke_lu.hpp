// Lemke's method on LU factors of the basis, which are made anew before rounding spoils them.
#pragma once

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble {

// How the numbers of the method are represented.
enum class Precision {
  double_precision,  // 53 bits
  quad_precision,    // 113 bits, in software: the same bits on every machine, some 50 times slower
};

struct LemkeLuSettings {
  int max_pivots = 0;                // [-] >= 0; 0 means 10 n + 100
  double pivot_tolerance = 1e-8;     // [-] in [0, 1): smallest pivot, relative to the largest entry of its column
  int max_exchanges = 40;            // [-] >= 0: pivots between two factorisations; 0: factors afresh at every pivot
  double accepted_residual = 1e-10;  // [-] in (0, 0.01]: `solved` means a residual no larger than this
  Precision precision = Precision::double_precision;
  int cover = 0;       // [-] >= 0: 0 is the cover of ones, any other number a pseudo-random one; another path
  double ridge = 0.0;  // [-] in [0, 1e-6]: added to the diagonal of the scaled M, to be judged without
  std::vector<std::uint8_t> start_basis = {};  // n, or empty: try this basis first, then pivot from it; `basis` of a
                                               // result of a problem like this one
};

// Throws std::invalid_argument for a setting outside its range.
void validate(const LemkeLuSettings& settings);

// As `lemke`, but only the list of basic variables is carried on. The direction of each pivot comes from LU factors of
// the rows with w_i = 0, sparse ones if those are many, and from the exchanges of columns since then, and is checked:
// where it misses its equations by more than round-off, the basis is factored anew, and so it is after `max_exchanges`.
// A pivot costs about n^2 operations, or as many as there are nonzeros, a factorisation up to k^3 / 3 for k basic z.
// Far more reliable than a tableau on problems that are nearly singular. From `start_basis` no pivot is made if it
// solves the problem as it stands. For large sparse problems the factors allocate memory.
LcpResult lemke_lu(const LcpProblem& problem, const LemkeLuSettings& settings = {});

}  // namespace tumble
