#include "tumble/scene/shape.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "tumble/scene/limits.hpp"

namespace tumble {
namespace {

constexpr double k_pi = 3.14159265358979323846;
// Sums of some ten terms of the size of the result.
constexpr double k_rounding = 1e-14;

std::string error_of(const Shape& shape) {
  try {
    validate(shape);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

template <class Build>
std::string error_of_building(Build build) {
  try {
    build();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

void expect_moments(const Shape& shape, double area, Vector2 centroid, double polar_moment) {
  const AreaMoments m = area_moments(shape);
  EXPECT_NEAR(m.area, area, k_rounding * area);
  EXPECT_NEAR(m.centroid.x, centroid.x, k_rounding);
  EXPECT_NEAR(m.centroid.y, centroid.y, k_rounding);
  EXPECT_NEAR(m.polar_moment, polar_moment, k_rounding * polar_moment);
}

TEST(AreaMoments, OfShapesWithClosedForms) {
  expect_moments(rectangle(3.0, 2.0), 6.0, {}, 6.0 * 13.0 / 12.0);
  expect_moments(disc(0.7, {1.0, -2.0}), k_pi * 0.49, {1.0, -2.0}, k_pi * std::pow(0.7, 4) / 2.0);
  expect_moments(ellipse(3.0, 2.0), 6.0 * k_pi, {}, 6.0 * k_pi * 13.0 / 4.0);
  expect_moments(RoundedPolygon{{{0, 0}, {3, 0}, {0, 3}}, 0.0}, 4.5, {1.0, 1.0},
                 4.5 * (9.0 + 9.0 + 18.0) / 36.0);  // area times the sum of the squared sides over 36
  // Capsule: a rectangle and two half discs, whose centroids are 4r/3pi from the centres of the ends.
  const double length = 2.0;
  const double r = 0.5;
  const double half_disc = k_pi * r * r / 2.0;
  const double to_centroid = 4.0 * r / (3.0 * k_pi);
  const double half_disc_moment = half_disc * (r * r / 2.0 - to_centroid * to_centroid);
  const double arm = length / 2.0 + to_centroid;
  expect_moments(
      capsule(length, r), length * 2.0 * r + 2.0 * half_disc, {},
      length * 2.0 * r * (length * length + 4.0 * r * r) / 12.0 + 2.0 * (half_disc_moment + half_disc * arm * arm));
}

TEST(AreaMoments, OfARoundedPolygonAreThoseOfAFineSharpOne) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    RoundedPolygon rounded;
    const int n = 2 + trial % 6;
    const double start = uniform(random);
    const Vector2 center{10.0 * uniform(random) - 5.0, 10.0 * uniform(random) - 5.0};
    for (int i = 0; i < n; ++i) {
      const double angle = start + 2.0 * k_pi * (i + 0.6 * uniform(random)) / n;
      rounded.vertices.push_back({center.x + 2.0 * std::cos(angle), center.y + std::sin(angle)});
    }
    rounded.rounding = 0.1 + uniform(random);
    // Its outline, each sector as chords.
    constexpr int chords = 20000;
    RoundedPolygon fine;
    for (int i = 0; i < n; ++i) {
      const auto at = [&](int k) { return rounded.vertices[static_cast<std::size_t>((k + n) % n)]; };
      const Vector2 before = turned_right(at(i) - at(i - 1));
      const Vector2 after = turned_right(at(i + 1) - at(i));
      const double from = std::atan2(before.y, before.x);
      double turn = std::atan2(cross(before, after), dot(before, after));
      if (n == 2) turn = k_pi;
      for (int k = 0; k <= chords; ++k) {
        const double angle = from + turn * k / chords;
        fine.vertices.push_back(at(i) + rounded.rounding * Vector2{std::cos(angle), std::sin(angle)});
      }
    }
    const AreaMoments exact = area_moments(rounded);
    const AreaMoments chorded = area_moments(fine);
    // A chord of angle d leaves out a share d^2/6 of its sector: below 1e-8 for pi/20000.
    constexpr double tolerance = 1e-8;
    EXPECT_NEAR(chorded.area, exact.area, tolerance * exact.area);
    EXPECT_NEAR(chorded.centroid.x, exact.centroid.x, tolerance);
    EXPECT_NEAR(chorded.centroid.y, exact.centroid.y, tolerance);
    EXPECT_NEAR(chorded.polar_moment, exact.polar_moment, tolerance * exact.polar_moment);
  }
}

TEST(AreaMoments, KeepTheCentroidOfSymmetricShapesAtTheOrigin) {
  // The sums of up to fifty terms of size 0.3^3, divided by an area of some 0.3^2. `set_density` takes this for zero.
  constexpr double tolerance = 1e-16;
  for (int corners = 3; corners <= 50; ++corners) {
    EXPECT_LT(length(area_moments(regular_polygon(corners, 0.3)).centroid), tolerance) << corners;
  }
  EXPECT_EQ(area_moments(square(0.2)).centroid, Vector2{});
  EXPECT_LT(length(area_moments(rectangle(0.3, 0.7, 0.1)).centroid), tolerance);
  EXPECT_LT(length(area_moments(capsule(0.3, 0.1)).centroid), tolerance);
}

TEST(AreaMoments, DoNotDependOnWhereTheShapeIs) {
  const Pose pose{{3.0, -4.0}, 0.8};
  for (const Shape& shape : {Shape(rectangle(0.4, 0.2, 0.05)), Shape(ellipse(0.3, 0.1)), Shape(capsule(0.3, 0.1))}) {
    const AreaMoments at_origin = area_moments(shape);
    const AreaMoments elsewhere = area_moments(moved(shape, pose));
    // Coordinates of size 5 round by 1e-15, 1e-14 of the sizes here.
    EXPECT_NEAR(elsewhere.area, at_origin.area, 1e-13 * at_origin.area);
    EXPECT_NEAR(elsewhere.centroid.x, pose.position.x, 1e-14);
    EXPECT_NEAR(elsewhere.centroid.y, pose.position.y, 1e-14);
    EXPECT_NEAR(elsewhere.polar_moment, at_origin.polar_moment, 1e-13 * at_origin.polar_moment);
  }
}

TEST(AreaMoments, AreNoneWithoutArea) {
  EXPECT_EQ(area_moments(segment({0.0, 0.0}, {1.0, 0.0})).area, 0.0);
  EXPECT_EQ(area_moments(HalfPlane{{0.0, 1.0}, 0.0}).area, 0.0);
  EXPECT_EQ(area_moments(Terrain{{{0.0, 0.0}, {1.0, 0.0}}}).area, 0.0);
}

TEST(Shape, ShortFormsHaveOuterSizes) {
  EXPECT_EQ(square(0.2).vertices, (std::vector<Vector2>{{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}}));
  EXPECT_EQ(rectangle(4.0, 2.0, 0.5).vertices[2], (Vector2{1.5, 0.5}));
  EXPECT_EQ(rectangle(4.0, 2.0, 1.0).vertices, capsule(2.0, 1.0).vertices);
  EXPECT_EQ(square(2.0, 1.0).vertices, disc(1.0).vertices);
  const RoundedPolygon hexagon = regular_polygon(6, 1.0, 0.25);
  ASSERT_EQ(hexagon.vertices.size(), 6u);
  EXPECT_EQ(hexagon.vertices[0].y, hexagon.vertices[5].y) << "the lowest side is level";
  for (const Vector2 v : hexagon.vertices) EXPECT_NEAR(length(v), 0.75, 1e-15);
}

TEST(Shape, HalfPlanesTakeNormalsOfAnyLength) {
  EXPECT_EQ(half_plane({0.0, 5.0}, 2.0), (HalfPlane{{0.0, 1.0}, 2.0}));
  const HalfPlane slope = half_plane({-3.0, 4.0});
  EXPECT_DOUBLE_EQ(slope.normal.x, -0.6);
  EXPECT_EQ(half_plane(slope.normal), slope) << "one of length 1 keeps its bits";
  EXPECT_THROW(half_plane({0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(half_plane({std::nan(""), 1.0}), std::invalid_argument);
}

TEST(Shape, ShortFormsAreValidForAllSizes) {
  for (int corners = 3; corners <= static_cast<int>(k_max_vertices); ++corners) {
    EXPECT_EQ(error_of(regular_polygon(corners, 0.3)), "") << corners;
    EXPECT_EQ(error_of(moved(regular_polygon(corners, 0.3), {{50.0, 70.0}, 0.1 * corners})), "") << corners;
  }
}

TEST(Shape, MovesByAPose) {
  const Shape plane = moved(HalfPlane{{0.0, 1.0}, 0.5}, {{1.0, 2.0}, k_pi / 2.0});
  EXPECT_NEAR(std::get<HalfPlane>(plane).normal.x, -1.0, 1e-15);
  EXPECT_NEAR(std::get<HalfPlane>(plane).offset, -0.5, 1e-15) << "-x <= -0.5";
  const Shape turned = moved(ellipse(2.0, 1.0), {{1.0, 2.0}, 0.3});
  EXPECT_EQ(std::get<Ellipse>(turned).pose.angle, 0.3);
  EXPECT_EQ(std::get<Ellipse>(turned).pose.position, (Vector2{1.0, 2.0}));
}

TEST(Shape, NamesWhatIsWrong) {
  EXPECT_EQ(error_of(RoundedPolygon{{}, 0.0}), "vertices: must have 1 to 1000 entries, got 0");
  EXPECT_EQ(error_of(RoundedPolygon{{{0, 0}}, 0.0}), "rounding: must be in [1e-12, 1000000000000] m, got 0");
  EXPECT_EQ(error_of(RoundedPolygon{{{0, 0}, {1, 0}, {0, 1}}, -1.0}),
            "rounding: must be in [0, 1000000000000] m, got -1");
  EXPECT_EQ(error_of(RoundedPolygon{{{0, 0}, {0, 1}, {1, 0}}, 0.0}),
            "vertices: must run counter-clockwise, got clockwise; write them in the opposite order");
  EXPECT_EQ(error_of(RoundedPolygon{{{0, 0}, {2, 0}, {2, 2}, {1, 0.5}, {0, 2}}, 0.0}),
            "vertices[3]: must be a convex corner, got a reflex one at (1, 0.5); write a concave shape as several "
            "convex parts");
  EXPECT_EQ(error_of(RoundedPolygon{{{0, 0}, {1, 0}, {2, 0}, {1, 1}}, 0.0}),
            "vertices[1]: must not lie on the line through its neighbours, got (1, 0); leave it out");
  EXPECT_NE(error_of(RoundedPolygon{{{0, 0}, {1, 0}, {1, 0}, {1, 1}}, 0.0}).find("vertices[2]: must be farther"),
            std::string::npos);
  RoundedPolygon star;
  for (int i = 0; i < 5; ++i) star.vertices.push_back({std::cos(0.8 * k_pi * i), std::sin(0.8 * k_pi * i)});
  EXPECT_EQ(error_of(star), "vertices: must go round once, got 2 times: the edges cross");
  EXPECT_EQ(error_of(HalfPlane{{0.0, 2.0}, 0.0}), "normal: must have length 1, got (0, 2) of length 2");
  EXPECT_EQ(error_of(Terrain{{{0, 0}}}), "points: must have 2 to 100000 entries, got 1");
  EXPECT_EQ(error_of(Terrain{{{0, 0}, {1, 0}, {0.5, 0}}}), "points[1]: must not turn straight back, got (1, 0)");
  EXPECT_NE(error_of(Ellipse{1e-3, 1e5, {}}).find("semi_axis_x: must be within a factor"), std::string::npos);
  EXPECT_EQ(error_of_building([] { regular_polygon(2, 1.0); }), "corners: must be in [3, 1000], got 2");
  EXPECT_EQ(error_of_building([] { square(0.2, 0.2); }),
            "rounding: must be in [0, 0.1] m, half of the shorter side, got 0.2");
  EXPECT_NE(error_of_building([] { square(-0.2); }), "");
  EXPECT_NE(error_of_building([] { segment({1.0, 1.0}, {1.0, 1.0}); }), "");
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e13}) {
    EXPECT_NE(error_of(RoundedPolygon{{{0, 0}, {1, 0}, {0, bad}}, 0.0}), "");
    EXPECT_NE(error_of(RoundedPolygon{{{0, 0}, {1, 0}, {0, 1}}, bad}), "");
    EXPECT_NE(error_of(Ellipse{bad, 1.0, {}}), "");
    EXPECT_NE(error_of(Ellipse{1.0, 1.0, {{bad, 0.0}, 0.0}}), "");
    EXPECT_NE(error_of(HalfPlane{{0.0, 1.0}, bad}), "");
    EXPECT_NE(error_of(HalfPlane{{0.0, bad}, 0.0}), "");
    EXPECT_NE(error_of(Terrain{{{0, 0}, {bad, 0}}}), "");
  }
}

TEST(Shape, TakesWallsAndPolygonsFarFromTheOrigin) {
  EXPECT_EQ(error_of(segment({0.0, -1.0}, {0.0, 1.0})), "");
  EXPECT_EQ(error_of(moved(square(0.2), {{1e6, 1e6}, 0.4})), "");
  EXPECT_EQ(error_of(Terrain{{{0, 0}, {1, 0}, {0.5, 1}, {2, 1}}}), "") << "overhangs are ground too";
}

}  // namespace
}  // namespace tumble
