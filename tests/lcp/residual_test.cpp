#include "tumble/lcp/residual.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "../random_contact.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/one_contact.hpp"

namespace tumble {
namespace {

const LcpProblem k_problem{{2, 1, 1, 2}, {-5, -6}, {}};  // solution (4/3, 7/3)

TEST(Residual, IsRoundOffAtTheSolution) {
  EXPECT_LT(residual(k_problem, std::vector{4 / 3., 7 / 3.}).largest(), 1e-15);
}

TEST(Residual, NamesThePartThatIsViolated) {
  const LcpResidual short_of = residual(k_problem, std::vector{1.0, 2.0});
  EXPECT_GT(short_of.negative_w, 0.05);
  EXPECT_EQ(short_of.negative_z, 0.0);
  EXPECT_EQ(short_of.complementarity, 0.0);

  const LcpResidual beyond = residual(k_problem, std::vector{2.0, 3.0});
  EXPECT_EQ(beyond.negative_w, 0.0);
  EXPECT_GT(beyond.complementarity, 0.1);

  EXPECT_GT(residual(k_problem, std::vector{-1.0, 5.0}).negative_z, 0.1);
  EXPECT_EQ(residual({{0}, {1}, {}}, std::vector{-1.0}).negative_z, std::numeric_limits<double>::infinity());
}

TEST(Residual, IsInfiniteWhereZIsNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e308}) {
    EXPECT_EQ(residual(k_problem, std::vector{bad, bad}).largest(), std::numeric_limits<double>::infinity());
  }
}

// Other units: rows times 2^a, columns times 2^b, q and row sizes with the rows, z against the columns.
TEST(Residual, DoesNotChangeWithTheUnits) {
  test::Random random(10);
  for (int i = 0; i < 500; ++i) {
    const LcpProblem problem = as_lcp(test::random_contact(random, 1.0));
    LcpProblem scaled = problem;
    const std::vector<int> row = {5, 5, 5, -20};
    const std::vector<int> column = {30, 30, 30, 0};
    std::vector<double> z(4), scaled_z(4);
    for (std::size_t j = 0; j < 4; ++j) {
      z[j] = random.log_uniform(-10.0, 10.0);
      scaled_z[j] = std::ldexp(z[j], -column[j]);
      scaled.q[j] = std::ldexp(problem.q[j], row[j]);
      scaled.row_sizes[j] = std::ldexp(problem.row_sizes[j], row[j]);
      for (std::size_t k = 0; k < 4; ++k) scaled.M[4 * j + k] = std::ldexp(problem.M[4 * j + k], row[j] + column[k]);
    }
    EXPECT_EQ(residual(problem, z).largest(), residual(scaled, scaled_z).largest());
  }
}

// Round-off beside a row of size 1 is small, a violation far above round-off is not.
TEST(Residual, TellsRoundOffInAnIdleRowFromAnError) {
  EXPECT_LT(residual({{1, 1e-19, 0, 1}, {-1, -1e-17}, {}}, std::vector{1.0, 0.0}).largest(), 1e-10);
  EXPECT_GT(residual({{1, 1e-19, 0, 1}, {-1, -1e-12}, {}}, std::vector{1.0, 0.0}).largest(), 1e-7);
  EXPECT_GT(residual({{1, 0, 0, 1}, {-1, -1e-17}, {}}, std::vector{1.0, 0.0}).largest(), 0.9) << "not coupled";
  EXPECT_LT(residual({{1, 0, 0, 1}, {-1, -1e-17}, {1, 1}}, std::vector{1.0, 0.0}).largest(), 1e-16) << "as told";
}

TEST(Residual, RefusesAVectorOfAnotherLength) {
  EXPECT_THROW(residual(k_problem, std::vector{1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace tumble
