#include "tumble/output/zip.hpp"

#include <algorithm>
#include <limits>
#include <new>
#include <stdexcept>

#include <zlib.h>

#include "tumble/math/format.hpp"
#include "tumble/output/file.hpp"

namespace tumble::output {
namespace {

// Names and layout: PKWARE, APPNOTE.TXT, sections 4.3.7 (local header), 4.3.12 (directory) and 4.3.16 (its
// end).
constexpr std::uint32_t k_local_signature = 0x04034b50;
constexpr std::uint32_t k_directory_signature = 0x02014b50;
constexpr std::uint32_t k_end_signature = 0x06054b50;
constexpr std::size_t k_local_bytes = 30;
constexpr std::size_t k_directory_bytes = 46;
constexpr std::size_t k_end_bytes = 22;
constexpr std::size_t k_max_comment = 65535;
constexpr std::uint16_t k_stored = 0;
constexpr std::uint16_t k_deflated = 8;
constexpr std::uint16_t k_encrypted_flag = 1;
constexpr std::uint16_t k_version = 20;      // 2.0: deflate
constexpr std::uint16_t k_first_day = 0x21;  // 1980-01-01
constexpr int k_level = 1;                   // of states: 6 takes three times as long and saves half a percent
constexpr int k_raw_deflate = -MAX_WBITS;
constexpr std::size_t k_max_ratio = 1032;  // deflate makes at most 258 bytes out of 2 bits

template <class Unsigned>
void put(std::string& bytes, Unsigned value) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xff);
}

// Little-endian number of 2 or 4 bytes at `at`; the caller has checked that they exist.
template <class Unsigned>
Unsigned get(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return static_cast<Unsigned>(value);
}

[[noreturn]] void refuse(const std::string& name, std::string_view why) {
  throw std::invalid_argument(tumble::format("{}: {}", name, why));
}

std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

Bytef* byte_pointer(const char* data) { return reinterpret_cast<Bytef*>(const_cast<char*>(data)); }

std::string deflate_bytes(std::string_view bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, k_level, Z_DEFLATED, k_raw_deflate, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
  std::string compressed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = byte_pointer(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = byte_pointer(compressed.data());
  stream.avail_out = static_cast<uInt>(compressed.size());
  const int result = deflate(&stream, Z_FINISH);
  compressed.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != Z_STREAM_END) throw std::runtime_error("zlib cannot compress: deflate did not finish");
  return compressed;
}

// False if the stream is broken or its content is not exactly `size` bytes.
bool inflate_bytes(std::string_view compressed, std::string& content) {
  z_stream stream{};
  if (inflateInit2(&stream, k_raw_deflate) != Z_OK) throw std::bad_alloc();
  char none = '\0';  // zlib wants a place to write to even where nothing is to be written
  stream.next_in = byte_pointer(compressed.data());
  stream.avail_in = static_cast<uInt>(compressed.size());
  stream.next_out = byte_pointer(content.empty() ? &none : content.data());
  stream.avail_out = static_cast<uInt>(content.size());
  const int result = inflate(&stream, Z_FINISH);
  const bool is_whole = result == Z_STREAM_END && stream.avail_in == 0 && stream.avail_out == 0;
  inflateEnd(&stream);
  return is_whole;
}

// Where the end record starts: behind it lies only its comment.
std::size_t find_end_record(std::string_view archive, const std::string& name) {
  if (archive.size() >= k_end_bytes) {
    const std::size_t latest = archive.size() - k_end_bytes;
    for (std::size_t comment = 0; comment <= std::min(latest, k_max_comment); ++comment) {
      const std::size_t at = latest - comment;
      if (get<std::uint32_t>(archive, at) == k_end_signature && get<std::uint16_t>(archive, at + 20) == comment) {
        return at;
      }
    }
  }
  refuse(name, "is not a whole zip archive: it has no end record; was it cut off?");
}

// The bytes of the entry, found through its local header.
std::string_view entry_bytes(std::string_view archive, std::size_t offset, std::size_t size, const std::string& name) {
  if (offset > archive.size() || archive.size() - offset < k_local_bytes ||
      get<std::uint32_t>(archive, offset) != k_local_signature) {
    refuse(name, tumble::format("the zip directory points to byte {}, where no entry is", offset));
  }
  const std::size_t start =
      offset + k_local_bytes + get<std::uint16_t>(archive, offset + 26) + get<std::uint16_t>(archive, offset + 28);
  if (start > archive.size() || archive.size() - start < size) {
    refuse(name, tumble::format("the zip entry at byte {} reaches over the end of the file", offset));
  }
  return archive.substr(start, size);
}

}  // namespace

void ZipWriter::add(const std::string& name, std::string_view bytes) {
  constexpr std::size_t limit = std::numeric_limits<std::uint32_t>::max();
  const std::string compressed = bytes.size() < limit ? deflate_bytes(bytes) : std::string();
  if (bytes.size() >= limit || archive_.size() + compressed.size() >= limit - (1u << 16)) {
    throw std::invalid_argument("the record is too long for a zip archive of 4 GiB: write .h5 or .csv");
  }
  std::string shared;  // the part that local header and directory have in common
  put<std::uint16_t>(shared, k_version);
  put<std::uint16_t>(shared, 0);  // flags
  put<std::uint16_t>(shared, k_deflated);
  put<std::uint16_t>(shared, 0);  // time of day
  put<std::uint16_t>(shared, k_first_day);
  put<std::uint32_t>(shared, crc_of(bytes));
  put<std::uint32_t>(shared, static_cast<std::uint32_t>(compressed.size()));
  put<std::uint32_t>(shared, static_cast<std::uint32_t>(bytes.size()));
  put<std::uint16_t>(shared, static_cast<std::uint16_t>(name.size()));
  put<std::uint16_t>(shared, 0);  // no extra field

  put<std::uint32_t>(directory_, k_directory_signature);
  put<std::uint16_t>(directory_, k_version);
  directory_ += shared;
  put<std::uint16_t>(directory_, 0);  // no comment
  put<std::uint16_t>(directory_, 0);  // disk
  put<std::uint16_t>(directory_, 0);  // internal attributes
  put<std::uint32_t>(directory_, 0);  // external attributes
  put<std::uint32_t>(directory_, static_cast<std::uint32_t>(archive_.size()));
  directory_ += name;

  put<std::uint32_t>(archive_, k_local_signature);
  archive_ += shared;
  archive_ += name;
  archive_ += compressed;
  ++entries_;
}

std::string ZipWriter::finish() {
  const std::size_t start = archive_.size();
  archive_ += directory_;
  put<std::uint32_t>(archive_, k_end_signature);
  put<std::uint16_t>(archive_, 0);  // disk
  put<std::uint16_t>(archive_, 0);  // disk of the directory
  put<std::uint16_t>(archive_, entries_);
  put<std::uint16_t>(archive_, entries_);
  put<std::uint32_t>(archive_, static_cast<std::uint32_t>(directory_.size()));
  put<std::uint32_t>(archive_, static_cast<std::uint32_t>(start));
  put<std::uint16_t>(archive_, 0);  // no comment
  return std::move(archive_);
}

std::vector<ZipEntry> read_zip_directory(std::string_view archive, const std::string& name) {
  const std::size_t end = find_end_record(archive, name);
  const std::size_t count = get<std::uint16_t>(archive, end + 10);
  const std::size_t size = get<std::uint32_t>(archive, end + 12);
  const std::size_t start = get<std::uint32_t>(archive, end + 16);
  if (start > end || end - start < size) refuse(name, "the zip directory lies outside the file; was it cut off?");
  const std::string_view directory = archive.substr(start, size);
  std::vector<ZipEntry> entries;
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (directory.size() - at < k_directory_bytes || get<std::uint32_t>(directory, at) != k_directory_signature) {
      refuse(name, tumble::format("the zip directory announces {} entries and has {}", count, i));
    }
    const std::size_t name_size = get<std::uint16_t>(directory, at + 28);
    const std::size_t skipped =
        name_size + get<std::uint16_t>(directory, at + 30) + get<std::uint16_t>(directory, at + 32);
    if (directory.size() - at - k_directory_bytes < skipped) refuse(name, "the zip directory is broken");
    ZipEntry entry;
    entry.name = directory.substr(at + k_directory_bytes, name_size);
    if (get<std::uint16_t>(directory, at + 8) & k_encrypted_flag) refuse(name, "holds an encrypted entry");
    entry.method = get<std::uint16_t>(directory, at + 10);
    entry.crc = get<std::uint32_t>(directory, at + 16);
    entry.size = get<std::uint32_t>(directory, at + 24);
    entry.compressed =
        entry_bytes(archive, get<std::uint32_t>(directory, at + 42), get<std::uint32_t>(directory, at + 20), name);
    entries.push_back(entry);
    at += k_directory_bytes + skipped;
  }
  return entries;
}

std::string extract(const ZipEntry& entry, std::size_t max_bytes, const std::string& name) {
  const std::string place = tumble::format("{}: {}", name, path_text(entry.name.substr(0, 60)));
  if (entry.size > max_bytes) refuse(place, tumble::format("has {} bytes, at most {} are read", entry.size, max_bytes));
  std::string content;
  if (entry.method == k_stored) {
    if (entry.compressed.size() != entry.size) refuse(place, "the sizes of the stored entry disagree");
    content = entry.compressed;
  } else if (entry.method == k_deflated) {
    if (entry.size / k_max_ratio > entry.compressed.size()) refuse(place, "announces more bytes than it can hold");
    content.resize(entry.size);
    if (!inflate_bytes(entry.compressed, content)) refuse(place, "its compressed bytes are broken");
  } else {
    refuse(place, tumble::format("is packed by method {}, only 0 (stored) and 8 (deflated) are read", entry.method));
  }
  if (crc_of(content) != entry.crc) refuse(place, "its bytes are damaged: the CRC differs");
  return content;
}

}  // namespace tumble::output
