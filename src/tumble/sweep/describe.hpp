// A sweep in the terms of its statistics, tables and pictures.
#pragma once

#include <optional>

#include "tumble/sweep/panels.hpp"
#include "tumble/sweep/spec.hpp"
#include "tumble/sweep/statistics.hpp"
#include "tumble/sweep/summary.hpp"

namespace tumble::sweep {

// All measures; as axes of the map the first two that are swept, grids before what is drawn. Of a normal distribution
// the map shows three deviations to either side.
Layout layout_of(const Spec& spec);

Facts facts_of(const Spec& spec);

// x over time of at most 200 instances, evenly spread over the sweep; nothing where the time step is swept.
std::optional<Fan> fan_of(const Spec& spec);

}  // namespace tumble::sweep
