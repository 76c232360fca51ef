#include "tumble/lcp/lemke_lu.hpp"

#include "problems.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/contact_system.hpp"
#include "tumble/lcp/robust.hpp"

namespace tumble {
namespace {

// Any positive vector may cover the start: with another one the path is another, not its end.
TEST(LemkeLu, SolvesContactsFromEveryCover) {
  constexpr int count = 300;
  for (const int cover : {0, 1, 2, 3}) {
    int num_failures = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      const LcpProblem problem = as_lcp(problems::wild_of(41, i, 4));
      if (lemke_lu(problem, {.cover = cover}).status != LcpStatus::solved) ++num_failures;
    }
    // Nearly parallel contacts are beyond 53 bits now and then: fewer than 1 in 100.
    EXPECT_LT(num_failures, count / 100) << cover;
  }
}

// Unknowns of 1e-14 beside others of 1: the round-off of one is the value of another.
TEST(LemkeLu, SolvesADefiniteProblemWhoseUnknownsDifferMuchInSize) {
  constexpr std::size_t n = 5;
  const double D[n][n] = {{4.768e-7, 0, 0, 0, 0}, {0, 0, 0, 0, 0}, {1, 0, 0, 0, 0}, {-3.576e-7, 0, 1, 1, 0}, {}};
  LcpProblem problem{std::vector<double>(n * n, 0.0), {0, 0, 0, 0, -1}, {}};
  for (std::size_t i = 0; i + 1 < n; ++i) {
    for (std::size_t j = 0; j + 1 < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) problem.M[(i + 1) * n + j + 1] += D[i][k] * D[j][k];
    }
  }
  for (std::size_t i = 0; i < n; ++i) problem.M[i * n + i] += 0.1;
  const LcpResult result = lemke_lu(problem);
  EXPECT_EQ(result.status, LcpStatus::solved);
  EXPECT_LT(result.residual, 1e-15);
}

TEST(LemkeLu, StartsAnewWhereTheStartBasisIsSingular) {
  const LcpProblem problem{{1, 1, 1, 1}, {-1, -1}, {}};
  const LcpResult result = lemke_lu(problem, {.start_basis = {1, 1}});
  EXPECT_EQ(result.status, LcpStatus::solved);
  EXPECT_EQ(result.residual, 0.0);
}

// The basis of a contact problem is one to start from: regular, also where contacts are open.
TEST(LemkeLu, TakesTheBasisOfTheDefaultSolverWithoutAPivot) {
  int num_open = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    problems::Random random = problems::random_of(43, i);
    const LcpProblem problem = as_lcp(problems::painleve(random, 1 + i % 3));
    const LcpResult first = robust(problem);
    ASSERT_EQ(first.status, LcpStatus::solved) << i;
    if (first.rung == LcpRung::none) continue;
    for (std::size_t c = 0; c < problem.size() / 4; ++c) num_open += first.z[c] == 0.0;
    const LcpResult again = lemke_lu(problem, {.start_basis = first.basis});
    EXPECT_EQ(again.status, LcpStatus::solved) << i;
    EXPECT_EQ(again.pivots, 0) << i;
  }
  EXPECT_GT(num_open, 20);
}

}  // namespace
}  // namespace tumble
