// What `robust` promises beyond solving: the same answer in every unit and from every start, proofs that hold, and
// no memory of earlier problems.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "problems.hpp"
#include "random_problems.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/infeasibility.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

using test::Random;

// Largest difference of the contact velocities that two solutions give, relative to the terms they are sums of.
double motion_difference(const LcpProblem& problem, const std::vector<double>& z, const std::vector<double>& other) {
  const std::size_t m = problem.size() / 4;
  const std::vector<double> w = complement(problem, z), w_other = complement(problem, other);
  const auto size = [&](std::size_t i) {
    double sum = std::abs(problem.q[i]) + problem.row_sizes[i];
    for (std::size_t j = 0; j < 3 * m; ++j) sum += std::abs(problem(i, j) * z[j]);
    return sum;
  };
  double largest = 0.0;
  for (std::size_t k = 0; k < m; ++k) {
    const std::size_t plus = m + 2 * k, minus = plus + 1;
    const double tangential = 0.5 * (w[plus] - w[minus]) - 0.5 * (w_other[plus] - w_other[minus]);
    largest = std::max({largest, std::abs(w[k] - w_other[k]) / size(k), std::abs(tangential) / size(plus)});
  }
  return largest;
}

// Residuals up to 1e-12 are accepted; velocities of stacks, measured in their terms, are hardly worse.
constexpr double k_same_motion = 1e-10;

std::vector<std::uint8_t> random_basis(Random& random, std::size_t n) {
  std::vector<std::uint8_t> basis(n);
  for (std::uint8_t& bit : basis) bit = random.one_in(2);
  return basis;
}

void expect_warm_next_steps(std::size_t contacts_per_face, double mass_exponent, bool is_graded) {
  Random random(1);
  for (const std::size_t num_contacts : {1u, 2u, 4u, 10u, 24u, 40u}) {
    for (int i = 0; i < 10; ++i) {
      problems::Tower tower{
          .contacts_per_face = contacts_per_face, .mass_exponent = mass_exponent, .is_graded = is_graded};
      tower.friction = random.uniform(0.1, 1.0);
      tower.step = random.log_uniform(-13.0, -3.0);
      const ContactSystem system = problems::tower(tower, random, num_contacts);
      const LcpResult first = robust(as_lcp(system));
      ASSERT_EQ(first.status, LcpStatus::solved);
      const LcpProblem next = as_lcp(problems::next_step(system, first.z, random));
      const LcpResult cold = robust(next);
      const LcpResult warm = robust(next, {.start_basis = first.basis});
      ASSERT_EQ(warm.status, LcpStatus::solved);
      ASSERT_EQ(cold.status, LcpStatus::solved);
      // The closed form of one contact needs no help.
      EXPECT_EQ(warm.rung, num_contacts == 1 ? LcpRung::closed_form : LcpRung::warm_start) << num_contacts;
      EXPECT_EQ(warm.pivots, 0) << num_contacts << " contacts, number " << i;
      EXPECT_LT(motion_difference(next, warm.z, cold.z), k_same_motion) << num_contacts << " contacts";
    }
  }
}

TEST(RobustWarmStart, TakesNoPivotInTheNextStepOfAStackAtRest) {
  for (const double mass_exponent : {0.0, 9.966, -19.932}) {  // 1, 1e3, 1e-6
    for (const bool is_graded : {false, true}) {
      expect_warm_next_steps(2, mass_exponent, is_graded);
      expect_warm_next_steps(4, mass_exponent, is_graded);
    }
  }
}

TEST(RobustWarmStart, AWrongBasisDoesNoHarm) {
  Random random(2);
  for (const std::size_t num_contacts : {2u, 4u, 10u, 24u}) {
    for (int i = 0; i < 20; ++i) {
      const LcpProblem problem = as_lcp(problems::tower(random, num_contacts));
      const LcpResult cold = robust(problem);
      ASSERT_EQ(cold.status, LcpStatus::solved);
      for (const auto& basis : {random_basis(random, problem.size()), std::vector<std::uint8_t>(problem.size(), 1),
                                std::vector<std::uint8_t>(problem.size(), 0)}) {
        const LcpResult warm = robust(problem, {.start_basis = basis});
        ASSERT_EQ(warm.status, LcpStatus::solved) << num_contacts << " contacts, number " << i;
        EXPECT_LT(motion_difference(problem, warm.z, cold.z), k_same_motion) << num_contacts << " contacts, " << i;
      }
    }
  }
}

// One solution, whatever the basis tried first, and at least one row that needs a z.
LcpProblem definite(Random& random, std::size_t n) {
  LcpProblem problem = test::random_definite(random, n);
  problem.q[0] = -1.0;
  return problem;
}

TEST(RobustWarmStart, AWrongBasisDoesNoHarmWithoutContacts) {
  Random random(3);
  for (const std::size_t n : {2u, 5u, 12u, 30u, 60u}) {
    for (int i = 0; i < 10; ++i) {
      const LcpProblem problem = definite(random, n);
      const LcpResult cold = robust(problem);
      ASSERT_EQ(cold.status, LcpStatus::solved);
      const LcpResult warm = robust(problem, {.start_basis = random_basis(random, n)});
      const LcpResult again = robust(problem, {.start_basis = cold.basis});
      ASSERT_EQ(warm.status, LcpStatus::solved);
      EXPECT_EQ(again.rung, LcpRung::warm_start);
      EXPECT_EQ(again.pivots, 0);
      const double largest = *std::max_element(cold.z.begin(), cold.z.end());
      constexpr double same = 1e-9;  // the smallest eigenvalue of M + M' is 0.2 or more, the largest below 100
      for (std::size_t j = 0; j < n; ++j) {
        EXPECT_NEAR(warm.z[j], cold.z[j], same * largest);
        EXPECT_NEAR(again.z[j], cold.z[j], same * largest);
      }
    }
  }
}

// Units as powers of two: w_i is multiplied by 2^row[i], z_i by 2^column[i].
struct Units {
  std::vector<int> row, column;
};

LcpProblem in_units(const LcpProblem& problem, const Units& units) {
  const std::size_t n = problem.size();
  LcpProblem scaled = problem;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) scaled.M[i * n + j] = std::ldexp(problem(i, j), units.row[i] - units.column[j]);
    scaled.q[i] = std::ldexp(problem.q[i], units.row[i]);
    if (!problem.row_sizes.empty()) scaled.row_sizes[i] = std::ldexp(problem.row_sizes[i], units.row[i]);
  }
  return scaled;
}

void expect_same_bits(const LcpProblem& problem, const Units& units, const std::string& what,
                      std::set<LcpRung>& rungs) {
  const LcpResult a = robust(problem);
  const LcpResult b = robust(in_units(problem, units));
  rungs.insert(a.rung);
  ASSERT_EQ(a.status, b.status) << what;
  ASSERT_EQ(a.rung, b.rung) << what;
  EXPECT_EQ(a.pivots, b.pivots) << what;
  EXPECT_EQ(a.basis, b.basis) << what;
  EXPECT_EQ(a.residual, b.residual) << what;
  for (std::size_t i = 0; i < a.z.size(); ++i) ASSERT_EQ(std::ldexp(a.z[i], units.column[i]), b.z[i]) << what;
}

// Velocities in one new unit, impulses in another: all that units of mass, length and time can do.
Units contact_units(Random& random, std::size_t n) {
  const int velocity = random.below(81) - 40, impulse = random.below(81) - 40;
  Units units{std::vector<int>(n, velocity), std::vector<int>(n, impulse)};
  for (std::size_t i = 3 * (n / 4); i < n; ++i) std::swap(units.row[i], units.column[i]);
  return units;
}

TEST(RobustUnits, ContactsHaveTheSameBitsInEveryUnit) {
  Random random(4);
  std::set<LcpRung> rungs;
  for (const std::size_t num_contacts : {1u, 2u, 4u, 10u}) {
    for (const problems::Family& family : problems::families()) {
      for (int i = 0; i < 100; ++i) {
        LcpProblem problem = as_lcp(family.make(random, num_contacts));
        if (i % 2 == 1) problem.row_sizes.clear();
        const std::string what = std::string(family.name) + ", number " + std::to_string(i);
        expect_same_bits(problem, contact_units(random, problem.size()), what, rungs);
      }
    }
  }
  EXPECT_TRUE(rungs.contains(LcpRung::closed_form) && rungs.contains(LcpRung::contact_modes));
}

// Each unknown in a unit of its own, with w_i z_i in the same unit for all i.
Units general_units(Random& random, std::size_t n) {
  const int product = random.below(41) - 20;
  Units units;
  for (std::size_t i = 0; i < n; ++i) {
    units.column.push_back(random.below(61) - 30);
    units.row.push_back(product - units.column.back());
  }
  return units;
}

// Solvable or not. Each row has a diagonal, by which its unit is known.
LcpProblem anything(Random& random, std::size_t n) {
  LcpProblem problem;
  for (std::size_t k = 0; k < n * n; ++k) {
    const bool is_zero = k % (n + 1) != 0 && random.one_in(3);
    const double scale = random.log_uniform(-10.0, 10.0);
    problem.M.push_back(is_zero ? 0.0 : scale * random.uniform(-1.0, 1.0));
  }
  for (std::size_t i = 0; i < n; ++i) problem.q.push_back(random.uniform(-1.0, 1.0));
  return problem;
}

TEST(RobustUnits, OtherProblemsHaveTheSameBitsInEveryUnit) {
  Random random(5);
  std::set<LcpRung> rungs;
  for (const std::size_t n : {4u, 8u, 16u, 40u, 120u}) {
    for (int i = 0; i < (n < 100 ? 40 : 2); ++i) {
      const std::string what = "n = " + std::to_string(n) + ", number " + std::to_string(i);
      expect_same_bits(definite(random, n), general_units(random, n), "definite, " + what, rungs);
      if (n <= 16) expect_same_bits(anything(random, n), general_units(random, n), "anything, " + what, rungs);
    }
  }
  EXPECT_TRUE(rungs.contains(LcpRung::lemke) && rungs.contains(LcpRung::lemke_lu));
}

TEST(RobustWorkspace, ResultsDoNotDependOnWhatWasSolvedBefore) {
  Random random(6);
  std::vector<LcpProblem> problems;
  for (int i = 0; i < 100; ++i) {
    problems.push_back(as_lcp(problems::wild(random, 1 + static_cast<std::size_t>(random.below(8)))));
    problems.push_back(definite(random, 1 + static_cast<std::size_t>(random.below(20))));
    problems.push_back(anything(random, 1 + static_cast<std::size_t>(random.below(9))));
  }
  problems.push_back({{1.0}, {std::numeric_limits<double>::quiet_NaN()}, {}});
  LcpWorkspace workspace;
  for (int i = 0; i < 1000; ++i) {
    const LcpProblem& problem = problems[static_cast<std::size_t>(random.below(static_cast<int>(problems.size())))];
    LcpWorkspace fresh;
    const LcpResult& a = solve_lcp(problem, RobustSettings{}, fresh);
    const LcpResult& b = solve_lcp(problem, RobustSettings{}, workspace);
    ASSERT_EQ(a.status, b.status);
    ASSERT_EQ(a.rung, b.rung);
    ASSERT_EQ(a.z, b.z);
    ASSERT_EQ(a.w, b.w);
    ASSERT_EQ(a.residual, b.residual);
    ASSERT_EQ(a.pivots, b.pivots);
    ASSERT_EQ(a.basis, b.basis);
    ASSERT_EQ(a.certificate, b.certificate);
  }
}

// y >= 0, M'y < 0 and q'y < 0 by construction, rows in units up to 2^(+-largest_exponent).
LcpProblem without_feasible_point(Random& random, std::size_t n, double largest_exponent) {
  std::vector<double> y(n, 0.0);
  for (double& y_i : y) {
    if (!random.one_in(3)) y_i = random.uniform(0.5, 1.0);
  }
  const auto anchor = static_cast<std::size_t>(random.below(static_cast<int>(n)));
  y[anchor] = 1.0;
  LcpProblem problem;
  problem.M.resize(n * n);
  problem.q.resize(n);
  const auto make_negative = [&](auto entry) {  // changes the anchor's entry of a column so that y'column is negative
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      entry(i) = random.one_in(3) ? 0.0 : random.uniform(-1.0, 1.0);
      sum += y[i] * entry(i);
    }
    if (sum > -0.1) entry(anchor) -= sum + random.uniform(0.1, 0.5);
  };
  for (std::size_t j = 0; j < n; ++j) make_negative([&](std::size_t i) -> double& { return problem.M[i * n + j]; });
  make_negative([&](std::size_t i) -> double& { return problem.q[i]; });
  for (std::size_t i = 0; i < n; ++i) {
    const double unit = random.log_uniform(-largest_exponent, largest_exponent);
    for (std::size_t j = 0; j < n; ++j) problem.M[i * n + j] *= unit;
    problem.q[i] *= unit;
  }
  return problem;
}

TEST(RobustProofs, ProblemsWithoutAFeasiblePointAreProvedToBeThat) {
  Random random(7);
  for (const double largest_exponent : {0.0, 10.0, 30.0}) {  // 2^30 is 1e9
    for (int i = 0; i < 150; ++i) {
      const std::size_t n = 1 + static_cast<std::size_t>(random.below(i % 10 == 0 ? 60 : 16));
      const LcpProblem problem = without_feasible_point(random, n, largest_exponent);
      const LcpResult result = robust(problem);
      ASSERT_EQ(result.status, LcpStatus::infeasible)
          << to_string(result.status) << ", n = " << n << ", number " << i << ", rows to 2^" << largest_exponent;
      EXPECT_TRUE(is_infeasibility_certificate(problem, result.certificate));
    }
  }
}

TEST(RobustProofs, FeasibleProblemsAreNeverCalledInfeasible) {
  Random random(8);
  int num_solved = 0;
  for (int i = 0; i < 600; ++i) {
    const std::size_t n = 1 + static_cast<std::size_t>(random.below(i % 20 == 0 ? 60 : 12));
    LcpProblem problem = anything(random, n);
    // q = w - M z for some z, w >= 0: a feasible point, which need not solve the problem.
    std::vector<double> z(n);
    for (double& z_i : z) z_i = random.one_in(2) ? 0.0 : random.log_uniform(-10.0, 10.0);
    problem.q.assign(n, 0.0);
    for (std::size_t k = 0; const double product : complement(problem, z))
      problem.q[k++] = (random.one_in(2) ? 0.01 : random.log_uniform(-10.0, 10.0)) - product;
    const LcpResult result = robust(problem);
    EXPECT_NE(result.status, LcpStatus::infeasible) << "n = " << n << ", number " << i;
    if (result.status == LcpStatus::solved) ++num_solved;
  }
  EXPECT_GT(num_solved, 100);
}

TEST(RobustKnown, AnAnswerFarLargerThanQIsFoundWhereItIsOne) {
  // z_1 = 1e9 makes w_1 vanish, and w_2 = 1e7.
  const LcpResult result = robust({{-1e-10, 1e-7, 0.01, 0.0}, {0.1, -1e-9}, {}});
  ASSERT_EQ(result.status, LcpStatus::solved);
  EXPECT_DOUBLE_EQ(result.z[0], 1e9);
  EXPECT_EQ(result.z[1], 0.0);
}

TEST(RobustKnown, OneRowAloneMakesAProblemInfeasible) {
  const LcpProblem problem{{-1e4, -1e3, 1e-3, -1e-6, 0, -1e-13, 0, -1e7, 10}, {-1e4, -1e-6, -1e8}, {}};
  const LcpResult result = robust(problem);
  EXPECT_EQ(result.status, LcpStatus::infeasible) << to_string(result.status);
  EXPECT_TRUE(is_infeasibility_certificate(problem, result.certificate));
  EXPECT_EQ(robust({{-1.0}, {-1.0}, {}}).status, LcpStatus::infeasible);
  EXPECT_EQ(robust({std::vector<double>(9, 0.0), {1.0, -1e-3, 2.0}, {}}).status, LcpStatus::infeasible);
}

TEST(RobustKnown, OneUnknown) {
  EXPECT_EQ(robust({{2.0}, {-1.0}, {}}).z, std::vector<double>{0.5});
  EXPECT_EQ(robust({{-2.0}, {1.0}, {}}).z, std::vector<double>{0.0});
  EXPECT_EQ(robust({{0.0}, {0.0}, {}}).z, std::vector<double>{0.0});
  EXPECT_EQ(robust({{-1.0}, {0.0}, {}}).z, std::vector<double>{0.0});
  const LcpResult none = robust({{0.0}, {-1e-300}, {}});
  EXPECT_EQ(none.status, LcpStatus::infeasible) << to_string(none.status);
}

TEST(RobustKnown, AZeroMatrixNeedsNothingButQ) {
  const LcpResult result = robust({std::vector<double>(16, 0.0), {1.0, 0.0, 2.0, 3.0}, {}});
  EXPECT_EQ(result.status, LcpStatus::solved);
  EXPECT_EQ(result.z, std::vector<double>(4, 0.0));
}

TEST(RobustKnown, NumbersAtTheEndsOfTheRange) {
  // M z = -q by hand.
  EXPECT_DOUBLE_EQ(robust({{1e300}, {-1e300}, {}}).z[0], 1.0);
  EXPECT_DOUBLE_EQ(robust({{1e-300}, {-1e-300}, {}}).z[0], 1.0);
  EXPECT_DOUBLE_EQ(robust({{1e-150}, {-1e150}, {}}).z[0], 1e300);
  EXPECT_DOUBLE_EQ(robust({{1e-310}, {-1e-310}, {}}).z[0], 1.0);
  const LcpResult mixed = robust({{1e300, 0.0, 0.0, 1e-310}, {-1e300, -1e-310}, {}});
  ASSERT_EQ(mixed.status, LcpStatus::solved) << to_string(mixed.status);
  EXPECT_DOUBLE_EQ(mixed.z[0], 1.0);
  EXPECT_DOUBLE_EQ(mixed.z[1], 1.0);
  // z = 1e600 is no double: whatever is said, it is not `solved` with a wrong z.
  const LcpResult too_large = robust({{1e-300}, {-1e300}, {}});
  EXPECT_NE(too_large.status, LcpStatus::solved);
  EXPECT_NE(too_large.status, LcpStatus::infeasible);
}

TEST(RobustInput, WhatIsNoProblemIsRefused) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::vector<LcpProblem> bad = {
      {{}, {}, {}},                 // n = 0
      {{1.0, 2.0}, {1.0}, {}},      // M is not 1 x 1
      {{nan}, {-1.0}, {}},          // NaN
      {{1.0}, {-infinity}, {}},     // infinity
      {{1.0}, {-1.0}, {1.0, 1.0}},  // a row size too many
      {{1.0}, {-1.0}, {-1.0}},      // a negative one
  };
  LcpWorkspace workspace;
  for (const LcpProblem& problem : bad) {
    EXPECT_THROW(robust(problem), std::invalid_argument);
    EXPECT_THROW(solve_lcp(problem), std::invalid_argument);
    EXPECT_EQ(solve_lcp(problem, RobustSettings{}, workspace).status, LcpStatus::bad_input);
    EXPECT_TRUE(workspace.result.z.empty());
  }
  const LcpProblem good{{2.0}, {-1.0}, {}};
  EXPECT_THROW(robust(good, {.start_basis = {1, 0}}), std::invalid_argument);
  EXPECT_THROW(robust(good, {.accepted_residual = 0.0}), std::invalid_argument);
  EXPECT_THROW(robust(good, {.accepted_residual = nan}), std::invalid_argument);
  EXPECT_EQ(solve_lcp(good, RobustSettings{}, workspace).status, LcpStatus::solved);
}

// Unknown i of the problem becomes unknown place[i].
LcpProblem permuted(const LcpProblem& problem, const std::vector<std::size_t>& place) {
  const std::size_t n = problem.size();
  LcpProblem result = problem;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) result.M[place[i] * n + place[j]] = problem(i, j);
    result.q[place[i]] = problem.q[i];
    if (!problem.row_sizes.empty()) result.row_sizes[place[i]] = problem.row_sizes[i];
  }
  return result;
}

std::vector<std::size_t> random_order(Random& random, std::size_t n) {
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  for (std::size_t i = n; i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  return order;
}

TEST(RobustInvariance, AnotherOrderOfTheUnknownsGivesTheSameMotion) {
  Random random(9);
  for (const std::size_t num_contacts : {1u, 2u, 4u, 10u}) {
    for (int i = 0; i < 50; ++i) {
      const LcpProblem problem = as_lcp(problems::tower(random, num_contacts));
      const std::vector<std::size_t> place = random_order(random, problem.size());
      const LcpResult a = robust(problem);
      const LcpResult b = robust(permuted(problem, place));
      ASSERT_EQ(a.status, LcpStatus::solved);
      ASSERT_EQ(b.status, LcpStatus::solved);
      std::vector<double> z(problem.size());
      for (std::size_t j = 0; j < z.size(); ++j) z[j] = b.z[place[j]];
      EXPECT_LT(motion_difference(problem, a.z, z), k_same_motion) << num_contacts << " contacts, number " << i;
    }
  }
}

TEST(RobustInvariance, AContactNamedTwiceChangesNoMotion) {
  Random random(10);
  for (const std::size_t num_contacts : {1u, 2u, 4u, 10u}) {
    for (int i = 0; i < 50; ++i) {
      ContactSystem system = problems::tower(random, num_contacts);
      const LcpResult once = robust(as_lcp(system));
      const std::vector<BodyContact> contacts = system.contacts;
      system.contacts.insert(system.contacts.end(), contacts.begin(), contacts.end());
      const LcpProblem doubled = as_lcp(system);
      const LcpResult twice = robust(doubled);
      ASSERT_EQ(once.status, LcpStatus::solved);
      ASSERT_EQ(twice.status, LcpStatus::solved) << num_contacts << " contacts, number " << i;
      // The single contacts' impulses, given to the first of each two.
      const std::size_t m = num_contacts;
      std::vector<double> z(8 * m, 0.0);
      for (std::size_t k = 0; k < m; ++k) {
        z[k] = once.z[k];
        z[2 * m + 2 * k] = once.z[m + 2 * k];
        z[2 * m + 2 * k + 1] = once.z[m + 2 * k + 1];
      }
      EXPECT_LT(motion_difference(doubled, twice.z, z), k_same_motion) << num_contacts << " contacts, number " << i;
    }
  }
}

}  // namespace
}  // namespace tumble
