// Sine and cosine with the same bits on every machine: no libm, no fused multiply-add, only + - * and integers.
#pragma once

namespace tumble {

struct SinCos {
  double sin;
  double cos;
};

// Sine and cosine of `angle` [rad], any finite value.
// Absolute error below 1.3e-16 for |angle| < 2^19 and below 2.3e-16 beyond (both asserted in sin_cos_test.cpp).
// A NaN or infinite angle gives NaN in both fields.
SinCos sin_cos(double angle);

}  // namespace tumble
