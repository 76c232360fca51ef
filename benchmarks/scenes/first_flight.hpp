// The exact motion of one body that falls on the ground y = 0, until it touches it a second time.
#pragma once

#include <optional>

#include "worlds.hpp"

namespace tumble::bench {

// Free flight, an impact at the one point that touches, free flight. The impact is that of Newton and Coulomb: the
// normal speed turns to -restitution times itself, friction stops the sliding if that takes no more than friction
// times the normal impulse, and is that much otherwise.
class FirstFlight {
 public:
  // Nothing if the body does not come down within the duration of the world.
  static std::optional<FirstFlight> of(const World& world, const WorldBody& body);

  double impact_time() const { return impact_time_; }
  double end_time() const { return end_time_; }  // of the second touch, or of the world

  // At a time from the impact to the end.
  Pose pose_at(double time) const;

 private:
  double gravity_ = 0.0;
  double impact_time_ = 0.0, end_time_ = 0.0;
  Pose impact_pose_;
  Vector3 velocity_{};  // after the impact
};

}  // namespace tumble::bench
