// The contact problems made from seeds: well formed, reproducible, solvable.
#include "problems.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/residual.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

TEST(GeneratedProblems, HaveTheSizeAskedForAndComeAgainFromTheirSeed) {
  for (const problems::Family& family : problems::families()) {
    for (const std::size_t num_contacts : {1u, 2u, 3u, 10u, 23u, 100u}) {
      problems::Random random(num_contacts), again(num_contacts), other(1000 + num_contacts);
      const LcpProblem problem = as_lcp(family.make(random, num_contacts));
      EXPECT_EQ(problem.size(), 4 * num_contacts) << family.name;
      EXPECT_EQ(problem.M, as_lcp(family.make(again, num_contacts)).M) << family.name;
      EXPECT_NE(problem.q, as_lcp(family.make(other, num_contacts)).q) << family.name;
    }
  }
}

// M = (A, E; mu, -E^T, 0) with A = J M^-1 J^T: x^T A x >= 0 up to round-off in its terms, the premise of every proof
// that these problems have a solution.
TEST(GeneratedProblems, HaveAPositiveSemidefiniteResponse) {
  problems::Random random(1);
  for (const problems::Family& family : problems::families()) {
    for (int i = 0; i < 50; ++i) {
      const LcpProblem problem = as_lcp(family.make(random, 5));
      std::vector<double> x(15);
      for (double& entry : x) entry = random.uniform(-1.0, 1.0);
      double sum = 0.0, size = 0.0;
      for (std::size_t r = 0; r < 15; ++r) {
        for (std::size_t c = 0; c < 15; ++c) {
          EXPECT_EQ(problem(r, c), problem(c, r)) << family.name;
          sum += x[r] * problem(r, c) * x[c];
          size += std::abs(x[r] * problem(r, c) * x[c]);
        }
      }
      EXPECT_GE(sum, -1e-14 * size) << family.name;
    }
  }
}

TEST(GeneratedProblems, AStackAtRestStaysAtRestInItsNextStep) {
  problems::Random random(2);
  for (const std::size_t num_contacts : {2u, 4u, 10u, 20u}) {
    const ContactSystem system = problems::resting_tower(random, num_contacts);
    const LcpResult first = robust(as_lcp(system));
    ASSERT_EQ(first.status, LcpStatus::solved);
    const LcpResult second = robust(as_lcp(problems::next_step(system, first.z, random)));
    ASSERT_EQ(second.status, LcpStatus::solved);
    double size = 0.0, difference = 0.0;
    for (std::size_t i = 0; i < num_contacts; ++i) {
      size += first.z[i];
      difference += second.z[i] - first.z[i];
    }
    // The same weight is carried, up to the one part in a million by which it was changed.
    EXPECT_NEAR(difference, 0.0, 2e-6 * size);
  }
}

}  // namespace
}  // namespace tumble
