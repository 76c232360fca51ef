// Shapes and frames for tests of contacts.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tumble/geometry/shape_contacts.hpp"

namespace tumble::test {

constexpr double k_tolerance = 1e-12;  // relative to the size of the shapes, which is about 1

inline RoundedPolygon box(double width, double height, double rounding = 0.0) {
  const double x = width / 2, y = height / 2;
  return {{{-x, -y}, {x, -y}, {x, y}, {-x, y}}, rounding};
}

inline Frame frame(double x, double y, double angle) { return frame_of({{x, y}, angle}); }

inline std::vector<ContactPoint> contacts_of(const Shape& a, const Frame& fa, const Shape& b, const Frame& fb,
                                             double reach = INFINITY) {
  std::vector<ContactPoint> contacts;
  find_contacts(a, fa, b, fb, reach, contacts);
  return contacts;
}

inline double smallest_gap(const std::vector<ContactPoint>& contacts) {
  double gap = INFINITY;
  for (const ContactPoint& c : contacts) gap = std::min(gap, c.gap);
  return gap;
}

// Discs, capsules and polygons of up to 7 corners, half of them rounded.
inline RoundedPolygon random_polygon(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  RoundedPolygon shape;
  const int corners = 1 + static_cast<int>(random() % 7);
  const double phase = 6.3 * unit(random), radius = 0.1 + 0.9 * unit(random);
  for (int i = 0; i < corners; ++i) {
    const SinCos turn = sin_cos(phase + 6.283185307179586 * (i + 0.6 * unit(random)) / corners);
    shape.vertices.push_back({radius * turn.cos, radius * turn.sin});
  }
  if (random() % 2 || corners == 1) shape.rounding = 0.3 * unit(random);
  return shape;
}

// The longer semi-axis is 1 or less, the shorter one as small as 1/1000 of it.
inline Ellipse random_ellipse(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double size = 0.1 + 0.9 * unit(random),
               ratio = std::pow(10.0, -3 * unit(random) * static_cast<double>(random() % 2));
  const Pose pose{{0.3 * unit(random), 0.3 * unit(random)}, 7 * unit(random)};
  return random() % 2 ? Ellipse{size, size * ratio, pose} : Ellipse{size * ratio, size, pose};
}

inline Pose random_pose(std::mt19937& random, double spread) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double x = spread * unit(random), y = spread * unit(random);
  return {{x, y}, 10 * unit(random)};
}

inline Frame random_frame(std::mt19937& random, double spread) { return frame_of(random_pose(random, spread)); }

// point_b is over point_a by the gap.
inline void expect_whole(const ContactPoint& c) {
  EXPECT_NEAR(length(c.normal), 1.0, k_tolerance);
  const Vector2 between = c.point_b - c.point_a;
  EXPECT_NEAR(between.x, c.gap * c.normal.x, 4 * k_tolerance);
  EXPECT_NEAR(between.y, c.gap * c.normal.y, 4 * k_tolerance);
}

inline void expect_symmetric(const Shape& a, const Frame& fa, const Shape& b, const Frame& fb) {
  const auto exchanged = [](const ContactPoint& c, const ContactPoint& d) {
    return c.normal == -d.normal && c.point_a == d.point_b && c.point_b == d.point_a && c.gap == d.gap &&
           c.radius_a == d.radius_b && c.radius_b == d.radius_a && c.feature == (d.feature << 16 | d.feature >> 16);
  };
  const auto forth = contacts_of(a, fa, b, fb), back = contacts_of(b, fb, a, fa);
  ASSERT_EQ(forth.size(), back.size());
  for (const ContactPoint& c : forth) {
    EXPECT_TRUE(std::any_of(back.begin(), back.end(), [&](const ContactPoint& d) { return exchanged(c, d); }));
  }
}

}  // namespace tumble::test
