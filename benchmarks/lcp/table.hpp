// Measurements as tables.
#pragma once

#include <string>
#include <vector>

#include "measure.hpp"

namespace tumble::bench {

// The solver that times are compared with.
inline constexpr const char* k_reference = "Siconos lexicolemke";

// Markdown, one table per group of cases. The ratio of times is the median of the ratios case by case.
std::string tables(const std::vector<Case>& cases, const std::vector<Solver>& solvers,
                   const std::vector<Measurement>& measurements);

// One row per measurement: group, case, n, solver, verdict, residual, seconds, pivots.
std::string csv(const std::vector<Case>& cases, const std::vector<Solver>& solvers,
                const std::vector<Measurement>& measurements);

}  // namespace tumble::bench
