// Random LCPs of no particular origin.
#pragma once

#include <vector>

#include "random.hpp"

#include "tumble/lcp/problem.hpp"

namespace tumble::test {

using problems::Random;

// M = R R^T + ridge I + a skew part, R n x rank with entries in [-1, 1): positive definite if ridge > 0, else
// semidefinite. q in [-1, 1).
inline LcpProblem random_semidefinite(Random& random, std::size_t n, std::size_t rank, double ridge, double skew) {
  std::vector<double> root(n * rank);
  for (double& entry : root) entry = random.uniform(-1.0, 1.0);
  LcpProblem problem{std::vector<double>(n * n, 0.0), {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = 0.0;
      for (std::size_t k = 0; k < rank; ++k) sum += root[i * rank + k] * root[j * rank + k];
      const double turn = i == j ? 0.0 : skew * random.uniform(-1.0, 1.0);
      problem.M[i * n + j] = sum + turn;
      problem.M[j * n + i] = sum - turn;
    }
    problem.M[i * n + i] += ridge;
    problem.q.push_back(random.uniform(-1.0, 1.0));
  }
  return problem;
}

// Positive definite, at least 0.1 in every direction, but not symmetric: exactly one solution.
inline LcpProblem random_definite(Random& random, std::size_t n) { return random_semidefinite(random, n, n, 0.1, 0.5); }

}  // namespace tumble::test
