// Layout: PKWARE, APPNOTE.TXT, sections 4.3.7 (local header), 4.3.9 (data descriptor: the CRC is known only behind the
// bytes), 4.3.12 (directory), 4.3.14 to 4.3.16 (its ends) and 4.5.3 (sizes of more than 32 bits).
#include "tumble/output/zip_stream.hpp"

#include <stdexcept>

#include <zlib.h>

namespace tumble::output {
namespace {

constexpr std::uint64_t k_most = 0xffffffffu;  // in 32 bits; itself it stands for "in the extra field"
constexpr std::uint16_t k_has_descriptor = 1u << 3;
constexpr std::uint16_t k_first_day = 0x21;  // 1980-01-01
constexpr std::uint16_t k_wide_field = 1;    // header of the extra field of 64-bit sizes

class Bytes {
 public:
  template <class Unsigned>
  Bytes& put(Unsigned value) {
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) text_ += static_cast<char>((value >> (8 * i)) & 0xff);
    return *this;
  }
  Bytes& put16(std::uint64_t value) { return put(static_cast<std::uint16_t>(value)); }
  Bytes& put32(std::uint64_t value) { return put(static_cast<std::uint32_t>(value)); }
  Bytes& put64(std::uint64_t value) { return put(value); }
  Bytes& text(std::string_view bytes) {
    text_ += bytes;
    return *this;
  }
  operator std::string_view() const { return text_; }

 private:
  std::string text_;
};

// Version that is needed to read it.
std::uint64_t version(bool is_wide) { return is_wide ? 45 : 20; }

std::uint64_t in_32_bits(std::uint64_t value) { return value < k_most ? value : k_most; }

}  // namespace

void ZipStream::put(std::string_view bytes) {
  sink_(bytes);
  at_ += bytes.size();
}

void ZipStream::begin(const std::string& name, std::uint64_t size) {
  name_ = name;
  start_ = at_;
  size_ = left_ = size;
  crc_ = 0;
  const bool is_wide = size >= k_most;
  Bytes header;
  header.put32(0x04034b50).put16(version(is_wide)).put16(k_has_descriptor).put16(0).put16(0).put16(k_first_day);
  header.put32(0).put32(is_wide ? k_most : 0).put32(is_wide ? k_most : 0).put16(name.size()).put16(is_wide ? 20 : 0);
  header.text(name);
  if (is_wide) header.put16(k_wide_field).put16(16).put64(0).put64(0);
  put(header);
}

void ZipStream::write(std::string_view bytes) {
  if (bytes.size() > left_) throw std::logic_error("more bytes than the zip entry announced");
  left_ -= bytes.size();
  crc_ = static_cast<std::uint32_t>(crc32_z(crc_, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  put(bytes);
}

void ZipStream::end() {
  if (left_ != 0) throw std::logic_error("fewer bytes than the zip entry announced");
  const bool is_wide = size_ >= k_most;
  Bytes descriptor;
  descriptor.put32(0x08074b50).put32(crc_);
  if (is_wide) {
    descriptor.put64(size_).put64(size_);
  } else {
    descriptor.put32(size_).put32(size_);
  }
  put(descriptor);

  Bytes extra;
  if (is_wide) extra.put64(size_).put64(size_);
  if (start_ >= k_most) extra.put64(start_);
  const std::string_view wide = extra;
  const std::uint64_t needed = version(!wide.empty());
  Bytes entry;
  entry.put32(0x02014b50).put16(needed).put16(needed).put16(k_has_descriptor).put16(0).put16(0).put16(k_first_day);
  entry.put32(crc_).put32(in_32_bits(size_)).put32(in_32_bits(size_)).put16(name_.size());
  entry.put16(wide.empty() ? 0 : 4 + wide.size()).put16(0).put16(0).put16(0).put32(0).put32(in_32_bits(start_));
  entry.text(name_);
  if (!wide.empty()) entry.put16(k_wide_field).put16(wide.size()).text(wide);
  directory_ += std::string_view(entry);
  ++entries_;
}

void ZipStream::finish() {
  const std::uint64_t start = at_;
  put(directory_);
  const std::uint64_t behind = at_;
  Bytes ends;
  if (start >= k_most || directory_.size() >= k_most || entries_ >= 0xffff) {
    ends.put32(0x06064b50).put64(44).put16(45).put16(45).put32(0).put32(0).put64(entries_).put64(entries_);
    ends.put64(directory_.size()).put64(start);
    ends.put32(0x07064b50).put32(0).put64(behind).put32(1);
  }
  const std::uint64_t entries = entries_ < 0xffff ? entries_ : 0xffff;
  ends.put32(0x06054b50).put16(0).put16(0).put16(entries).put16(entries).put32(in_32_bits(directory_.size()));
  ends.put32(in_32_bits(start)).put16(0);
  put(ends);
}

}  // namespace tumble::output
