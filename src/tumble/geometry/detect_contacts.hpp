// All contacts of a scene.
#pragma once

#include <vector>

#include "tumble/geometry/broad_phase.hpp"
#include "tumble/geometry/contact_point.hpp"
#include "tumble/geometry/placed_shape.hpp"
#include "tumble/math/pose.hpp"
#include "tumble/scene/scene.hpp"

namespace tumble {

// Scratch memory and what does not change with the motion. Of one scene; its loss changes no result. One per thread.
class ContactFinder {
 public:
  explicit ContactFinder(const Scene& scene);

  // The contacts at these frames, one for each body, with gap <= reach[a] + reach[b] [m], of pairs of bodies of which
  // at least one is dynamic. In the order of (body_a, body_b, part_a, part_b, feature). Valid until the next call.
  const std::vector<Contact>& find(const std::vector<Frame>& frames, const std::vector<double>& reach);

 private:
  struct PlacedPart {
    PlacedShape shape;
    int body = 0, part = 0;
    bool dynamic = false;
  };

  void place_parts(const std::vector<Frame>& frames, const std::vector<double>& reach);
  void find_pairs(const std::vector<double>& reach);
  void sort_pairs();
  bool may_touch_ground(const PlacedShape& ground, double reach, const Box& box) const;

  std::vector<PlacedPart> parts_;  // in the order of (body, part)
  std::vector<Frame> placed_at_;   // of each body
  std::vector<int> ground_;        // half-planes and terrain, which reach deeper than a box can say
  std::vector<int> bounded_;       // the other parts
  std::vector<Box> boxes_;         // of these
  BroadPhase broad_phase_;
  std::vector<BoxPair> unsorted_, pairs_;  // of parts
  std::vector<std::size_t> bucket_;        // by body
  std::vector<ContactPoint> points_;
  std::vector<Contact> contacts_;
};

}  // namespace tumble
