// Murty's least-index principal pivoting.  [Murty 1974; Cottle 1992, section 4.2]
#pragma once

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble {

struct MurtySettings {
  int max_pivots = 0;                // [-] >= 0; 0 means 2^n, or 100 n + 10000 if that is less
  double accepted_residual = 1e-10;  // [-] in (0, 0.01]: `solved` means a residual no larger than this
};

// Throws std::invalid_argument for a setting outside its range.
void validate(const MurtySettings& settings);

// The shortest pivoting method there is: solve for the z of a basis; of all i whose basic variable, z_i or w_i, is
// negative take the least, and let z_i and w_i change places; until none is negative. It begins with z = 0.
// Guaranteed if M is a P-matrix (all principal minors > 0), up to rounding: no basis comes twice then, so at most 2^n
// bases are tried. That many can be needed (an upper triangle of 2 beside a diagonal of 1 takes 2^n - 1), though random
// problems take about n. Up to n = 13 the default limit covers every P-matrix. Each basis is factored afresh, k^3 / 3
// operations for k basic z.
// Beyond P-matrices it may meet a singular basis, where it stops, or go in circles up to the limit. The LCP of a
// frictional contact is beyond: its cone row has diagonal 0.
// Status: solved; iteration_limit; numerical (a singular basis, or the residual is too large). z belongs to the last
// basis that could be solved for. Throws std::invalid_argument where `validate` does, or for a setting outside its
// range.
LcpResult murty(const LcpProblem& problem, const MurtySettings& settings = {});

}  // namespace tumble
