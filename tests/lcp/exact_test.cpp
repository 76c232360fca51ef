#include "tumble/lcp/exact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "../random_contact.hpp"
#include "known_problems.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/problem_text.hpp"

namespace tumble {
namespace {

using Vector = std::vector<std::string>;
using Face = std::set<Vector>;

// The files of data/lcp, with the solutions that they list.
const std::vector<problems::KnownProblem>& known_problems() {
  static const std::vector<problems::KnownProblem> known = problems::read_known_problems(TUMBLE_LCP_DATA);
  return known;
}

LcpStatus expected_status(const problems::KnownProblem& known) {
  if (!known.solutions.empty()) return LcpStatus::solved;
  return known.certificate.empty() ? LcpStatus::no_solution_proved : LcpStatus::infeasible;
}

// How the vertices of a solution set belong together.
struct Shape {
  std::vector<Vector> rays;                     // of all faces
  std::vector<std::vector<std::size_t>> faces;  // places of their vertices in the file; none: each vertex is a face
};

const Shape& known_shape(const std::string& name) {
  static const std::map<std::string, Shape> shapes = {
      {"all-ones", {{}, {{0, 1}}}},
      {"vertex-and-ray", {{{"1", "1"}}, {}}},
      {"small-beside-huge", {{{"1", "1"}}, {}}},
      {"stick", {{}, {{0, 1}}}},
      {"painleve-jam", {{}, {{0, 1}}}},
      // Without a force of friction the slip speed is bounded from below only.
      {"box-frictionless", {{{"0", "0", "0", "0", "0", "0", "1", "0"}, {"0", "0", "0", "0", "0", "0", "0", "1"}}, {}}},
      {"grazing", {{{"0", "0", "0", "1"}}, {}}},
      {"painleve-three-motions", {{{"0", "0", "0", "1"}}, {{0, 1}, {2}, {3}}}},
      // One motion, and all the friction that can share its impulse.
      {"box-at-rest", {{}, {{0, 1, 2, 3, 4}}}},
      {"box-rocking", {{}, {{0, 1, 2, 3, 4, 5, 6}}}},
      // Sliding on without a force, at any slip speed above; with a force up to where it sticks; sticking, however hard
      // the wedge squeezes, with all the friction that adds up to the same.
      {"wedge-consistent",
       {{{"0", "0", "0", "0", "0", "0", "1", "0"},
         {"0", "0", "0", "0", "0", "0", "0", "1"},
         {"1", "1", "0", "0", "0", "0", "0", "0"},
         {"4", "4", "1", "1", "0", "0", "0", "0"},
         {"2", "2", "1", "0", "1", "0", "0", "0"},
         {"2", "2", "0", "1", "0", "1", "0", "0"},
         {"4", "4", "0", "0", "1", "1", "0", "0"}},
        {{3}, {2, 3}, {0, 1, 2}}}},
  };
  static const Shape points;
  const auto found = shapes.find(name);
  return found == shapes.end() ? points : found->second;
}

Face vertices_of(const ExactSolutionSet& set, const SolutionFace& face) {
  Face vertices;
  for (const std::size_t v : face.vertices) vertices.insert(set.vertices[v].z);
  return vertices;
}

TEST(Exact, SolutionSetsOfKnownProblemsAreRightToTheLastDigit) {
  for (const problems::KnownProblem& known : known_problems()) {
    const ExactLcp problem = parse_exact_lcp(known.text);
    const ExactSolutionSet set = exact_solution_set(problem);
    EXPECT_EQ(set.status, expected_status(known)) << known.name;
    std::vector<Vector> vertices;
    for (const ExactResult& vertex : set.vertices) vertices.push_back(vertex.z);
    EXPECT_EQ(vertices, known.exact_solutions) << known.name;  // in the order of their bases
    const Shape& shape = known_shape(known.name);
    EXPECT_EQ(set.rays, shape.rays) << known.name;
    std::set<Face> faces, expected;
    for (const SolutionFace& face : set.faces) faces.insert(vertices_of(set, face));
    for (const std::vector<std::size_t>& face : shape.faces) {
      Face of_vertices;
      for (const std::size_t v : face) of_vertices.insert(known.exact_solutions[v]);
      expected.insert(of_vertices);
    }
    if (expected.empty()) {
      for (const Vector& vertex : known.exact_solutions) expected.insert(Face{vertex});
    }
    EXPECT_EQ(faces, expected) << known.name;
    EXPECT_EQ(set.certificate.empty(), set.status != LcpStatus::infeasible) << known.name;
    if (set.status == LcpStatus::infeasible) {
      EXPECT_TRUE(proves_infeasible(problem, set.certificate)) << known.name;
    }
  }
}

TEST(Exact, LemkeFindsAKnownSolutionOrProvesWhyNot) {
  for (const problems::KnownProblem& known : known_problems()) {
    const ExactLcp problem = parse_exact_lcp(known.text);
    const ExactResult result = exact_lemke(problem);
    // Lemke's path ends on a ray although there are solutions, or feasible points.
    if (known.name == "bimatrix" || known.name.ends_with("-without-solution")) {
      EXPECT_EQ(result.status, LcpStatus::ray_unproven) << known.name;
      EXPECT_FALSE(result.certificate.empty()) << known.name;
      continue;
    }
    if (known.name == "murty-lower-12") {  // the lexicographic rule takes 2^n pivots here
      EXPECT_EQ(result.status, LcpStatus::iteration_limit) << known.name;
      continue;
    }
    EXPECT_EQ(result.status, expected_status(known)) << known.name;
    if (result.status == LcpStatus::infeasible) {
      EXPECT_TRUE(proves_infeasible(problem, result.certificate)) << known.name;
    } else {
      const std::vector<Vector>& vertices = known.exact_solutions;
      EXPECT_NE(std::find(vertices.begin(), vertices.end(), result.z), vertices.end()) << known.name;
      EXPECT_EQ(exact_solution(problem, result.basis).z, result.z) << known.name;
    }
  }
}

TEST(Exact, DecidesEveryKnownProblem) {
  for (const problems::KnownProblem& known : known_problems()) {
    const ExactResult result = solve_exactly(parse_exact_lcp(known.text));
    EXPECT_EQ(result.status, expected_status(known)) << known.name;
    EXPECT_EQ(result.certificate.empty(), result.status != LcpStatus::infeasible) << known.name;
  }
}

TEST(Exact, ASolutionBeyondTheRangeOfDoubleLeavesNoInfinity) {
  const LcpResult result = exact_lemke(LcpProblem{{1e-300, 0, 0, 1}, {-1e300, -1}, {}});
  EXPECT_EQ(result.status, LcpStatus::numerical);
  EXPECT_EQ(result.z, (std::vector<double>{0, 0}));
  EXPECT_EQ(result.w, (std::vector<double>{-1e300, -1}));
}

TEST(Exact, SingularBasesAreSolvedWhereTheyCanBe) {
  const ExactLcp segment = parse_exact_lcp("M\n1 1\n1 1\nq\n-1 -1");
  const std::uint8_t both[] = {1, 1}, none[] = {0, 0}, first[] = {1, 0};
  const ExactResult on_segment = exact_solution(segment, both);
  EXPECT_EQ(on_segment.status, LcpStatus::solved);
  EXPECT_TRUE(on_segment.z == (Vector{"1", "0"}) || on_segment.z == (Vector{"0", "1"}));
  EXPECT_EQ(on_segment.w, (Vector{"0", "0"}));

  const ExactResult contradiction = exact_solution(parse_exact_lcp("M\n1 1\n1 1\nq\n-1 -2"), both);
  EXPECT_EQ(contradiction.status, LcpStatus::no_solution_proved);
  EXPECT_TRUE(contradiction.z.empty());
  const ExactResult negative = exact_solution(parse_exact_lcp("M\n1 1\n1 1\nq\n1 1"), both);
  EXPECT_EQ(negative.status, LcpStatus::no_solution_proved);

  const ExactResult regular = exact_solution(segment, none);  // regular, but w < 0
  EXPECT_EQ(regular.status, LcpStatus::no_solution_proved);
  EXPECT_EQ(regular.w, (Vector{"-1", "-1"}));
  EXPECT_EQ(exact_solution(segment, first).z, (Vector{"1", "0"}));
}

// Small whole numbers: singular bases, ties and rays abound.
ExactLcp random_small(test::Random& random, std::size_t n) {
  ExactLcp problem;
  const auto draw = [&] { return std::to_string(static_cast<int>(random.uniform(0.0, 5.0)) - 2); };
  for (std::size_t i = 0; i < n * n; ++i) problem.M.push_back(draw());
  for (std::size_t i = 0; i < n; ++i) problem.q.push_back(draw());
  return problem;
}

// Two methods that share no code but the conversion to whole numbers.
TEST(Exact, DoubleDescriptionAgreesWithTryingEveryBasis) {
  test::Random random(21);
  int num_solved = 0, num_rays = 0, num_infeasible = 0, num_edges = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::size_t n = 1 + static_cast<std::size_t>(i) % 4;
    const ExactLcp problem = random_small(random, n);
    const ExactSolutionSet set = exact_solution_set(problem);
    num_rays += !set.rays.empty();
    for (const SolutionFace& face : set.faces) num_edges += face.vertices.size() > 1;
    for (unsigned basis = 0; basis < 1u << n; ++basis) {
      std::vector<std::uint8_t> is_basic;
      for (std::size_t k = 0; k < n; ++k) is_basic.push_back(basis >> k & 1);
      const ExactResult of_basis = exact_solution(problem, is_basic);
      // A basis has a solution exactly if it has one of the vertices.
      const bool has_vertex = std::any_of(set.vertices.begin(), set.vertices.end(), [&](const ExactResult& vertex) {
        for (std::size_t k = 0; k < n; ++k) {
          if ((is_basic[k] ? vertex.w[k] : vertex.z[k]) != "0") return false;
        }
        return true;
      });
      ASSERT_EQ(of_basis.status == LcpStatus::solved, has_vertex) << i << " basis " << basis;
      if (has_vertex) {
        for (std::size_t k = 0; k < n; ++k) ASSERT_EQ(is_basic[k] ? of_basis.w[k] : of_basis.z[k], "0");
        for (const std::string& z : of_basis.z) ASSERT_NE(z.front(), '-');
        for (const std::string& w : of_basis.w) ASSERT_NE(w.front(), '-');
      }
    }
    num_solved += set.status == LcpStatus::solved;
    const ExactFeasibility feasibility = exact_feasibility(problem);
    num_infeasible += feasibility.status == LcpStatus::infeasible;
    ASSERT_EQ(set.status == LcpStatus::infeasible, feasibility.status == LcpStatus::infeasible);
    if (feasibility.status == LcpStatus::infeasible) {
      ASSERT_TRUE(proves_infeasible(problem, feasibility.certificate));
    }
    const ExactResult pivoted = exact_lemke(problem);
    if (pivoted.status == LcpStatus::solved) {
      ASSERT_EQ(set.status, LcpStatus::solved);
      ASSERT_EQ(exact_solution(problem, pivoted.basis).status, LcpStatus::solved);
    } else if (pivoted.status == LcpStatus::infeasible) {
      ASSERT_EQ(set.status, LcpStatus::infeasible);
    }
  }
  EXPECT_GT(num_solved, 500);
  EXPECT_GT(num_rays, 100);
  EXPECT_GT(num_infeasible, 100);
  EXPECT_GT(num_edges, 100);
}

// z -> z / c and w -> w r when column j is multiplied by c_j and row i by r_i.
TEST(Exact, UnitsOfRowsAndColumnsChangeTheSolutionExactly) {
  test::Random random(22);
  const std::vector<std::pair<int, int>> factors = {{1, 3}, {7, 2}, {10, 1}, {1000003, 7}};
  for (int i = 0; i < 200; ++i) {
    const std::size_t n = 2 + static_cast<std::size_t>(i) % 3;
    const ExactLcp problem = random_small(random, n);
    ExactLcp other = problem;
    const auto times = [](const std::string& whole, std::pair<int, int> a, std::pair<int, int> b) {
      const long long top = std::stoll(whole) * a.first * b.first;
      return std::to_string(top) + "/" + std::to_string(static_cast<long long>(a.second) * b.second);
    };
    const auto row = [&](std::size_t k) { return factors[k]; };
    const auto column = [&](std::size_t k) { return factors[(k + 2) % 4]; };
    for (std::size_t k = 0; k < n * n; ++k) other.M[k] = times(problem.M[k], row(k / n), column(k % n));
    for (std::size_t k = 0; k < n; ++k) other.q[k] = times(problem.q[k], row(k), {1, 1});
    const ExactSolutionSet a = exact_solution_set(problem), b = exact_solution_set(other);
    ASSERT_EQ(a.status, b.status);
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    for (std::size_t v = 0; v < a.vertices.size(); ++v) {
      for (std::size_t k = 0; k < n; ++k) {
        // Compared as doubles that are each the nearest to an exact value: off by one rounding at most.
        const double z = as_doubles({b.vertices[v].z[k]})[0] * column(k).first / column(k).second;
        const double w = as_doubles({b.vertices[v].w[k]})[0] * row(k).second / row(k).first;
        EXPECT_NEAR(z, as_doubles({a.vertices[v].z[k]})[0], 1e-15 * z);
        EXPECT_NEAR(w, as_doubles({a.vertices[v].w[k]})[0], 1e-15 * w);
      }
    }
    ASSERT_EQ(a.rays.size(), b.rays.size());
    ASSERT_EQ(a.faces.size(), b.faces.size());
    for (std::size_t f = 0; f < a.faces.size(); ++f) EXPECT_EQ(a.faces[f].vertices, b.faces[f].vertices);
  }
}

TEST(Exact, DoublesAreTakenAtTheirWord) {
  const ExactLcp problem = as_exact({{0.1}, {-0.5}, {}});
  EXPECT_EQ(problem.M[0], "3602879701896397/36028797018963968");
  EXPECT_EQ(exact_lemke(problem).z[0], "18014398509481984/3602879701896397");
  EXPECT_EQ(exact_lemke(parse_exact_lcp("M\n0.1\nq\n-0.5")).z[0], "5");
  test::Random random(23);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.uniform(-1.0, 1.0) * random.log_uniform(-1073.0, 1000.0);
    EXPECT_EQ(as_doubles(as_exact({{x}, {0.0}, {}})).M[0], x);
  }
}

TEST(Exact, FractionsRoundToTheNearestDouble) {
  EXPECT_EQ(as_doubles(Vector{"1/3", "-2/3", "0.1", "0", "-7"}), (std::vector<double>{1 / 3.0, -2 / 3.0, 0.1, 0, -7}));
  // Ties to even: 2^53 + 1 and 2^53 + 3; a hair above the first.
  EXPECT_EQ(as_doubles(Vector{"9007199254740993", "9007199254740995", "9007199254740993.0000000000001"}),
            (std::vector<double>{0x1p53, 0x1p53 + 4, 0x1p53 + 2}));
  EXPECT_EQ(as_doubles(Vector{"1e400", "-1e400", "1e-400", "3e-324", "1.7976931348623157e308"}),
            (std::vector<double>{HUGE_VAL, -HUGE_VAL, 0.0, 0x1p-1074, std::numeric_limits<double>::max()}));
  test::Random random(24);
  for (int i = 0; i < 1000; ++i) {  // division in double is correctly rounded
    const double a = std::floor(random.uniform(1.0, 1e15)), b = std::floor(random.uniform(1.0, 1e15));
    EXPECT_EQ(
        as_doubles({std::to_string(static_cast<long long>(a)) + "/" + std::to_string(static_cast<long long>(b))})[0],
        a / b);
  }
}

TEST(Exact, LemkeAnswersInDoublesWithRoundOffOnly) {
  test::Random random(25);
  for (int i = 0; i < 300; ++i) {
    const LcpProblem problem = as_lcp(test::random_contact(random, 1.0));
    const LcpResult result = exact_lemke(problem);
    ASSERT_EQ(result.status, LcpStatus::solved);
    EXPECT_EQ(result.rung, LcpRung::exact);
    EXPECT_LT(result.residual, 1e-15);  // four terms a row, each rounded once
  }
  const LcpResult none = exact_lemke({{1, -1, -1, 1}, {-1, -1}, {}});
  EXPECT_EQ(none.status, LcpStatus::infeasible);
  EXPECT_TRUE(proves_infeasible(LcpProblem{{1, -1, -1, 1}, {-1, -1}, {}}, none.certificate));
  // Its solution, 1e600, is no double.
  EXPECT_EQ(exact_lemke(LcpProblem{{1e-300}, {-1e300}, {}}).status, LcpStatus::numerical);
}

TEST(Exact, ResultsMayBeLongerThanTheirProblem) {
  const std::string sevens(900, '7'), threes(901, '3');
  const ExactLcp problem = parse_exact_lcp("M\n" + sevens + " 1\n-1 " + threes + "\nq\n-1/" + threes + " -1e-900");
  const ExactResult result = exact_lemke(problem);
  ASSERT_EQ(result.status, LcpStatus::solved);
  EXPECT_GT(result.z[0].size(), 2000u);
  EXPECT_EQ(exact_solution(problem, result.basis).z, result.z);
  EXPECT_EQ(as_doubles(result.z), (std::vector<double>{0.0, 0.0}));  // 1e-1800
}

TEST(Exact, CertificatesAreCheckedToTheLastDigit) {
  const ExactLcp problem = parse_exact_lcp("M\n1 -1\n-1 1\nq\n-1 -1");
  EXPECT_TRUE(proves_infeasible(problem, {"1", "1"}));
  EXPECT_FALSE(proves_infeasible(problem, {"1", "0.9999999999999999999999"}));
  EXPECT_FALSE(proves_infeasible(problem, {"0", "0"}));
  EXPECT_FALSE(proves_infeasible(problem, {"-1", "-1"}));
  EXPECT_FALSE(proves_infeasible(LcpProblem{{0.1}, {-1}, {}}, std::vector<double>{1.0}));
  EXPECT_FALSE(proves_infeasible(LcpProblem{{-1}, {-1}, {}}, std::vector<double>{std::nan("")}));
  EXPECT_THROW(proves_infeasible(problem, {"1"}), std::invalid_argument);
  EXPECT_THROW(proves_infeasible(problem, {"1", "one"}), std::invalid_argument);
}

std::string error_of(const ExactLcp& problem) {
  try {
    exact_solution_set(problem);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(Exact, NamesWhatIsOutOfItsLimits) {
  EXPECT_EQ(error_of({Vector(169, "1"), Vector(13, "1")}), "q: exact arithmetic takes at most 12 entries here, got 13");
  EXPECT_EQ(error_of({{"1", "2"}, {"1"}}), "M: must be 1 x 1 for q of length 1, got 2 entries");
  EXPECT_EQ(error_of({{"x"}, {"1"}}), "M[0][0]: expected a number like 1e-3 or 1/3, got 'x'");
  EXPECT_EQ(error_of({{"1"}, {"1/0"}}), "q[0]: must be finite, got '1/0'");
  EXPECT_EQ(error_of({{"1"}, {"1e1001"}}),
            "q[0]: must have at most 100000 digits and an exponent within +-1000, got '1e1001'");
  EXPECT_EQ(error_of({{"1e1000", "1", "1", "1e1000"}, {"1e-1000", "1e999"}}).substr(0, 40),
            "M, q: brought to whole numbers, n times ");
  EXPECT_TRUE(is_within_exact_limits({{1e300, 1e-300, 1e-300, 1e300}, {1, 1}, {}}));
  EXPECT_FALSE(is_within_exact_limits({std::vector<double>(41 * 41, 1.0), std::vector<double>(41, 1.0), {}}));
}

TEST(ParseExactLcp, ReadsWhatParseLcpReadsAndKeepsEveryDigit) {
  const ExactLcp problem = parse_exact_lcp("M # comment\n+.5 -1.e1\n1E-3/2 007\nq\n1/3\n-0.1/-0.3");
  EXPECT_EQ(problem.M, (Vector{"1/2", "-10", "1/2000", "7"}));
  EXPECT_EQ(problem.q, (Vector{"1/3", "1/3"}));
}

TEST(ParseExactLcp, RefusesWhatWouldFillTheMemory) {
  const auto error_of_text = [](const std::string& text) -> std::string {
    try {
      parse_exact_lcp(text, "file");
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no error";
  };
  const std::string limit = "must have at most 1000 digits and an exponent within +-1000";
  EXPECT_EQ(error_of_text("M\n1e999999\nq\n1"), "file:2:1: " + limit + ", got '1e999999'");
  EXPECT_EQ(error_of_text("M\n1e-99999999999999999999\nq\n1").substr(0, 71), "file:2:1: " + limit + ", ");
  EXPECT_EQ(error_of_text("M\n" + std::string(1001, '7') + "\nq\n1").substr(0, 71), "file:2:1: " + limit + ", ");
  EXPECT_EQ(error_of_text("M\n1\nq\nnan"), "file:4:1: expected a number like 1e-3 or 1/3, got 'nan'");
  for (const char* word : {"1/0", "0/0", "1/0e9"}) {
    EXPECT_EQ(error_of_text(std::string("M\n1\nq\n") + word),
              std::string("file:4:1: must be finite, got '") + word + "'");
  }
  for (const char* word : {"-", ".", "e5", "1e", "1e+", "--1", "+-1", "1/", "/2", "1/2/3", "0x10", "1_0", "1.2.3"}) {
    EXPECT_EQ(error_of_text(std::string("M\n1\nq\n") + word),
              std::string("file:4:1: expected a number like 1e-3 or 1/3, got '") + word + "'");
  }
  const std::string row = [] {
    std::string text;
    for (int i = 0; i < 41; ++i) text += "1 ";
    return text;
  }();
  EXPECT_EQ(error_of_text("M\n" + row + "\nq\n1"), "file:2:81: M: at most 40 columns are read, got 41");
}

}  // namespace
}  // namespace tumble
