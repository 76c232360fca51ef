// The finished chunks of a sweep as one.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "tumble/sweep/folder.hpp"

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

struct Counts {
  std::uint64_t instances = 0;
  std::array<std::uint64_t, 3> by_status{};  // see batch::DropStatus
  std::array<std::uint64_t, 4> by_face{};    // of those that were solved
};

Counts count(const Chunks& chunks);

// All columns, whole, into a .npz or .h5: see docs/sweep.md. The bytes depend on the spec alone. Throws as write_table.
void write_columns(const Chunks& chunks, const std::filesystem::path& path, bool overwrite);

}  // namespace tumble::sweep
