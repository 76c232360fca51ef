#include "tumble/sweep/chunk_file.hpp"

#include <bit>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include <zlib.h>

#include "tumble/math/format.hpp"
#include "tumble/output/file.hpp"

namespace tumble::sweep {
namespace {

static_assert(std::endian::native == std::endian::little, "files hold little-endian numbers, as in memory");

// "TUMBLESW", fingerprint, chunk, number of parts; for each part its size and CRC; CRC of all that: words of 64 bits.
constexpr std::uint64_t k_magic = 0x5753454c424d5554u;
constexpr std::size_t k_fixed_words = 4;
constexpr std::uint64_t k_max_parts = 10'000;

std::uint64_t crc_of(std::string_view bytes) {
  return crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

std::string_view bytes_of(std::span<const std::uint64_t> words) {
  return {reinterpret_cast<const char*>(words.data()), words.size_bytes()};
}

class Reader {
 public:
  Reader(const std::filesystem::path& path, const ChunkId& id) : path_(path), file_(path, std::ios::binary) {
    if (!file_) fail("cannot be opened");
    std::vector<std::uint64_t> head(k_fixed_words);
    read(head);
    if (head[0] != k_magic) fail("is no file of a chunk");
    if (head[3] > k_max_parts) fail("is damaged");
    head.resize(k_fixed_words + 2 * head[3]);
    read(std::span(head).subspan(k_fixed_words));
    std::uint64_t crc = 0;
    read({&crc, 1});
    if (crc != crc_of(bytes_of(head))) fail("is damaged: its head has another checksum");
    if (head[1] != id.fingerprint) fail("belongs to another sweep");
    if (head[2] != id.chunk) fail(tumble::format("holds chunk {}", head[2]));
    std::uint64_t offset = (head.size() + 1) * sizeof(std::uint64_t);
    for (std::size_t k = k_fixed_words; k < head.size(); k += 2) {
      parts_.push_back({offset, head[k], head[k + 1]});
      offset += head[k];
    }
    file_.seekg(0, std::ios::end);
    if (static_cast<std::uint64_t>(file_.tellg()) != offset) fail("is cut off, or too long");
  }

  std::size_t num_parts() const { return parts_.size(); }

  std::string part(std::size_t k) {
    if (k >= parts_.size()) fail(tumble::format("has no part {}", k));
    std::string bytes(parts_[k].size, '\0');
    file_.seekg(static_cast<std::streamoff>(parts_[k].offset));
    if (!file_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) fail("cannot be read");
    if (crc_of(bytes) != parts_[k].crc) fail(tumble::format("is damaged: part {} has another checksum", k));
    return bytes;
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw std::runtime_error(tumble::format("{}: {}", output::path_text(path_), why));
  }

 private:
  struct Part {
    std::uint64_t offset, size, crc;
  };

  void read(std::span<std::uint64_t> words) {
    if (!file_.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size_bytes()))) {
      fail("is cut off");
    }
  }

  const std::filesystem::path& path_;
  std::ifstream file_;
  std::vector<Part> parts_;
};

template <class Number>
std::string numbers_as_bytes(const std::vector<double>& values) {
  std::string bytes(sizeof(Number) * values.size(), '\0');
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto number = static_cast<Number>(values[k]);
    std::memcpy(bytes.data() + k * sizeof(Number), &number, sizeof(Number));
  }
  return bytes;
}

template <class Number>
std::vector<double> numbers_from_bytes(std::string_view bytes) {
  std::vector<double> values(bytes.size() / sizeof(Number));
  for (std::size_t k = 0; k < values.size(); ++k) {
    Number number;
    std::memcpy(&number, bytes.data() + k * sizeof(Number), sizeof(Number));
    values[k] = static_cast<double>(number);
  }
  return values;
}

}  // namespace

void write_chunk_file(const std::filesystem::path& path, const ChunkId& id, std::span<const std::string> parts) {
  std::vector<std::uint64_t> head = {k_magic, id.fingerprint, id.chunk, parts.size()};
  for (const std::string& part : parts) {
    head.push_back(part.size());
    head.push_back(crc_of(part));
  }
  head.push_back(crc_of(bytes_of(head)));
  output::OutputFile file(path, true);
  file.write(bytes_of(head));
  for (const std::string& part : parts) file.write(part);
  file.commit();
}

std::string read_chunk_part(const std::filesystem::path& path, const ChunkId& id, std::size_t part) {
  return Reader(path, id).part(part);
}

std::optional<std::string> fault_of_chunk_file(const std::filesystem::path& path, const ChunkId& id,
                                               std::size_t num_parts) {
  try {
    Reader reader(path, id);
    if (reader.num_parts() != num_parts)
      reader.fail(tumble::format("has {} parts, not {}", reader.num_parts(), num_parts));
    for (std::size_t k = 0; k < num_parts; ++k) static_cast<void>(reader.part(k));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return std::nullopt;
}

std::string to_bytes(const Column& column) {
  return column.is_whole ? numbers_as_bytes<std::int32_t>(column.values) : numbers_as_bytes<double>(column.values);
}

std::vector<double> from_bytes(std::string_view bytes, bool is_whole) {
  return is_whole ? numbers_from_bytes<std::int32_t>(bytes) : numbers_from_bytes<double>(bytes);
}

}  // namespace tumble::sweep
