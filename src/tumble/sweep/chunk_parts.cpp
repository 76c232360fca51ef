#include "tumble/sweep/chunk_parts.hpp"

#include <algorithm>

#include "tumble/sweep/chunk_file.hpp"
#include "tumble/sweep/describe.hpp"
#include "tumble/sweep/drop_chunk.hpp"
#include "tumble/sweep/field_bytes.hpp"
#include "tumble/sweep/plan.hpp"

namespace tumble::sweep {

std::size_t num_parts(const Spec& spec) {
  return k_first_column_part + (spec.keep == Keep::columns ? empty_columns(spec).size() : 0);
}

std::vector<std::string> compute_parts(const Spec& spec, std::uint64_t chunk, const std::function<void()>& watch) {
  const Slice slice = slice_of_chunk(spec, chunk);
  Statistics statistics(layout_of(spec));
  std::vector<std::string> parts(num_parts(spec));
  for (std::size_t done = 0; done < slice.count; done += k_piece) {
    const Slice piece = {slice.first + done, std::min<std::size_t>(k_piece, slice.count - done)};
    const std::vector<Column> columns = simulate_slice(spec, piece, watch);
    statistics.add(columns);
    for (std::size_t k = k_first_column_part; k < parts.size(); ++k) parts[k] += to_bytes(columns[k - 1]);
  }
  parts[k_statistics_part] = to_bytes(statistics.to_fields());
  return parts;
}

Statistics statistics_from_part(const Layout& layout, std::string_view part) {
  return Statistics::from_fields(layout, fields_from_bytes(part));
}

}  // namespace tumble::sweep
