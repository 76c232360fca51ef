// The motion does not depend on how one looks at it.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "closed_form.hpp"
#include "named_scenes.hpp"
#include "scene_builder.hpp"
#include "transform.hpp"
#include <gtest/gtest.h>

namespace tumble::physics {
namespace {

// Round-off grows at impacts, in scenes of some bodies by up to a factor of 10 each; these have few in their first
// second.
constexpr double k_accepted = 1e-10;  // [m], [rad]
constexpr double k_duration = 1.0;    // [s]
// Not the scenes' own: several start where impacts fall on the end of a step of 1 ms, up to round-off.
constexpr double k_step_share = 0.9371;

using Back = std::function<BodyState(BodyState)>;

struct Difference {
  double largest = 0.0;  // [m], [rad]
  bool has_bits = true;  // all poses and velocities are the same numbers
};

// Runs a scene and its image, whose body i is body order[i] of the scene, seen by `back` as the scene is.
Difference compare(const Scene& scene, const Scene& image, double time_unit, const Back& back,
                   const std::vector<std::size_t>& order) {
  const double duration = std::min(k_duration, scene.duration);
  Simulation first = start(scene, scene.step_size, duration),
             second = start(image, image.step_size, time_unit * duration);
  Difference difference;
  while (!first.is_done()) {
    first.advance();
    second.advance();
    for (std::size_t i = 0; i < order.size(); ++i) {
      const BodyState a = first.state().bodies[order[i]], b = back(second.state().bodies[i]);
      difference.largest = std::max(
          {difference.largest, length(a.pose.position - b.pose.position), std::abs(a.pose.angle - b.pose.angle)});
      const bool is_same =
          a.pose.position == b.pose.position && a.pose.angle == b.pose.angle && a.velocity == b.velocity;
      difference.has_bits = difference.has_bits && is_same;
    }
  }
  return difference;
}

std::vector<std::size_t> same_order(const Scene& scene) {
  std::vector<std::size_t> order(scene.bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

Scene scene_of_test(const std::string& name) {
  Scene scene = named_scene(name);
  scene.step_size *= k_step_share;
  return scene;
}

Difference under_motion(const Scene& scene, const Pose& frame) {
  const Frame f = frame_of(frame);
  const Back back = [=](BodyState body) {
    const Vector2 v = direction_to_local(f, {body.velocity[0], body.velocity[1]});
    return BodyState{{point_to_local(f, body.pose.position), body.pose.angle - frame.angle},
                     {v.x, v.y, body.velocity[2]}};
  };
  return compare(scene, moved(scene, frame), 1.0, back, same_order(scene));
}

Difference under_reflection(const Scene& scene) {
  const Back back = [](BodyState body) {
    return BodyState{{{-body.pose.position.x, body.pose.position.y}, -body.pose.angle},
                     {-body.velocity[0], body.velocity[1], -body.velocity[2]}};
  };
  return compare(scene, mirrored(scene), 1.0, back, same_order(scene));
}

Difference under_units(const Scene& scene, double length, double mass, double time) {
  const Back back = [=](BodyState body) {
    const double speed = length / time;
    return BodyState{{(1.0 / length) * body.pose.position, body.pose.angle},
                     {body.velocity[0] / speed, body.velocity[1] / speed, body.velocity[2] * time}};
  };
  return compare(scene, in_units(scene, length, mass, time), time, back, same_order(scene));
}

class Invariance : public testing::TestWithParam<std::string> {
 protected:
  const Scene scene = scene_of_test(GetParam());
};

TEST_P(Invariance, UnderTranslation) { EXPECT_LT(under_motion(scene, {{3.25, -1.5}, 0.0}).largest, k_accepted); }

TEST_P(Invariance, UnderRotation) { EXPECT_LT(under_motion(scene, {{}, 0.7}).largest, k_accepted); }

TEST_P(Invariance, UnderReflection) { EXPECT_LT(under_reflection(scene).largest, k_accepted); }

TEST_P(Invariance, UnderOtherUnits) { EXPECT_LT(under_units(scene, 1000.0, 1000.0, 1000.0).largest, k_accepted); }

TEST_P(Invariance, UnderUnitsOfPowersOfTwoBitForBit) { EXPECT_TRUE(under_units(scene, 0.125, 8.0, 4.0).has_bits); }

TEST_P(Invariance, UnderTheOrderOfBodies) {
  std::vector<std::size_t> order = same_order(scene);
  std::reverse(order.begin(), order.end());
  EXPECT_LT(compare(
                scene, reordered(scene, order), 1.0, [](BodyState body) { return body; }, order)
                .largest,
            k_accepted);
}

// Left out: piles and flows, where round-off grows fast (funnel, galton_board, pile, wall_and_ball).
INSTANTIATE_TEST_SUITE_P(Physics, Invariance,
                         testing::Values("backspin", "billiard", "bouncing_balls", "capsule_and_rounded", "conveyor",
                                         "drop", "ellipse_drop", "newtons_cradle", "painleve_rod", "pusher", "pyramid",
                                         "ramp_with_disc", "rocking_block", "rod_impact", "slope_slide", "slope_stick",
                                         "stack", "stack_heavy_top", "terrain", "tilting_table", "tip_or_slide",
                                         "wedge"),
                         [](const auto& scene) { return scene.param; });

// One body on level ground: its mirror image is the same to the last bit.
TEST(MirrorImage, OfOneBodyHasTheSameBits) {
  for (const char* name : {"drop", "ellipse_drop", "rocking_block", "rod_impact", "painleve_rod", "backspin"}) {
    EXPECT_TRUE(under_reflection(scene_of_test(name)).has_bits) << name;
  }
}

}  // namespace
}  // namespace tumble::physics
