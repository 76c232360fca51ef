// A slice of the long lists of benchmarks/lcp: the default solver must solve every one of these contact problems.
#include "problems.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/residual.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

constexpr std::uint64_t k_seed = 1;
constexpr double k_accepted_residual = 1e-12;  // what RobustSettings promises by default

// Empty if solved and the residual, computed anew, agrees; else what happened.
std::string failure_of(const LcpProblem& problem, LcpWorkspace& workspace) {
  const LcpResult& result = solve_lcp(problem, RobustSettings{}, workspace);
  const double r = residual(problem, result.z).largest();
  if (result.status == LcpStatus::solved && r <= k_accepted_residual) return {};
  return std::string(to_string(result.status)) + ", residual " + std::to_string(r);
}

void expect_wild_solved(std::uint64_t count, int max_contacts) {
  LcpWorkspace workspace;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string failure = failure_of(as_lcp(problems::wild_of(k_seed, i, max_contacts)), workspace);
    EXPECT_EQ(failure, "") << "wild_of(" << k_seed << ", " << i << ", " << max_contacts << ")";
  }
}

TEST(RobustSlice, SolvesEveryWildProblemOfUpTo16Unknowns) { expect_wild_solved(100'000, 4); }

TEST(RobustSlice, SolvesEveryWildProblemOfUpTo48Unknowns) { expect_wild_solved(2'000, 12); }

// 12 contacts, some of which depend on each other to the last bit: M is indefinite by its rounding, so that a ridge
// must be above 1e-17, and with 1e-15 the residual is 1.7e-11.
TEST(RobustSlice, SolvesAProblemThatNeedsTheSmallestRidge) {
  LcpWorkspace workspace;
  EXPECT_EQ(failure_of(as_lcp(problems::wild_of(6, 746'943, 12)), workspace), "");
}

TEST(RobustSlice, SolvesEveryStackOfUpTo400Unknowns) {
  LcpWorkspace workspace;
  for (const problems::Family& family : problems::families()) {
    if (family.name == "wild") continue;
    for (const std::size_t n : {40u, 160u, 400u}) {
      for (std::uint64_t i = 0; i < 4; ++i) {
        problems::Random random = problems::random_of(k_seed + n, i);
        const std::string failure = failure_of(as_lcp(family.make(random, n / 4)), workspace);
        EXPECT_EQ(failure, "") << family.name << ", n = " << n << ", index " << i;
      }
    }
  }
}

}  // namespace
}  // namespace tumble
