// Murty, Dantzig, Newton and the two Gauss-Seidel methods: what each is guaranteed to solve it solves, and none of them
// calls solved what is not.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "known_problems.hpp"
#include "other_units.hpp"
#include "random_problems.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/contact_system.hpp"
#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/methods.hpp"
#include "tumble/lcp/residual.hpp"

namespace tumble {
namespace {

using Vector = std::vector<double>;

struct Solver {
  std::string name;
  LcpSettings settings;
  LcpRung rung;
};

const std::vector<Solver>& solvers() {
  static const std::vector<Solver> all = {
      {"murty", MurtySettings{}, LcpRung::murty},    {"dantzig", DantzigSettings{}, LcpRung::dantzig},
      {"newton", NewtonSettings{}, LcpRung::newton}, {"pgs", PgsSettings{}, LcpRung::pgs},
      {"nlgs", NlgsSettings{}, LcpRung::nlgs},
  };
  return all;
}

// The first three end in exact arithmetic; the others converge, to the accepted residual.
const std::vector<std::string> k_pivoting = {"murty", "dantzig", "newton"};
const std::vector<std::string> k_all = {"murty", "dantzig", "newton", "pgs", "nlgs"};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_pivoting(const Solver& solver) { return contains(k_pivoting, solver.name); }

// [Murty 1988]: 2^n - 1 pivots by least index.
LcpProblem upper(std::size_t n) {
  LcpProblem problem;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) problem.M.push_back(i == j ? 1.0 : (j < i ? 0.0 : 2.0));
    problem.q.push_back(-1.0);
  }
  return problem;
}

// Residual up to which two candidates are taken for the same solution, and the bound of what is accepted.
constexpr double k_accepted = 1e-8;

double largest(const Vector& values) {
  double size = 0.0;
  for (const double x : values) size = std::max(size, std::abs(x));
  return size;
}

double difference(const Vector& a, const Vector& b) {
  double size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) size = std::max(size, std::abs(a[i] - b[i]));
  return size;
}

void expect_consistent(const LcpProblem& problem, const LcpResult& result, const std::string& name) {
  ASSERT_EQ(result.z.size(), problem.size()) << name;
  EXPECT_EQ(result.w, complement(problem, result.z)) << name;
  EXPECT_EQ(result.residual, residual(problem, result.z).largest()) << name;
  EXPECT_EQ(result.basis.size(), problem.size()) << name;
}

// Who must solve which of data/lcp; others may fail, but must say so. A solver that solves one of these must find the
// first of its solutions, which is the only one but for the ray of vertex-and-ray.
const std::map<std::string, std::vector<std::string>>& must_solve() {
  static const std::map<std::string, std::vector<std::string>> names = {
      {"murty-upper-12", k_all}, {"murty-lower-8", k_all},
      {"murty-lower-12", k_all}, {"csizmadia-12", k_all},
      {"circulant", k_pivoting}, {"circulant-uneven", k_pivoting},
      {"ties", k_all},           {"p0", {"dantzig", "newton"}},
      {"vertex-and-ray", k_all}, {"slide", {"murty", "dantzig", "newton", "nlgs"}},
  };
  return names;
}

void expect_known_answer(const problems::KnownProblem& known, const Solver& solver) {
  const std::string name = solver.name + ", " + known.name;
  const LcpResult result = solve_lcp(known.problem, solver.settings);
  expect_consistent(known.problem, result, name);
  const bool is_trivial = *std::min_element(known.problem.q.begin(), known.problem.q.end()) >= 0.0;
  EXPECT_EQ(result.rung, is_trivial ? LcpRung::none : solver.rung) << name;
  const auto names = must_solve().find(known.name);
  if (names != must_solve().end() && contains(names->second, solver.name)) {
    EXPECT_EQ(result.status, LcpStatus::solved) << name;
  }
  if (result.status != LcpStatus::solved) return;
  EXPECT_LE(result.residual, k_accepted) << name;
  ASSERT_FALSE(known.solutions.empty()) << name;
  if (names == must_solve().end() || known.name == "vertex-and-ray") return;
  EXPECT_LT(difference(result.z, known.solutions.front()), (is_pivoting(solver) ? 1e-13 : 1e-6)) << name;
}

TEST(ComparisonSolvers, SolveKnownProblemsOrSayThatTheyDidNot) {
  for (const problems::KnownProblem& known : problems::read_known_problems(TUMBLE_LCP_DATA)) {
    for (const Solver& solver : solvers()) expect_known_answer(known, solver);
  }
}

TEST(ComparisonSolvers, SolveASkewProblemOrSayThatTheyDidNot) {
  const LcpProblem problem{{0, 1, -1, 0}, {-1, 2}, {}};
  for (const Solver& solver : solvers()) {
    const LcpResult result = solve_lcp(problem, solver.settings);
    expect_consistent(problem, result, solver.name);
    EXPECT_EQ(result.rung, solver.rung) << solver.name;
    if (contains({"dantzig", "newton"}, solver.name)) {
      EXPECT_EQ(result.status, LcpStatus::solved) << solver.name;
    }
    if (result.status != LcpStatus::solved) continue;
    EXPECT_LT(difference(result.z, {2, 1}), (is_pivoting(solver) ? 1e-13 : 1e-6)) << solver.name;
  }
}

TEST(Murty, TakesEveryBasisOfTheUpperTriangle) {
  for (std::size_t n = 1; n <= 12; ++n) {
    const LcpResult result = murty(upper(n));
    ASSERT_EQ(result.status, LcpStatus::solved);
    EXPECT_EQ(result.pivots, (1 << n) - 1);
    Vector expected(n, 0.0);
    expected.back() = 1.0;
    EXPECT_EQ(result.z, expected);
  }
}

// z_i = 2^(i - 1).
LcpProblem growing(std::size_t n) {
  LcpProblem problem;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) problem.M.push_back(i == j ? 1.0 : (j < i ? -1.0 : 0.0));
    problem.q.push_back(-1.0);
  }
  return problem;
}

// Of the other methods too, but for `enumerate`, which takes 12 unknowns at most.
TEST(ComparisonSolvers, SurviveGrowthOfTheSolution) {
  for (const LcpMethod& method : lcp_methods()) {
    if (std::holds_alternative<EnumerateSettings>(method.defaults)) continue;
    // Lemke's pivots fall with 2^-n beside the largest entry of their column, below what both versions take.
    const std::size_t n = method.name.starts_with("lemke") ? 20 : 40;
    const LcpResult result = solve_lcp(growing(n), method.defaults);
    ASSERT_EQ(result.status, LcpStatus::solved) << method.name;
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_DOUBLE_EQ(result.z[i], std::ldexp(1.0, static_cast<int>(i))) << method.name;
    }
  }
}

LcpProblem random_dominant(test::Random& random, std::size_t n) {
  LcpProblem problem;
  for (std::size_t i = 0; i < n; ++i) {
    double beside = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      problem.M.push_back(random.uniform(-1.0, 1.0));
      if (j != i) beside += std::abs(problem.M.back());
    }
    problem.M[i * n + i] = (beside + 0.1) * random.uniform(1.1, 2.0);
    problem.q.push_back(random.uniform(-1.0, 1.0));
  }
  return problem;
}

// A triangle with a positive diagonal is a P-matrix, though far from definite. Shuffled, so that no order helps.
LcpProblem random_shuffled_triangle(test::Random& random, std::size_t n) {
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) {
    order[i] = i;
    std::swap(order[i], order[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i + 1)))]);
  }
  LcpProblem problem{Vector(n * n, 0.0), Vector(n, 0.0), {}};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) problem.M[order[i] * n + order[j]] = random.uniform(-2.0, 2.0);
    problem.M[order[i] * n + order[i]] = random.uniform(0.5, 1.0);
    problem.q[order[i]] = random.uniform(-1.0, 1.0);
  }
  return problem;
}

// The one solution, by enumeration. Entries stay within 1e4 times round-off for n <= 6 and bases as above.
void expect_enumerated_solution(const LcpProblem& problem, const Solver& solver, int number) {
  const LcpResult result = solve_lcp(problem, solver.settings);
  ASSERT_EQ(result.status, LcpStatus::solved) << solver.name << " " << number;
  const std::vector<LcpResult> all = enumerate_solutions(problem);
  ASSERT_EQ(all.size(), 1u) << number;
  const double tolerance = is_pivoting(solver) ? 1e-12 : 1e4 * k_accepted;
  EXPECT_LE(difference(result.z, all[0].z), tolerance * largest(all[0].z)) << solver.name << " " << number;
}

TEST(ComparisonSolvers, FindTheSolutionOfSymmetricDefiniteProblems) {
  test::Random random(31);
  for (int i = 0; i < 1000; ++i) {
    const std::size_t n = 1 + static_cast<std::size_t>(i) % 6;
    const LcpProblem problem = test::random_semidefinite(random, n, n, 0.1, 0.0);
    for (const Solver& solver : solvers()) expect_enumerated_solution(problem, solver, i);
    expect_enumerated_solution(problem, {"pgs", PgsSettings{.relaxation = 1.5}, LcpRung::pgs}, i);
  }
}

TEST(ComparisonSolvers, FindTheSolutionOfDominantProblems) {
  test::Random random(32);
  for (int i = 0; i < 1000; ++i) {
    const LcpProblem problem = random_dominant(random, 1 + static_cast<std::size_t>(i) % 6);
    for (const Solver& solver : solvers()) expect_enumerated_solution(problem, solver, i);
  }
}

TEST(ComparisonSolvers, PivotingOnesFindTheSolutionForPMatrices) {
  test::Random random(33);
  for (int i = 0; i < 2000; ++i) {
    const std::size_t n = 1 + static_cast<std::size_t>(i) % 6;
    const LcpProblem problem =
        i % 2 == 0 ? random_shuffled_triangle(random, n) : test::random_semidefinite(random, n, n, 0.1, 1.0);
    for (const Solver& solver : solvers()) {
      if (is_pivoting(solver)) expect_enumerated_solution(problem, solver, i);
    }
  }
}

// y with M'y <= 0, y >= 0, q'y < 0: no z >= 0 can make w = M z + q >= 0, for y.w would be < 0.
void expect_proof(const LcpProblem& problem, const Vector& y) {
  constexpr double round_off = 1e-12;  // of the terms summed, for y from a basis of at most 8 rows
  const std::size_t n = problem.size();
  ASSERT_EQ(y.size(), n);
  double product = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_GE(y[i], 0.0);
    product += problem.q[i] * y[i];
  }
  EXPECT_LT(product, -round_off * largest(y));
  for (std::size_t j = 0; j < n; ++j) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += problem(i, j) * y[i];
    EXPECT_LE(sum, round_off * largest(y));
  }
}

TEST(Dantzig, SolvesSemidefiniteProblemsOrProvesThatThereIsNoSolution) {
  test::Random random(34);
  int num_solved = 0, num_infeasible = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::size_t n = 2 + static_cast<std::size_t>(i) % 6;
    const LcpProblem problem = test::random_semidefinite(random, n, n / 3, 0.0, i % 2 == 0 ? 0.0 : 1.0);
    const LcpResult result = dantzig(problem);
    const std::vector<LcpResult> all = enumerate_solutions(problem);
    // M is semidefinite but for its rounding, which may let in a solution beyond what a proof in doubles excludes.
    const bool has_solution = !all.empty() && largest(all[0].z) <= k_largest_growth * largest(problem.q);
    ASSERT_EQ(result.status, has_solution ? LcpStatus::solved : LcpStatus::infeasible) << i;
    ++(has_solution ? num_solved : num_infeasible);
    if (!has_solution) expect_proof(problem, result.certificate);
  }
  EXPECT_GT(num_solved, 500);
  EXPECT_GT(num_infeasible, 300);
}

TEST(Dantzig, ProofsHoldInTheUnitsOfTheProblem) {
  const LcpResult result = dantzig({{0x1p-20, -1, -1, 0x1p20}, {-0x1p-30, -1}, {}});
  ASSERT_EQ(result.status, LcpStatus::infeasible);
  EXPECT_GT(result.certificate[1], 0.0);
  EXPECT_EQ(result.certificate[0], 0x1p20 * result.certificate[1]);  // M'y = 0
}

// A nearly singular basis has huge z, beside which everything is small.
TEST(ComparisonSolvers, DoNotCallInfeasibleProblemsSolved) {
  test::Random random(35);
  int num_infeasible = 0;
  for (int i = 0; i < 600; ++i) {
    const std::size_t n = 2 + static_cast<std::size_t>(i) % 6;
    const LcpProblem problem = test::random_semidefinite(random, n, n / 3, 0.0, 0.0);
    if (dantzig(problem).status != LcpStatus::infeasible) continue;
    ++num_infeasible;
    for (const Solver& solver : solvers()) {
      EXPECT_NE(solve_lcp(problem, solver.settings).status, LcpStatus::solved) << solver.name << " " << i;
    }
  }
  EXPECT_GT(num_infeasible, 200);
}

// A block on the ground, cm to m in size, hit or thrown; sides may touch a wall too.
ContactSystem random_system(test::Random& random, int num_contacts, double max_friction) {
  ContactSystem system;
  for (int k = 0; k < 2; ++k) {
    const double mass = random.uniform(0.5, 2.0);
    system.inverse_mass.push_back({1.0 / mass, 1.0 / mass, random.uniform(6.0, 12.0) / mass});
    system.velocity.push_back({random.uniform(-1.0, 1.0), random.uniform(-2.0, 0.0), random.uniform(-1.0, 1.0)});
  }
  for (int i = 0; i < num_contacts; ++i) {
    BodyContact contact;
    contact.body_b = i % 2;
    contact.body_a = i % 3 == 2 ? 1 - contact.body_b : -1;
    const double x = random.uniform(-0.5, 0.5), y = random.uniform(-0.6, -0.4);
    contact.normal_b = {0.0, 1.0, x};
    contact.tangent_b = {1.0, 0.0, -y};
    contact.normal_a = {0.0, -1.0, -random.uniform(-0.5, 0.5)};
    contact.tangent_a = {-1.0, 0.0, 0.5};
    contact.friction = random.uniform(0.0, max_friction);
    system.contacts.push_back(contact);
  }
  return system;
}

double distance_of_motions(const ContactSystem& system, const Vector& z_a, const Vector& z_b) {
  const std::vector<Vector3> a = velocities_after(system, z_a), b = velocities_after(system, z_b);
  double distance = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) distance = std::max(distance, std::abs(a[k][i] - b[k][i]));
  }
  return distance;
}

TEST(Nlgs, FindsAMotionThatEnumerationFinds) {
  test::Random random(36);
  for (int i = 0; i < 300; ++i) {
    const ContactSystem system = random_system(random, 1 + i % 2, 1.0);
    const LcpProblem problem = as_lcp(system);
    const LcpResult result = nlgs(problem, {.accepted_residual = 1e-12});
    ASSERT_EQ(result.status, LcpStatus::solved) << i;
    expect_consistent(problem, result, "nlgs");
    double nearest = std::numeric_limits<double>::infinity();
    for (const LcpResult& solution : enumerate_solutions(problem)) {
      nearest = std::min(nearest, distance_of_motions(system, result.z, solution.z));
    }
    EXPECT_LT(nearest, 1e-9) << i;  // velocities of order 1, a residual of 1e-12, condition of A up to 1e3
  }
}

// Boxes on each other, two contacts per face, at rest but for one step of gravity.
ContactSystem tower(int num_boxes, double friction) {
  ContactSystem system;
  for (int k = 0; k < num_boxes; ++k) {
    system.inverse_mass.push_back({1.0, 1.0, 6.0});
    system.velocity.push_back({0.25, -1.0, 0.0});
    for (const double x : {-0.5, 0.5}) {
      BodyContact contact;
      contact.body_a = k - 1;
      contact.body_b = k;
      contact.normal_b = {0.0, 1.0, x};
      contact.tangent_b = {1.0, 0.0, 0.5};
      contact.normal_a = {0.0, -1.0, -x};
      contact.tangent_a = {-1.0, 0.0, 0.5};
      contact.friction = friction;
      system.contacts.push_back(contact);
    }
  }
  return system;
}

TEST(Nlgs, SolvesTowersWithTheMotionOfRobust) {
  for (const double friction : {0.0, 0.1, 0.8}) {
    const ContactSystem system = tower(10, friction);
    const LcpProblem problem = as_lcp(system);
    // The slowest of them takes 32000 sweeps: the error of a tower falls by a thousandth per sweep.
    const LcpResult swept = nlgs(problem, {.max_sweeps = 100'000, .accepted_residual = 1e-11});
    const LcpResult exact = robust(problem);
    ASSERT_EQ(swept.status, LcpStatus::solved) << friction;
    ASSERT_EQ(exact.status, LcpStatus::solved) << friction;
    EXPECT_LT(distance_of_motions(system, swept.z, exact.z), 1e-7) << friction;  // errors of ten boxes add up
  }
}

TEST(Nlgs, StartsFromAGivenZ) {
  const LcpProblem problem = as_lcp(tower(5, 0.5));
  const LcpResult cold = nlgs(problem);
  ASSERT_EQ(cold.status, LcpStatus::solved);
  EXPECT_EQ(nlgs(problem, {.start_z = cold.z}).pivots, 0);
  LcpProblem near = problem;
  for (double& q_i : near.q) q_i *= 1.0 + 0x1p-20;
  const LcpResult warm = nlgs(near, {.start_z = cold.z});
  EXPECT_EQ(warm.status, LcpStatus::solved);
  EXPECT_LT(warm.pivots, cold.pivots / 2);
}

TEST(Nlgs, BasisGivesTheSolutionExactly) {
  const LcpProblem problem = as_lcp(tower(1, 0.05));
  const LcpResult swept = nlgs(problem);
  ASSERT_EQ(swept.status, LcpStatus::solved);
  const LcpResult exact = lemke_lu(problem, {.start_basis = swept.basis});
  EXPECT_EQ(exact.status, LcpStatus::solved);
  EXPECT_EQ(exact.pivots, 0);
}

// A wheel on an axle: normal and tangential velocity are one and the same motion, so the 2x2 block is singular.
TEST(Nlgs, SolvesContactsWithASingularBlock) {
  ContactSystem system;
  system.inverse_mass = {{0.0, 0.0, 2.0}};
  system.velocity = {{0.0, 0.0, -1.0}};
  BodyContact contact;
  contact.body_b = 0;
  contact.normal_b = {0.0, 1.0, 0.3};
  contact.tangent_b = {1.0, 0.0, 0.7};
  for (const double friction : {0.0, 0.2, 1.0}) {
    contact.friction = friction;
    system.contacts = {contact, contact};
    const LcpProblem problem = as_lcp(system);
    const LcpResult result = nlgs(problem);
    EXPECT_EQ(result.status, LcpStatus::solved) << friction;
    EXPECT_NEAR(velocities_after(system, result.z)[0][2], 0.0, 1e-7)
        << friction;  // the accepted residual, times 1 / 0.3
  }
}

TEST(ComparisonSolvers, SayWhichMatricesGaussSeidelCannotTake) {
  const LcpProblem contact = as_lcp(tower(1, 0.5));
  const LcpResult result = pgs(contact);  // its cone rows have no diagonal
  EXPECT_EQ(result.status, LcpStatus::numerical);
  EXPECT_EQ(result.pivots, 0);
  EXPECT_EQ(result.z, Vector(contact.size(), 0.0));
  EXPECT_EQ(nlgs({{0, 1, -1, 0}, {-1, 2}, {}}).status, LcpStatus::numerical);  // no contacts, and no diagonal
  EXPECT_EQ(nlgs({{1, 0, 0, -1}, {-1, -1}, {}}).status, LcpStatus::numerical);
}

TEST(ComparisonSolvers, GiveTheScaledSolutionBitForBitInOtherUnits) {
  test::Random random(37);
  for (int i = 0; i < 100; ++i) {
    const ContactSystem system = random_system(random, 3, 1.0);
    const LcpProblem problem = as_lcp(system);
    const LcpProblem other = as_lcp(test::in_other_units(system, 13, -9, 6));
    const std::size_t k = system.contacts.size();
    for (const Solver& solver : solvers()) {
      const LcpResult a = solve_lcp(problem, solver.settings);
      const LcpResult b = solve_lcp(other, solver.settings);
      EXPECT_EQ(a.status, b.status) << solver.name;
      EXPECT_EQ(a.pivots, b.pivots) << solver.name;
      EXPECT_EQ(a.residual, b.residual) << solver.name;
      for (std::size_t j = 0; j < problem.size(); ++j) {
        const int exponent = j < 3 * k ? 13 - 9 - 6 : -9 - 6;  // impulses, slip speeds
        EXPECT_EQ(std::ldexp(a.z[j], exponent), b.z[j]) << solver.name;
      }
    }
  }
}

TEST(ComparisonSolvers, GiveTheScaledSolutionBitForBitForAnyMatrix) {
  test::Random random(38);
  for (int i = 0; i < 100; ++i) {
    const LcpProblem problem = test::random_semidefinite(random, 6, 6, 0.1, 0.3);
    LcpProblem other = problem;
    for (double& entry : other.M) entry = std::ldexp(entry, 17 - 40);
    for (double& entry : other.q) entry = std::ldexp(entry, -40);
    for (const Solver& solver : solvers()) {
      const LcpResult a = solve_lcp(problem, solver.settings);
      const LcpResult b = solve_lcp(other, solver.settings);
      EXPECT_EQ(a.pivots, b.pivots) << solver.name;
      for (std::size_t j = 0; j < 6; ++j) EXPECT_EQ(std::ldexp(a.z[j], -17), b.z[j]) << solver.name;
    }
  }
}

TEST(ComparisonSolvers, DoNotDependOnWhatTheWorkspaceSolvedBefore) {
  test::Random random(39);
  LcpWorkspace workspace;
  for (int i = 0; i < 200; ++i) {
    const std::size_t n = 1 + static_cast<std::size_t>(random.uniform(0.0, 9.0));
    const LcpProblem problem = i % 3 == 0 ? as_lcp(random_system(random, 1 + i % 4, 1.0))
                                          : test::random_semidefinite(random, n, n / 2, 0.0, 0.5);
    for (const Solver& solver : solvers()) {
      const LcpResult fresh = solve_lcp(problem, solver.settings);
      const LcpResult& reused = solve_lcp(problem, solver.settings, workspace);
      EXPECT_EQ(fresh.status, reused.status) << solver.name;
      EXPECT_EQ(fresh.z, reused.z) << solver.name;
      EXPECT_EQ(fresh.basis, reused.basis) << solver.name;
      EXPECT_EQ(fresh.pivots, reused.pivots) << solver.name;
      EXPECT_EQ(fresh.certificate, reused.certificate) << solver.name;
    }
  }
}

TEST(ComparisonSolvers, StopAtTheAllowedNumberOfSteps) {
  test::Random random(40);
  const LcpProblem problem = test::random_semidefinite(random, 30, 30, 0.01, 0.3);
  const std::vector<LcpSettings> all = {MurtySettings{.max_pivots = 2}, DantzigSettings{.max_pivots = 2},
                                        NewtonSettings{.max_iterations = 1}, PgsSettings{.max_sweeps = 2},
                                        NlgsSettings{.max_sweeps = 2}};
  for (const LcpSettings& settings : all) {
    const LcpResult result = solve_lcp(problem, settings);
    EXPECT_EQ(result.status, LcpStatus::iteration_limit);
    EXPECT_EQ(result.pivots, std::holds_alternative<NewtonSettings>(settings) ? 1 : 2);
    EXPECT_GT(result.residual, k_accepted);
    expect_consistent(problem, result, std::string(to_string(result.rung)));
  }
}

TEST(ComparisonSolvers, RefuseBadSettings) {
  const LcpProblem problem{{1}, {-1}, {}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(murty(problem, {.max_pivots = -1}), std::invalid_argument);
  EXPECT_THROW(murty(problem, {.accepted_residual = 0.0}), std::invalid_argument);
  EXPECT_THROW(dantzig(problem, {.max_pivots = -1}), std::invalid_argument);
  EXPECT_THROW(dantzig(problem, {.pivot_tolerance = 1.0}), std::invalid_argument);
  EXPECT_THROW(dantzig(problem, {.accepted_residual = nan}), std::invalid_argument);
  EXPECT_THROW(newton(problem, {.max_iterations = 0}), std::invalid_argument);
  EXPECT_THROW(newton(problem, {.accepted_residual = 0.1}), std::invalid_argument);
  EXPECT_THROW(pgs(problem, {.max_sweeps = 0}), std::invalid_argument);
  EXPECT_THROW(pgs(problem, {.relaxation = 2.0}), std::invalid_argument);
  EXPECT_THROW(pgs(problem, {.relaxation = nan}), std::invalid_argument);
  EXPECT_THROW(pgs(problem, {.start_z = {1.0, 1.0}}), std::invalid_argument);
  EXPECT_THROW(pgs(problem, {.start_z = {-1.0}}), std::invalid_argument);
  EXPECT_THROW(nlgs(problem, {.max_sweeps = 0}), std::invalid_argument);
  EXPECT_THROW(nlgs(problem, {.start_z = {nan}}), std::invalid_argument);
  EXPECT_THROW(nlgs({{nan}, {1}, {}}), std::invalid_argument);
}

TEST(ComparisonSolvers, ReportNumbersBeyondDoubleAsAStatus) {
  for (const Solver& solver : solvers()) {
    const LcpResult result = solve_lcp({{1e-300}, {-1e300}, {}}, solver.settings);  // z = 1e600
    EXPECT_NE(result.status, LcpStatus::solved) << solver.name;
    EXPECT_FALSE(result.residual < 1.0) << solver.name;
  }
}

// A ratio beyond the largest double is one all the same: a variable that blocks nowhere else blocks there.
TEST(Dantzig, TakesRatiosBeyondDouble) {
  const LcpResult result = dantzig({{1, -1e-310, 0, 1}, {1, -1}, {}}, {.pivot_tolerance = 0.0});
  EXPECT_EQ(result.status, LcpStatus::solved);
  EXPECT_EQ(result.z, (std::vector<double>{0, 1}));
}

}  // namespace
}  // namespace tumble
