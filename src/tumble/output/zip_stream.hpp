// Zip archives written from front to back, of any size: entries are stored as they are. Not a public header.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace tumble::output {

// The archive depends on names and bytes alone: its time stamps are those of 1980.
class ZipStream {
 public:
  explicit ZipStream(std::function<void(std::string_view bytes)> sink) : sink_(std::move(sink)) {}

  // An entry of `size` bytes: begin, write those, end. Throws std::logic_error if they are more or fewer.
  void begin(const std::string& name, std::uint64_t size);
  void write(std::string_view bytes);
  void end();
  void finish();

 private:
  void put(std::string_view bytes);

  std::function<void(std::string_view)> sink_;
  std::uint64_t at_ = 0;     // bytes written
  std::uint64_t start_ = 0;  // of the entry
  std::uint64_t size_ = 0;   // of the entry's content
  std::uint64_t left_ = 0;
  std::uint32_t crc_ = 0;
  std::string name_;
  std::string directory_;
  std::uint64_t entries_ = 0;
};

}  // namespace tumble::output
