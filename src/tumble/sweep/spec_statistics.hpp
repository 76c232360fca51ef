// From the spec of a sweep to its statistics, its summary and its pictures.
#pragma once

#include <string>

#include "tumble/sweep/panels.hpp"
#include "tumble/sweep/spec.hpp"
#include "tumble/sweep/summary.hpp"

namespace tumble::sweep {

// All that is measured; the map is over the first two quantities that take more than one value.
Layout layout_of(const Spec& spec);

Facts facts_of(const Spec& spec);

inline constexpr std::uint64_t k_fan_instances = 200;

// Runs instances again, evenly spread over the sweep, at most k_fan_instances of them: x over time, without those that
// are invalid.
Fan simulate_fan(const Spec& spec);

}  // namespace tumble::sweep
