// The files of scenes/.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "random_scene.hpp"
#include <gtest/gtest.h>

#include "tumble/geometry/detect_contacts.hpp"
#include "tumble/scene/scene_toml.hpp"

namespace tumble {
namespace {

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::filesystem::path path_of(const std::string& name) {
  return std::filesystem::path(TUMBLE_SOURCE) / "scenes" / (name + ".toml");
}

Scene named(const std::string& name) { return parse_scene(read(path_of(name)), name + ".toml"); }

const Body& body_of(const Scene& scene, const std::string& name) {
  for (const Body& body : scene.bodies) {
    if (body.name == name) return body;
  }
  throw std::runtime_error("no body " + name);
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(TUMBLE_SOURCE) / "scenes")) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST(NamedScenes, AreReadAndWrittenAndSayWhatTheyShow) {
  EXPECT_GE(all_names().size(), 22u);
  for (const std::string& name : all_names()) {
    const std::string text = read(path_of(name));
    EXPECT_EQ(text.rfind("# ", 0), 0u) << name;
    EXPECT_NE(text.find("\n# Expect: "), std::string::npos) << name;
    Scene scene;
    ASSERT_NO_THROW(scene = named(name)) << name;
    EXPECT_FALSE(scene.title.empty()) << name;
    EXPECT_EQ(bits_of(parse_scene(to_toml(scene))), bits_of(scene)) << name;
  }
}

// On a slope the corners lie on its side exactly, but its normal (0.6, 0.8) is rounded and so is the gap, of size 0.2.
constexpr double k_gap_rounding = 1e-16;  // [m]

// The least gap at the start between bodies of which one is dynamic, among those nearer than 1 mm.
double least_gap(const Scene& scene) {
  std::vector<Pose> poses;
  for (const Body& body : scene.bodies) poses.push_back(body.pose);
  ContactFinder finder(scene);
  double least = 1e-3;
  for (const Contact& contact : finder.find(poses, std::vector<double>(scene.bodies.size(), 0.5e-3))) {
    least = std::min(least, contact.gap);
  }
  return least;
}

TEST(NamedScenes, DoNotOverlapAtTheStart) {
  for (const std::string& name : all_names()) {
    // Ellipses and terrain have no contacts yet.
    EXPECT_GE(least_gap(named(name)), -k_gap_rounding) << name;
  }
}

TEST(NamedScenes, StandWithoutGapWhereTheyStartAtRest) {
  for (const char* name :
       {"stack", "stack_heavy_top", "pyramid", "dominoes", "wedge", "tip_or_slide", "conveyor", "tilting_table",
        "pusher", "rocking_block", "painleve_rod", "backspin", "compound", "wall_and_ball"}) {
    EXPECT_EQ(least_gap(named(name)), 0.0) << name;
  }
  for (const char* name : {"slope_stick", "slope_slide"}) {
    EXPECT_LE(std::abs(least_gap(named(name))), k_gap_rounding) << name;
  }
}

TEST(NamedScenes, HaveTheNumbersOfTheirComments) {
  EXPECT_DOUBLE_EQ(body_of(named("drop"), "square").moment_of_inertia, 0.002);
  EXPECT_EQ(body_of(named("stack"), "box10").pose.position, (Vector2{0.0, 2.375}));
  double pyramid = 0.0;
  for (const Body& body : named("pyramid").bodies) pyramid += body.mass;
  EXPECT_EQ(pyramid, 21.0);
  const Scene rod = named("painleve_rod");
  const Body& body = body_of(rod, "rod");
  const Vector2 lower_end = std::get<RoundedPolygon>(body.parts[0].shape).vertices[0];
  EXPECT_EQ(point_to_world(frame_of(body.pose), lower_end), Vector2{});
  EXPECT_EQ(contact_law(named("bouncing_balls"), 0, 3).restitution, 0.5);
}

}  // namespace
}  // namespace tumble
