// Some instances of a sweep, simulated.
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

// x [m] of one instance, of the measured body, over time [s]; NaN where it has ended.
struct Path {
  std::vector<double> time;
  std::vector<double> x;
};

// In the samples 0, every, 2 every, ...
Path simulate_path(const Spec& spec, std::uint64_t instance, int every);

// The columns of simulate_slice without values.
std::vector<Column> empty_columns(const Spec& spec);

}  // namespace tumble::sweep
