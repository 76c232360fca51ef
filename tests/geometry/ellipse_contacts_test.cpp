// Claims are proved from what comes back, not from a second solver. Two convex shapes that a line separates by `gap`
// along a normal, with points on them that far apart, have that distance. Where they overlap, no direction of a dense
// fan may show less depth.
#include "shapes_at_random.hpp"

namespace tumble::test {
namespace {

constexpr double k_ellipse_tolerance = 1e-10;  // relative to the longer semi-axis, at most 1

constexpr int k_fan = 100;  // directions of a fan

using Real = double;
struct Point {
  Real x, y;
};

// The farthest point of a shape along n, in the world.
Point farthest(const Ellipse& e, const Frame& f, Point n) {
  const Real s = std::sin(static_cast<Real>(e.pose.angle)), c = std::cos(static_cast<Real>(e.pose.angle));
  const Real ax = f.cos * c - f.sin * s, ay = f.sin * c + f.cos * s;
  const Real u = e.semi_axis_x * (n.x * ax + n.y * ay), v = e.semi_axis_y * (n.y * ax - n.x * ay),
             h = std::sqrt(u * u + v * v);
  const Real p = e.semi_axis_x * u / h, q = e.semi_axis_y * v / h;
  const Vector2 z = e.pose.position;
  const Real cx = f.position.x + static_cast<Real>(f.cos) * z.x - static_cast<Real>(f.sin) * z.y;
  const Real cy = f.position.y + static_cast<Real>(f.sin) * z.x + static_cast<Real>(f.cos) * z.y;
  return {cx + p * ax - q * ay, cy + p * ay + q * ax};
}

Point farthest(const RoundedPolygon& shape, const Frame& f, Point n) {
  Point best{0, 0};
  Real most = -INFINITY;
  for (const Vector2 v : shape.vertices) {
    const Point p{f.position.x + static_cast<Real>(f.cos) * v.x - static_cast<Real>(f.sin) * v.y,
                  f.position.y + static_cast<Real>(f.sin) * v.x + static_cast<Real>(f.cos) * v.y};
    if (n.x * p.x + n.y * p.y > most) most = n.x * p.x + n.y * p.y, best = p;
  }
  return {best.x + shape.rounding * n.x, best.y + shape.rounding * n.y};
}

template <class A, class B>
Real separation(const A& a, const Frame& fa, const B& b, const Frame& fb, Point n) {
  const Point p = farthest(a, fa, n), q = farthest(b, fb, {-n.x, -n.y});
  return n.x * (q.x - p.x) + n.y * (q.y - p.y);
}

// Least over an arc of normals about those of the ellipse where it is flattest and where it is sharpest.
template <class A, class B, class Visit>
void fan(const A& a, const B& b, const Frame& fa, const Frame& fb, Visit visit) {
  const auto of_ellipse = [&](const Ellipse& e, const Frame& f) {
    for (int i = 0; i < k_fan; ++i) {
      const double phi = 6.283185307179586 * i / k_fan;
      const Vector2 n{e.semi_axis_y * std::cos(phi), e.semi_axis_x * std::sin(phi)};
      const Vector2 w = direction_to_world(f, direction_to_world(frame_of(e.pose), (1 / length(n)) * n));
      visit(Point{w.x, w.y});
      visit(Point{-w.x, -w.y});
    }
  };
  const auto of_shape = [&](const auto& shape, const Frame& f) {
    if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, Ellipse>) of_ellipse(shape, f);
  };
  of_shape(a, fa);
  of_shape(b, fb);
  for (int i = 0; i < k_fan; ++i) {
    const double phi = 6.283185307179586 * i / k_fan;
    visit(Point{std::cos(phi), std::sin(phi)});
  }
}

double distance_to_polygon(const RoundedPolygon& shape, const Frame& f, Vector2 point) {
  double best = INFINITY;
  const std::size_t n = shape.vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2 from = point_to_world(f, shape.vertices[i]),
                  side = point_to_world(f, shape.vertices[(i + 1) % n]) - from;
    const double square = dot(side, side),
                 t = square > 0 ? std::clamp(dot(point - from, side) / square, 0.0, 1.0) : 0.0;
    best = std::min(best, length(point - (from + t * side)));
  }
  return best - shape.rounding;
}

void expect_on_surface(const Ellipse& e, const Frame& f, Vector2 point, Vector2 outward) {
  const Point p = farthest(e, f, {outward.x, outward.y});
  EXPECT_NEAR(static_cast<double>(p.x), point.x, k_ellipse_tolerance);
  EXPECT_NEAR(static_cast<double>(p.y), point.y, k_ellipse_tolerance);
}
void expect_on_surface(const RoundedPolygon& shape, const Frame& f, Vector2 point, Vector2) {
  EXPECT_NEAR(distance_to_polygon(shape, f, point), 0.0, k_ellipse_tolerance);
}

template <class A, class B>
void expect_closest(const A& a, const Frame& fa, const B& b, const Frame& fb) {
  const auto contacts = contacts_of(a, fa, b, fb);
  ASSERT_EQ(contacts.size(), 1u);
  const ContactPoint& c = contacts[0];
  expect_whole(c);
  EXPECT_NEAR(static_cast<double>(separation(a, fa, b, fb, {c.normal.x, c.normal.y})), c.gap, k_ellipse_tolerance);
  expect_on_surface(a, fa, c.point_a, c.normal);
  expect_on_surface(b, fb, c.point_b, -c.normal);
  if (c.gap < 0) {
    Real most = -INFINITY;
    fan(a, b, fa, fb, [&](Point n) { most = std::max(most, separation(a, fa, b, fb, n)); });
    EXPECT_LE(static_cast<double>(most), c.gap + k_ellipse_tolerance);
  }
}

TEST(EllipseContacts, RandomPairsAreProvedClosest) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 100000; ++trial) {
    SCOPED_TRACE(trial);
    // Most of the pairs are apart or overlap little; the proof of the deep ones takes a fan of directions.
    const double spread = trial % 50 == 0 ? 0.3 : 2.5;
    expect_closest(random_ellipse(random), random_frame(random, spread), random_ellipse(random),
                   random_frame(random, spread));
    expect_closest(random_ellipse(random), random_frame(random, spread), random_polygon(random),
                   random_frame(random, spread));
    if (testing::Test::HasFailure()) return;
  }
}

TEST(EllipseContacts, DegeneratePairsAreProvedClosest) {
  for (const double ratio : {1.0, 0.999999, 0.5, 0.01, 0.001}) {
    for (const double other : {1.0, 0.5, 0.001}) {
      for (const double angle : {0.0, 1e-9, 0.7853981633974483, 1.5707963267948966}) {
        for (const double shift : {0.0, 1e-12, 1.0, 2.0, 2.0 + 1e-12}) {
          for (const double lift : {0.0, ratio + other, 1e-9}) {
            SCOPED_TRACE(testing::Message() << ratio << " " << other << " " << angle << " " << shift << " " << lift);
            expect_closest(Ellipse{1.0, ratio, {}}, frame(0, 0, 0), Ellipse{other, 1.0, {}}, frame(shift, lift, angle));
            expect_closest(Ellipse{1.0, ratio, {}}, frame(0, 0, 0), Ellipse{1.0, other, {}}, frame(shift, lift, angle));
            expect_closest(Ellipse{1.0, ratio, {}}, frame(0, 0, 0), RoundedPolygon{{{0, 0}}, other},
                           frame(shift, lift, 0));
            expect_closest(Ellipse{1.0, ratio, {}}, frame(0, 0, 0), box(2, other), frame(shift, lift, angle));
            expect_closest(Ellipse{1.0, ratio, {}}, frame(0, 0, 0), RoundedPolygon{{{-1, 0}, {1, 0}}, 0.0},
                           frame(shift, lift, angle));
            if (testing::Test::HasFailure()) return;
          }
        }
      }
    }
  }
}

TEST(EllipseContacts, RoundEllipsesAreDiscs) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const Frame fa = random_frame(random, 1.0), fb = random_frame(random, 1.0);
    const RoundedPolygon polygon = random_polygon(random);
    const auto round = contacts_of(Ellipse{0.4, 0.4, {}}, fa, polygon, fb);
    const auto disc = contacts_of(RoundedPolygon{{{0, 0}}, 0.4}, fa, polygon, fb);
    ASSERT_EQ(round.size(), 1u);
    EXPECT_NEAR(round[0].gap, smallest_gap(disc), 1e-12);
    EXPECT_NEAR(round[0].radius_a, 0.4, 1e-15);
  }
}

TEST(EllipseContacts, ExchangingTheShapesExchangesTheBits) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 10000; ++trial) {
    const Ellipse a = random_ellipse(random), b = random_ellipse(random);
    const Frame fa = random_frame(random, 1.5), fb = random_frame(random, 1.5);
    expect_symmetric(a, fa, b, fb);
    expect_symmetric(a, fa, a, fb);
    expect_symmetric(a, fa, random_polygon(random), fb);
    expect_symmetric(a, fa, HalfPlane{{0.6, 0.8}, 0.3}, fb);
    if (testing::Test::HasFailure()) FAIL() << trial;
  }
}

// The lowest point of an ellipse turned by an angle: sqrt(p^2 sin^2 + q^2 cos^2) below its centre.
TEST(EllipseContacts, AHalfPlaneTouchesTheLowestPoint) {
  for (const double angle : {0.0, 0.3, 1.0, 2.0, -3.0}) {
    const auto contacts = contacts_of(Ellipse{2, 0.5, {}}, frame(1, 3, angle), HalfPlane{{0, 1}, 0.25}, frame(0, 0, 0));
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_NEAR(contacts[0].gap, 2.75 - std::hypot(2 * std::sin(angle), 0.5 * std::cos(angle)), 1e-15);
    const auto mirrored =
        contacts_of(Ellipse{2, 0.5, {}}, frame(-1, 3, -angle), HalfPlane{{0, 1}, 0.25}, frame(0, 0, 0));
    EXPECT_EQ(mirrored[0].gap, contacts[0].gap);
    EXPECT_EQ(mirrored[0].point_a, (Vector2{-contacts[0].point_a.x, contacts[0].point_a.y}));
    EXPECT_EQ(mirrored[0].radius_a, contacts[0].radius_a);
  }
}

}  // namespace
}  // namespace tumble::test
