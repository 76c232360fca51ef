// The files of scenes/.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "random_scene.hpp"
#include <gtest/gtest.h>

#include "tumble/scene/scene_toml.hpp"

namespace tumble {
namespace {

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Scene named(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(TUMBLE_SOURCE) / "scenes" / (name + ".toml");
  return parse_scene(read(path), path.string());
}

const Body& body_of(const Scene& scene, const std::string& name) {
  for (const Body& body : scene.bodies) {
    if (body.name == name) return body;
  }
  throw std::runtime_error("no body " + name);
}

TEST(NamedScenes, AreReadAndWrittenAndSayWhatTheyShow) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(TUMBLE_SOURCE) / "scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string text = read(entry.path());
    EXPECT_EQ(text.rfind("# ", 0), 0u) << entry.path();
    EXPECT_NE(text.find("\n# Expect: "), std::string::npos) << entry.path();
    Scene scene;
    ASSERT_NO_THROW(scene = parse_scene(text, entry.path().string())) << entry.path();
    EXPECT_FALSE(scene.title.empty()) << entry.path();
    EXPECT_EQ(bits_of(parse_scene(to_toml(scene))), bits_of(scene)) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 22);
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
