// Small fixed-size vectors and matrices: plain arrays, so that they cross compilers, languages and build flags
// unchanged.
#pragma once

#include <array>

namespace tumble {

using Vector3 = std::array<double, 3>;
using Vector4 = std::array<double, 4>;
using Matrix4 = std::array<Vector4, 4>;  // rows

// a . b, summed from the first entry to the last: the order is part of the bit-equality promise.
inline double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace tumble
