// Exponential function and natural logarithm with the same bits on every compiler and machine.
#pragma once

namespace tumble {

// e^x within 1 ulp (below 2^-1022: within one spacing there). NaN for NaN, infinity above 709.78.
double exp(double x);

// Within 1 ulp. -infinity at 0; NaN for x < 0 and NaN.
double log(double x);

}  // namespace tumble
