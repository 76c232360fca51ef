#include "tumble/lcp/enumerate.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "../random_contact.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/exact.hpp"

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

TEST(SolutionSet, JoinsVerticesAndRaysToFaces) {
  const SolutionSet segment = solution_set({{1, 1, 1, 1}, {-1, -1}, {}});
  ASSERT_EQ(segment.vertices.size(), 2u);
  ASSERT_EQ(segment.faces.size(), 1u);
  EXPECT_EQ(segment.faces[0].vertices, (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(segment.rays.empty());

  const SolutionSet half_line = solution_set({{1, -1, -1, 1}, {1, -1}, {}});
  ASSERT_EQ(half_line.faces.size(), 1u);
  EXPECT_EQ(half_line.faces[0].vertices.size(), 1u);
  EXPECT_EQ(half_line.faces[0].rays, (std::vector<std::size_t>{0}));
  EXPECT_EQ(half_line.rays, (std::vector<std::vector<double>>{{1, 1}}));

  EXPECT_EQ(solution_set({{-2, -1, -1, -2}, {1, 1}, {}}).faces.size(), 4u);

  const SolutionSet none = solution_set({{-1}, {-1}, {}});
  EXPECT_EQ(none.status, LcpStatus::no_solution_proved);
  EXPECT_TRUE(none.faces.empty());
}

// Half of the problems of whole numbers, half of those singular; small n, so that all kinds occur often.
LcpProblem random_problem(test::Random& random, int kind, std::size_t n) {
  LcpProblem problem;
  const auto draw = [&] { return kind == 0 ? random.uniform(-1.0, 1.0) : std::floor(random.uniform(-2.0, 3.0)); };
  for (std::size_t k = 0; k < n * n; ++k) problem.M.push_back(draw());
  for (std::size_t k = 0; k < n; ++k) problem.q.push_back(draw());
  if (kind != 2 || n == 1) return problem;
  for (std::size_t k = 0; k < n; ++k) {  // the last two rows equal, the last two columns opposite
    problem.M[(n - 1) * n + k] = problem.M[(n - 2) * n + k];
  }
  problem.q[n - 1] = problem.q[n - 2];
  for (std::size_t k = 0; k < n; ++k) problem.M[k * n + n - 1] = -problem.M[k * n + n - 2];
  return problem;
}

// Multiplies row i by r_i and column j by c_j, powers of two that follow no change of units.
void scale_apart(LcpProblem& problem, test::Random& random, double exponent) {
  const std::size_t n = problem.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double row = std::ldexp(1.0, static_cast<int>(random.uniform(-exponent, exponent)));
    const double column = std::ldexp(1.0, static_cast<int>(random.uniform(-exponent, exponent)));
    for (std::size_t j = 0; j < n; ++j) problem.M[i * n + j] *= row;
    for (std::size_t j = 0; j < n; ++j) problem.M[j * n + i] *= column;
    problem.q[i] *= row;
  }
}

// Uniform numbers seldom make a basis so nearly singular that a digit of these is lost.
constexpr double k_same = 1e-9;

bool is_same(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(a[i] - b[i]) > k_same * std::max(std::abs(a[i]), std::abs(b[i]))) return false;
  }
  return true;
}

void expect_same_set(const LcpProblem& problem, int i) {
  const ExactSolutionSet exact = exact_solution_set(as_exact(problem));
  const SolutionSet set = solution_set(problem);
  ASSERT_EQ(set.status == LcpStatus::solved, exact.status == LcpStatus::solved) << i;
  ASSERT_EQ(set.vertices.size(), exact.vertices.size()) << i;
  for (const ExactResult& vertex : exact.vertices) {
    const std::vector<double> z = as_doubles(vertex.z);
    ASSERT_TRUE(std::any_of(set.vertices.begin(), set.vertices.end(), [&](const LcpResult& found) {
      return is_same(found.z, z);
    })) << i;
  }
  ASSERT_EQ(set.rays.size(), exact.rays.size()) << i;
  ASSERT_EQ(set.faces.size(), exact.faces.size()) << i;
  for (std::size_t f = 0; f < set.faces.size(); ++f) {
    ASSERT_EQ(set.faces[f].vertices.size(), exact.faces[f].vertices.size()) << i;
    ASSERT_EQ(set.faces[f].rays.size(), exact.faces[f].rays.size()) << i;
  }
}

TEST(SolutionSet, IsTheExactOne) {
  test::Random random(31);
  for (int i = 0; i < 10'000; ++i) {
    expect_same_set(random_problem(random, i % 3, 1 + static_cast<std::size_t>(i / 3) % 5), i);
    if (HasFatalFailure()) return;
  }
  for (int i = 0; i < 12; ++i) {
    expect_same_set(random_problem(random, i % 3, 9 + static_cast<std::size_t>(i / 3)), i);
    if (HasFatalFailure()) return;
  }
}

// Rows and columns up to 2^40 = 1e12 apart from each other.
TEST(SolutionSet, IsTheExactOneForRowsAndColumnsScaledApart) {
  test::Random random(32);
  for (int i = 0; i < 3'000; ++i) {
    LcpProblem problem = random_problem(random, i % 3, 1 + static_cast<std::size_t>(i / 3) % 5);
    scale_apart(problem, random, 20.0);
    expect_same_set(problem, i);
    if (HasFatalFailure()) return;
  }
  for (int i = 0; i < 12; ++i) {
    LcpProblem problem = random_problem(random, i % 3, 9 + static_cast<std::size_t>(i / 3));
    scale_apart(problem, random, 20.0);
    expect_same_set(problem, i);
    if (HasFatalFailure()) return;
  }
}

// Basis {1, 2} misses by z_2 = -1e-8 beside z_1 = 1: nothing that doubles with a tolerance could exclude.
TEST(Enumerate, AsksExactArithmeticWhereDoubleCannotTell) {
  EXPECT_EQ(enumerate({{1, 0, 0, -1}, {-1, -1e-8}, {}}).status, LcpStatus::no_solution_proved);
}

}  // namespace
}  // namespace tumble
