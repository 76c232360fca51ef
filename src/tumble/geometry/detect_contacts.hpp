// All contacts of a scene.
#pragma once

#include <vector>

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
    Box box;
  };
  // Indices into parts_, first < second.
  struct Pair {
    int first = 0, second = 0;
  };

  void find_pairs();
  void sort_pairs();

  std::vector<PlacedPart> parts_;  // in the order of (body, part)
  std::vector<Frame> placed_at_;   // of each body
  std::vector<int> unbounded_;     // parts whose boxes have no end
  std::vector<int> order_;         // the others by their boxes' lower x, as of the last call
  std::vector<Pair> pairs_, sorted_pairs_;
  std::vector<int> bucket_;
  std::vector<ContactPoint> points_;
  std::vector<Contact> contacts_;
};

}  // namespace tumble
