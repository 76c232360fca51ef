#include "tumble/geometry/time_of_impact.hpp"

#include "shapes_at_random.hpp"

namespace tumble::test {
namespace {

// 1 m per step of 1 ms against a wall without thickness.
TEST(TimeOfImpact, NothingPassesAWallAtAThousandMetresPerSecond) {
  const RoundedPolygon wall{{{0, -5}, {0, 5}}, 0.0};
  constexpr double speed = 1000, h = 1e-3, distance = 1e-6;
  const Shape bullets[] = {RoundedPolygon{{{0, 0}}, 0.01}, RoundedPolygon{{{-0.05, 0}, {0.05, 0}}, 0.0}, box(0.01, 0.3),
                           Ellipse{0.001, 0.2, {}}};
  for (const Shape& bullet : bullets) {
    for (const double spin : {0.0, 300.0}) {
      for (const double angle : {0.0, 0.4, 1.5707963267948966}) {
        const auto impact = time_of_impact(bullet, {{-0.5, 0.1}, angle}, {speed, 0, spin}, wall, {}, {}, h, distance);
        ASSERT_TRUE(impact.has_value());
        EXPECT_LT(impact->time, 0.5e-3);
        EXPECT_GT(impact->contact.gap, 0.0);
        EXPECT_LE(impact->contact.gap, distance);
        EXPECT_NEAR(impact->contact.normal.x, 1.0, 1e-12);
        const Frame there = frame_of({{-0.5 + speed * impact->time, 0.1}, angle + spin * impact->time});
        EXPECT_NEAR(smallest_gap(contacts_of(bullet, there, wall, frame(0, 0, 0))), impact->contact.gap, 1e-12);
      }
    }
  }
}

TEST(TimeOfImpact, ADiscMeetsADiscWhenTheirCentresAreTwoRadiiApart) {
  const RoundedPolygon disc{{{0, 0}}, 0.5};
  // Centres 0.6 aside: they meet with 0.8 left between them along x, 10 - 0.8 closed at 30 m/s.
  const auto impact = time_of_impact(disc, {}, {10, 0, 5}, disc, {{10, 0.6}, 0}, {-20, 0, -3}, 1.0, 1e-9);
  ASSERT_TRUE(impact.has_value());
  EXPECT_NEAR(impact->time, 9.2 / 30, 1e-9);
  EXPECT_NEAR(impact->contact.normal.x, 0.8, 1e-8);
  EXPECT_FALSE(time_of_impact(disc, {}, {10, 0, 5}, disc, {{10, 1.01}, 0}, {-20, 0, 0}, 1.0, 1e-9).has_value());
  EXPECT_FALSE(time_of_impact(disc, {}, {10, 0, 5}, disc, {{10, 0.6}, 0}, {-20, 0, 0}, 0.3, 1e-9).has_value());
}

TEST(TimeOfImpact, GroundStopsWhatFallsFast) {
  const Shape grounds[] = {HalfPlane{{0, 1}, 0}, Terrain{{{-9, 0}, {-1, 0}, {0.3, 0}, {9, 0}}}};
  for (const Shape& ground : grounds) {
    const auto impact =
        time_of_impact(ground, {}, {}, box(0.1, 0.1), {{0, 0.8}, 0.7853981633974483}, {50, -1000, 0}, 1e-3, 1e-6);
    ASSERT_TRUE(impact.has_value());
    EXPECT_NEAR(impact->time, (0.8 - 0.1 / std::sqrt(2.0)) / 1000, 1e-9);
    EXPECT_EQ(impact->contact.normal, (Vector2{0, 1}));
  }
  // A plane that swings up against a disc that stands still: sin(angle) = 0.1 / 2 where it touches.
  const auto impact =
      time_of_impact(grounds[0], {}, {0, 0, 100}, RoundedPolygon{{{0, 0}}, 0.1}, {{2, 0.2}, 0}, {}, 0.1, 1e-9);
  ASSERT_TRUE(impact.has_value());
  EXPECT_NEAR(std::sin(100 * impact->time - std::atan2(0.2, 2)), -0.1 / std::hypot(2, 0.2), 1e-7);
}

TEST(TimeOfImpact, IsNeverLaterThanSmallStepsFind) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int impacts = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Shape a = random_polygon(random);
    const Shape b = trial % 2 ? Shape(random_polygon(random)) : Shape(random_ellipse(random));
    const Pose pose_a{{0, 0}, unit(random)}, pose_b{{4, 2 * unit(random)}, unit(random)};
    const Vector3 v_a{3 * unit(random), unit(random), 5 * unit(random)}, v_b{-4, unit(random), 5 * unit(random)};
    const auto impact = time_of_impact(a, pose_a, v_a, b, pose_b, v_b, 1.5, 1e-6);
    impacts += impact.has_value();
    const double end = impact ? impact->time : 1.5;
    for (int i = 0; i <= 1000; ++i) {
      const double t = end * i / 1000;
      const auto at = [&](const Pose& p, const Vector3& v) {
        return frame_of({{p.position.x + t * v[0], p.position.y + t * v[1]}, p.angle + t * v[2]});
      };
      ASSERT_GT(smallest_gap(contacts_of(a, at(pose_a, v_a), b, at(pose_b, v_b))), 0.0) << trial << " " << t;
    }
  }
  EXPECT_GT(impacts, 100);
}

TEST(TimeOfImpact, ShapesAreApartForAsLongAsTheQuickBoundSays) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int always = 0, for_a_while = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const RoundedPolygon b = random_polygon(random);
    const bool is_plane = trial % 4 == 0;
    const Shape a = is_plane ? Shape(HalfPlane{{0.6, 0.8}, 0.5}) : Shape(random_polygon(random));
    const Pose pose_a{{0.1, 0}, unit(random)}, pose_b{{1 + unit(random), 1.5 + unit(random)}, unit(random)};
    const Vector3 v_a{unit(random), unit(random), is_plane ? 0.0 : 2 * unit(random)};
    const Vector3 v_b{3 * unit(random), 3 * unit(random), 3 * unit(random)};
    const MovedShape at_a(a, pose_a), at_b(b, pose_b);
    const Vector2 n = contacts_of(a, frame_of(pose_a), b, frame_of(pose_b))[0].normal;
    const double turn = trial % 2 ? 0.0 : unit(random);
    const Vector2 direction = std::cos(turn) * n + std::sin(turn) * turned_left(n);
    constexpr double duration = 0.3, distance = 0.01;
    const double time = time_apart(at_a.placed(), v_a, at_b.placed(), v_b, direction, duration, distance);
    always += time == duration;
    for_a_while += time > 0.0 && time < duration;
    if (time == 0.0) continue;
    for (int i = 0; i <= 100; ++i) {
      const double t = time * i / 100;
      const auto at = [&](const Pose& p, const Vector3& v) {
        return frame_of({{p.position.x + t * v[0], p.position.y + t * v[1]}, p.angle + t * v[2]});
      };
      const double gap = smallest_gap(contacts_of(a, at(pose_a, v_a), b, at(pose_b, v_b)));
      ASSERT_GE(gap, distance - k_tolerance) << trial << " " << t;
    }
  }
  EXPECT_GT(always, 300);
  EXPECT_GT(for_a_while, 100);
}

}  // namespace
}  // namespace tumble::test
