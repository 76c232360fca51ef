// Zip archives in memory, as far as .npz files need them: stored and deflated entries, no zip64, one disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tumble::output {

// Entries are deflated. The archive depends on names and bytes alone: its time stamps are those of 1980.
class ZipWriter {
 public:
  void add(const std::string& name, std::string_view bytes);
  std::string finish();

 private:
  std::string archive_;
  std::string directory_;
  std::uint16_t entries_ = 0;
};

struct ZipEntry {
  std::string name;
  std::uint16_t method = 0;  // 0 stored, 8 deflated
  std::uint32_t crc = 0;
  std::size_t size = 0;         // of the content
  std::string_view compressed;  // into the archive
};

// The entries of the central directory. Throws std::invalid_argument "name: what".
std::vector<ZipEntry> read_zip_directory(std::string_view archive, const std::string& name);

// The content of an entry, its CRC checked. More than `max_bytes`, or more than deflate can make out of the
// bytes that are there, is refused before it is allocated.
std::string extract(const ZipEntry& entry, std::size_t max_bytes, const std::string& name);

}  // namespace tumble::output
