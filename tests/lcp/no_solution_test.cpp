// No method says solved of a problem that has no solution. Singular matrices are where that is hard: far out along a
// ray a z misses by no more than the last digits of M z.
#include <cmath>

#include "problems.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/exact.hpp"
#include "tumble/lcp/infeasibility.hpp"
#include "tumble/lcp/methods.hpp"

namespace tumble {
namespace {

LcpProblem integer_problem(problems::Random& random, std::size_t n) {
  LcpProblem problem;
  for (std::size_t k = 0; k < n * n; ++k) problem.M.push_back(std::floor(random.uniform(-1.0, 3.0)));
  for (std::size_t k = 0; k < n; ++k) problem.q.push_back(std::floor(random.uniform(-2.0, 3.0)));
  return problem;
}

// Rows in pairs that differ in q alone.
LcpProblem problem_of_equal_rows(problems::Random& random) {
  LcpProblem problem = integer_problem(random, 4);
  for (std::size_t j = 0; j < 4; ++j) {
    problem.M[4 + j] = problem.M[j];
    problem.M[12 + j] = problem.M[8 + j];
  }
  for (double& q_i : problem.q) q_i = random.uniform(-2.0, 2.0);
  return problem;
}

// What is checked for one problem. `num_unsolvable` counts those without a solution.
void expect_no_invention(const LcpProblem& problem, int& num_unsolvable) {
  const LcpStatus truth = solve_exactly(as_exact(problem)).status;
  const LcpStatus found = solve_lcp(problem, RobustSettings{}).status;
  EXPECT_EQ(found, truth);
  if (truth == LcpStatus::solved) return;
  ++num_unsolvable;
  for (const LcpMethod& method : lcp_methods()) {
    EXPECT_NE(solve_lcp(problem, method.defaults).status, LcpStatus::solved) << method.name;
  }
}

TEST(NoSolution, OfIntegerProblemsIsSeenByEveryMethod) {
  problems::Random random(61);
  int num_unsolvable = 0;
  for (const std::size_t n : {2, 3, 4}) {
    for (int i = 0; i < 1000 && !testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE(testing::Message() << "n = " << n << ", number " << i);
      expect_no_invention(integer_problem(random, n), num_unsolvable);
    }
  }
  EXPECT_GT(num_unsolvable, 500);
}

TEST(NoSolution, OfEqualRowsIsSeenByEveryMethod) {
  problems::Random random(62);
  int num_unsolvable = 0;
  for (int i = 0; i < 1000 && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "number " << i);
    expect_no_invention(problem_of_equal_rows(random), num_unsolvable);
  }
  EXPECT_GT(num_unsolvable, 300);
}

// P-matrices that are nearly singular, up to the last bit and past it: their one solution may be too large to be found
// in doubles, but it is there.
TEST(NoSolution, IsNotProvedWhereRoundingAloneHidesOne) {
  problems::Random random(64);
  int num_found = 0;
  for (int exponent = 0; exponent <= 60; ++exponent) {
    for (int i = 0; i < 40; ++i) {
      const double a = random.uniform(0.1, 10.0), b = random.uniform(0.1, 10.0), c = random.uniform(0.1, 10.0);
      const LcpProblem problem{{a, -b, -c * a, c * b * (1.0 + std::ldexp(1.0, -exponent))},
                               {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)},
                               {}};
      const LcpStatus found = solve_lcp(problem).status, truth = solve_exactly(as_exact(problem)).status;
      if (truth != LcpStatus::solved) continue;
      EXPECT_TRUE(found == LcpStatus::solved || found == LcpStatus::numerical)
          << to_string(found) << ", 2^-" << exponent << ", number " << i;
      num_found += found == LcpStatus::solved;
    }
  }
  EXPECT_GT(num_found, 1000);
}

// A body between two walls that are too near: whatever moves it out of one moves it into the other.
TEST(NoSolution, OfAJammedBodyIsProved) {
  problems::Random random(63);
  for (int i = 0; i < 500; ++i) {
    const double angle = random.uniform(0.0, 6.28);
    const double c = std::cos(angle), s = std::sin(angle), lever = random.uniform(-1.0, 1.0);
    const Vector3 normal{c, s, lever}, tangent{s, -c, random.uniform(-1.0, 1.0)}, none{};
    const auto reversed = [](const Vector3& v) { return Vector3{-v[0], -v[1], -v[2]}; };
    const ContactSystem system{{{1, 1, 6}},
                               {{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)}},
                               {{-1, 0, none, normal, none, tangent, 0.5, -random.uniform(0.01, 0.2)},
                                {-1, 0, none, reversed(normal), none, reversed(tangent), 0.3, -0.1}}};
    const LcpResult result = solve_lcp(as_lcp(system));
    ASSERT_EQ(result.status, LcpStatus::infeasible) << i;
    EXPECT_TRUE(is_infeasibility_certificate(as_lcp(system), result.certificate)) << i;
  }
}

}  // namespace
}  // namespace tumble
