// What a solver of linear complementarity problems returns.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "tumble/lcp/residual.hpp"

namespace tumble {

// No setting accepts more as a solution: at 1e-2 an answer is visibly wrong.
inline constexpr double k_largest_accepted_residual = 1e-2;

enum class LcpStatus : std::uint8_t {
  solved,              // z is a solution; its residual is within the accepted bound
  no_solution_proved,  // feasible or not, every complementary basis was tried and none is a solution
  ray_unproven,        // Lemke ended on a ray: no solution found, but none excluded either
  iteration_limit,     // the allowed number of pivots or sweeps was used up
  numerical,           // the method ended regularly, but the residual is above the accepted bound
  infeasible,          // no z >= 0 has M z + q >= 0: `certificate` is the proof
  bad_input,           // the problem is not one: wrong lengths, NaN, infinity; only from functions that never throw
};

// All of them in order; files store the position, so new ones go to the end.
inline constexpr std::array k_lcp_statuses = {
    LcpStatus::solved,    LcpStatus::no_solution_proved, LcpStatus::ray_unproven, LcpStatus::iteration_limit,
    LcpStatus::numerical, LcpStatus::infeasible,         LcpStatus::bad_input};

// The enumerator's own name, "solved" and so on.
std::string_view to_string(LcpStatus status);

// What found the answer. The methods of `robust` are rungs of a ladder: each is tried where those before it failed.
enum class LcpRung {
  none,           // q >= 0: z = 0 needs no method
  warm_start,     // the basis that the caller passed
  closed_form,    // one contact
  contact_modes,  // Newton on the modes of contacts
  lemke,          // tableau
  lemke_lu,       // LU factors of the basis
  lemke_quad,     // the same with 113 bits
  ridge,          // the same for M + a tiny diagonal
  exact,          // rational arithmetic
  enumerate,      // all bases
  nlgs,           // block Gauss-Seidel over contacts
  murty,          // least index
  dantzig,        // principal pivoting, one row after the other
  newton,         // semismooth Newton on min(w, z)
  pgs,            // projected Gauss-Seidel
};

// All of them in order.
inline constexpr std::array k_lcp_rungs = {
    LcpRung::none,     LcpRung::warm_start, LcpRung::closed_form, LcpRung::contact_modes, LcpRung::lemke,
    LcpRung::lemke_lu, LcpRung::lemke_quad, LcpRung::ridge,       LcpRung::exact,         LcpRung::enumerate,
    LcpRung::nlgs,     LcpRung::murty,      LcpRung::dantzig,     LcpRung::newton,        LcpRung::pgs};

// The enumerator's own name, "lemke" and so on.
std::string_view to_string(LcpRung rung);

struct LcpResult {
  LcpStatus status = LcpStatus::numerical;
  std::vector<double> z;            // n; if the status is not `solved`, the best candidate met, or 0
  std::vector<double> w;            // n; M z + q, recomputed from the problem
  double residual = 0.0;            // [-], parts.largest(); recomputed from the problem
  LcpResidual parts;                // the three parts of the residual, see residual.hpp
  int pivots = 0;                   // pivots made, bases tried, or sweeps
  int refactorisations = 0;         // LU factorisations of a basis
  LcpRung rung = LcpRung::none;     // the method that found z, or the last one tried
  std::vector<std::uint8_t> basis;  // n; 1 where z_i is basic (w_i = 0), 0 where w_i is (z_i = 0); that of z if solved,
                                    // else the last one tried
  std::vector<double> certificate;  // infeasible: y (n) with M'y <= 0, y >= 0, q'y < 0; ray_unproven: the direction of
                                    // the ray in z (n); else empty
};

}  // namespace tumble
