// std::bit_cast, which the library of emscripten 3.1.6 does not have.
#pragma once

namespace tumble {

template <class To, class From>
constexpr To bit_cast(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

}  // namespace tumble
