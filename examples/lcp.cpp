// Solves one LCP and lists all solutions of another: w = M z + q >= 0, z >= 0, w . z = 0. Twin: lcp.py.
#include <cstdio>
#include <string>

#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/solve.hpp"

int main() {
  const tumble::LcpResult result = tumble::solve_lcp({{2, 1, 1, 2}, {-5, -6}, {}});
  const std::string status(to_string(result.status));
  std::printf("%s: z = (%.6f, %.6f)\n", status.c_str(), result.z[0], result.z[1]);

  const auto solutions = tumble::enumerate_solutions({{-2, -1, -1, -2}, {1, 1}, {}});
  std::printf("%zu solutions:\n", solutions.size());
  for (const tumble::LcpResult& s : solutions) {
    std::printf("z = (%.6f, %.6f), w = (%.6f, %.6f)\n", s.z[0], s.z[1], s.w[0], s.w[1]);
  }
}
