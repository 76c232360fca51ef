// The linear complementarity problem: find z with  w = M z + q >= 0,  z >= 0,  z . w = 0.  [Cottle 1992, 1.1]
#pragma once

#include <cstddef>
#include <vector>

namespace tumble {

struct LcpProblem {
  std::vector<double> M;  // n x n, row after row
  std::vector<double> q;  // n

  // Typical size of each w_i, in its own unit (n values >= 0), or empty. It tells the residual what counts as round-off
  // in a row whose terms all vanish: a contact model knows it (an approach speed, say). Left empty, `default_row_sizes`
  // finds them.
  std::vector<double> row_sizes;

  std::size_t size() const { return q.size(); }
  double operator()(std::size_t row, std::size_t column) const { return M[row * q.size() + column]; }
};

// Throws std::invalid_argument, naming the field, if M is not n x n for the n of q, if row_sizes has another length,
// or if any entry is NaN or infinite. n = 0 is refused.
void validate(const LcpProblem& problem);

}  // namespace tumble
