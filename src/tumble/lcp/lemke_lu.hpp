// Lemke's method with the basis factored afresh at every pivot: no rounding is carried from one pivot to the next.
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
  int max_pivots = 0;               // [-] >= 0; 0 means 10 n + 100
  double pivot_tolerance = 1e-8;    // [-] in [0, 1): smallest pivot, relative to the largest entry of its column
  double accepted_residual = 1e-8;  // [-] in (0, 0.01]: `solved` means a residual no larger than this
  Precision precision = Precision::double_precision;
  double ridge = 0.0;  // [-] in [0, 1e-6]: added to the diagonal of the scaled M, to be judged without
  std::vector<std::uint8_t> start_basis = {};  // n, or empty: try this basis first, then pivot from it; `basis` of a
                                               // result of a problem like this one
};

// Throws std::invalid_argument for a setting outside its range.
void validate(const LemkeLuSettings& settings);

// As `lemke`, but only the list of basic variables is carried on: directions and values come from LU factors of the
// rows with w_i = 0, (k + 1)^3 / 3 operations per pivot for k basic z. Slower than the tableau, and far more reliable
// on problems that are nearly singular. From `start_basis` no pivot is made if it solves the problem as it stands.
LcpResult lemke_lu(const LcpProblem& problem, const LemkeLuSettings& settings = {});

}  // namespace tumble
