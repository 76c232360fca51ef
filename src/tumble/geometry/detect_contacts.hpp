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
//
// The boxes of the broad phase are wider than they need be, so that their pairs stay good for some steps: what
// is far from everything else costs no more than a look at how far it has gone.
class ContactFinder {
 public:
  explicit ContactFinder(const Scene& scene);

  // The contacts at these poses, one for each body, with gap <= reach[a] + reach[b] [m], of pairs of bodies of which
  // at least one is dynamic. In the order of (body_a, body_b, part_a, part_b, feature). Valid until the next call.
  const std::vector<Contact>& find(const std::vector<Pose>& poses, const std::vector<double>& reach);

  // A part of a body that has contacts, where the last `find` had it.
  const PlacedShape& shape(int body, int part) const { return part_of(body, part).shape.placed(); }

  // The same shape for the caller to move, with no meaning of where it was left.
  MovedShape& moved(int body, int part) { return parts_[index_of(body, part)].moved; }

 private:
  struct PlacedPart {
    MovedShape shape, moved;
    int body = 0, part = 0;
    bool is_ground = false;
    double circle = 0.0;  // radius of the one about its body, if that is nearly as small as its box; else 0
    Box box;              // of the shape; infinite for ground
  };
  struct PlacedBody {
    std::size_t first_part = 0, end_part = 0;
    bool dynamic = false;
    double radius = 0.0;
    Pose boxed_at;         // where its boxes were made,
    double margin = -1.0;  // and by how much they are wider than its parts; < 0: never
  };

  // The contacts of a pair in the last call, at which poses, and within which distance there are no others.
  struct PairMemory {
    Pose pose_a, pose_b;
    double wide = -1.0;  // < 0: not known
    std::size_t first = 0, count = 0;
  };

  std::size_t index_of(int body, int part) const {
    return bodies_[static_cast<std::size_t>(body)].first_part + static_cast<std::size_t>(part);
  }
  const PlacedPart& part_of(int body, int part) const { return parts_[index_of(body, part)]; }

  bool do_boxes_hold(const std::vector<Pose>& poses, const std::vector<double>& reach) const;
  void place(int body, const Pose& pose);
  void find_of_pair(const BoxPair& pair, const std::vector<Pose>& poses, const std::vector<double>& reach,
                    PairMemory& memory);
  bool remembers(const PairMemory& memory, const Pose& pose_a, const Pose& pose_b, double within) const;
  Box wide_box(const PlacedPart& part, const std::vector<Pose>& poses, double margin);
  void make_boxes(const std::vector<Pose>& poses, const std::vector<double>& reach);
  void find_pairs();
  void sort_pairs();
  bool may_touch_ground(const PlacedShape& ground, double margin, const Box& box) const;

  std::vector<PlacedPart> parts_;  // in the order of (body, part)
  std::vector<PlacedBody> bodies_;
  std::vector<int> ground_;   // half-planes and terrain, which reach deeper than a box can say
  std::vector<int> bounded_;  // the other parts
  std::vector<Box> boxes_;    // of these, margins included
  BroadPhase broad_phase_;
  std::vector<BoxPair> unsorted_, pairs_;  // of parts
  std::vector<PairMemory> memories_;       // of the latter
  std::vector<std::size_t> bucket_;        // by body
  std::vector<ContactPoint> points_;
  std::vector<Contact> contacts_, last_contacts_;
};

}  // namespace tumble
