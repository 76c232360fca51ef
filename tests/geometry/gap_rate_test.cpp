#include "tumble/geometry/gap_rate.hpp"

#include "shapes_at_random.hpp"

namespace tumble::test {
namespace {

struct Moving {
  Shape shape;
  Pose pose;
  Vector3 velocity;

  Frame at(double t) const {
    return frame_of(
        {{pose.position.x + t * velocity[0], pose.position.y + t * velocity[1]}, pose.angle + t * velocity[2]});
  }
  Motion motion() const { return {pose.position, velocity}; }
};

// The gap of the same features at a time, NaN if they do not touch then.
double gap_at(const Moving& a, const Moving& b, std::uint32_t feature, double t) {
  for (const ContactPoint& c : contacts_of(a.shape, a.at(t), b.shape, b.at(t))) {
    if (c.feature == feature) return c.gap;
  }
  return NAN;
}

Shape random_shape(std::mt19937& random) {
  if (random() % 2) return random_polygon(random);
  Ellipse e = random_ellipse(random);  // not so thin that the third derivative rules the difference
  e.semi_axis_x = std::max(e.semi_axis_x, 0.3);
  e.semi_axis_y = std::max(e.semi_axis_y, 0.3);
  return e;
}

Moving random_moving(std::mt19937& random, Shape shape) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  return {std::move(shape),
          {{1.2 * unit(random), 1.2 * unit(random)}, 5 * unit(random)},
          {unit(random), unit(random), unit(random)}};
}

// Against central differences. Their error is d^2 times higher derivatives, which grow as the distance of two centres
// of curvature shrinks, and round-off over d^2.
TEST(GapRate, BothDerivativesAreThoseOfTheGap) {
  std::mt19937 random(1);
  constexpr double d = 1e-4;
  int compared = 0;
  for (int trial = 0; trial < 30000; ++trial) {
    const Moving a = random_moving(random, random_shape(random));
    const Shape ground[] = {HalfPlane{{0.6, 0.8}, -0.5}, Terrain{{{-3, -1}, {0, -0.5}, {3, -1}}}};
    const Moving b = random_moving(random, trial % 4 ? random_shape(random) : ground[trial / 4 % 2]);
    for (const ContactPoint& c : contacts_of(a.shape, a.at(0), b.shape, b.at(0), 1.0)) {
      const double before = gap_at(a, b, c.feature, -d), after = gap_at(a, b, c.feature, d);
      const double centres = c.gap + c.radius_a + c.radius_b;
      if (std::isnan(before) || std::isnan(after) || centres < 0.2) continue;
      ASSERT_NEAR(gap_rate(c, a.motion(), b.motion()), (after - before) / (2 * d), 1e-5) << trial;
      ASSERT_NEAR(gap_curvature(c, a.motion(), b.motion()), (after - 2 * c.gap + before) / (d * d), 1e-3) << trial;
      ++compared;
    }
  }
  EXPECT_GT(compared, 10000);
}

// A rod with one end on the ground, the other turning over it: the gap of its end is l sin(theta).
TEST(GapRate, ACornerOverTheGroundTurnsOnACircle) {
  const ContactPoint contact{{0, 1}, {0.8, 0}, {0.8, 0.6}, 0.6, INFINITY, 0.0, 0};
  const Motion ground, rod{{0, 0}, {0, 0, 2}};
  EXPECT_NEAR(gap_rate(contact, ground, rod), 2 * 0.8, 1e-15);
  EXPECT_NEAR(gap_curvature(contact, ground, rod), -4 * 0.6, 1e-15);
}

// Two discs that pass each other: gap = sqrt(x^2 + v^2 t^2) - 2 r, with the second derivative v^2 / x.
TEST(GapRate, DiscsThatPassEachOther) {
  const RoundedPolygon disc{{{0, 0}}, 0.5};
  const auto contacts = contacts_of(disc, frame(0, 0, 0), disc, frame(0, 1.25, 0));
  EXPECT_NEAR(gap_curvature(contacts[0], {{0, 0}, {}}, {{0, 1.25}, {3, 0, 7}}), 9 / 1.25, 1e-14);
}

}  // namespace
}  // namespace tumble::test
