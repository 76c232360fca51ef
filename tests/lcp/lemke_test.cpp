#include "tumble/lcp/lemke.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "random_problems.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/residual.hpp"

namespace tumble {
namespace {

TEST(Lemke, AgreesWithEnumerationWhereTheSolutionIsUnique) {
  test::Random random(5);
  for (int i = 0; i < 300; ++i) {
    const LcpProblem problem = test::random_definite(random, 1 + static_cast<std::size_t>(i) % 8);
    const LcpResult pivoted = lemke(problem);
    const std::vector<LcpResult> all = enumerate_solutions(problem);
    ASSERT_EQ(pivoted.status, LcpStatus::solved);
    ASSERT_EQ(all.size(), 1u);
    // M is at least 0.1 in every direction: errors of 1e-16 grow at most a thousandfold.
    for (std::size_t k = 0; k < problem.size(); ++k) EXPECT_NEAR(pivoted.z[k], all[0].z[k], 1e-12);
  }
}

TEST(Lemke, SolvesLargeProblems) {
  test::Random random(6);
  for (const std::size_t n : {50u, 120u, 200u}) {
    const LcpProblem problem = test::random_definite(random, n);
    const LcpResult result = lemke(problem);
    EXPECT_EQ(result.status, LcpStatus::solved);
    EXPECT_LT(residual(problem, result.z).largest(), 1e-12) << n;  // n^2 round-off at most
  }
}

TEST(Lemke, GivesTheScaledSolutionOfAScaledProblemBitForBit) {
  test::Random random(7);
  for (int i = 0; i < 200; ++i) {
    const LcpProblem problem = test::random_definite(random, 6);
    LcpProblem scaled = problem;  // other units of force and velocity, by powers of two
    for (double& entry : scaled.M) entry = std::ldexp(entry, 17 - 40);
    for (double& entry : scaled.q) entry = std::ldexp(entry, -40);
    const LcpResult a = lemke(problem);
    const LcpResult b = lemke(scaled);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(std::ldexp(a.z[k], -17), b.z[k]);
  }
}

// The first unknown is many orders below the others; no tolerance may swallow it.
TEST(Lemke, SolvesRowsOfVeryDifferentSizes) {
  for (const double small : {-1.8189894e-12, -1.42108547e-14, -1e-200}) {
    const LcpResult result = lemke({{.1, 0, 0, 0, .1, 0, 0, 0, .1}, {small, -1, -1}, {}});
    EXPECT_EQ(result.status, LcpStatus::solved);
    EXPECT_DOUBLE_EQ(result.z[0], -10 * small);
  }
}

// Entries of no consequence (1e-23, 1e-45) must not decide what counts as large.
TEST(Lemke, IsNotMisledByTinyEntries) {
  LcpProblem problem{std::vector<double>(25, 1.9757e-45), {0, 0, -1, -1, 0}, {}};
  for (std::size_t k = 1; k < 5; ++k) problem.M[k] = problem.M[5 * k] = 9.9585e-24;
  for (std::size_t k = 0; k < 5; ++k) problem.M[6 * k] = k == 0 ? 0.351 : 0.1;
  const LcpResult result = lemke(problem);
  EXPECT_EQ(result.status, LcpStatus::solved);
  EXPECT_DOUBLE_EQ(result.z[2], 10);
  EXPECT_DOUBLE_EQ(result.z[3], 10);
  EXPECT_GT(residual(problem, std::vector<double>{0, 0, 0, 10, 0}).largest(), 0.4);
}

// Rows and columns of very uneven sizes: an answer may be missed, but not invented.
TEST(Lemke, DoesNotCallAWrongVectorSolvedWhereSizesDiffer) {
  const std::vector<LcpProblem> problems = {
      {{11, 0, 10, 1, 0, 11e-8, 10e-8, 1e-8, 10, 10, 21, 1, -1e-8, -1e-8, -1e-8, 0}, {50, 50e-8, 10, -6e-8}, {}},
      {{256, -0x1p-28, 0, 0, 0, 0x1p-4, -0x1p34, .25, 16}, {-0x1p-4, -0x1p14, -0x1p22}, {}}};
  for (const LcpProblem& problem : problems) {
    const LcpResult result = lemke(problem);
    if (result.status != LcpStatus::solved) continue;
    for (std::size_t i = 0; i < problem.size(); ++i) {
      double size = std::abs(problem.q[i]);
      for (std::size_t j = 0; j < problem.size(); ++j) size += std::abs(problem(i, j) * result.z[j]);
      EXPECT_GE(result.w[i], -1e-8 * size);
    }
  }
}

// Each row is 1e-8 times coupled to the one before: a scale that follows the coupling would grow without bound.
TEST(Lemke, SolvesWeaklyCoupledChains) {
  constexpr std::size_t n = 12;
  LcpProblem problem{std::vector<double>(n * n, 0.0), std::vector<double>(n, -1.0), {}};
  for (std::size_t i = 0; i < n; ++i) {
    problem.M[i * n + i] = 1.0;
    if (i > 0) problem.M[i * n + i - 1] = 1e-8;
  }
  const LcpResult result = lemke(problem);
  EXPECT_EQ(result.status, LcpStatus::solved);
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(result.z[i], 1.0, 2e-8);
  std::vector<double> wrong = result.z;
  wrong[0] = 0.0;
  EXPECT_GT(residual(problem, wrong).largest(), 0.1);
}

TEST(Lemke, ReturnsWAndBasisThatBelongToZ) {
  test::Random random(8);
  const LcpProblem problem = test::random_definite(random, 10);
  const LcpResult result = lemke(problem);
  EXPECT_EQ(result.w, complement(problem, result.z));
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_EQ(result.basis[k] != 0, result.z[k] > 0.0);
    EXPECT_NEAR(result.basis[k] ? result.w[k] : result.z[k], 0.0, 1e-14);
  }
}

TEST(Lemke, StopsAtTheAllowedNumberOfPivots) {
  test::Random random(9);
  const LcpResult result = lemke(test::random_definite(random, 30), {.max_pivots = 3});
  EXPECT_EQ(result.status, LcpStatus::iteration_limit);
  EXPECT_EQ(result.pivots, 3);
  EXPECT_GT(result.residual, 1e-8);
}

TEST(Lemke, RefusesBadProblemsAndSettings) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(lemke({{}, {}, {}}), std::invalid_argument);
  EXPECT_THROW(lemke({{1, 2, 3}, {1, 1}, {}}), std::invalid_argument);
  EXPECT_THROW(lemke({{nan}, {1}, {}}), std::invalid_argument);
  EXPECT_THROW(lemke({{1}, {-std::numeric_limits<double>::infinity()}, {}}), std::invalid_argument);
  EXPECT_THROW(lemke({{1}, {1}, {-1.0}}), std::invalid_argument);
  EXPECT_THROW(lemke({{1}, {1}, {}}, {.max_pivots = -1}), std::invalid_argument);
  EXPECT_THROW(lemke({{1}, {1}, {}}, {.pivot_tolerance = 1.0}), std::invalid_argument);
  EXPECT_THROW(lemke({{1}, {1}, {}}, {.accepted_residual = nan}), std::invalid_argument);
}

TEST(Lemke, ReportsNumbersBeyondDoubleAsAStatus) {
  const LcpResult result = lemke({{1e-300}, {-1e300}, {}});  // z = 1e600
  EXPECT_NE(result.status, LcpStatus::solved);
  EXPECT_FALSE(result.residual < 1.0);
}

// w_1 = -7e-14 at z = (10, 0) is round-off beside z_0's 10, and all that row 1 is about.
TEST(Lemke, SolvesARowWhoseValuesAreSmallBesideOthers) {
  const double small = -7.10542739e-15;
  const LcpResult result = lemke({{0.1, small, small, 1.1}, {-1, 0}, {}});
  EXPECT_EQ(result.status, LcpStatus::solved);
  EXPECT_EQ(result.z[0], 10.0);
  EXPECT_NEAR(result.z[1], -10.0 * small / 1.1, 1e-28);  // 10 round-offs
}

// A tableau T holds the same equations as the first one, T_0, solved for the basic variables: T_0,B T = T_0.
TEST(Lemke, TraceShowsEquivalentTableaus) {
  test::Random random(8);
  for (int i = 0; i < 100; ++i) {
    const std::size_t n = 2 + static_cast<std::size_t>(i) % 5, width = 2 * n + 2;
    const LcpProblem problem = test::random_definite(random, n);
    const LemkeTrace trace = trace_lemke(problem);
    EXPECT_EQ(trace.result.z, lemke(problem).z);
    ASSERT_EQ(static_cast<int>(trace.pivots.size()), trace.result.pivots);
    ASSERT_EQ(trace.start.size(), n * width);
    double cover = 0.0;
    for (std::size_t row = 0; row < n; ++row) {
      for (std::size_t j = 0; j < n; ++j) EXPECT_EQ(trace.start[row * width + n + j], -problem(row, j));
      EXPECT_EQ(trace.start[row * width + width - 1], problem.q[row]);
      cover = std::min(cover, trace.start[row * width + 2 * n]);
    }
    EXPECT_EQ(cover, -1.0);
    for (const LemkePivot& pivot : trace.pivots) {
      for (std::size_t row = 0; row < n; ++row) {
        for (std::size_t j = 0; j < width; ++j) {
          double sum = 0.0, size = 0.0;
          for (std::size_t k = 0; k < n; ++k) {
            const double term =
                trace.start[row * width + static_cast<std::size_t>(pivot.basis[k])] * pivot.tableau[k * width + j];
            sum += term;
            size += std::abs(term);
          }
          // 1e-10: at most 10 pivots, each larger than 1e-8 of its column, on well-conditioned problems.
          EXPECT_NEAR(sum, trace.start[row * width + j], 1e-10 * std::max(size, 1.0));
        }
      }
    }
    if (!trace.pivots.empty()) {
      EXPECT_EQ(trace.pivots.front().entering, static_cast<int>(2 * n));
      EXPECT_EQ(trace.pivots.back().leaving, static_cast<int>(2 * n));
    }
  }
}

}  // namespace
}  // namespace tumble
