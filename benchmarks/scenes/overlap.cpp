#include "overlap.hpp"

#include <algorithm>
#include <limits>

namespace tumble::bench {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();

bool is_disc(const Outline& outline) { return outline.vertices.size() == 1; }

// How deep `b` reaches behind the edge of polygon `a` that it is least deep behind; negative if an edge separates them.
// Without the radius of `b`.
double depth_behind_edges(const Outline& a, const Outline& b) {
  double least = k_infinity;
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    const Vector2 from = a.vertices[i];
    const Vector2 edge = a.vertices[(i + 1) % a.vertices.size()] - from;
    const Vector2 inward = (1.0 / length(edge)) * turned_left(edge);
    double depth = -k_infinity;
    for (const Vector2& p : b.vertices) depth = std::max(depth, dot(inward, p - from));
    least = std::min(least, depth);
  }
  return least;
}

double distance_to_outside(const Outline& polygon, Vector2 p) {
  double least = k_infinity;
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const Vector2 from = polygon.vertices[i];
    const Vector2 edge = polygon.vertices[(i + 1) % polygon.vertices.size()] - from;
    const double share = std::clamp(dot(p - from, edge) / dot(edge, edge), 0.0, 1.0);
    least = std::min(least, length(p - (from + share * edge)));
  }
  return least;
}

double depth_of_disc(const Outline& polygon, const Outline& disc) {
  const double inside = depth_behind_edges(polygon, disc);
  return disc.radius + (inside >= 0.0 ? inside : -distance_to_outside(polygon, disc.vertices[0]));
}

struct Bounds {
  double left = k_infinity, right = -k_infinity, bottom = k_infinity, top = -k_infinity;
  const Outline* outline = nullptr;
  bool is_wall = false;
};

Bounds bounds_of(const Outline& outline, bool is_wall) {
  Bounds b;
  for (const Vector2& p : outline.vertices) {
    b.left = std::min(b.left, p.x - outline.radius);
    b.right = std::max(b.right, p.x + outline.radius);
    b.bottom = std::min(b.bottom, p.y - outline.radius);
    b.top = std::max(b.top, p.y + outline.radius);
  }
  b.outline = &outline;
  b.is_wall = is_wall;
  return b;
}

}  // namespace

Outline placed(const Outline& outline, const Pose& pose) {
  const Frame frame = frame_of(pose);
  Outline moved = outline;
  for (Vector2& p : moved.vertices) p = point_to_world(frame, p);
  return moved;
}

double overlap(const Outline& a, const Outline& b) {
  double depth = 0.0;
  if (is_disc(a) && is_disc(b)) {
    depth = a.radius + b.radius - length(a.vertices[0] - b.vertices[0]);
  } else if (is_disc(b)) {
    depth = depth_of_disc(a, b);
  } else if (is_disc(a)) {
    depth = depth_of_disc(b, a);
  } else {
    depth = std::min(depth_behind_edges(a, b), depth_behind_edges(b, a));
  }
  return std::max(depth, 0.0);
}

double deepest_overlap(std::span<const Outline> bodies, std::span<const Outline> walls) {
  std::vector<Bounds> all;
  for (const Outline& body : bodies) all.push_back(bounds_of(body, false));
  for (const Outline& wall : walls) all.push_back(bounds_of(wall, true));
  std::sort(all.begin(), all.end(), [](const Bounds& a, const Bounds& b) { return a.left < b.left; });
  double deepest = 0.0;
  std::vector<const Bounds*> open;  // those that the sweep from left to right is in
  for (const Bounds& b : all) {
    std::erase_if(open, [&](const Bounds* a) { return a->right < b.left; });
    for (const Bounds* a : open) {
      if (a->top < b.bottom || b.top < a->bottom || (a->is_wall && b.is_wall)) continue;
      deepest = std::max(deepest, overlap(*a->outline, *b.outline));
    }
    open.push_back(&b);
  }
  return deepest;
}

}  // namespace tumble::bench
