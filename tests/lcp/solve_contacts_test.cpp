// Contacts by their Jacobians: laws, closed forms, and what is gained over the rounded J M^-1 J^T.
#include "tumble/lcp/solve_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "other_units.hpp"
#include "problems.hpp"
#include <gtest/gtest.h>

namespace tumble {
namespace {

using enum ContactMode;

// A ball of mass 1 on the ground, and one of mass 1 / w on top; both come down with the ground moving under them.
ContactSystem heavy_on_light(double w) {
  const Vector3 up{0, 1, 0}, right{1, 0, 0}, none{};
  return {{{1, 1, 1}, {w, w, w}},
          {{0.03, -1, 0}, {-0.07, -1.1, 0}},
          {{-1, 0, none, up, none, right, 0.5, 0.0}, {0, 1, {0, -1, 0}, up, {-1, 0, 0}, right, 0.5, 0.0}}};
}

// The lower contact bears 1 + 1.1 / w, the upper one 1.1 / w: to the last digits, where M holds the fewer of them the
// heavier the body on top is, so that the LCP of the rounded M has another solution.
TEST(SolveContacts, KeepsTheDigitsOfAHeavyBodyOnALightOne) {
  double worst_of_lcp = 0.0;
  for (double w = 1.0; w > 1e-20; w *= 0.7) {
    const ContactSystem system = heavy_on_light(w);
    const ContactSolution solution = solve_contacts(system);
    ASSERT_EQ(solution.result.status, LcpStatus::solved) << w;
    const double upper = 1.1 / w, lower = upper + 1.0;
    // In M and q as well, as far as z, rounded to double, can: its terms are known to 2^-53, and count up to 1e7.
    EXPECT_LE(solution.result.residual, std::max(1e-12, 0x1p-52 * lower / k_largest_growth)) << w;
    // The impulses are rounded once; 1e-13 is what the correction promises for velocities.
    EXPECT_NEAR(solution.normal_impulse[0], lower, 1e-13 * lower) << w;
    EXPECT_NEAR(solution.normal_impulse[1], upper, 1e-13 * upper) << w;
    for (const Vector3& v : solution.velocity) {
      for (const double x : v) EXPECT_NEAR(x, 0.0, 2e-13) << w;
    }
    worst_of_lcp = std::max(worst_of_lcp, std::abs(solve_lcp(as_lcp(system)).z[1] / upper - 1.0));
  }
  EXPECT_GT(worst_of_lcp, 1e-4);
}

// What the answer must be whatever the method: judged with the Jacobians in long double.
void expect_laws(const ContactSystem& system, const ContactSolution& solution, double tolerance) {
  double speed = 0.0;
  const auto velocity = [&](const BodyContact& c, const std::vector<Vector3>& v, bool is_normal) {
    long double u = is_normal ? c.offset : 0.0;
    for (std::size_t j = 0; j < 3; ++j) {
      const Vector3 &a = is_normal ? c.normal_a : c.tangent_a, &b = is_normal ? c.normal_b : c.tangent_b;
      if (c.body_a >= 0) u += static_cast<long double>(a[j]) * v[static_cast<std::size_t>(c.body_a)][j];
      if (c.body_b >= 0) u += static_cast<long double>(b[j]) * v[static_cast<std::size_t>(c.body_b)][j];
    }
    return static_cast<double>(u);
  };
  for (const BodyContact& c : system.contacts) {
    for (const bool is_normal : {true, false}) {
      speed = std::max(speed, std::abs(velocity(c, system.velocity, is_normal)));
    }
  }
  for (std::size_t i = 0; i < system.contacts.size(); ++i) {
    const BodyContact& c = system.contacts[i];
    const double f_n = solution.normal_impulse[i], f_t = solution.friction_impulse[i];
    const double u_n = velocity(c, solution.velocity, true), u_t = velocity(c, solution.velocity, false);
    EXPECT_GE(f_n, 0.0);
    EXPECT_LE(std::abs(f_t), c.friction * f_n * (1.0 + 4e-16) + std::numeric_limits<double>::min());
    EXPECT_GE(u_n, -tolerance * speed);
    const ContactMode mode = solution.mode[i];
    EXPECT_TRUE(mode == open || u_n <= tolerance * speed);
    EXPECT_TRUE(mode != stick || std::abs(u_t) <= tolerance * speed);
    EXPECT_TRUE(mode != slip_left || u_t <= tolerance * speed);
    EXPECT_TRUE(mode != slip_right || u_t >= -tolerance * speed);
  }
}

// A box on two corners, each of them there twice: the same, or up to 1e-14 apart.
TEST(SolveContacts, TakesContactsThatAreNearlyTheSame) {
  problems::Random random(51);
  for (int i = 0; i < 200; ++i) {
    ContactSystem system{{{1, 1, 10}}, {{random.uniform(-1, 1), -1, random.uniform(-1, 1)}}, {}};
    for (const double r_x : {-0.5, -0.5, 0.5, 0.5}) {
      const double apart = i % 2 == 0 ? 0.0 : random.uniform(-1e-14, 1e-14);
      const Vector3 normal{apart, 1, r_x + apart}, tangent{1, -apart, 0.25};
      system.contacts.push_back({-1, 0, {}, normal, {}, tangent, 0.5, 0.0});
    }
    const ContactSolution solution = solve_contacts(system);
    ASSERT_EQ(solution.result.status, LcpStatus::solved) << i;
    expect_laws(system, solution, 1e-13);
    if (HasFailure()) FAIL() << i;
  }
}

// Towers whose masses are up to 1e3 : 1 or 1 : 1e6 are at rest to the last digits of their speed.
TEST(SolveContacts, SatisfiesTheContactsOfTowers) {
  problems::Random random(52);
  for (int i = 0; i < 100; ++i) {
    const ContactSystem system = problems::tower(random, 8);
    const ContactSolution solution = solve_contacts(system);
    ASSERT_EQ(solution.result.status, LcpStatus::solved) << i;
    expect_laws(system, solution, 2e-13);  // k_round_off, and the rounding of the velocities
    if (HasFailure()) FAIL() << i;
  }
}

TEST(SolveContacts, GivesTheSameInOtherUnitsBitForBit) {
  const ContactSystem system = heavy_on_light(0.7e-10);
  const ContactSolution one = solve_contacts(system);
  const ContactSolution other = solve_contacts(test::in_other_units(system, 13, -9, 6));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(std::ldexp(one.normal_impulse[i], 13 - 9 - 6), other.normal_impulse[i]);
    EXPECT_EQ(std::ldexp(one.friction_impulse[i], 13 - 9 - 6), other.friction_impulse[i]);
  }
}

TEST(SolveContacts, GivesTheSameWithAWorkspace) {
  problems::Random random(53);
  LcpWorkspace workspace;
  for (int i = 0; i < 50; ++i) {
    const ContactSystem system = problems::wild(random, 1 + static_cast<std::size_t>(i % 3));
    const ContactSolution one = solve_contacts(system), other = solve_contacts(system, RobustSettings{}, workspace);
    EXPECT_EQ(one.result.z, other.result.z);
    EXPECT_EQ(one.velocity, other.velocity);
    EXPECT_EQ(one.mode, other.mode);
  }
  const ContactSystem system = heavy_on_light(1.0);
  RobustSettings settings;
  settings.start_basis = {1};
  EXPECT_THROW(solve_contacts(system, settings), std::invalid_argument);
  const ContactSolution bad = solve_contacts(system, settings, workspace);
  EXPECT_EQ(bad.result.status, LcpStatus::bad_input);
  EXPECT_EQ(bad.velocity, system.velocity);
}

}  // namespace
}  // namespace tumble
