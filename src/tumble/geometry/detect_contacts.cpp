#include "tumble/geometry/detect_contacts.hpp"

#include <algorithm>
#include <tuple>

#include "tumble/geometry/pair_contacts.hpp"

namespace tumble {

ContactFinder::ContactFinder(const Scene& scene) : placed_at_(scene.bodies.size()) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    placed_at_[i] = frame_of(body.pose);
    for (std::size_t k = 0; k < body.parts.size(); ++k) {
      PlacedPart part{placed_shape(body.parts[k].shape), static_cast<int>(i), static_cast<int>(k),
                      body.kind == BodyKind::dynamic};
      place(part.shape, placed_at_[i]);
      const bool is_ground =
          std::holds_alternative<PlacedHalfPlane>(part.shape) || std::holds_alternative<PlacedTerrain>(part.shape);
      (is_ground ? ground_ : bounded_).push_back(static_cast<int>(parts_.size()));
      parts_.push_back(std::move(part));
    }
  }
  boxes_.resize(bounded_.size());
}

const std::vector<Contact>& ContactFinder::find(const std::vector<Frame>& frames, const std::vector<double>& reach) {
  place_parts(frames, reach);
  contacts_.clear();
  find_pairs(reach);
  sort_pairs();
  for (const BoxPair& pair : pairs_) {
    const PlacedPart &a = parts_[pair.first], &b = parts_[pair.second];
    points_.clear();
    append_sorted_contacts(a.shape, b.shape, reach[a.body] + reach[b.body], points_);
    for (const ContactPoint& point : points_) contacts_.push_back({point, a.body, b.body, a.part, b.part});
  }
  return contacts_;
}

void ContactFinder::place_parts(const std::vector<Frame>& frames, const std::vector<double>& reach) {
  for (PlacedPart& part : parts_) {
    const Frame &frame = frames[part.body], &old = placed_at_[part.body];
    const bool has_moved = frame.position != old.position || frame.sin != old.sin || frame.cos != old.cos;
    if (has_moved) place(part.shape, frame);
  }
  placed_at_ = frames;
  for (std::size_t i = 0; i < bounded_.size(); ++i) {
    const PlacedPart& part = parts_[bounded_[i]];
    boxes_[i] = bounding_box(part.shape, reach[part.body]);
  }
}

void ContactFinder::find_pairs(const std::vector<double>& reach) {
  unsorted_.clear();
  const auto add = [&](int i, int j) {
    const PlacedPart &a = parts_[i], &b = parts_[j];
    if (a.body != b.body && (a.dynamic || b.dynamic)) unsorted_.push_back({std::min(i, j), std::max(i, j)});
  };
  for (const BoxPair& pair : broad_phase_.find(boxes_)) add(bounded_[pair.first], bounded_[pair.second]);
  for (const int i : ground_) {
    for (std::size_t k = 0; k < bounded_.size(); ++k) {
      if (may_touch_ground(parts_[i].shape, reach[parts_[i].body], boxes_[k])) add(i, bounded_[k]);
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

  bucket_.assign(placed_at_.size() + 1, 0);
  const auto bucket_of = [&](const BoxPair& pair) { return static_cast<std::size_t>(parts_[pair.first].body); };
  for (const BoxPair& pair : unsorted_) ++bucket_[bucket_of(pair) + 1];
  for (std::size_t i = 1; i < bucket_.size(); ++i) bucket_[i] += bucket_[i - 1];
  pairs_.resize(unsorted_.size());
  for (const BoxPair& pair : unsorted_) pairs_[bucket_[bucket_of(pair)]++] = pair;
  auto begin = pairs_.begin();
  for (std::size_t body = 0; body < placed_at_.size(); ++body) {
    const auto end = pairs_.begin() + static_cast<std::ptrdiff_t>(bucket_[body]);
    if (!std::is_sorted(begin, end, before)) std::sort(begin, end, before);
    begin = end;
  }
}

// `box` is that of a part and its reach.
bool ContactFinder::may_touch_ground(const PlacedShape& ground, double reach, const Box& box) const {
  if (const auto* plane = std::get_if<PlacedHalfPlane>(&ground)) {
    const Vector2 n = plane->normal;
    const Vector2 lowest = {n.x > 0.0 ? box.low.x : box.high.x, n.y > 0.0 ? box.low.y : box.high.y};
    return dot(n, lowest - plane->position) - plane->offset <= reach;
  }
  // Bodies are found as deep below terrain as they are long.
  const double depth = length(box.high - box.low);
  return overlap(bounding_box(ground, reach + depth), box);
}

}  // namespace tumble
