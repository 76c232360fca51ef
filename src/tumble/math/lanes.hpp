// Numbers side by side in a vector register, or one alone, under the same operations. For translation units that are
// compiled for an instruction set of their own: everything is inlined, as a function with a name could be taken by the
// linker for all of them. Not a public header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#define TUMBLE_INLINE inline __attribute__((always_inline))

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors as arguments of functions, all of which are inlined
#elif defined(__clang__)
#pragma clang diagnostic ignored "-Wbitwise-instead-of-logical"  // of one lane, as of many
#endif

namespace tumble {

// k_count numbers in a `Value`, with + - * / and comparisons, which give a `Mask`; masks take & and |. `Bits` are
// the numbers' bits as integers.
template <class RealType, int k_num>
struct Lanes {
  using Real = RealType;
  using Int = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
  static constexpr int k_count = k_num;
  // As typedefs: g++ 12 ignores the attribute in a using.
  typedef Real Value __attribute__((vector_size(k_num * sizeof(Real))));
  typedef Int Mask __attribute__((vector_size(k_num * sizeof(Real))));  // 0 or -1 in each lane
  using Bits = Mask;

  static TUMBLE_INLINE Value load(const Real* from) {
    Value lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
  }
  static TUMBLE_INLINE void store(Real* to, Value lanes) { std::memcpy(to, &lanes, sizeof lanes); }
  static TUMBLE_INLINE Value all(Real x) { return Value{} + x; }
  static TUMBLE_INLINE Value select(Mask mask, Value a, Value b) { return mask ? a : b; }
  static TUMBLE_INLINE Value keep(Mask mask, Value a) { return (Value)((Mask)a & mask); }  // elsewhere 0
  static TUMBLE_INLINE Bits bits(Value x) { return (Bits)x; }
  static TUMBLE_INLINE Value absolute(Value x) {
    constexpr Int all_but_sign = sizeof(Real) == 8 ? static_cast<Int>(INT64_MAX) : static_cast<Int>(INT32_MAX);
    return (Value)((Bits)x & all_but_sign);
  }
  static TUMBLE_INLINE bool any(Mask mask) {
    if constexpr (sizeof(Mask) == 16) {
      std::uint64_t halves[2];
      std::memcpy(halves, &mask, sizeof mask);
      return (halves[0] | halves[1]) != 0;
    } else {  // by halves, which the compiler turns into one instruction where there is one
      typedef Int Half __attribute__((vector_size(sizeof(Mask) / 2)));
      Half low, high;
      std::memcpy(&low, &mask, sizeof low);
      std::memcpy(&high, reinterpret_cast<const char*>(&mask) + sizeof low, sizeof high);
      return Lanes<Real, k_num / 2>::any(low | high);
    }
  }
  static TUMBLE_INLINE Value smaller(Value a, Value b) { return select(a < b, a, b); }
  static TUMBLE_INLINE Value larger(Value a, Value b) { return select(a > b, a, b); }
};

template <class RealType>
struct Lanes<RealType, 1> {
  using Real = RealType;
  using Int = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
  static constexpr int k_count = 1;
  using Value = Real;
  using Mask = int;
  using Bits = Int;

  static TUMBLE_INLINE Value load(const Real* from) { return *from; }
  static TUMBLE_INLINE void store(Real* to, Value x) { *to = x; }
  static TUMBLE_INLINE Value all(Real x) { return x; }
  static TUMBLE_INLINE Value select(Mask mask, Value a, Value b) { return mask ? a : b; }
  static TUMBLE_INLINE Value keep(Mask mask, Value a) { return mask ? a : Real(0); }
  static TUMBLE_INLINE Bits bits(Value x) {
    Bits bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
  }
  static TUMBLE_INLINE Value absolute(Value x) {
    if constexpr (sizeof(Real) == 8) {
      return __builtin_fabs(x);
    } else {
      return __builtin_fabsf(x);
    }
  }
  static TUMBLE_INLINE bool any(Mask mask) { return mask != 0; }
  static TUMBLE_INLINE Value smaller(Value a, Value b) { return a < b ? a : b; }
  static TUMBLE_INLINE Value larger(Value a, Value b) { return a > b ? a : b; }
};

}  // namespace tumble
