// The instances of a chunk, simulated.
#pragma once

#include <functional>
#include <vector>

#include "tumble/sweep/columns.hpp"
#include "tumble/sweep/plan.hpp"
#include "tumble/sweep/spec.hpp"

namespace tumble::sweep {

// What is swept, then what is measured, of each instance of the slice. An instance with a draw out of range has status
// `invalid` and NaN (face and impacts: -1) for what is measured. `watch` is called now and then; what it throws ends
// the work.
std::vector<Column> simulate_slice(const Spec& spec, const Slice& slice, const std::function<void()>& watch);

// The same without values.
std::vector<Column> empty_columns(const Spec& spec);

}  // namespace tumble::sweep
