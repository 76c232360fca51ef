// Semismooth Newton method on min(w, z) = 0.  [Qi & Sun 1993; Cottle 1992, section 5.8; De Luca et al. 2000]
#pragma once

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble {

struct NewtonSettings {
  int max_iterations = 200;         // [-] >= 1
  double accepted_residual = 1e-8;  // [-] in (0, 0.01]: `solved` means a residual no larger than this
};

// Throws std::invalid_argument for a setting outside its range.
void validate(const NewtonSettings& settings);

// z solves the LCP if min(z_i, w_i) = 0 for every i. These equations are linear piece by piece, so a Newton step from z
// takes w_i = 0 where w_i < z_i and z_i = 0 elsewhere: it tries the basis that z points at. Once that is the right one,
// the step ends at the solution, exactly; usually after a few. A step need not get closer, so a line search watches
// over it, on the merit function 1/2 sum phi_i^2 of Fischer and Burmeister, phi(a, b) = sqrt(a^2 + b^2) - a - b, which
// is smooth and 0 only at solutions [Fischer 1992; Facchinei & Soares 1997]. Where the basis is singular, or its step
// no way down, the step is that of Levenberg and Marquardt for phi = 0,
//   (J'J + nu I) step = -J'phi,
// which is one at every z that is not stationary, whatever the rank of J. All is done in scaled numbers, from z = 0.
// Guaranteed for a P-matrix: every z that is stationary for the merit function solves the LCP, and none escapes to
// infinity; the last step is a Newton step if the solution is nondegenerate (z_i + w_i > 0). For P0-matrices, to which
// semidefinite ones belong, the first holds but not the second. The matrices of frictional contacts are no P0-matrices;
// their bases are often singular and their merit functions have minima where nothing is solved: expect failures.
// An iteration costs k^3 / 3 operations for k basic z, n^3 with Levenberg and Marquardt.
// Status: solved; iteration_limit; numerical (no way down). `pivots` counts the iterations. Throws
// std::invalid_argument where `validate` does, or for a setting outside its range.
LcpResult newton(const LcpProblem& problem, const NewtonSettings& settings = {});

}  // namespace tumble
