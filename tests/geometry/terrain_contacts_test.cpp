#include "shapes_at_random.hpp"

namespace tumble::test {
namespace {

const Frame k_origin = frame(0, 0, 0);

// Of many short segments in one line, at uneven steps.
Terrain straight(double from, double to, double slope = 0.0) {
  Terrain terrain;
  for (double x = from; x < to; x += 0.1 + 0.05 * std::sin(7 * x)) terrain.points.push_back({x, slope * x});
  terrain.points.push_back({to, slope * to});
  return terrain;
}

std::vector<Shape> bodies(std::mt19937& random) {
  RoundedPolygon polygon = random_polygon(random);
  if (polygon.vertices.size() == 1) polygon.rounding += 0.05;
  return {polygon, random_ellipse(random)};
}

// Bodies deeper in the ground than their own size are not found. The shapes here are larger than this.
constexpr double k_deepest = -0.1;

TEST(TerrainContacts, OneLongSegmentIsAHalfPlane) {
  std::mt19937 random(1);
  const Terrain terrain{{{-100, 0}, {100, 0}}};
  for (int trial = 0; trial < 10000; ++trial) {
    for (const Shape& body : bodies(random)) {
      const Frame f = random_frame(random, 1.0);
      const auto on_plane = contacts_of(body, f, HalfPlane{{0, 1}, 0}, k_origin);
      if (smallest_gap(on_plane) < k_deepest) continue;
      const auto on_terrain = contacts_of(body, f, terrain, k_origin, 10.0);
      ASSERT_FALSE(on_terrain.empty()) << trial;
      ASSERT_NEAR(smallest_gap(on_terrain), smallest_gap(on_plane), k_tolerance) << trial;
      for (const ContactPoint& c : on_terrain) {
        expect_whole(c);
        EXPECT_EQ(c.normal, (Vector2{0, -1}));
      }
    }
  }
}

// Joints in a straight line are no corners: normals, and the smallest gap, are those of the line wherever the body is.
TEST(TerrainContacts, JointsInALineAreNotFelt) {
  std::mt19937 random(2);
  for (const double slope : {0.0, 0.3}) {
    const Terrain terrain = straight(-5, 5, slope);
    const double norm = std::hypot(1.0, slope);
    const HalfPlane line{{-slope / norm, 1 / norm}, 0};
    for (int trial = 0; trial < 5000; ++trial) {
      for (const Shape& body : bodies(random)) {
        const Frame f = random_frame(random, 2.0);
        const double gap = smallest_gap(contacts_of(body, f, line, k_origin));
        if (gap < k_deepest || gap > 1) continue;
        const auto contacts = contacts_of(body, f, terrain, k_origin, 1.0);
        ASSERT_NEAR(smallest_gap(contacts), gap, k_tolerance) << trial;
        for (const ContactPoint& c : contacts) EXPECT_NEAR(length(c.normal + line.normal), 0.0, 1e-9);
      }
    }
  }
}

// A disc that slides over joints exactly below its centre, in steps that hit them exactly and just beside.
TEST(TerrainContacts, ADiscOverAJointKeepsTheNormal) {
  const Terrain terrain{{{-2, 0}, {-1, 0}, {0, 0}, {1, 0}, {2, 0}}};
  for (const double x : {0.0, 1e-17, -1e-17, 1e-12, -1e-12, 1.0, 1 - 1e-15}) {
    for (const double gap : {0.0, 1e-17, -1e-12, 1e-3, -1e-3}) {
      const auto contacts = contacts_of(RoundedPolygon{{{0, 0}}, 0.5}, frame(x, 0.5 + gap, 0), terrain, k_origin, 0.1);
      ASSERT_GE(contacts.size(), 1u);
      for (const ContactPoint& c : contacts) {
        EXPECT_NEAR(c.normal.x, 0, 1e-11);
        EXPECT_NEAR(c.gap, gap, 1e-15);
      }
      const auto of_ellipse = contacts_of(Ellipse{1.0, 0.5, {}}, frame(x, 0.5 + gap, 0), terrain, k_origin, 0.1);
      ASSERT_GE(of_ellipse.size(), 1u);
      for (const ContactPoint& c : of_ellipse) EXPECT_NEAR(c.normal.x, 0, 1e-11);
    }
  }
}

TEST(TerrainContacts, AValleyHoldsADiscOnBothSides) {
  const Terrain valley{{{-2, 2}, {0, 0}, {2, 2}}};
  const double root = std::sqrt(0.5);
  for (const double sink : {0.0, 1e-3, 0.3}) {
    const auto contacts =
        contacts_of(RoundedPolygon{{{0, 0}}, 0.5}, frame(0, 0.5 / root - sink, 0), valley, k_origin, 0.1);
    ASSERT_EQ(contacts.size(), 2u);
    for (const ContactPoint& c : contacts) {
      EXPECT_NEAR(c.gap, -sink * root, 1e-15);
      EXPECT_NEAR(std::abs(c.normal.x), root, 1e-15);
      EXPECT_NEAR(c.normal.y, -root, 1e-15);
    }
  }
  // A sharp corner in the valley, above and below its lowest point.
  for (const double y : {0.1, 1e-15, 0.0, -0.1}) {
    const RoundedPolygon spike{{{0, 0}, {0.1, 1}, {-0.1, 1}}, 0.0};
    const auto contacts = contacts_of(spike, frame(0, y, 0), valley, k_origin, 0.2);
    ASSERT_EQ(contacts.size(), 2u) << y;
    for (const ContactPoint& c : contacts) EXPECT_NEAR(c.gap, y * root, 1e-15);
  }
}

TEST(TerrainContacts, ARidgeTurnsTheNormalBetweenItsSlopes) {
  const Terrain roof{{{-2, -1}, {0, 0}, {2, -1}}};
  for (double x = -0.4; x <= 0.4; x += 0.01) {
    const double y = std::sqrt(0.25 - x * x) + 0.01;
    const auto contacts = contacts_of(RoundedPolygon{{{0, 0}}, 0.5}, frame(x, y, 0), roof, k_origin, 0.1);
    ASSERT_EQ(contacts.size(), 1u);
    const double at_slope = 1 / std::sqrt(5.0);
    EXPECT_LE(std::abs(contacts[0].normal.x), at_slope + 1e-15);
    const double distance = std::hypot(x, y);
    if (std::abs(x) / distance < at_slope) {
      EXPECT_NEAR(contacts[0].gap, distance - 0.5, 1e-15);
      EXPECT_EQ(contacts[0].radius_b, 0.0);
    }
  }
  // A box and an ellipse lie on the ridge itself.
  const auto of_box = contacts_of(box(1, 1), frame(0.2, 0.5, 0), roof, k_origin, 0.01);
  ASSERT_EQ(of_box.size(), 1u);
  EXPECT_EQ(of_box[0].gap, 0.0);
  EXPECT_EQ(of_box[0].point_b, (Vector2{0, 0}));
  const auto of_ellipse = contacts_of(Ellipse{1.0, 0.5, {}}, frame(0.0, 0.51, 0), roof, k_origin, 0.011);
  ASSERT_EQ(of_ellipse.size(), 1u);
  EXPECT_NEAR(of_ellipse[0].gap, 0.01, 1e-15);
}

// A box flush with a ledge rests on its own corner and on the end of the ledge, whatever round-off tilts it.
TEST(TerrainContacts, ABoxOverALedgeRestsOnItsEnd) {
  for (const Terrain& ledge :
       {Terrain{{{-3, 0}, {0, 0}}}, Terrain{{{-3, 0}, {0, 0}, {0, -3}}}, Terrain{{{-3, 0}, {0, 0}, {2, -1}}}}) {
    for (const double tilt : {0.0, 1e-16, -1e-16, 1e-12, -1e-12, 1e-6, -1e-6}) {
      const auto contacts = contacts_of(box(1, 1), frame(-0.2, 0.5, tilt), ledge, k_origin, 1e-3);
      ASSERT_EQ(contacts.size(), 2u) << tilt;
      double low = std::min(contacts[0].point_b.x, contacts[1].point_b.x),
             high = std::max(contacts[0].point_b.x, contacts[1].point_b.x);
      EXPECT_NEAR(low, -0.7, 1e-6);
      EXPECT_NEAR(high, 0.0, 1e-6);
    }
  }
}

// A tilted box whose low corner slides towards a ridge is not hit by the ridge before the corner is there.
TEST(TerrainContacts, ASlidingCornerMeetsNoGhost) {
  const Terrain bumpy{{{-3, 0}, {0, 0}, {3, -0.01}}};
  for (const double tilt : {0.2, 0.05}) {
    for (const double ahead : {1e-9, 1e-4, 1e-3, 0.01}) {
      const Frame f = frame(0, 0, tilt);
      const Vector2 corner = direction_to_world(f, {-0.5, -0.5});
      const auto contacts = contacts_of(box(1, 1), frame(-ahead - corner.x, -corner.y, tilt), bumpy, k_origin, 0.02);
      ASSERT_EQ(contacts.size(), 1u) << tilt << " " << ahead;
      EXPECT_EQ(contacts[0].normal, (Vector2{0, -1}));
    }
  }
}

TEST(TerrainContacts, DiscsHaveTheSignedDistanceOfABruteForce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 2000; ++trial) {
    Terrain hills;
    for (int i = -20; i <= 20; ++i) hills.points.push_back({0.25 * i, 0.4 * unit(random)});
    for (int k = 0; k < 20; ++k) {
      const Vector2 p{3 * unit(random), unit(random)};
      double distance = INFINITY, ground = 0;
      for (std::size_t i = 0; i + 1 < hills.points.size(); ++i) {
        const Vector2 a = hills.points[i], side = hills.points[i + 1] - a;
        const double t = std::clamp(dot(p - a, side) / dot(side, side), 0.0, 1.0);
        distance = std::min(distance, length(p - (a + t * side)));
        if (p.x >= a.x && p.x <= a.x + side.x) ground = a.y + (p.x - a.x) / side.x * side.y;
      }
      const RoundedPolygon disc{{{0, 0}}, 0.3};
      const auto contacts = contacts_of(disc, frame(p.x, p.y, 1), hills, k_origin, 5.0);
      for (const ContactPoint& c : contacts) expect_whole(c);
      if (p.y >= ground) {
        ASSERT_NEAR(smallest_gap(contacts), distance - 0.3, k_tolerance) << trial;
      } else if (distance < 0.5) {
        // In the ground: out by the nearest way, or, below a valley, by both of its slopes, which are not as deep.
        ASSERT_GE(smallest_gap(contacts), -distance - 0.3 - k_tolerance) << trial;
        ASSERT_LT(smallest_gap(contacts), -0.3) << trial;
      }
    }
  }
}

TEST(TerrainContacts, ExchangingTheShapesExchangesTheBits) {
  std::mt19937 random(4);
  const Terrain terrain{{{-2, 0.2}, {-1, 0}, {0, 0.3}, {1, -0.1}, {2, 0}}};
  for (int trial = 0; trial < 1000; ++trial) {
    for (const Shape& body : bodies(random))
      expect_symmetric(body, random_frame(random, 1.0), terrain, frame(0.1, 0.2, 0.3));
  }
}

}  // namespace
}  // namespace tumble::test
