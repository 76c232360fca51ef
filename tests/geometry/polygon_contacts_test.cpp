#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "shapes_at_random.hpp"
#include <gtest/gtest.h>

namespace tumble::test {
namespace {

double distance_to_segment(Vector2 p, Vector2 from, Vector2 to) {
  const Vector2 side = to - from;
  const double square = dot(side, side);
  const double t = square > 0 ? std::clamp(dot(p - from, side) / square, 0.0, 1.0) : 0.0;
  return length(p - (from + t * side));
}

std::vector<Vector2> in_world(const RoundedPolygon& shape, const Frame& f) {
  std::vector<Vector2> points;
  for (const Vector2 v : shape.vertices) points.push_back(point_to_world(f, v));
  return points;
}

// Height of the highest corner of b under side i of a, where b overlaps a.
double least_depth(const std::vector<Vector2>& a, const std::vector<Vector2>& b) {
  double best = -INFINITY;
  for (std::size_t i = 0; i < a.size() && a.size() > 1; ++i) {
    const Vector2 side = a[(i + 1) % a.size()] - a[i];
    const Vector2 normal = turned_right((1 / length(side)) * side);
    double lowest = INFINITY;
    for (const Vector2 p : b) lowest = std::min(lowest, dot(normal, p - a[i]));
    best = std::max(best, lowest);
  }
  return best;
}

bool cross_each_other(Vector2 a, Vector2 b, Vector2 c, Vector2 d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

// Distance of two cores from all pairs of a corner and a side, or minus the depth.
double core_distance(const std::vector<Vector2>& a, const std::vector<Vector2>& b) {
  double distance = INFINITY;
  bool overlap = false;
  const std::size_t n = a.size(), m = b.size();
  const auto inside = [](const std::vector<Vector2>& polygon, Vector2 p) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      if (cross(polygon[(i + 1) % polygon.size()] - polygon[i], p - polygon[i]) < 0) return false;
    }
    return polygon.size() > 2;
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < m; ++k) {
      distance = std::min(distance, distance_to_segment(a[i], b[k], b[(k + 1) % m]));
      distance = std::min(distance, distance_to_segment(b[k], a[i], a[(i + 1) % n]));
      if (n > 1 && m > 1) overlap = overlap || cross_each_other(a[i], a[(i + 1) % n], b[k], b[(k + 1) % m]);
      overlap = overlap || inside(a, b[k]) || inside(b, a[i]);
    }
  }
  if (!overlap && distance > 0) return distance;
  return n == 1 && m == 1 ? 0.0 : std::max(least_depth(a, b), least_depth(b, a));
}

TEST(PolygonContacts, RandomPairsHaveTheDistanceOfABruteForce) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 100000; ++trial) {
    const RoundedPolygon a = random_polygon(random), b = random_polygon(random);
    const Frame fa = random_frame(random, 1.5), fb = random_frame(random, 1.5);
    const auto contacts = contacts_of(a, fa, b, fb);
    const double expected = core_distance(in_world(a, fa), in_world(b, fb)) - a.rounding - b.rounding;
    ASSERT_FALSE(contacts.empty());
    ASSERT_NEAR(smallest_gap(contacts), expected, k_tolerance) << trial;
    for (const ContactPoint& c : contacts) expect_whole(c);
    if (testing::Test::HasFailure()) FAIL() << trial;
  }
}

// Shapes in one line, flush, concentric, corner to corner: on a lattice, with axes at right angles and nearly so.
TEST(PolygonContacts, DegeneratePairsHaveTheDistanceOfABruteForce) {
  const RoundedPolygon shapes[] = {{{{0, 0}}, 0.0},
                                   {{{0, 0}}, 0.25},
                                   {{{-1, 0}, {1, 0}}, 0.0},
                                   {{{-0.5, 0}, {0.5, 0}}, 0.25},
                                   {{{0, -1}, {0, 1}}, 0.25},
                                   {{{-0.5, -0.5}, {0.5, -0.5}, {0, 0.5}}, 0.0},
                                   box(1, 1),
                                   box(2, 1, 0.25)};
  for (const RoundedPolygon& a : shapes) {
    for (const RoundedPolygon& b : shapes) {
      for (double x = -3; x <= 3; x += 0.5) {
        for (double y = -3; y <= 3; y += 0.5) {
          for (const double angle : {0.0, 1e-17, -1e-14, 1e-9, 0.5, 1.5707963267948966, 3.141592653589793}) {
            SCOPED_TRACE(testing::Message() << x << " " << y << " " << angle << " of " << a.vertices.size() << " and "
                                            << b.vertices.size());
            const Frame fa = frame(0, 0, 0), fb = frame(x, y, angle);
            const auto contacts = contacts_of(a, fa, b, fb);
            const double expected = core_distance(in_world(a, fa), in_world(b, fb)) - a.rounding - b.rounding;
            ASSERT_FALSE(contacts.empty());
            ASSERT_NEAR(smallest_gap(contacts), expected, k_tolerance);
            for (const ContactPoint& c : contacts) expect_whole(c);
            ASSERT_FALSE(testing::Test::HasFailure());
          }
        }
      }
    }
  }
}

// Moved together, by turns and as far as a kilometre, the shapes have the same contacts to 1e-12 of that way.
TEST(PolygonContacts, MovingBothShapesMovesTheContacts) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 10000; ++trial) {
    const RoundedPolygon a = random_polygon(random), b = random_polygon(random);
    const Frame fa = random_frame(random, 1.0), fb = random_frame(random, 1.0);
    const double far = trial % 2 ? 1000.0 : 1.0;
    const Frame motion = random_frame(random, far);
    const auto moved = [&](const Frame& f) {
      return Frame{point_to_world(motion, f.position), motion.sin * f.cos + motion.cos * f.sin,
                   motion.cos * f.cos - motion.sin * f.sin};
    };
    const auto here = contacts_of(a, fa, b, fb), there = contacts_of(a, moved(fa), b, moved(fb));
    ASSERT_NEAR(smallest_gap(here), smallest_gap(there), far * k_tolerance) << trial;
    for (const ContactPoint& c : here) {
      for (const ContactPoint& d : there) {
        if (c.feature != d.feature) continue;
        EXPECT_NEAR(length(point_to_world(motion, c.point_a) - d.point_a), 0.0, far * k_tolerance);
        EXPECT_NEAR(length(point_to_world(motion, c.point_b) - d.point_b), 0.0, far * k_tolerance);
      }
    }
  }
}

TEST(PolygonContacts, ExchangingTheShapesExchangesTheBits) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> whole(-2, 2);
  for (int trial = 0; trial < 20000; ++trial) {
    const RoundedPolygon a = random_polygon(random), b = random_polygon(random);
    expect_symmetric(a, random_frame(random, 1.5), b, random_frame(random, 1.5));
    // Boxes on a lattice: full of ties.
    const RoundedPolygon c = box(1, 1), d = box(1 + 0.5 * whole(random), 1);
    const Frame fc = frame(0.5 * whole(random), 0.5 * whole(random), 0),
                fd = frame(0.5 * whole(random), 0.5 * whole(random), 0);
    if (d.vertices[1].x > 0 && !(c.vertices == d.vertices && fc.position == fd.position))
      expect_symmetric(c, fc, d, fd);
    if (testing::Test::HasFailure()) FAIL() << trial;
  }
}

// A box on a box: always the two ends of the stretch that they share.
TEST(PolygonContacts, StackedBoxesTouchAtBothEnds) {
  for (const double tilt : {0.0, 1e-17, -1e-17, 1e-12, -1e-12, 1e-6, -1e-6, 1e-3, -1e-3}) {
    for (const double shift : {0.0, 1e-17, 1e-13, 0.25, -0.25, 1e-6, -1e-6}) {
      for (const double width : {1.0, 0.5, 2.0}) {
        for (const double gap : {0.0, 1e-17, 1e-9, 1e-4, -1e-9, -1e-4}) {
          SCOPED_TRACE(testing::Message() << tilt << " " << shift << " " << width << " " << gap);
          const auto contacts =
              contacts_of(box(1, 1), frame(0, 0, 0), box(width, 1), frame(shift, 1 + gap, tilt), 0.01);
          ASSERT_EQ(contacts.size(), 2u);
          double low = std::min(contacts[0].point_a.x, contacts[1].point_a.x);
          double high = std::max(contacts[0].point_a.x, contacts[1].point_a.x);
          EXPECT_NEAR(low, std::max(-0.5, shift - width / 2), 1e-3);
          EXPECT_NEAR(high, std::min(0.5, shift + width / 2), 1e-3);
          for (const ContactPoint& c : contacts) {
            EXPECT_NEAR(c.gap, gap + std::sin(tilt) * (c.point_a.x - shift), 1e-6);
            EXPECT_NEAR(c.normal.x, 0.0, 1.01 * std::abs(tilt) + 1e-16);
            EXPECT_NEAR(c.normal.y, 1.0, 1e-6);
            expect_whole(c);
          }
        }
      }
    }
  }
}

TEST(PolygonContacts, ReachOnlyDropsContacts) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20000; ++trial) {
    const RoundedPolygon a = random_polygon(random), b = random_polygon(random);
    const Frame fa = random_frame(random, 1.0), fb = random_frame(random, 1.0);
    auto all = contacts_of(a, fa, b, fb);
    const auto near = contacts_of(a, fa, b, fb, 0.1);
    std::erase_if(all, [](const ContactPoint& c) { return !(c.gap <= 0.1); });
    ASSERT_EQ(all.size(), near.size());
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].feature, near[i].feature);
  }
}

TEST(PolygonContacts, FeaturesOfAPairAreDistinct) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 20000; ++trial) {
    const auto contacts = contacts_of(random_polygon(random), random_frame(random, 1.0), random_polygon(random),
                                      random_frame(random, 1.0));
    for (std::size_t i = 1; i < contacts.size(); ++i) ASSERT_LT(contacts[i - 1].feature, contacts[i].feature);
  }
}

TEST(PolygonContacts, ABoxRestsOnAHalfPlaneWithTwoCorners) {
  const HalfPlane ground{{0, 1}, 0.0};
  const auto contacts = contacts_of(box(2, 1), frame(3, 0.5, 0), ground, frame(0, 0, 0), 0.1);
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_EQ(contacts[0].gap, 0.0);
  EXPECT_EQ(contacts[0].normal, (Vector2{0, -1}));
  EXPECT_EQ(contacts[0].point_a, (Vector2{2, 0}));
  EXPECT_EQ(contacts[1].point_a, (Vector2{4, 0}));
}

TEST(PolygonContacts, MirroringOneBodyOnAHalfPlaneMirrorsTheBits) {
  std::mt19937 random(5);
  const auto mirrored = [](Vector2 v) { return Vector2{-v.x, v.y}; };
  for (int trial = 0; trial < 10000; ++trial) {
    const RoundedPolygon a = random_polygon(random);
    RoundedPolygon mirror{{}, a.rounding};
    for (auto v = a.vertices.rbegin(); v != a.vertices.rend(); ++v) mirror.vertices.push_back(mirrored(*v));
    const Frame f = random_frame(random, 1.0);
    const Frame mirror_frame{mirrored(f.position), -f.sin, f.cos};
    const HalfPlane plane{{0, 1}, 0.1};
    const auto contacts = contacts_of(a, f, plane, frame(0, 0, 0)),
               other = contacts_of(mirror, mirror_frame, plane, frame(0, 0, 0));
    ASSERT_EQ(contacts.size(), other.size());
    for (const ContactPoint& c : contacts) {
      EXPECT_TRUE(std::any_of(other.begin(), other.end(), [&](const ContactPoint& d) {
        return c.normal == mirrored(d.normal) && c.point_a == mirrored(d.point_a) && c.point_b == mirrored(d.point_b) &&
               c.gap == d.gap;
      }));
    }
  }
}

}  // namespace
}  // namespace tumble::test
