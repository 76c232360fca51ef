// `residual` for solvers: no checks, no allocation once warm. Not a public header.
#pragma once

#include <span>
#include <vector>

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/residual.hpp"
#include "tumble/lcp/row_sizes.hpp"

namespace tumble {

struct JudgeBuffers {
  std::vector<double> row_scales;    // d_i of the last call
  std::vector<std::size_t> columns;  // j with z_j != 0
};

// The residual of z in a valid problem, with `sizes` in place of the problem's own, and w = M z + q.
LcpResidual judge(const LcpProblem& problem, const RowSizes& sizes, std::span<const double> z, std::vector<double>& w,
                  JudgeBuffers& buffers);

}  // namespace tumble
