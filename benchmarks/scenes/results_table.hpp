// Measurements as tables.
#pragma once

#include <string>
#include <vector>

#include "measure_engines.hpp"

namespace tumble::bench {

// Markdown: one row for each world and engine, accuracy beside time; then how the time grows from pile to pile. The
// times of a world are compared with those of `reference`, round by round.
std::string tables(const std::vector<World>& worlds, const std::vector<Engine>& engines,
                   const std::vector<Measurement>& measurements, std::size_t reference);

// One row per measurement and round.
std::string csv(const std::vector<World>& worlds, const std::vector<Engine>& engines,
                const std::vector<Measurement>& measurements, double step_size);

}  // namespace tumble::bench
