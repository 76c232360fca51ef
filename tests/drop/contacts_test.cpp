// Part 1: distance and Jacobian of the lowest corner.
#include <cmath>
#include <numbers>

#include "../random_contact.hpp"
#include <gtest/gtest.h>

#include "tumble/drop/drop.hpp"

namespace tumble::drop {
namespace {

constexpr double k_pi = std::numbers::pi;

TEST(GetContacts, KnowsPosesByHand) {
  const auto [J, phi] = get_contacts({3.0, 1.0, k_pi / 4});  // on one corner, straight below the centre
  const double half_diagonal = 0.1 * std::numbers::sqrt2;
  EXPECT_NEAR(phi, 1.0 - half_diagonal, 1e-15);
  EXPECT_EQ(J.t[0], 1.0);
  EXPECT_EQ(J.t[1], 0.0);
  EXPECT_NEAR(J.t[2], half_diagonal, 1e-15);
  EXPECT_EQ(J.n[0], 0.0);
  EXPECT_EQ(J.n[1], 1.0);
  EXPECT_NEAR(J.n[2], 0.0, 1e-16);
}

TEST(GetContacts, TakesTheFirstCornerOnATie) {
  EXPECT_EQ(corner_index({0, 1, 0}), 0);  // corners 0 and 1 are level
  const auto [J, phi] = get_contacts({0, 1, 0});
  EXPECT_EQ(J.n[2], -0.1);
  EXPECT_EQ(phi, 0.9);
}

TEST(GetContacts, FindsEveryCorner) {
  EXPECT_EQ(corner_index({0, 1, 0.3}), 0);
  EXPECT_EQ(corner_index({0, 1, -0.3}), 1);
  EXPECT_EQ(corner_index({0, 1, k_pi + 0.3}), 2);
  EXPECT_EQ(corner_index({0, 1, -k_pi / 2 - 0.3}), 2);
  EXPECT_EQ(corner_index({0, 1, k_pi - 0.3}), 3);
  EXPECT_EQ(corner_index({0, 1, 0.3 + 6 * k_pi}), 0);
}

TEST(GetContacts, AgreesWithTheCornerPositions) {
  test::Random random(20);
  for (int i = 0; i < 10000; ++i) {
    const Vector3 q = {random.uniform(-5, 5), random.uniform(-1, 2), random.uniform(-50, 50)};
    const Parameters p{.l = random.uniform(0.01, 3.0)};
    const auto corners = corner_positions(q, p);
    const auto [J, phi] = get_contacts(q, p);
    const auto& lowest = corners[static_cast<std::size_t>(corner_index(q, p))];
    for (const auto& corner : corners) EXPECT_LE(lowest[1], corner[1]);
    EXPECT_EQ(lowest[1], phi);
    EXPECT_NEAR(lowest[0], q[0] + J.n[2], 1e-15);
    EXPECT_NEAR(lowest[1], q[1] - J.t[2], 1e-15);
    for (std::size_t k = 0; k < 4; ++k) {  // all on the circle around the centre, a side apart
      const auto& a = corners[k];
      const auto& b = corners[(k + 1) % 4];
      EXPECT_NEAR(std::hypot(a[0] - b[0], a[1] - b[1]), p.l, 1e-14 * 6);  // 1e-16 of coordinates up to 6
    }
  }
}

// J_n is the gradient of phi, J_t that of the corner's x, as long as the same corner stays the lowest.
TEST(GetContacts, JacobianIsTheDerivativeOfTheCorner) {
  test::Random random(21);
  constexpr double h = 1e-6;
  // Central differences: h^2 / 6 |third derivative| = 2e-13 l, plus round-off 1e-16 |q| / h.
  constexpr double tolerance = 5e-10;
  for (int i = 0; i < 2000; ++i) {
    Vector3 q = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-10, 10)};
    // Keep a corner's width away from level faces, where the lowest corner changes.
    if (std::abs(std::sin(2.0 * q[2])) < 1e-3) continue;
    const auto [J, phi] = get_contacts(q);
    const auto k = static_cast<std::size_t>(corner_index(q));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Vector3 plus = q, minus = q;
      plus[axis] += h;
      minus[axis] -= h;
      EXPECT_NEAR(J.n[axis], (get_contacts(plus).phi - get_contacts(minus).phi) / (2 * h), tolerance);
      EXPECT_NEAR(J.t[axis], (corner_positions(plus)[k][0] - corner_positions(minus)[k][0]) / (2 * h), tolerance);
    }
  }
}

}  // namespace
}  // namespace tumble::drop
