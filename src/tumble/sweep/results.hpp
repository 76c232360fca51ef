// The finished chunks of a sweep as one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tumble/sweep/folder.hpp"
#include "tumble/sweep/statistics.hpp"

namespace tumble::sweep {

// Where each chunk of a sweep lies.
class Chunks {
 public:
  // Of all folders, which must hold the same sweep; of several good files of a chunk the first one. All bytes are read.
  // Throws std::invalid_argument if a folder holds another sweep, std::runtime_error naming the chunks that no folder
  // has.
  Chunks(std::span<const Folder> folders, int threads);

  const Spec& spec() const { return spec_; }

  // Part `part` of a chunk. Throws std::runtime_error if it cannot be read any more.
  std::string read(std::uint64_t chunk, std::size_t part) const;

 private:
  Spec spec_;
  std::uint64_t fingerprint_;
  std::vector<std::filesystem::path> paths_;
};

// Of all chunks, merged in their order.
Statistics merge_statistics(const Chunks& chunks);

// What is kept, columns or statistics, into a .npz or .h5: see docs/sweep.md. The bytes depend on the spec alone.
// Throws as output::write_table.
void write_results(const Chunks& chunks, const Statistics& statistics, const std::filesystem::path& path,
                   bool overwrite);

}  // namespace tumble::sweep
