#include "tumble/sweep/results.hpp"

#include <algorithm>
#include <stdexcept>

#include "tumble/batch/parallel.hpp"
#include "tumble/math/format.hpp"
#include "tumble/output/file.hpp"
#include "tumble/output/table.hpp"
#include "tumble/sweep/chunk_file.hpp"
#include "tumble/sweep/chunk_parts.hpp"
#include "tumble/sweep/describe.hpp"
#include "tumble/sweep/plan.hpp"
#include "tumble/sweep/slice.hpp"

namespace tumble::sweep {
namespace {

void require_same(std::span<const Folder> folders) {
  for (const Folder& folder : folders) {
    if (folder.spec_fingerprint() == folders[0].spec_fingerprint()) continue;
    throw std::invalid_argument(tumble::format("{}: holds another sweep than {}", output::path_text(folder.path()),
                                               output::path_text(folders[0].path())));
  }
}

// "3, 5, 6 and 12 more".
std::string list_of(const std::vector<std::uint64_t>& numbers) {
  constexpr std::size_t most = 10;
  const std::span<const std::uint64_t> first(numbers.data(), std::min(numbers.size(), most));
  return tumble::format("{}{}", tumble::join(first, ", "),
                        numbers.size() > most ? tumble::format(" and {} more", numbers.size() - most) : "");
}

// What the columns do not say: the spec, and the quantities that are the same for all.
std::vector<output::Field> notes_of(const Spec& spec) {
  std::vector<output::Field> notes = {{"spec", "", {}, std::vector<std::string>{spec.text}}};
  for (const auto& [name, unit, source, draw, target] : spec.quantities) {
    if (const auto* constant = std::get_if<Constant>(&source)) {
      notes.push_back({name, unit, {}, std::vector<double>{constant->value}});
    }
  }
  if (spec.scene) {
    notes.push_back({"scene", "", {}, std::vector<std::string>{spec.scene->text}});
  } else {
    notes.push_back({"steps", "", {}, std::vector<std::int64_t>{spec.columns - 1}});
  }
  notes.push_back({"status_names", "", {3}, std::vector<std::string>{"solved", "numerical", "invalid"}});
  std::vector<std::string> axes;
  for (const Axis& axis : axes_of(spec)) axes.push_back(axis.name);
  const std::size_t num_axes = axes.size();
  if (num_axes > 0) notes.push_back({"axes", "", {num_axes}, std::move(axes)});
  return notes;
}

}  // namespace

Chunks::Chunks(std::span<const Folder> folders, int threads)
    : spec_(folders[0].spec()), fingerprint_(folders[0].spec_fingerprint()), paths_(num_chunks(spec_)) {
  require_same(folders);
  std::vector<std::string> faults(paths_.size());
  batch::for_each_chunk(paths_.size(), threads, [&](std::size_t chunk, std::size_t) {
    for (const Folder& folder : folders) {
      const std::filesystem::path path = folder.chunk_path(chunk);
      if (!std::filesystem::exists(path)) continue;
      const auto fault = fault_of_chunk_file(path, {fingerprint_, chunk}, num_parts(spec_));
      if (!fault) {
        paths_[chunk] = path;
        return;
      }
      faults[chunk] = *fault;
    }
  });
  std::vector<std::uint64_t> missing;
  for (std::size_t chunk = 0; chunk < paths_.size(); ++chunk) {
    if (!paths_[chunk].empty()) continue;
    if (!faults[chunk].empty()) {
      throw std::runtime_error(tumble::format("{}; run the sweep or its shard again, which repairs it", faults[chunk]));
    }
    missing.push_back(chunk);
  }
  if (missing.empty()) return;
  throw std::runtime_error(tumble::format(
      "{}: the sweep is not finished: of {} chunks, {} missing: {}", output::path_text(folders[0].path()),
      paths_.size(), missing.size() == 1 ? "1 is" : tumble::format("{} are", missing.size()), list_of(missing)));
}

std::string Chunks::read(std::uint64_t chunk, std::size_t part) const {
  return read_chunk_part(paths_[chunk], {fingerprint_, chunk}, part);
}

Statistics merge_statistics(const Chunks& chunks) {
  const Layout layout = layout_of(chunks.spec());
  Statistics statistics(layout);
  for (std::uint64_t chunk = 0; chunk < num_chunks(chunks.spec()); ++chunk) {
    statistics.merge(statistics_from_part(layout, chunks.read(chunk, k_statistics_part)));
  }
  return statistics;
}

void write_results(const Chunks& chunks, const Statistics& statistics, const std::filesystem::path& path,
                   bool overwrite) {
  const Spec& spec = chunks.spec();
  output::Table table;
  table.notes = notes_of(spec);
  if (spec.keep == Keep::statistics) {
    for (output::Field& field : statistics.to_fields()) table.notes.push_back(std::move(field));
  } else {
    for (const Column& column : empty_columns(spec)) {
      table.columns.push_back({column.name, column.unit, column.is_whole});
    }
    table.rows = num_instances(spec);
    table.read = [&](std::size_t column, const std::function<void(std::string_view)>& take) {
      for (std::uint64_t chunk = 0; chunk < num_chunks(spec); ++chunk) {
        take(chunks.read(chunk, k_first_column_part + column));
      }
    };
  }
  output::write_table(table, path, overwrite);
}

}  // namespace tumble::sweep
