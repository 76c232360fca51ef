// The file of one finished chunk: parts (columns or statistics) as bytes, with what shows whether they are whole and
// whose they are. Format: docs/sweep.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tumble/sweep/columns.hpp"

namespace tumble::sweep {

struct ChunkId {
  std::uint64_t fingerprint;  // of the spec
  std::uint64_t chunk;
};

// All or nothing; replaces what is there. Throws std::system_error with path and reason.
void write_chunk_file(const std::filesystem::path& path, const ChunkId& id, std::span<const std::string> parts);

// Throws std::runtime_error "path: what is wrong" if the file is not that of the chunk, cut off, damaged or without
// part k.
std::string read_chunk_part(const std::filesystem::path& path, const ChunkId& id, std::size_t part);

// What is wrong with a file of `num_parts` parts, all of its bytes read; nothing if it is good.
std::optional<std::string> fault_of_chunk_file(const std::filesystem::path& path, const ChunkId& id,
                                               std::size_t num_parts);

// Values as a part and in .npy files: little-endian, 8 bytes, or 4 of whole numbers.
std::string to_bytes(const Column& column);
std::vector<double> from_bytes(std::string_view bytes, bool is_whole);

}  // namespace tumble::sweep
