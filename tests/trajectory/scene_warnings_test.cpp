#include "tumble/trajectory/scene_warnings.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tumble/scene/scene_toml.hpp"

namespace tumble {
namespace {

using Kind = SceneWarning::Kind;

Scene scene_of(const std::string& text) { return parse_scene("tumble = 1\n" + text); }

std::vector<std::string> texts(const Scene& scene) {
  std::vector<std::string> lines;
  for (const SceneWarning& warning : scene_warnings(scene)) {
    lines.push_back(to_text(warning, scene, body_labels(scene)));
  }
  return lines;
}

using Lines = std::vector<std::string>;

TEST(SceneWarnings, NameEachPairThatOverlapsWithItsDepth) {
  const std::string floor = R"([[bodies]]
    name = "floor"
    kind = "fixed"
    shape = { half_plane = [0, 1] }
  )";
  const std::string boxes = R"([[bodies]]
    name = "box"
    shape = { square = 0.5 }
    mass = 1
    position = [0, 0.125]
    copies = { count = 2, step = [0.375, 0.25] }
    [[bodies]]
    name = "round"
    shape = { disc = 1 }
    mass = 1
    position = [0, 9]
    [[bodies]]
    name = "oval"
    shape = { ellipse = [2, 1] }
    mass = 1
    position = [0, 10.75]
  )";
  EXPECT_EQ(texts(scene_of(floor + boxes)),
            (Lines{"floor and box1 overlap by 0.125 m at the start; they will be pushed apart",
                   "box1 and box2 overlap by 0.125 m at the start; they will be pushed apart",
                   "round and oval overlap by 0.25 m at the start; they will be pushed apart"}));
}

TEST(SceneWarnings, LeaveRoundOffAlone) {
  // The corners lie on the slope to round-off, far from the origin.
  EXPECT_EQ(texts(scene_of(R"(bodies = [
              { kind = "fixed", shape = { half_plane = [3, 4], offset = 600 } },
              { shape = { square = 0.2 }, mass = 1, position = [360.06, 480.08], angle = -0.6435011087932844 },
            ])")),
            Lines{});
}

TEST(SceneWarnings, FindWhatNothingCarries) {
  // The plank lies on the post, the box on the plank; the ball is beside, the ring below the post.
  const std::string bodies = R"(
    [[bodies]]
    name = "post"
    kind = "fixed"
    shape = { rectangle = [0.5, 1] }
    [[bodies]]
    name = "ring"
    shape = { disc = 0.25 }
    mass = 1
    position = [0, -2]
    [[bodies]]
    name = "box"
    shape = { square = 0.25 }
    mass = 1
    position = [1, 0.875]
    [[bodies]]
    name = "plank"
    shape = { rectangle = [4, 0.25] }
    mass = 1
    position = [0, 0.625]
    [[bodies]]
    name = "ball"
    shape = { disc = 0.25 }
    mass = 1
    position = [3, 4]
  )";
  EXPECT_EQ(texts(scene_of(bodies)),
            (Lines{"nothing is below ring: it falls for ever", "nothing is below ball: it falls for ever"}));
  EXPECT_EQ(texts(scene_of("gravity = [0, 0]\n" + bodies)), Lines{});
  EXPECT_EQ(texts(scene_of("gravity = [0, 3]\n" + bodies)),  // upwards: the ring is on the post, all others fall
            (Lines{"nothing is below box: it falls for ever", "nothing is below plank: it falls for ever",
                   "nothing is below ball: it falls for ever"}));
  EXPECT_EQ(texts(scene_of("gravity = [-5, 0]\n" + bodies)),  // to the left: box and plank hang on the post no more
            (Lines{"nothing is below ring: it falls for ever", "nothing is below box: it falls for ever",
                   "nothing is below plank: it falls for ever", "nothing is below ball: it falls for ever"}));
  const std::string slope = R"(
    [[bodies]]
    kind = "fixed"
    shape = { half_plane = [3, 4], offset = -9 }
  )";
  EXPECT_EQ(texts(scene_of(bodies + slope)), Lines{}) << "all fall on a slope";
  EXPECT_EQ(texts(scene_of("gravity = [0, 3]\n" + bodies + slope)).size(), 3u) << "but not on its underside";
}

TEST(SceneWarnings, AdviseStepsForFastBodies) {
  const auto with = [](const std::string& line) {
    return scene_of("gravity = [0, 0]\nstep_size = 0.01\nduration = 1\n[[bodies]]\nname = 'ball'\nshape = { disc = " +
                    line);
  };
  // Half the diagonal of its box is sqrt(2) r.
  EXPECT_EQ(texts(with("0.1 }\nmass = 1\nvelocity = [7, 0]")), Lines{});
  EXPECT_EQ(texts(with("0.1 }\nmass = 1\nvelocity = [0, 8]")),
            Lines{"ball goes far in one step of 0.01 s; step_size = 0.002 would follow it better"});
  EXPECT_EQ(texts(with("0.1 }\nmass = 1\nangular_velocity = 49")), Lines{});
  EXPECT_EQ(texts(with("0.1 }\nmass = 1\nangular_velocity = -500")),
            Lines{"ball goes far in one step of 0.01 s; step_size = 0.0002 would follow it better"});
  const std::string slow = "0.1 }\nkind = 'kinematic'\nmotion = [{ time = 1 }, { time = 2, position = [7, 0] }]";
  EXPECT_EQ(texts(with(slow)), Lines{});
  const std::string fast = "0.1 }\nkind = 'kinematic'\nmotion = [{ time = 1 }, { time = 2, position = [8, 0] }]";
  EXPECT_EQ(texts(with(fast)).size(), 1u);
}

TEST(SceneWarnings, SayWhatIsTooLong) {
  EXPECT_EQ(texts(scene_of("step_size = 1e-6\nduration = 1001")),
            Lines{"the duration of 1001 s takes 1.001e+09 steps of 1e-06 s; at most 1e+09 are made"});
}

}  // namespace
}  // namespace tumble
