#include "tumble/lcp/enumerate.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace tumble {
namespace {

TEST(Enumerate, RefusesMoreThanTwelveUnknowns) {
  LcpProblem problem{std::vector<double>(13 * 13, 0.0), std::vector<double>(13, 1.0), {}};
  EXPECT_THROW(enumerate_solutions(problem), std::invalid_argument);
  EXPECT_THROW(enumerate({{1}, {1}, {}}, {.accepted_residual = 0.0}), std::invalid_argument);
}

// Two corners of a box at rest: normal forces 1/2 each, friction undetermined. M is singular, and most of the five
// vertices belong to singular bases.
TEST(Enumerate, CompletesSingularBases) {
  const double k = 6.0 * 0.5 * 0.5;  // M^-1_theta r_x r_x
  const double nn = 1.0 + k, nm = 1.0 - k, tt = 1.0 + k, a = 6.0 * 0.5 * 0.5;
  // Rows: normal 1, normal 2, then +t and -t of each, then the two cones; A_nt = M^-1_theta (-+1/2)(1/2).
  const LcpProblem problem{{
                               nn, nm, -a,  a,   -a,  a,   0, 0,  //
                               nm, nn, a,   -a,  a,   -a,  0, 0,  //
                               -a, a,  tt,  -tt, tt,  -tt, 1, 0,  //
                               a,  -a, -tt, tt,  -tt, tt,  1, 0,  //
                               -a, a,  tt,  -tt, tt,  -tt, 0, 1,  //
                               a,  -a, -tt, tt,  -tt, tt,  0, 1,  //
                               .5, 0,  -1,  -1,  0,   0,   0, 0,  //
                               0,  .5, 0,   0,   -1,  -1,  0, 0,
                           },
                           {-1, -1, 0, 0, 0, 0, 0, 0},
                           {}};
  const std::vector<LcpResult> solutions = enumerate_solutions(problem);
  EXPECT_EQ(solutions.size(), 5u);  // by rational enumeration
  for (const LcpResult& solution : solutions) {
    EXPECT_NEAR(solution.z[0], 0.5, 1e-12);
    EXPECT_NEAR(solution.z[1], 0.5, 1e-12);
    const double friction = solution.z[2] - solution.z[3] + solution.z[4] - solution.z[5];
    EXPECT_NEAR(friction, 0.0, 1e-12);
    EXPECT_LE(solution.residual, 1e-12);
  }
}

TEST(Enumerate, ClaimsNoProofWhereNumbersLeaveTheRangeOfDouble) {
  EXPECT_EQ(enumerate({{1e308, 1e308, 1e308, 1e308}, {-1e308, -1e308}, {}}).status, LcpStatus::numerical);
  EXPECT_EQ(enumerate({{1e-300}, {-1e300}, {}}).status, LcpStatus::numerical);
}

TEST(Enumerate, ListsEachSolutionOnceInTheOrderOfItsBasis) {
  const std::vector<LcpResult> solutions = enumerate_solutions({{-2, -1, -1, -2}, {1, 1}, {}});
  ASSERT_EQ(solutions.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(solutions[i].basis[0] + 2 * solutions[i].basis[1], static_cast<int>(i));
    EXPECT_EQ(solutions[i].pivots, 4);
  }
}

}  // namespace
}  // namespace tumble
