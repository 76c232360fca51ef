// Checks of settings: one message for one mistake. Not a public header.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "tumble/lcp/result.hpp"
#include "tumble/math/format.hpp"

namespace tumble {

// Throws std::invalid_argument "field: must be range, got value" unless `is_met`.
inline void require(bool is_met, const char* field, const char* range, double value) {
  if (!is_met) throw std::invalid_argument(tumble::format("{}: must be {}, got {}", field, range, value));
}

inline void require_accepted_residual(double value) {
  require(value > 0.0 && value <= k_largest_accepted_residual, "accepted_residual", "in (0, 0.01]", value);
}

inline void require_start_basis(const std::vector<std::uint8_t>& basis, std::size_t n) {
  if (basis.empty() || basis.size() == n) return;
  throw std::invalid_argument(tumble::format("start_basis: must be empty or have {} entries, got {}", n, basis.size()));
}

inline void require_start_z(const std::vector<double>& z, std::size_t n) {
  if (!z.empty() && z.size() != n) {
    throw std::invalid_argument(tumble::format("start_z: must be empty or have {} entries, got {}", n, z.size()));
  }
}

// Each entry finite and >= 0.
inline void require_nonnegative(const std::vector<double>& z, const char* field) {
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (std::isfinite(z[i]) && z[i] >= 0.0) continue;
    throw std::invalid_argument(tumble::format("{}[{}]: must be finite and >= 0, got {}", field, i, z[i]));
  }
}

}  // namespace tumble
