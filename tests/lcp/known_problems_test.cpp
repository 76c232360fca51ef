// Problems with exact solutions, solved by every method for LCPs of any origin.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tumble/lcp/residual.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

struct KnownProblem {
  std::string name;
  LcpProblem problem;
  std::vector<std::vector<double>> vertices;  // all vertex solutions
  bool lemke_finds_one = true;
};

LcpProblem lower_triangular(std::size_t n) {  // [Murty 1988]: exponential for least-index pivoting
  LcpProblem problem;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) problem.M.push_back(i == j ? 1.0 : (j < i ? 2.0 : 0.0));
    problem.q.push_back(-1.0);
  }
  return problem;
}

LcpProblem growing(std::size_t n) {  // z_i = 2^(i - 1)
  LcpProblem problem;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) problem.M.push_back(i == j ? 1.0 : (j < i ? -1.0 : 0.0));
    problem.q.push_back(-1.0);
  }
  return problem;
}

const std::vector<KnownProblem>& known_problems() {
  static const std::vector<KnownProblem> problems = {
      {"murty 8", lower_triangular(8), {{1, 0, 0, 0, 0, 0, 0, 0}}},
      {"growing 6", growing(6), {{1, 2, 4, 8, 16, 32}}},
      {"circulant P", {{1, 2, 0, 0, 1, 2, 2, 0, 1}, {-1, -1, -1}, {}}, {{1 / 3., 1 / 3., 1 / 3.}}},
      {"circulant P, uneven", {{1, 0, 2, 2, 1, 0, 0, 2, 1}, {-2, -1, -1}, {}}, {{4 / 9., 1 / 9., 7 / 9.}}},
      {"all ones", {{1, 1, 1, 1}, {-1, -1}, {}}, {{1, 0}, {0, 1}}},
      {"P0", {{0, 2, -1, -1, 0, 1, 2, -2, 0}, {-3, 6, -1}, {}}, {{6, 1.5, 0}}},
      {"bimatrix game",
       {{0, 0, 10, 30, 0, 0, 20, 15, 10, 30, 0, 0, 20, 15, 0, 0}, {-1, -1, -1, -1}, {}},
       {{.1, 0, .1, 0}, {1 / 30., 1 / 45., 1 / 30., 1 / 45.}, {0, 1 / 15., 0, 1 / 15.}},
       false},
      {"vertex and ray", {{1, -1, -1, 1}, {1, -1}, {}}, {{0, 1}}},
      {"q = 0", {{1, 1, 1, 1}, {0, 0}, {}}, {{0, 0}}},
      {"every ratio ties", {{1, 0, 0, 1}, {-1, -1}, {}}, {{1, 1}}},
      {"infeasible row", {{11, 0, 10, 1, 0, 11, 10, 1, 10, 10, 21, 1, -1, -1, -1, 0}, {50, 50, 10, -6}, {}}, {}},
      {"minus one", {{-1}, {-1}, {}}, {}},
      {"infeasible pair", {{1, -1, -1, 1}, {-1, -1}, {}}, {}},
      {"feasible without solution", {{0, 1, 0, 0}, {-1, 1}, {}}, {}},
      {"two solutions", {{-1}, {1}, {}}, {{0}, {1}}},
      {"four solutions", {{-2, -1, -1, -2}, {1, 1}, {}}, {{0, 0}, {.5, 0}, {0, .5}, {1 / 3., 1 / 3.}}},
      {"stick",
       {{1, 0, 0, 0, 0, 4, -4, 1, 0, -4, 4, 1, .5, -1, -1, 0}, {-1, -.1, .1, 0}, {}},
       {{1, .025, 0, 0}, {1, .2625, .2375, 0}}},
      {"slide", {{1, 0, 0, 0, 0, 4, -4, 1, 0, -4, 4, 1, .5, -1, -1, 0}, {-1, -4, 4, 0}, {}}, {{1, .5, 0, 2}}},
  };
  return problems;
}

bool is_near(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) difference = std::max(difference, std::abs(a[i] - b[i]));
  return difference < 1e-12;  // the entries are of order 1 and the bases well conditioned
}

bool contains(const std::vector<std::vector<double>>& vertices, const std::vector<double>& z) {
  return std::any_of(vertices.begin(), vertices.end(), [&](const auto& vertex) { return is_near(vertex, z); });
}

TEST(KnownProblems, EnumerationFindsEveryVertexAndNothingElse) {
  for (const KnownProblem& known : known_problems()) {
    const std::vector<LcpResult> solutions = enumerate_solutions(known.problem);
    EXPECT_EQ(solutions.size(), known.vertices.size()) << known.name;
    for (const LcpResult& solution : solutions) EXPECT_TRUE(contains(known.vertices, solution.z)) << known.name;
  }
}

TEST(KnownProblems, EnumerationProvesThatThereIsNoSolution) {
  for (const KnownProblem& known : known_problems()) {
    const LcpStatus expected = known.vertices.empty() ? LcpStatus::no_solution_proved : LcpStatus::solved;
    EXPECT_EQ(solve_lcp(known.problem, EnumerateSettings{}).status, expected) << known.name;
  }
}

TEST(KnownProblems, LemkeFindsASolutionOrSaysThatItFoundNone) {
  for (const KnownProblem& known : known_problems()) {
    const LcpResult result = lemke(known.problem);
    if (known.vertices.empty() || !known.lemke_finds_one) {
      EXPECT_EQ(result.status, LcpStatus::ray_unproven) << known.name;
      continue;
    }
    EXPECT_EQ(result.status, LcpStatus::solved) << known.name;
    EXPECT_LT(residual(known.problem, result.z).largest(), 1e-15) << known.name;
  }
}

TEST(KnownProblems, LemkeSurvivesGrowthOfTheSolution) {
  const LcpResult result = lemke(growing(20));
  ASSERT_EQ(result.status, LcpStatus::solved);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_DOUBLE_EQ(result.z[i], std::ldexp(1.0, static_cast<int>(i)));
}

}  // namespace
}  // namespace tumble
