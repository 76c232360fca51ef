// The direction along which two convex shapes are farthest apart or, where they overlap, overlap least.
//
// For a unit vector n the shapes are f(n) = n . x(n) apart along n, x the vector from the farthest point of a along n
// to the farthest point of b along -n. The largest f is the distance, or minus the depth. With n turning by an angle,
// f' = t . x, t = n turned left, and f'' = -(rho_a + rho_b) - f, rho the radii of curvature.
//
// Where f > -r, r the least of rho_a + rho_b, there is one maximum only: f + r is that of the shapes with a layer of
// thickness r taken off, a concave function of a vector n of any length. For such a function, x + r n at any n confines
// the directions where it is positive to a half-plane; so the sign of f' says on which side of n they are, and halving
// the angle finds the maximum or shows that there is none with f > -r. Only shapes that overlap deeper than r need a
// search round the circle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tumble/geometry/placed_shape.hpp"

namespace tumble {

// The point of a shape farthest along a direction, about the position of its body.
struct SupportPoint {
  Vector2 point;
  double radius = 0.0;  // of curvature there
  int corner = 0;       // of a polygon
};

inline SupportPoint support(const PlacedEllipse& shape, Vector2 n) {
  const double p = shape.semi_axis_x, q = shape.semi_axis_y;
  const Vector2 axis_y = turned_left(shape.axis);
  const Vector2 scaled = {p * dot(n, shape.axis), q * dot(n, axis_y)};
  const double h = length(scaled);
  const Vector2 from_centre = (p * (scaled.x / h)) * shape.axis + (q * (scaled.y / h)) * axis_y;
  return {shape.centre + from_centre, (p / h) * (q / h) * (p * q / h), 0};
}

// Of the core, without rounding.
inline SupportPoint support(const PlacedPolygon& shape, Vector2 n) {
  int best = 0;
  for (int i = 1; i < shape.count(); ++i) {
    if (dot(n, shape.corners[i].vertex) > dot(n, shape.corners[best].vertex)) best = i;
  }
  return {shape.corners[best].vertex, 0.0, best};
}

inline double least_radius(const PlacedEllipse& shape) {
  const double small = std::min(shape.semi_axis_x, shape.semi_axis_y);
  return small * (small / std::max(shape.semi_axis_x, shape.semi_axis_y));
}
inline double least_radius(const PlacedPolygon&) { return 0.0; }

// f at one direction.
struct Separation {
  Vector2 normal;
  SupportPoint a, b;  // both about the position of a
  double distance = -std::numeric_limits<double>::infinity();
  double slope = 0.0;  // f'
  double size = 0.0;   // of the numbers that make f and f'
};

template <class A, class B>
Separation separation_along(const A& a, const B& b, Vector2 n) {
  const Vector2 offset = b.position - a.position;
  Separation s{n, support(a, n), support(b, -n), 0.0, 0.0, 0.0};
  s.b.point = s.b.point + offset;
  const Vector2 between = s.b.point - s.a.point;
  s.distance = dot(n, between);
  s.slope = dot(turned_left(n), between);
  s.size = std::abs(s.a.point.x) + std::abs(s.a.point.y) + std::abs(s.b.point.x) + std::abs(s.b.point.y);
  return s;
}

inline Vector2 normalized(Vector2 v) { return (1.0 / length(v)) * v; }

// The zero of f' between two directions less than 180 degrees apart, where f' falls from + at `right` to - at `left`.
// Newton's method, kept inside, and halving wherever it does not at least do as much.
template <class A, class B>
Separation level_between(const A& a, const B& b, Separation s, Vector2 right, Vector2 left) {
  constexpr double k_round_off = std::numeric_limits<double>::epsilon();
  constexpr int k_most_steps = 200;  // 53 halvings, each after up to two steps of Newton's
  double last_slope = std::numeric_limits<double>::infinity();
  for (int step = 0; step < k_most_steps; ++step) {
    if (std::abs(s.slope) <= k_round_off * s.size) break;
    (s.slope > 0.0 ? right : left) = s.normal;
    const double bend = s.a.radius + s.b.radius + s.distance;
    Vector2 n = normalized(right + left);
    if (bend > 0.0 && std::abs(s.slope) < 0.25 * last_slope) {
      const Vector2 newton = normalized(s.normal + (s.slope / bend) * turned_left(s.normal));
      if (cross(right, newton) > 0.0 && cross(newton, left) > 0.0) n = newton;
    }
    last_slope = std::abs(s.slope);
    if (!(cross(right, n) > 0.0 && cross(n, left) > 0.0)) break;  // nothing is left between them
    s = separation_along(a, b, n);
  }
  return s;
}

// No more than this is f between two directions: f(m) <= m . x(n) for every m and n, as f is concave in vectors.
inline double bound_between(const Separation& right, const Separation& left) {
  const auto largest = [&](Vector2 x) {
    const bool inside = cross(right.normal, x) > 0.0 && cross(x, left.normal) > 0.0;
    return inside ? length(x) : std::max(dot(right.normal, x), dot(left.normal, x));
  };
  return std::min(largest(right.b.point - right.a.point), largest(left.b.point - left.a.point));
}

// Shapes that overlap deeply may have several maxima. Branch and bound on arcs of directions finds the best of them.
template <class A, class B>
class SearchRound {
 public:
  SearchRound(const A& a, const B& b) : a_(a), b_(b) {}

  Separation search(Vector2 start) {
    std::array<Separation, 4> quarters;
    for (Separation& s : quarters) {
      s = separation_along(a_, b_, start);
      take(s, best_);
      start = turned_left(start);
    }
    for (std::size_t i = 0; i < 4; ++i) search_between(quarters[i], quarters[(i + 1) % 4], 0);
    // Where both are the same maximum, the points at the zero of f' are the right ones.
    return best_.distance > best_level_.distance + k_round_off * best_.size ? best_ : best_level_;
  }

 private:
  static constexpr double k_round_off = 16.0 * std::numeric_limits<double>::epsilon();
  static constexpr double k_negligible = 1e-12;  // relative: of two maxima this close either will do
  static constexpr int k_most_halvings = 60;

  static void take(const Separation& s, Separation& best) {
    if (s.distance > best.distance) best = s;
  }

  void search_between(const Separation& right, const Separation& left, int depth) {
    const double worth = std::max(best_.distance, best_level_.distance) + k_negligible * right.size;
    if (depth == k_most_halvings || bound_between(right, left) <= worth) return;
    Separation middle = separation_along(a_, b_, normalized(right.normal + left.normal));
    if (right.slope > 0.0 && left.slope < 0.0) {
      middle = level_between(a_, b_, middle, right.normal, left.normal);
      middle.slope = 0.0;  // what is left of it is round-off
      take(middle, best_level_);
    }
    take(middle, best_);
    if (!(cross(right.normal, middle.normal) > 0.0 && cross(middle.normal, left.normal) > 0.0)) return;
    search_between(right, middle, depth + 1);
    search_between(middle, left, depth + 1);
  }

  const A& a_;
  const B& b_;
  Separation best_, best_level_;  // over all directions seen, over the zeros of f' among them
};

// The largest separation of two shapes of which at least one is an ellipse.
template <class A, class B>
Separation largest_separation(const A& a, const B& b, Vector2 guess) {
  const double layer = least_radius(a) + least_radius(b);
  const Separation start = separation_along(a, b, guess);
  const Vector2 towards = (start.b.point - start.a.point) + layer * guess;
  const double size = length(towards);
  if (size > 0.0) {
    const Vector2 n = (1.0 / size) * towards;
    const Separation s = level_between(a, b, separation_along(a, b, n), turned_right(n), turned_left(n));
    constexpr double k_certain = 0.999;  // away from the depth where there may be a second maximum
    if (s.distance > -k_certain * layer) return s;
  }
  return SearchRound(a, b).search(guess);
}

}  // namespace tumble
