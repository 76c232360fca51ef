#include "tumble/geometry/detect_contacts.hpp"

#include <algorithm>

#include "tumble/geometry/pair_contacts.hpp"

namespace tumble {

ContactFinder::ContactFinder(const Scene& scene) : placed_at_(scene.bodies.size()) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    placed_at_[i] = frame_of(body.pose);
    for (std::size_t k = 0; k < body.parts.size(); ++k) {
      const int index = static_cast<int>(parts_.size());
      PlacedPart part{placed_shape(body.parts[k].shape),
                      static_cast<int>(i),
                      static_cast<int>(k),
                      body.kind == BodyKind::dynamic,
                      {}};
      place(part.shape, placed_at_[i]);
      (std::holds_alternative<PlacedHalfPlane>(part.shape) ? unbounded_ : order_).push_back(index);
      parts_.push_back(std::move(part));
    }
  }
  bucket_.resize(parts_.size() + 1);
}

const std::vector<Contact>& ContactFinder::find(const std::vector<Frame>& frames, const std::vector<double>& reach) {
  for (PlacedPart& part : parts_) {
    const Frame &frame = frames[part.body], &old = placed_at_[part.body];
    const bool moved = frame.position != old.position || frame.sin != old.sin || frame.cos != old.cos;
    if (moved) place(part.shape, frame);
    part.box = bounding_box(part.shape, reach[part.body]);
  }
  placed_at_ = frames;

  find_pairs();
  sort_pairs();
  contacts_.clear();
  for (const Pair& pair : sorted_pairs_) {
    const PlacedPart &a = parts_[pair.first], &b = parts_[pair.second];
    points_.clear();
    append_sorted_contacts(a.shape, b.shape, reach[a.body] + reach[b.body], points_);
    for (const ContactPoint& point : points_) contacts_.push_back({point, a.body, b.body, a.part, b.part});
  }
  return contacts_;
}

// Sweep and prune along x: boxes in the order of their lower x, each against those that begin before it ends.
void ContactFinder::find_pairs() {
  pairs_.clear();
  const auto add = [&](int i, int j) {
    const PlacedPart &a = parts_[i], &b = parts_[j];
    if (a.body != b.body && (a.dynamic || b.dynamic)) pairs_.push_back({std::min(i, j), std::max(i, j)});
  };
  // By insertion: between two steps the order hardly changes.
  for (std::size_t i = 1; i < order_.size(); ++i) {
    const int part = order_[i];
    std::size_t j = i;
    for (; j > 0 && parts_[part].box.low.x < parts_[order_[j - 1]].box.low.x; --j) order_[j] = order_[j - 1];
    order_[j] = part;
  }
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Box& box = parts_[order_[i]].box;
    for (std::size_t j = i + 1; j < order_.size() && parts_[order_[j]].box.low.x <= box.high.x; ++j) {
      if (overlap(box, parts_[order_[j]].box)) add(order_[i], order_[j]);
    }
  }
  for (const int i : unbounded_) {
    for (const int j : order_) add(i, j);
  }
}

// By first and second: buckets by the first, insertion within them.
void ContactFinder::sort_pairs() {
  std::fill(bucket_.begin(), bucket_.end(), 0);
  for (const Pair& pair : pairs_) ++bucket_[pair.first + 1];
  for (std::size_t i = 1; i < bucket_.size(); ++i) bucket_[i] += bucket_[i - 1];
  sorted_pairs_.resize(pairs_.size());
  for (const Pair& pair : pairs_) sorted_pairs_[bucket_[pair.first]++] = pair;
  for (std::size_t i = 1; i < sorted_pairs_.size(); ++i) {
    const Pair pair = sorted_pairs_[i];
    std::size_t j = i;
    for (; j > 0 && sorted_pairs_[j - 1].first == pair.first && sorted_pairs_[j - 1].second > pair.second; --j) {
      sorted_pairs_[j] = sorted_pairs_[j - 1];
    }
    sorted_pairs_[j] = pair;
  }
}

}  // namespace tumble
