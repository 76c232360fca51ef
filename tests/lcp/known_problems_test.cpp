// Problems with exact solutions, solved by every method for LCPs of any origin.
#include "known_problems.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tumble/lcp/residual.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

using problems::KnownProblem;

// The files of data/lcp. Each says how many vertex solutions there are, and lists all; found in rational arithmetic.
const std::vector<KnownProblem>& known_problems() {
  static const std::vector<KnownProblem> known = problems::read_known_problems(TUMBLE_LCP_DATA);
  return known;
}

bool is_near(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) difference = std::max(difference, std::abs(a[i] - b[i]));
  return difference < 1e-12;  // the entries are of order 1 and the bases well conditioned
}

bool contains(const std::vector<std::vector<double>>& vertices, const std::vector<double>& z) {
  return std::any_of(vertices.begin(), vertices.end(), [&](const auto& vertex) { return is_near(vertex, z); });
}

TEST(KnownProblems, AreAllThereAndSayWhatIsKnown) {
  EXPECT_EQ(known_problems().size(), 41u);
  for (const KnownProblem& known : known_problems()) {
    ASSERT_TRUE(known.num_solutions.has_value()) << known.name;
    EXPECT_EQ(known.solutions.size(), *known.num_solutions) << known.name;
    for (const std::vector<double>& z : known.solutions) {
      EXPECT_LT(residual(known.problem, z).largest(), 1e-15) << known.name;  // fractions are rounded once
    }
  }
}

TEST(KnownProblems, EnumerationFindsEveryVertexAndNothingElse) {
  for (const KnownProblem& known : known_problems()) {
    const std::vector<LcpResult> solutions = enumerate_solutions(known.problem);
    EXPECT_EQ(solutions.size(), known.solutions.size()) << known.name;
    for (const LcpResult& solution : solutions) EXPECT_TRUE(contains(known.solutions, solution.z)) << known.name;
  }
}

TEST(KnownProblems, EnumerationProvesThatThereIsNoSolution) {
  for (const KnownProblem& known : known_problems()) {
    const LcpStatus expected = known.solutions.empty() ? LcpStatus::no_solution_proved : LcpStatus::solved;
    EXPECT_EQ(solve_lcp(known.problem, EnumerateSettings{}).status, expected) << known.name;
  }
}

// y >= 0, M^T y <= 0 and q^T y < 0: then y^T w < 0 for every z >= 0. All numbers here are small whole ones: no
// rounding.
TEST(KnownProblems, CertificatesProveInfeasibility) {
  int num_certificates = 0;
  for (const KnownProblem& known : known_problems()) {
    const std::vector<double>& y = known.certificate;
    if (y.empty()) continue;
    ++num_certificates;
    EXPECT_EQ(known.num_solutions, 0u) << known.name;
    const std::size_t n = known.problem.size();
    double q_y = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      double column = 0.0;
      for (std::size_t k = 0; k < n; ++k) column += known.problem(k, i) * y[k];
      EXPECT_GE(y[i], 0.0) << known.name;
      EXPECT_LE(column, 0.0) << known.name;
      q_y += known.problem.q[i] * y[i];
    }
    EXPECT_LT(q_y, 0.0) << known.name;
  }
  EXPECT_EQ(num_certificates, 7);  // of the eight without a solution, one is feasible
}

TEST(KnownProblems, LemkeFindsASolutionOrSaysThatItFoundNone) {
  for (const KnownProblem& known : known_problems()) {
    const LcpResult result = lemke(known.problem);
    // The bimatrix game and this one have solutions that Lemke's path does not reach: M is not copositive.
    const bool is_out_of_reach = known.name == "bimatrix" || known.name == "small-beside-huge";
    if (known.solutions.empty() || is_out_of_reach) {
      EXPECT_EQ(result.status, LcpStatus::ray_unproven) << known.name;
      continue;
    }
    EXPECT_EQ(result.status, LcpStatus::solved) << known.name;
    EXPECT_LT(result.residual, 1e-15) << known.name;
    EXPECT_EQ(result.residual, residual(known.problem, result.z).largest()) << known.name;
  }
}

TEST(KnownProblems, TheDefaultSolvesEachOrProvesThatItCannotBeSolved) {
  for (const KnownProblem& known : known_problems()) {
    const LcpResult result = solve_lcp(known.problem);
    if (known.solutions.empty()) {
      EXPECT_TRUE(result.status == LcpStatus::infeasible || result.status == LcpStatus::no_solution_proved)
          << known.name << ": " << to_string(result.status);
      continue;
    }
    EXPECT_EQ(result.status, LcpStatus::solved) << known.name;
    EXPECT_LT(residual(known.problem, result.z).largest(), 1e-12) << known.name;
  }
}

TEST(KnownProblems, RefuseCommentsThatCannotBeTrue) {
  const auto parse = [](const char* comment) {
    return problems::parse_known_problem(std::string("# any words: are fine\n") + comment + "\nM\n2\nq\n-1\n", "f");
  };
  EXPECT_EQ(parse("# solution: 1/2").solutions, std::vector<std::vector<double>>{{0.5}});
  EXPECT_FALSE(parse("#").num_solutions.has_value());
  EXPECT_THROW(parse("# solution: 1 2"), std::invalid_argument);
  EXPECT_THROW(parse("# solution: x"), std::invalid_argument);
  EXPECT_THROW(parse("# solutions: -1"), std::invalid_argument);
  EXPECT_THROW(parse("# infeasible:"), std::invalid_argument);
}

}  // namespace
}  // namespace tumble
