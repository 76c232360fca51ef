#include "tumble/lcp/one_contact.hpp"

#include <limits>

#include "../random_contact.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/residual.hpp"

namespace tumble {
namespace {

// J_n = (0, 1, n), J_t = (1, 0, t), M^-1 = diag(1, 1, 12), velocity v.
OneContact contact(double n, double t, double friction, const Vector3& v) {
  return {1 + 12 * n * n, 12 * n * t, 1 + 12 * t * t, v[1] + n * v[2], v[0] + t * v[2], friction};
}

void expect_solution(const OneContact& c, ContactMode mode, double f_n, double f_t, double slip_speed) {
  const OneContactSolution solution = solve_one_contact(c);
  EXPECT_EQ(solution.status, LcpStatus::solved);
  EXPECT_EQ(solution.mode, mode);
  EXPECT_NEAR(solution.f_n, f_n, 1e-14);
  EXPECT_NEAR(solution.f_t, f_t, 1e-14);
  EXPECT_NEAR(solution.slip_speed, slip_speed, 1e-14);
  EXPECT_LT(solution.residual, 1e-14);
}

TEST(OneContact, SolvesProblemsWithExactSolutions) {
  expect_solution(contact(0, .5, .5, {.1, -1, 0}), ContactMode::stick, 1, -1 / 40., 0);
  expect_solution(contact(0, .5, .5, {4, -1, 0}), ContactMode::slip_right, 1, -.5, 2);
  expect_solution(contact(0, .5, .5, {-4, -1, 0}), ContactMode::slip_left, 1, .5, 2);
  expect_solution(contact(.4, .3, 1, {1, -1, 0}), ContactMode::slip_right, 25 / 37., -25 / 37., 21 / 37.);
  expect_solution(contact(.4, .3, 1, {1, 0, 0}), ContactMode::open, 0, 0, 1);
  expect_solution(contact(.4, .3, 1, {-1, 2, 0}), ContactMode::open, 0, 0, 1);
}

// Friction above A_nn / |A_nt|, where sliding one way pulls the contact in. [Painleve 1895]
TEST(OneContact, SolvesPainleveContacts) {
  expect_solution(contact(.3, -.8, 3, {1, -.01, 0}), ContactMode::slip_right, 1 / 1072., -3 / 1072., 26077 / 26800.);
  // Jammed: only sticking is left, an impact without collision.
  expect_solution(contact(.3, -.8, 3, {-1, -.01, 0}), ContactMode::stick, 7417 / 24400., 659 / 3050., 0);
  // Opening while jammed has three solutions; the one without force is chosen.
  expect_solution(contact(.3, -.8, 3, {-1, .01, 0}), ContactMode::open, 0, 0, 1);
}

TEST(OneContact, DoesNothingAtRestWithoutLoad) { expect_solution({1, 0, 1, 0, 0, .5}, ContactMode::open, 0, 0, 0); }

TEST(OneContact, MirrorsTheSolutionOfAMirroredContactBitForBit) {
  test::Random random(11);
  for (int i = 0; i < 2000; ++i) {
    OneContact c = test::random_contact(random, 3.0);
    const OneContactSolution original = solve_one_contact(c);
    c.A_nt = -c.A_nt;
    c.b_t = -c.b_t;
    const OneContactSolution mirrored = solve_one_contact(c);
    EXPECT_EQ(original.f_n, mirrored.f_n);
    EXPECT_EQ(original.f_t, -mirrored.f_t);
    EXPECT_EQ(original.slip_speed, mirrored.slip_speed);
  }
}

// The residual in closed form is the general one: same rows, same scales.
TEST(OneContact, ReportsTheResidualOfItsLcp) {
  test::Random random(12);
  for (int i = 0; i < 2000; ++i) {
    const OneContact c = test::random_contact(random, 3.0);
    const OneContactSolution solution = solve_one_contact(c);
    const double general = residual(as_lcp(c), as_z(solution)).largest();
    EXPECT_NEAR(solution.residual, general, 4e-16);  // both are round-off, summed in another order
    EXPECT_EQ(solution.status, LcpStatus::solved);
  }
}

TEST(OneContact, ReportsAWrongContactAsNumerical) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(solve_one_contact({1, 0, 1, -1, 0, nan}).status, LcpStatus::numerical);
  EXPECT_EQ(solve_one_contact({nan, 0, 1, -1, 0, .5}).status, LcpStatus::numerical);
  EXPECT_EQ(solve_one_contact({-1, 0, 1, -1, 0, 0}).status, LcpStatus::numerical);  // A not positive definite
  EXPECT_EQ(solve_one_contact({1, 0, 1, 1, 0, nan}).status, LcpStatus::numerical);
  EXPECT_EQ(solve_one_contact({1, 5, 1, 1, 1, -.5}).status, LcpStatus::numerical);
  const OneContactSolution beyond_double = solve_one_contact({1e-300, 0, 1e-300, -1e300, 0, .5});
  EXPECT_EQ(beyond_double.status, LcpStatus::numerical);
  EXPECT_EQ(beyond_double.residual, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace tumble
