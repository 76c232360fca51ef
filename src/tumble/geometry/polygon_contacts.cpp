// Rounded polygons against each other and against half-planes, by the exact closest features of their cores.
//
// Of the two shapes, `own` is the one with the side that separates them most (or overlaps least); everything after that
// choice is computed about the position of `own`, so that it does not matter which of the two came first.
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "tumble/geometry/pair_contacts.hpp"

namespace tumble {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
// The direction between two corners closer than this many units of round-off of their coordinates means nothing.
constexpr double k_round_off = 8.0 * std::numeric_limits<double>::epsilon();
// A corner beyond which a side of the other shape rises steeper than 45 degrees is none that it can come to lie on
// within a step: near 90 degrees the normal of that side would hold the shapes apart along the side that they share.
constexpr double k_steepest = 0.7071067811865476;

// The side of `own` farthest below all of `other`, and the corner of `other` nearest to its line.
struct SideSeparation {
  double distance = -k_infinity;
  int side = -1;
  int corner = -1;
};

// Height of a corner of the shape at `offset` over the line of a side.
double height(const PlacedPolygon::Corner& side, Vector2 corner, Vector2 offset) {
  return (dot(side.normal, corner) + dot(side.normal, offset)) - side.offset;
}

// The corner of `shape` that is lowest along a direction, and how low; the first of several. `guess` wins where no
// corner is lower.
struct Lowest {
  double height;
  int corner;
};
Lowest lowest_corner(const PlacedPolygon& shape, Vector2 normal, int guess) {
  const PlacedPolygon::Corner* const corners = shape.corners.data();
  Lowest lowest{dot(normal, corners[guess].vertex), guess};
  for (int k = 0, count = shape.count(); k < count; ++k) {
    const double h = dot(normal, corners[k].vertex);
    const bool is_lower = h < lowest.height;  // no branch: which one it is cannot be foretold
    lowest.height = is_lower ? h : lowest.height;
    lowest.corner = is_lower ? k : lowest.corner;
  }
  return lowest;
}

// The side that faces a point most.
int facing_side(const PlacedPolygon& own, Vector2 point) {
  const PlacedPolygon::Corner* const corners = own.corners.data();
  int facing = 0;
  double most = -k_infinity;
  for (int i = 0, sides = own.sides(); i < sides; ++i) {
    const double distance = dot(corners[i].normal, point) - corners[i].offset;
    const bool is_more = distance > most;
    most = is_more ? distance : most;
    facing = is_more ? i : facing;
  }
  return facing;
}

// Sides that separate less than `floor` are not looked at.
SideSeparation separation(const PlacedPolygon& own, const PlacedPolygon& other, Vector2 offset, double floor) {
  const int sides = own.sides();
  // The side that faces the other's position most is a good guess: most others are ruled out by a single corner.
  int i = sides > 0 ? facing_side(own, offset) : 0;
  SideSeparation best;
  int corner = 0;
  for (int count = 0; count < sides; ++count, i = i + 1 < sides ? i + 1 : 0) {
    const PlacedPolygon::Corner& side = own.corners[i];
    if (const double bound = height(side, other.corners[corner].vertex, offset);
        bound <= best.distance || bound < floor) {
      continue;
    }
    corner = lowest_corner(other, side.normal, corner).corner;
    const double distance = height(side, other.corners[corner].vertex, offset);
    if (distance > best.distance && distance >= floor) best = {distance, i, corner};
  }
  return best;
}

// An order of two shapes that does not depend on which came first, to break ties by.
bool precedes(const PlacedPolygon& a, const PlacedPolygon& b, Vector2 offset) {
  if (a.count() != b.count()) return a.count() > b.count();
  if (a.rounding != b.rounding) return a.rounding > b.rounding;
  if (offset.y != 0.0) return offset.y > 0.0;
  if (offset.x != 0.0) return offset.x > 0.0;
  for (int i = 0; i < a.count(); ++i) {
    const Vector2 difference = b.corners[i].vertex - a.corners[i].vertex;
    if (difference.y != 0.0) return difference.y > 0.0;
    if (difference.x != 0.0) return difference.x > 0.0;
  }
  return true;
}

// The contacts of two polygons once it is known which is `own`. Points are about the position of `own`.
class Manifold {
 public:
  Manifold(const PlacedPolygon& own, const PlacedPolygon& other, Vector2 offset, bool own_is_b, double reach,
           ContactPoints& contacts)
      : own_(own), other_(other), offset_(offset), own_is_b_(own_is_b), reach_(reach), contacts_(contacts) {}

  // From the side that separates the shapes most. The closest points lie on that side, or are two corners.
  void from_side(const SideSeparation& s) {
    if (s.side < 0) return corner_corner(0, 0, s);  // two discs
    Stretch stretch = shared_stretch(s.side, most_opposed_side(s.side, s.corner), s.corner);
    if (stretch.near <= stretch.far) {
      near_end(s, stretch);
    } else if (s.distance > 0.0 || are_in_one_line()) {
      return closest_corners(s);
    } else {
      other_corner_over_side(s.corner, s.side);
    }
    far_ends(s.side, s.corner, &stretch);
  }

 private:
  // Segments and discs that share no stretch, but that no side separates, lie in one line, apart.
  bool are_in_one_line() const { return own_.count() <= 2 && other_.count() <= 2; }

  // The stretch that a side of `own` and a side of `other` that faces it share, measured along the side of `own` away
  // from a given corner of `other`.
  struct Stretch {
    int side = -1;  // of `other`; -1 if it has none there
    double near = 0.0, far = 0.0;
    int own_near = -1, own_far = -1;        // the corner of `own` where the stretch ends, -1 if it is that of `other`
    int other_corner = -1, other_far = -1;  // the ends of the side of `other`
  };

  Vector2 other_vertex(int k) const { return other_.corners[k].vertex + offset_; }

  // The side of `other` at a corner that is most opposed to the side of `own`, -1 if there is none that faces it.
  int most_opposed_side(int side, int corner) const {
    if (other_.sides() == 0) return -1;
    const Vector2 normal = own_.corners[side].normal;
    const int before = other_.previous(corner);
    const double leaving = dot(normal, other_.corners[corner].normal);
    const double arriving = dot(normal, other_.corners[before].normal);
    if (std::min(leaving, arriving) >= 0.0) return -1;
    return leaving <= arriving ? corner : before;
  }

  Stretch shared_stretch(int own_side, int other_side, int corner) const {
    // The side of `own` runs to the left of its normal. A facing side of `other` that leaves `corner` runs to the
    // right.
    const bool to_the_right = other_side < 0 || other_side == corner;
    const Vector2 left = turned_left(own_.corners[own_side].normal);
    const Vector2 along = to_the_right ? -left : left;
    int own_near = own_side, own_far = own_.next(own_side);
    if (to_the_right) std::swap(own_near, own_far);
    const double near = dot(along, own_.corners[own_near].vertex), far = dot(along, own_.corners[own_far].vertex);

    Stretch s;
    s.side = other_side;
    s.other_corner = corner;
    s.other_far = other_side < 0 ? corner : to_the_right ? other_.next(corner) : other_side;
    const double other_near = dot(along, other_vertex(corner)), other_far = dot(along, other_vertex(s.other_far));
    s.near = near > other_near ? near : other_near;
    s.own_near = near > other_near ? own_near : -1;
    s.far = far < other_far ? far : other_far;
    s.own_far = far < other_far ? own_far : -1;
    return s;
  }

  void near_end(const SideSeparation& s, const Stretch& stretch) {
    if (stretch.own_near < 0) return other_corner_over_side(s.corner, s.side);
    if (s.distance > 0.0 && !is_over_side(stretch)) return corner_corner(stretch.own_near, s.corner, s);
    own_corner_over_side(stretch.own_near, stretch.side);
  }

  // Whether the corner of `own` at the near end lies over the side of `other`, not before its corner.
  bool is_over_side(const Stretch& stretch, int own_corner) const {
    const Vector2 left = turned_left(other_.corners[stretch.side].normal);
    const double run = dot(left, own_.corners[own_corner].vertex - other_vertex(stretch.other_corner));
    return stretch.side == stretch.other_corner ? run > 0.0 : run < 0.0;
  }
  bool is_over_side(const Stretch& stretch) const { return is_over_side(stretch, stretch.own_near); }

  // The ends that the two sides at a corner of `other` share with a side of `own`, away from the corner. One of them
  // may be known already.
  void far_ends(int own_side, int corner, const Stretch* known = nullptr) {
    if (other_.sides() == 0) return;
    for (const int other_side : {corner, other_.previous(corner)}) {
      const double opposed = -dot(own_.corners[own_side].normal, other_.corners[other_side].normal);
      if (!(opposed > 0.0)) continue;
      if (opposed <= k_steepest &&
          !is_within_reach(own_side, other_side == corner ? other_.next(corner) : other_side)) {
        continue;  // of a steep side only the corner counts
      }
      const Stretch stretch =
          known != nullptr && known->side == other_side ? *known : shared_stretch(own_side, other_side, corner);
      if (!(stretch.near < stretch.far)) continue;
      if (stretch.own_far < 0) {
        other_corner_over_side(stretch.other_far, own_side);
      } else if (opposed > k_steepest && is_over_side(stretch, stretch.own_far)) {
        own_corner_over_side(stretch.own_far, other_side);
      }
    }
  }

  bool is_within_reach(int own_side, int other_corner) const {
    const double h = height(own_.corners[own_side], other_.corners[other_corner].vertex, offset_);
    return h - (own_.rounding + other_.rounding) <= reach_;
  }

  // Where no corner lies over a side of the other shape, the closest points are two corners.
  void closest_corners(const SideSeparation& s) {
    int m = own_end_near(s.side, s.corner), k = s.corner;
    if (!are_closest(m, k)) std::tie(m, k) = closest_of_all_corners();
    corner_corner(m, k, s);
    if (m == s.side || m == own_.next(s.side)) far_ends(s.side, k);
  }

  // The end of a side of `own` on whose side a corner of `other` lies.
  int own_end_near(int side, int corner) const {
    const Vector2 left = turned_left(own_.corners[side].normal);
    const int end = own_.next(side);
    const double middle = 0.5 * (dot(left, own_.corners[side].vertex) + dot(left, own_.corners[end].vertex));
    return dot(left, other_vertex(corner)) > middle ? end : side;
  }

  // Two corners are if neither shape has a side there that leads towards the other.
  bool are_closest(int m, int k) const {
    const Vector2 between = other_vertex(k) - own_.corners[m].vertex;
    const auto leads = [](const PlacedPolygon& shape, int corner, Vector2 towards) {
      const Vector2 v = shape.corners[corner].vertex;
      return dot(shape.corners[shape.next(corner)].vertex - v, towards) > 0.0 ||
             dot(shape.corners[shape.previous(corner)].vertex - v, towards) > 0.0;
    };
    return !leads(own_, m, between) && !leads(other_, k, -between);
  }

  std::pair<int, int> closest_of_all_corners() const {
    std::pair<int, int> closest;
    double smallest = k_infinity;
    for (int i = 0; i < own_.count(); ++i) {
      for (int j = 0; j < other_.count(); ++j) {
        const Vector2 between = other_vertex(j) - own_.corners[i].vertex;
        const double square = dot(between, between);
        if (square < smallest) {
          smallest = square;
          closest = {i, j};
        }
      }
    }
    return closest;
  }

  void corner_corner(int m, int k, const SideSeparation& s) {
    const Vector2 from = own_.corners[m].vertex, to = other_vertex(k);
    const Vector2 between = to - from;
    const double distance = length(between);
    const double size = std::abs(from.x) + std::abs(from.y) + std::abs(to.x) + std::abs(to.y);
    Vector2 normal{0.0, 1.0};  // of two discs with one centre
    if (s.side >= 0 && distance <= k_round_off * size) {
      normal = own_.corners[s.side].normal;
    } else if (distance > 0.0) {
      normal = (1.0 / distance) * between;
    }
    append(normal, from + own_.rounding * normal, to - other_.rounding * normal, distance, own_.rounding,
           other_.rounding, corner_feature(m), corner_feature(k));
  }

  void other_corner_over_side(int k, int side) {
    const Vector2 normal = own_.corners[side].normal, corner = other_vertex(k);
    const double h = height(own_.corners[side], other_.corners[k].vertex, offset_);
    append(normal, corner - (h - own_.rounding) * normal, corner - other_.rounding * normal, h, k_infinity,
           other_.rounding, side_feature(side), corner_feature(k));
  }

  void own_corner_over_side(int m, int side) {
    const Vector2 outward = other_.corners[side].normal, corner = own_.corners[m].vertex;
    const double h = height(other_.corners[side], corner, -offset_);
    append(-outward, corner - own_.rounding * outward, corner - (h - other_.rounding) * outward, h, own_.rounding,
           k_infinity, corner_feature(m), side_feature(side));
  }

  // `distance` is that of the cores.
  void append(Vector2 normal, Vector2 point_own, Vector2 point_other, double distance, double radius_own,
              double radius_other, std::uint32_t feature_own, std::uint32_t feature_other) {
    const double gap = distance - (own_.rounding + other_.rounding);
    if (!(gap <= reach_)) return;
    const ContactPoint contact{normal,
                               own_.position + point_own,
                               own_.position + point_other,
                               gap,
                               radius_own,
                               radius_other,
                               pair_feature(feature_own, feature_other)};
    contacts_.push_back(own_is_b_ ? exchanged(contact) : contact);
  }

  const PlacedPolygon& own_;
  const PlacedPolygon& other_;
  Vector2 offset_;  // position of `other` minus that of `own`
  bool own_is_b_;
  double reach_;
  ContactPoints& contacts_;
};

}  // namespace

void append_contacts(const PlacedPolygon& a, const PlacedPolygon& b, double reach, ContactPoints& contacts) {
  const Vector2 offset = b.position - a.position;
  const double limit = reach + (a.rounding + b.rounding);
  const SideSeparation from_a = separation(a, b, offset, -k_infinity);
  if (from_a.distance > limit) return;
  const SideSeparation from_b = separation(b, a, -offset, from_a.distance);
  if (from_b.distance > limit) return;
  if (from_a.distance > from_b.distance || (from_a.distance == from_b.distance && precedes(a, b, offset))) {
    Manifold(a, b, offset, false, reach, contacts).from_side(from_a);
  } else {
    Manifold(b, a, -offset, true, reach, contacts).from_side(from_b);
  }
}

// The lowest corners and their neighbours: a body that rocks from one corner to the next meets both within a step.
void append_contacts(const PlacedPolygon& a, const PlacedHalfPlane& b, double reach, ContactPoints& contacts) {
  const Vector2 outward = b.normal;
  const double base = dot(outward, a.position - b.position) - b.offset;
  const auto height_of = [&](int i) { return (dot(outward, a.corners[i].vertex) + base) - a.rounding; };
  double lowest = k_infinity;
  for (int i = 0; i < a.count(); ++i) lowest = std::min(lowest, height_of(i));
  if (!(lowest <= reach)) return;
  for (int i = 0; i < a.count(); ++i) {
    const double gap = height_of(i);
    if (!(gap <= reach)) continue;
    if (gap != lowest && height_of(a.next(i)) != lowest && height_of(a.previous(i)) != lowest) continue;
    const Vector2 point = a.position + (a.corners[i].vertex - a.rounding * outward);
    contacts.push_back({-outward, point, point - gap * outward, gap, a.rounding, k_infinity,
                        pair_feature(corner_feature(i), side_feature(0))});
  }
}

}  // namespace tumble
