// An LCP in equilibrated units, the form in which the pivoting methods work. Not a public header.
#pragma once

#include <cstdint>
#include <vector>

#include "tumble/lcp/equilibrate.hpp"

namespace tumble {

// M and q times powers of two: nothing is rounded. |q| is at most 1 in each block.
struct ScaledProblem {
  std::vector<double> M;  // n x n, row after row
  std::vector<double> q;
  std::vector<int> z_exponent;  // z_i = z_scaled_i * 2^z_exponent_i
  std::vector<int> w_exponent;  // w_scaled_i = w_i * 2^w_exponent_i
  Equilibration scales;
  std::vector<double> sizes;        // scratch
  std::vector<int> size_exponents;  // scratch

  std::size_t size() const { return q.size(); }
  double operator()(std::size_t row, std::size_t column) const { return M[row * q.size() + column]; }
};

// Fills `scaled` without allocating once it is warm.
void scale(const LcpProblem& problem, ScaledProblem& scaled);

// x * 2^exponent, as std::ldexp; faster where nothing leaves the range of normal numbers.
double scaled_by(double x, int exponent);

// z in the units of the problem. Negative parts are cut off.
void unscale(const ScaledProblem& scaled, const std::vector<double>& z_scaled, std::vector<double>& z);

}  // namespace tumble
