// Which instance has which values. Instance i is sample i % samples of cell i / samples; of the cells' axes, the first
// one changes slowest. Its values depend on the spec and i alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tumble/sweep/columns.hpp"
#include "tumble/sweep/spec.hpp"

namespace tumble::sweep {

// Instances first to first + count - 1.
struct Slice {
  std::uint64_t first;
  std::size_t count;
};

std::uint64_t num_instances(const Spec& spec);

std::uint64_t num_chunks(const Spec& spec);

Slice slice_of_chunk(const Spec& spec, std::uint64_t chunk);

// The grids of the spec, in its order.
std::vector<Axis> axes_of(const Spec& spec);

bool is_swept(const Quantity& quantity);

// Of the quantity with this index in spec.quantities, in values.size() instances from `first` on.
void fill_values(const Spec& spec, std::size_t quantity, std::uint64_t first, std::span<double> values);

}  // namespace tumble::sweep
