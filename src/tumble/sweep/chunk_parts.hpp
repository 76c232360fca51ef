// What the file of a chunk holds: part 0 its statistics, then, where they are kept, its columns.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tumble/sweep/columns.hpp"
#include "tumble/sweep/plan.hpp"
#include "tumble/sweep/spec.hpp"
#include "tumble/sweep/statistics.hpp"

namespace tumble::sweep {

std::size_t num_parts(const Spec& spec);

// The statistics of a chunk, of which `columns_of` gives one piece after the other.
Statistics add_up_chunk(const Spec& spec, std::uint64_t chunk,
                        const std::function<std::vector<Column>(const Slice& piece)>& columns_of);

// Simulates the chunk. `watch` is called now and then; what it throws ends the work.
std::vector<std::string> compute_parts(const Spec& spec, std::uint64_t chunk, const std::function<void()>& watch);

// Throws std::invalid_argument for bytes that are not the statistics of such a sweep.
Statistics statistics_from_part(const Layout& layout, std::string_view part);

inline constexpr std::size_t k_statistics_part = 0;
inline constexpr std::size_t k_first_column_part = 1;

}  // namespace tumble::sweep
