// The part of view.hpp that looks at a whole run.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "tumble/math/format.hpp"
#include "tumble/output/trajectory_fields.hpp"
#include "tumble/output/view.hpp"

namespace tumble::output {
namespace {

// Products of two such numbers stay finite.
constexpr double k_largest = 1e100;
constexpr double k_smallest_body = 1e-100;

constexpr double k_smallest_sight = 1.9;  // in diameters of the smallest body
// The boundary of a half-plane is shown while it is no farther from the motion than this many times the motion's own
// size; other fixed bodies up to such a distance.
constexpr double k_ground_reach = 2.0;
constexpr double k_fixed_reach = 0.3;
// Where all of the motion is this many times as long as what most of it takes, the rest is left out.
constexpr double k_most_stray = 2.5;
constexpr double k_stray_share = 0.05;         // of all poses, at each end
constexpr std::size_t k_most_poses = 200'000;  // that are looked at for that
// Of a crowd, the place where it starts and this many times its size around it.
constexpr std::size_t k_crowd = 9;
constexpr double k_crowd_reach = 0.75;

constexpr Box k_nothing = {{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()},
                           {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}};

bool is_empty(const Box& box) { return !(box.low.x <= box.high.x && box.low.y <= box.high.y); }

Box moved(const Box& box, Vector2 by) { return {box.low + by, box.high + by}; }

Box grown(const Box& box, double by) { return {box.low - Vector2{by, by}, box.high + Vector2{by, by}}; }

Box common(const Box& a, const Box& b) {
  return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)},
          {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y)}};
}

double size_of(const Box& box) { return std::max(box.high.x - box.low.x, box.high.y - box.low.y); }

// The box of a body about its own position, for one angle after the other.
class BodyBox {
 public:
  explicit BodyBox(const Body& body) {
    for (const Part& part : body.parts) {
      if (!std::holds_alternative<HalfPlane>(part.shape)) parts_.push_back(placed_shape(part.shape));
    }
  }

  const Box& at(double angle) {
    if (angle_ == angle) return box_;
    angle_ = angle;
    const Frame frame = frame_of({{}, angle});
    box_ = k_nothing;
    for (PlacedShape& part : parts_) {
      place(part, frame);
      box_ = united(box_, bounding_box(part, 0.0));
    }
    return box_;
  }

 private:
  std::vector<PlacedShape> parts_;
  std::optional<double> angle_;
  Box box_ = k_nothing;
};

void require_drawable(double value, double low, const char* what) {
  if (std::abs(value) <= k_largest && value >= low) return;
  throw std::invalid_argument(
      tumble::format("picture: {} must lie in [{:g}, {:g}] m, got {:g}", what, low, k_largest, value));
}

// What moves: everywhere, at the start, and the ends of some of the boxes.
struct Motion {
  Box all = k_nothing;
  Box start = k_nothing;
  std::array<std::vector<double>, 4> ends;                            // low x, low y, -high x, -high y
  double smallest_dynamic = std::numeric_limits<double>::infinity();  // diameter [m]
  double smallest_kinematic = std::numeric_limits<double>::infinity();
  std::size_t bodies = 0;
};

Motion motion_of(const Trajectory& trajectory) {
  Motion motion;
  const Scene& scene = trajectory.scene;
  const std::size_t samples = trajectory.time.size();
  const std::size_t stride = 1 + samples * scene.bodies.size() / k_most_poses;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.kind == BodyKind::fixed) continue;
    ++motion.bodies;
    BodyBox body_box(body);
    const Box upright = body_box.at(0.0);
    const double diameter = length(upright.high - upright.low);
    require_drawable(diameter, k_smallest_body, "sizes");
    double& smallest = body.kind == BodyKind::dynamic ? motion.smallest_dynamic : motion.smallest_kinematic;
    smallest = std::min(smallest, diameter);
    for (std::size_t k = 0; k < samples; ++k) {
      const Pose& pose = trajectory.bodies(k)[i].pose;
      require_drawable(pose.position.x, -k_largest, "positions");
      require_drawable(pose.position.y, -k_largest, "positions");
      const Box box = moved(body_box.at(pose.angle), pose.position);
      motion.all = united(motion.all, box);
      if (k == 0) motion.start = united(motion.start, box);
      if (k % stride != 0) continue;
      const std::array<double, 4> ends = {box.low.x, box.low.y, -box.high.x, -box.high.y};
      for (std::size_t side = 0; side < 4; ++side) motion.ends[side].push_back(ends[side]);
    }
  }
  return motion;
}

// All of the motion, or, where few of its poses make it long, that of most of them and the start.
Box without_strays(Motion motion) {
  std::array<double, 4> most{};
  for (std::size_t side = 0; side < 4; ++side) {
    std::vector<double>& ends = motion.ends[side];
    const auto at = ends.begin() + static_cast<std::ptrdiff_t>(k_stray_share * static_cast<double>(ends.size()));
    std::nth_element(ends.begin(), at, ends.end());
    most[side] = *at;
  }
  const Box inner = united(motion.start, {{most[0], most[1]}, {-most[2], -most[3]}});
  const Box wide = common(motion.all, grown(inner, 0.25 * size_of(inner)));
  Box box = motion.all;
  if (box.high.x - box.low.x > k_most_stray * (inner.high.x - inner.low.x)) {
    box.low.x = wide.low.x;
    box.high.x = wide.high.x;
  }
  if (box.high.y - box.low.y > k_most_stray * (inner.high.y - inner.low.y)) {
    box.low.y = wide.low.y;
    box.high.y = wide.high.y;
  }
  return box;
}

// The box with what is near of the fixed bodies.
Box with_fixed_bodies(const Box& box, const Scene& scene) {
  Box wide = box;
  const Box reach = grown(box, k_fixed_reach * size_of(box));
  for (const Body& body : scene.bodies) {
    if (body.kind != BodyKind::fixed) continue;
    BodyBox body_box(body);
    const Box near = common(moved(body_box.at(body.pose.angle), body.pose.position), reach);
    if (!is_empty(near)) wide = united(wide, near);
  }
  return wide;
}

// The motion without that of a crowd that has gone far from where it was, and from what is fixed there.
Box without_departed(const Box& motion, const Box& start, const Scene& scene) {
  const Box place = with_fixed_bodies(start, scene);
  return common(motion, grown(place, k_crowd_reach * size_of(place)));
}

// Extends the box to the boundary of a half-plane that is near. True if the boundary is in the box.
bool reach_boundary(Vector2 normal, double offset, double reach, Box& box) {
  const std::array<Vector2, 4> corners = {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
  const auto height = [&](Vector2 p) { return dot(normal, p) - offset; };
  const auto by_height = [&](Vector2 a, Vector2 b) { return height(a) < height(b); };
  const auto [lowest, highest] = std::minmax_element(corners.begin(), corners.end(), by_height);
  if (height(*lowest) <= 0.0 && height(*highest) >= 0.0) return true;
  const Vector2 nearest = height(*lowest) > 0.0 ? *lowest : *highest;
  if (!(std::abs(height(nearest)) <= reach)) return false;
  const Vector2 foot = nearest - height(nearest) * normal;
  box = united(box, {foot, foot});
  return true;
}

}  // namespace

Sight sight_of(const Trajectory& trajectory) {
  check_trajectory(trajectory);
  const Scene& scene = trajectory.scene;
  Motion motion = motion_of(trajectory);
  Sight sight;
  const double smallest = std::isfinite(motion.smallest_dynamic) ? motion.smallest_dynamic : motion.smallest_kinematic;
  if (is_empty(motion.all)) {
    sight.box = with_fixed_bodies({{-1.0, -1.0}, {1.0, 1.0}}, scene);
  } else {
    const Box start = motion.start;
    const bool is_crowd = motion.bodies >= k_crowd;
    sight.box = without_strays(std::move(motion));
    if (is_crowd) sight.box = without_departed(sight.box, start, scene);
    sight.box = with_fixed_bodies(sight.box, scene);
  }
  const double size = size_of(sight.box);
  sight.smallest = std::isfinite(smallest) ? k_smallest_sight * smallest : size;
  const double reach = k_ground_reach * std::max(size, sight.smallest);
  for (const Body& body : scene.bodies) {
    const Frame frame = frame_of(body.pose);
    for (const Part& part : body.parts) {
      const auto* plane = std::get_if<HalfPlane>(&part.shape);
      if (plane == nullptr) continue;
      const Vector2 normal = direction_to_world(frame, plane->normal);
      const bool is_seen = reach_boundary(normal, plane->offset + dot(normal, frame.position), reach, sight.box);
      constexpr double k_level = 0.999;
      sight.has_ground = sight.has_ground || (is_seen && normal.y > k_level);
    }
  }
  return sight;
}

}  // namespace tumble::output
