#include "tumble/geometry/detect_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "tumble/geometry/pair_contacts.hpp"
#include "tumble/geometry/shape_size.hpp"

namespace tumble {

namespace {

constexpr double k_margin = 6.0;        // [-] of the reach: for about as many steps
constexpr double k_spare_reach = 1e-6;  // [-] contacts of pairs are looked for so much further away
constexpr double k_round = 0.75;        // [-] of the thickness: a circle as small holds a part that need not be placed
constexpr double k_round_off = 4.0 * std::numeric_limits<double>::epsilon();

Box with_margin(const Box& box, double margin) {
  return {{box.low.x - margin, box.low.y - margin}, {box.high.x + margin, box.high.y + margin}};
}

}  // namespace

ContactFinder::ContactFinder(const Scene& scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    bodies_.push_back(
        {parts_.size(), parts_.size() + body.parts.size(), body.kind == BodyKind::dynamic, radius_of(body), {}, -1.0});
    for (std::size_t k = 0; k < body.parts.size(); ++k) {
      const MovedShape shape(body.parts[k].shape, body.pose);
      const bool is_ground = std::holds_alternative<PlacedHalfPlane>(shape.placed()) ||
                             std::holds_alternative<PlacedTerrain>(shape.placed());
      (is_ground ? ground_ : bounded_).push_back(static_cast<int>(parts_.size()));
      const Box box = is_ground ? Box{{-HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL}} : bounding_box(shape.placed(), 0.0);
      const double radius = radius_of(body.parts[k].shape);
      const bool is_round = radius <= k_round * size_of(body.parts[k].shape).thickness && !is_ground;
      parts_.push_back(
          {shape, shape, static_cast<int>(i), static_cast<int>(k), is_ground, is_round ? radius : 0.0, box});
    }
  }
  boxes_.resize(bounded_.size());
}

const std::vector<Contact>& ContactFinder::find(const std::vector<Pose>& poses, const std::vector<double>& reach) {
  if (!do_boxes_hold(poses, reach)) {
    make_boxes(poses, reach);
    find_pairs();
    sort_pairs();
    memories_.assign(pairs_.size(), {});
  }
  contacts_.swap(last_contacts_);
  contacts_.clear();
  for (std::size_t k = 0; k < pairs_.size(); ++k) find_of_pair(pairs_[k], poses, reach, memories_[k]);
  last_contacts_.reserve(contacts_.capacity());  // now, so that the next call takes nothing from the heap
  return contacts_;
}

// Between bodies that have not moved since the last call nothing has changed. Their reach may have, by round-off of
// their velocities.
void ContactFinder::find_of_pair(const BoxPair& pair, const std::vector<Pose>& poses, const std::vector<double>& reach,
                                 PairMemory& memory) {
  const PlacedPart &a = parts_[pair.first], &b = parts_[pair.second];
  const double within = reach[a.body] + reach[b.body], wide = within * (1.0 + k_spare_reach);
  if (remembers(memory, poses[a.body], poses[b.body], within)) {
    const std::size_t first = contacts_.size();
    const auto old = last_contacts_.begin() + static_cast<std::ptrdiff_t>(memory.first);
    contacts_.insert(contacts_.end(), old, old + static_cast<std::ptrdiff_t>(memory.count));
    memory.first = first;
    return;
  }
  memory = {poses[a.body], poses[b.body], wide, contacts_.size(), 0};
  if (!overlap(wide_box(a, poses, wide), wide_box(b, poses, 0.0))) return;
  place(a.body, poses[a.body]);
  place(b.body, poses[b.body]);
  if (!overlap(with_margin(a.box, wide), b.box)) return;
  points_.clear();
  append_sorted_contacts(a.shape.placed(), b.shape.placed(), wide, points_);
  for (const ContactPoint& point : points_) {
    if (point.gap <= within) {
      contacts_.push_back({point, a.body, b.body, a.part, b.part});
    } else {
      memory.wide = -1.0;
    }
  }
  memory.count = contacts_.size() - memory.first;
}

bool ContactFinder::remembers(const PairMemory& memory, const Pose& pose_a, const Pose& pose_b, double within) const {
  if (!(within <= memory.wide && memory.wide <= within * (1.0 + 2.0 * k_spare_reach))) return false;
  if (memory.pose_a != pose_a || memory.pose_b != pose_b) return false;
  const auto old = last_contacts_.begin() + static_cast<std::ptrdiff_t>(memory.first);
  return std::all_of(old, old + static_cast<std::ptrdiff_t>(memory.count),
                     [&](const Contact& contact) { return contact.gap <= within; });
}

// Whether every body is so near to where its boxes were made that they still hold all within its reach.
bool ContactFinder::do_boxes_hold(const std::vector<Pose>& poses, const std::vector<double>& reach) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const PlacedBody& body = bodies_[i];
    const Vector2 way = poses[i].position - body.boxed_at.position;
    const double turn = std::abs(poses[i].angle - body.boxed_at.angle);
    const double left = body.margin - reach[i] - (turn > 0.0 ? turn * body.radius : 0.0);
    if (!(left >= 0.0 && dot(way, way) <= left * left)) return false;
  }
  return true;
}

void ContactFinder::place(int body, const Pose& pose) {
  const PlacedBody& b = bodies_[body];
  for (std::size_t k = b.first_part; k < b.end_part; ++k) {
    PlacedPart& part = parts_[k];
    if (part.shape.move_to(pose) && !part.is_ground) part.box = bounding_box(part.shape.placed(), 0.0);
  }
}

// A box about everything within `margin` of a part, which is placed only if its circle is too wide.
Box ContactFinder::wide_box(const PlacedPart& part, const std::vector<Pose>& poses, double margin) {
  const Pose& pose = poses[part.body];
  if (part.circle == 0.0) {
    place(part.body, pose);
    return with_margin(part.box, margin);
  }
  const Vector2 p = pose.position;
  return with_margin({p, p}, part.circle + margin + k_round_off * (std::abs(p.x) + std::abs(p.y)));
}

void ContactFinder::make_boxes(const std::vector<Pose>& poses, const std::vector<double>& reach) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].boxed_at = poses[i];
    bodies_[i].margin = k_margin * reach[i];
  }
  for (std::size_t i = 0; i < bounded_.size(); ++i) {
    const PlacedPart& part = parts_[bounded_[i]];
    boxes_[i] = wide_box(part, poses, bodies_[part.body].margin);
  }
  for (const int i : ground_) place(parts_[i].body, poses[parts_[i].body]);
}

void ContactFinder::find_pairs() {
  unsorted_.clear();
  const auto add = [&](int i, int j) {
    const PlacedBody &a = bodies_[parts_[i].body], &b = bodies_[parts_[j].body];
    if (&a != &b && (a.dynamic || b.dynamic)) unsorted_.push_back({std::min(i, j), std::max(i, j)});
  };
  for (const BoxPair& pair : broad_phase_.find(boxes_)) add(bounded_[pair.first], bounded_[pair.second]);
  for (const int i : ground_) {
    const double margin = bodies_[parts_[i].body].margin;
    for (std::size_t k = 0; k < bounded_.size(); ++k) {
      if (may_touch_ground(parts_[i].shape.placed(), margin, boxes_[k])) add(i, bounded_[k]);
    }
  }
}

// By (first body, second body, first part, second part): by the first body in buckets, then in each.
void ContactFinder::sort_pairs() {
  const auto before = [&](const BoxPair& p, const BoxPair& q) {
    const auto key = [&](const BoxPair& pair) {
      return std::tuple(parts_[pair.first].body, parts_[pair.second].body, pair.first, pair.second);
    };
    return key(p) < key(q);
  };
  if (std::is_sorted(unsorted_.begin(), unsorted_.end(), before)) return pairs_.swap(unsorted_);

  bucket_.assign(bodies_.size() + 1, 0);
  const auto bucket_of = [&](const BoxPair& pair) { return static_cast<std::size_t>(parts_[pair.first].body); };
  for (const BoxPair& pair : unsorted_) ++bucket_[bucket_of(pair) + 1];
  for (std::size_t i = 1; i < bucket_.size(); ++i) bucket_[i] += bucket_[i - 1];
  pairs_.resize(unsorted_.size());
  for (const BoxPair& pair : unsorted_) pairs_[bucket_[bucket_of(pair)]++] = pair;
  auto begin = pairs_.begin();
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const auto end = pairs_.begin() + static_cast<std::ptrdiff_t>(bucket_[body]);
    if (!std::is_sorted(begin, end, before)) std::sort(begin, end, before);
    begin = end;
  }
}

// `box` is that of a part and its margin.
bool ContactFinder::may_touch_ground(const PlacedShape& ground, double margin, const Box& box) const {
  if (const auto* plane = std::get_if<PlacedHalfPlane>(&ground)) {
    const Vector2 n = plane->normal;
    const Vector2 lowest = {n.x > 0.0 ? box.low.x : box.high.x, n.y > 0.0 ? box.low.y : box.high.y};
    return dot(n, lowest - plane->position) - plane->offset <= margin;
  }
  // Bodies are found as deep below terrain as they are long.
  const double depth = length(box.high - box.low);
  return overlap(bounding_box(ground, margin + depth), box);
}

}  // namespace tumble
