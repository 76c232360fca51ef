// The worlds that engines are compared in, and the judges of the outcome, against known answers.
#include "worlds.hpp"

#include <cmath>
#include <numbers>

#include "first_flight.hpp"
#include "overlap.hpp"
#include <gtest/gtest.h>

namespace tumble::bench {
namespace {

constexpr double k_round_off = 1e-14;  // [m]: some additions of lengths of order 1

Outline unit_square(Vector2 centre, double angle = 0.0) {
  return placed({{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}, 0.0}, {centre, angle});
}

Outline disc_at(Vector2 centre, double radius) { return {{centre}, radius}; }

TEST(Overlap, OfPolygonsIsTheShortestWayApart) {
  EXPECT_NEAR(overlap(unit_square({0, 0}), unit_square({0.9, 0.3})), 0.1, k_round_off);
  EXPECT_EQ(overlap(unit_square({0, 0}), unit_square({1.0, 0.3})), 0.0);
  EXPECT_EQ(overlap(unit_square({0, 0}), unit_square({1.2, 0.0})), 0.0);
  // A corner in a face: half a diagonal above the face, less 0.05.
  const double height = 0.5 + 0.5 * std::numbers::sqrt2 - 0.05;
  EXPECT_NEAR(overlap(unit_square({0, 0}), unit_square({0.2, height}, std::numbers::pi / 4)), 0.05, k_round_off);
  // A corner beside a face that only the edges of the second square separate.
  EXPECT_EQ(overlap(unit_square({0, 0}), unit_square({0.9, 0.9}, std::numbers::pi / 4)), 0.0);
  // One mostly inside the other: out through the nearest face.
  EXPECT_NEAR(overlap(unit_square({0, 0}), unit_square({0.1, 0})), 0.9, k_round_off);
}

TEST(Overlap, OfDiscsIsExactAtFacesCornersAndInside) {
  EXPECT_NEAR(overlap(disc_at({0, 0}, 0.5), disc_at({0.6, 0.8}, 0.6)), 0.1, k_round_off);
  EXPECT_NEAR(overlap(unit_square({0, 0}), disc_at({0.2, 0.7}, 0.3)), 0.1, k_round_off);
  EXPECT_NEAR(overlap(disc_at({0.8, 0.9}, 0.6), unit_square({0, 0})), 0.1, k_round_off);  // at a corner, 3 : 4 : 5
  EXPECT_EQ(overlap(unit_square({0, 0}), disc_at({0.8, 0.9}, 0.45)), 0.0);  // the rectangles around them overlap
  EXPECT_NEAR(overlap(unit_square({0, 0}), disc_at({0.4, 0.0}, 0.2)), 0.3, k_round_off);
}

TEST(Overlap, DeepestOfAllPairsIsFoundAndWallsAreNoPair) {
  const std::vector<Outline> bodies = {unit_square({5, 0}), unit_square({0, 0}), unit_square({0.1, 0.98}),
                                       unit_square({0, 7}), unit_square({5.5, 0.97})};
  const std::vector<Outline> walls = {unit_square({0, 8}), unit_square({0, 8.4}), unit_square({-0.95, 0})};
  EXPECT_NEAR(deepest_overlap(bodies, {}), 0.03, k_round_off);
  EXPECT_NEAR(deepest_overlap(bodies, walls), 0.05, k_round_off);
}

TEST(FirstFlight, OfABallTurnsItAsFrictionDoes) {
  // A fall of 1 m. Friction stops the sliding of a disc whose speed is below 3 mu (1 + eps) v_n: it leaves with 2/3 of
  // its speed, and rolls.
  const World world = dropped_ball();
  const auto flight = FirstFlight::of(world, world.bodies[0]);
  ASSERT_TRUE(flight.has_value());
  const double fall = std::sqrt(2.0 / world.gravity), speed = std::sqrt(2.0 * world.gravity);
  EXPECT_NEAR(flight->impact_time(), fall, k_round_off);
  EXPECT_NEAR(flight->end_time(), fall * (1.0 + 2.0 * world.restitution), 10 * k_round_off);
  const double time = 0.5 * fall;
  const Pose pose = flight->pose_at(fall + time);
  EXPECT_NEAR(pose.position.x, fall + time * 2.0 / 3.0, 10 * k_round_off);
  EXPECT_NEAR(pose.position.y, 0.1 + time * world.restitution * speed - 0.5 * world.gravity * time * time,
              10 * k_round_off);
  EXPECT_NEAR(pose.angle, -time * (2.0 / 3.0) / 0.1, 100 * k_round_off);
}

TEST(FirstFlight, OfABallThatKeepsSliding) {
  World world = dropped_ball();
  world.bodies[0].velocity[0] = 10.0;
  const auto flight = FirstFlight::of(world, world.bodies[0]);
  ASSERT_TRUE(flight.has_value());
  const double fall = flight->impact_time(), time = 0.2;
  const double lost = world.friction * (1.0 + world.restitution) * std::sqrt(2.0 * world.gravity);
  const Pose pose = flight->pose_at(fall + time);
  EXPECT_NEAR(pose.position.x, 10.0 * fall + (10.0 - lost) * time, 100 * k_round_off);
  const double moment_over_mass_and_arm = 0.5 * 0.1;  // I / (m r) of a disc
  EXPECT_NEAR(pose.angle, -lost * time / moment_over_mass_and_arm, 100 * k_round_off);
}

class FirstFlightOfTheSquare : public testing::TestWithParam<double> {};

TEST_P(FirstFlightOfTheSquare, KeepsTheLawsOfItsImpact) {
  World world = dropped_square();
  world.friction = GetParam();
  const WorldBody& body = world.bodies[0];
  const auto flight = FirstFlight::of(world, body);
  ASSERT_TRUE(flight.has_value());
  const double t = flight->impact_time();
  EXPECT_NEAR(deepest_overlap(std::vector{placed(body.outline, flight->pose_at(t))}, world.walls), 0.0, k_round_off);
  EXPECT_GT(flight->end_time(), t + 0.1);
  EXPECT_NEAR(deepest_overlap(std::vector{placed(body.outline, flight->pose_at(flight->end_time()))}, world.walls), 0.0,
              k_round_off);
  // Velocities by differences of the positions, exact for the angle and x, and for y up to gravity.
  const double dt = 0.01;
  const Pose a = flight->pose_at(t), b = flight->pose_at(t + dt);
  const Vector2 v = {(b.position.x - a.position.x) / dt, (b.position.y - a.position.y) / dt + 0.5 * world.gravity * dt};
  const double omega = (b.angle - a.angle) / dt;
  // Momentum, and its moment about the centre, by the corner that hits, 15 degrees left of straight below.
  const double arm = 0.2 / std::numbers::sqrt2;
  const double r_x = -arm * std::sin(std::numbers::pi / 12), r_y = -arm * std::cos(std::numbers::pi / 12);
  const double before_n = -0.2 - world.gravity * t;
  const double p_n = body.mass * (v.y - before_n), p_t = body.mass * v.x;
  constexpr double impulse_round_off = 1e-11;  // differences over 0.01 s, times some 1e2
  EXPECT_NEAR(body.moment_of_inertia * omega, r_x * p_n - r_y * p_t, impulse_round_off);
  EXPECT_NEAR(v.y + r_x * omega, -world.restitution * before_n, impulse_round_off);
  const double sliding = v.x - r_y * omega;
  if (world.friction == 0.3) {  // sticks
    EXPECT_NEAR(sliding, 0.0, impulse_round_off);
    EXPECT_LT(std::abs(p_t), world.friction * p_n);
  } else {
    EXPECT_NEAR(std::abs(p_t), world.friction * p_n, impulse_round_off);
    EXPECT_LT(sliding * p_t, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(SticksOrSlides, FirstFlightOfTheSquare, testing::Values(0.3, 0.1));

TEST(Worlds, StartWithoutOverlapAndATowerWithoutGap) {
  for (const World& world :
       {dropped_square(), dropped_ball(), squares_side_by_side(500), tower(10), pile(10), pile(100), pile(1000)}) {
    std::vector<Outline> bodies;
    for (const WorldBody& body : world.bodies) bodies.push_back(placed(body.outline, body.pose));
    EXPECT_LE(deepest_overlap(bodies, world.walls), k_round_off) << world.name;
  }
  EXPECT_EQ(pile(1000).bodies.size(), 1000u);
  const World stack = tower(10);
  for (std::size_t i = 1; i < stack.bodies.size(); ++i) {
    const double gap = stack.bodies[i].pose.position.y - stack.bodies[i - 1].pose.position.y - 0.2;
    EXPECT_NEAR(gap, 0.0, k_round_off);
  }
}

}  // namespace
}  // namespace tumble::bench
