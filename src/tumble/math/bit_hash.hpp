// A 64-bit hash over the bits of numbers: FNV-1a, a word at a time. Not a public header.
#pragma once

#include <cstdint>
#include <cstring>

namespace tumble {

class BitHash {
 public:
  void add(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    state_ = (state_ ^ bits) * 0x100000001b3u;
  }
  template <class Range>
  void add(const Range& values) {
    for (const double value : values) add(value);
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace tumble
