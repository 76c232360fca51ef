#include "tumble/sweep/chunk_parts.hpp"

#include <algorithm>

#include "tumble/sweep/chunk_file.hpp"
#include "tumble/sweep/describe.hpp"
#include "tumble/sweep/field_bytes.hpp"
#include "tumble/sweep/plan.hpp"
#include "tumble/sweep/slice.hpp"

namespace tumble::sweep {

std::size_t num_parts(const Spec& spec) {
  return k_first_column_part + (spec.keep == Keep::columns ? empty_columns(spec).size() : 0);
}

Statistics add_up_chunk(const Spec& spec, std::uint64_t chunk,
                        const std::function<std::vector<Column>(const Slice& piece)>& columns_of) {
  const Slice slice = slice_of_chunk(spec, chunk);
  const std::size_t usual = spec.scene ? k_scene_piece : k_piece;
  Statistics statistics(layout_of(spec));
  for (std::size_t done = 0; done < slice.count; done += usual) {
    statistics.add(columns_of({slice.first + done, std::min(usual, slice.count - done)}));
  }
  return statistics;
}

std::vector<std::string> compute_parts(const Spec& spec, std::uint64_t chunk, const std::function<void()>& watch) {
  std::vector<std::string> parts(num_parts(spec));
  const Statistics statistics = add_up_chunk(spec, chunk, [&](const Slice& piece) {
    std::vector<Column> columns = simulate_slice(spec, piece, watch);
    for (std::size_t k = k_first_column_part; k < parts.size(); ++k) parts[k] += to_bytes(columns[k - 1]);
    return columns;
  });
  parts[k_statistics_part] = to_bytes(statistics.to_fields());
  return parts;
}

Statistics statistics_from_part(const Layout& layout, std::string_view part) {
  return Statistics::from_fields(layout, fields_from_bytes(part));
}

}  // namespace tumble::sweep
