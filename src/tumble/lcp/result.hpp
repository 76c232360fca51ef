// What a solver of linear complementarity problems returns.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace tumble {

// No setting accepts more as a solution: at 1e-2 an answer is visibly wrong.
inline constexpr double k_largest_accepted_residual = 1e-2;

enum class LcpStatus {
  solved,              // z is a solution; its residual is within the accepted bound
  no_solution_proved,  // every complementary basis was tried and failed clearly
  ray_unproven,        // Lemke ended on a ray: no solution found, but none excluded either
  iteration_limit,     // the allowed number of pivots was used up
  numerical,           // the pivots ended regularly, but the residual is above the accepted bound
};

// The enumerator's own name, "solved" and so on.
std::string_view to_string(LcpStatus status);

struct LcpResult {
  LcpStatus status = LcpStatus::numerical;
  std::vector<double> z;            // n; if the status is not `solved`, the best candidate met, or 0
  std::vector<double> w;            // n; M z + q, recomputed from the problem
  double residual = 0.0;            // [-], see `residual` in residual.hpp; recomputed from the problem
  int pivots = 0;                   // pivots made, or bases tried
  std::vector<std::uint8_t> basis;  // n; 1 where z_i is basic (w_i = 0), 0 where w_i is (z_i = 0)
};

}  // namespace tumble
