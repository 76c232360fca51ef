#include "tumble/scene/scene_toml.hpp"

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "random_scene.hpp"
#include <gtest/gtest.h>

#include "tumble/scene/limits.hpp"

namespace tumble {
namespace {

std::string error_of(const std::string& text) {
  try {
    parse_scene(text, "s.toml");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

// A file with one body of these lines.
std::string with_body(const std::string& lines) { return "tumble = 1\n[[bodies]]\n" + lines; }

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(SceneToml, ReadsTheDocumentsDrop) {
  const Scene scene = parse_scene(R"(
    tumble = 1
    title = "drop"
    step_size = 0.01
    duration = 1.5
    [materials.wood]
    friction = 0.3
    restitution = 0.5
    [[bodies]]
    name = "ground"
    kind = "fixed"
    shape = { half_plane = [0, 1] }
    material = "wood"
    [[bodies]]
    name = "box"
    shape = { square = 0.2 }
    mass = 0.3
    position = [0, 1.5]
    angle = "30 deg"
    velocity = [0, -0.2]
    material = "wood")");
  ASSERT_EQ(scene.bodies.size(), 2u);
  const Body& box = scene.bodies[1];
  EXPECT_EQ(box.mass, 0.3);
  EXPECT_DOUBLE_EQ(box.moment_of_inertia, 0.3 * 0.04 / 6.0);
  EXPECT_EQ(box.pose.position, (Vector2{0.0, 1.5}));
  EXPECT_DOUBLE_EQ(box.pose.angle, 0.52359877559829887);
  EXPECT_EQ(box.velocity, (Vector3{0.0, -0.2, 0.0}));
  EXPECT_EQ(std::get<RoundedPolygon>(box.parts[0].shape).vertices, square(0.2).vertices);
  EXPECT_EQ(scene.materials[0].law, (ContactLaw{0.3, 0.3, 0.5}));
  EXPECT_EQ(scene.gravity, (Vector2{0.0, -9.81}));
  EXPECT_EQ(scene.step_size, 0.01);
}

TEST(SceneToml, MovesTheOriginToTheCentreOfMass) {
  const Body body = parse_scene(with_body("shape = { polygon = [[0, 0], [3, 0], [0, 3]] }\n"
                                          "density = 2\nposition = [1, 1]\nvelocity = [1, 0]\nangular_velocity = 5"))
                        .bodies[0];
  EXPECT_DOUBLE_EQ(body.mass, 9.0);
  EXPECT_DOUBLE_EQ(body.pose.position.x, 2.0);
  EXPECT_EQ(body.velocity, (Vector3{1.0, 0.0, 5.0})) << "that of the centre of mass";
  EXPECT_DOUBLE_EQ(std::get<RoundedPolygon>(body.parts[0].shape).vertices[0].x, -1.0);
  const Body off = parse_scene(with_body("shape = { square = 2 }\nmass = 3\nmoment_of_inertia = 4\n"
                                         "centre_of_mass = [0.5, 0]\nangle = \"90 deg\""))
                       .bodies[0];
  EXPECT_EQ(off.mass, 3.0);
  EXPECT_EQ(off.moment_of_inertia, 4.0);
  EXPECT_NEAR(off.pose.position.y, 0.5, 1e-16);
  EXPECT_EQ(std::get<RoundedPolygon>(off.parts[0].shape).vertices[0], (Vector2{-1.5, -1.0}));
}

TEST(SceneToml, CopiesInRowsAndColumns) {
  const Scene scene =
      parse_scene(with_body("name = \"b\"\nshape = { square = 0.25 }\ndensity = 1\n"
                            "copies = [{ count = 3, step = [0.5, 0] }, { count = 2, step = [0, 0.25] }]"));
  ASSERT_EQ(scene.bodies.size(), 6u);
  EXPECT_EQ(scene.bodies[0].name, "b1");
  EXPECT_EQ(scene.bodies[5].name, "b6");
  EXPECT_EQ(scene.bodies[4].pose.position, (Vector2{0.5, 0.25}));
}

TEST(SceneToml, KeepsTheOrderOfMaterialsInTheFile) {
  const Scene scene = parse_scene("tumble = 1\n[materials.zinc]\n[materials.\"a b\"]\nfriction = 0.1\n");
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[0].name, "zinc");
  EXPECT_EQ(scene.materials[1].law.static_friction, 0.1) << "that of friction where it is not given";
}

TEST(SceneToml, StartsAMovedBodyAtItsFirstKnot) {
  const Body body = parse_scene(with_body("kind = \"kinematic\"\nshape = { square = 1 }\n"
                                          "motion = [{ time = 1, position = [2, 0] }, { time = 2, angle = 1 }]"))
                        .bodies[0];
  EXPECT_EQ(body.pose.position, (Vector2{2.0, 0.0}));
  EXPECT_EQ(body.motion[1].pose.position, (Vector2{2.0, 0.0}));
  EXPECT_EQ(body.motion[1].pose.angle, 1.0);
}

TEST(SceneToml, NamesPlaceFieldAndWhatIsAllowed) {
  const std::string box = "shape = { square = 1 }\ndensity = 1\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "s.toml:1:1: must have the key 'tumble'"},
      {"tumble = 2", "s.toml:1:10: tumble: must be in [1, 1], got 2"},
      {"tumble = 1\ngravty = [0, -1]", "s.toml:2:1: 'gravty': unknown key; did you mean 'gravity'?"},
      {"tumble = 1\ngravity = 9.81", "s.toml:2:11: gravity: must be a list in brackets, got a number"},
      {"tumble = 1\ngravity = [0, \"x\"]", "s.toml:2:15: gravity[1]: must be a number, got a string"},
      {"tumble = 1\ngravity = [0, nan]",
       "s.toml:2:15: gravity[1]: must be in [-1000000000, 1000000000] m/s^2, got nan"},
      {"tumble = 1\nstep_size = 1979-05-27", "s.toml:2:13: step_size: must be a number, got a date or time"},
      {"tumble = 1\nstep_size = 0", "s.toml:2:13: step_size: must be in [1e-12, 1000000000000] s, got 0"},
      {"tumble = 1\n[materials.a]\nfriction = -1",
       "s.toml:3:12: materials.a.friction: must be in [0, 1000000], got -1"},
      {"tumble = 1\n[materials.a]\nfriction = 0.5\nstatic_friction = 0.4",
       "s.toml:2:1: materials.a.static_friction: must be >= friction, which is 0.5, got 0.4"},
      {"tumble = 1\n[materials.a]\nbounce = 0.5",
       "s.toml:3:1: materials.a.'bounce': unknown key; allowed are friction, static_friction, restitution"},
      {"tumble = 1\n[materials.wood]\n[[bodies]]\n" + box + "material = \"wod\"",
       "s.toml:6:12: bodies[0].material: must be the name of a material, got 'wod'; did you mean 'wood'?"},
      {"tumble = 1\n[materials.a]\n[[pairs]]\nmaterials = [\"a\", \"a\"]",
       "s.toml:4:19: pairs[0].materials[1]: must be another material than the first"},
      {with_body("shape = { square = 1 }"),
       "s.toml:2:1: bodies[0]: a dynamic body must have the key 'density' or the key 'mass'"},
      {with_body("density = 1"), "s.toml:2:1: bodies[0]: a body must have the key 'shape' or the key 'parts'"},
      {with_body("density = 1\nshape = { sqare = 1 }"),
       "s.toml:4:11: bodies[0].shape.'sqare': unknown key; did you mean 'square'?"},
      {with_body("density = 1\nshape = { square = 1, disc = 2 }"),
       "s.toml:4:30: bodies[0].shape.disc: must not stand beside square: a shape is one thing"},
      {with_body("density = 1\nshape = { disc = 1, rounding = 2 }"),
       "s.toml:4:32: bodies[0].shape.rounding: only square, rectangle, regular and polygon have one, got it for disc"},
      {with_body("density = 1\nshape = { square = 1, rounding = 2 }"),
       "s.toml:4:9: bodies[0].shape.rounding: must be in [0, 0.5] m, half of the shorter side, got 2"},
      {with_body("density = 1\nshape = { square = -1 }"),
       "s.toml:4:20: bodies[0].shape.square: must be in [1e-12, 1000000000000] m, got -1"},
      {with_body("density = 1\nshape = { polygon = [[0, 0], [2, 0], [1, 0.1], [0, 2]] }"),
       "s.toml:4:9: bodies[0].shape.vertices[2]: must be a convex corner, got a reflex one at (1, 0.1); write a "
       "concave "
       "shape as several convex parts"},
      {with_body("density = 1\nshape = { segment = [[0, 0], [2, 0]] }"),
       "s.toml:2:1: bodies[0]: parts[0].shape: must have an area to get a mass from a density, got one without"},
      {with_body("density = 1\nmass = 2\nshape = { square = 1 }"),
       "s.toml:4:8: bodies[0].mass: must not stand beside density, which gives it"},
      {with_body("kind = \"fixd\"\nshape = { square = 1 }"),
       "s.toml:3:8: bodies[0].kind: must be the kind of a body, got 'fixd'; did you mean 'fixed'?"},
      {with_body("kind = \"fixed\"\nmass = 1\nshape = { square = 1 }"),
       "s.toml:4:8: bodies[0].mass: only dynamic bodies have one, got it for a fixed one"},
      {with_body("density = 1\nshape = { half_plane = [0, 1] }"),
       "s.toml:2:1: bodies[0]: parts[0].shape: must have an area to get a mass from a density, got one without"},
      {with_body(box + "angle = \"30 degrees\""),
       "s.toml:5:9: bodies[0].angle: must be a number in rad or a string like \"30 deg\", got '30 degrees'"},
      {with_body(box + "angle = \"deg\""),
       "s.toml:5:9: bodies[0].angle: must be a number in rad or a string like \"30 deg\", got 'deg'"},
      {with_body(box + "wrenches = [{ time = 1 }, { time = 1 }]"),
       "s.toml:5:27: bodies[0].wrenches[1]: time: must be later than 1 s, that of the entry before, got 1"},
      {with_body(box + "name = \"a\"\n[[bodies]]\nname = \"a\"\n" + box),
       "s.toml:6:1: bodies[1]: name: must differ from those before, got 'a'"},
      {with_body(box + "copies = { count = 1000000, step = [1, 0] }"),
       "s.toml:5:20: bodies[0].copies.count: must be in [1, 100000], got 1000000"},
      {with_body(box + "copies = [{ count = 1000, step = [1, 0] }, { count = 1000, step = [1, 0] }]"),
       "s.toml:2:1: bodies[0]: a scene has at most 100000 bodies"},
      {with_body("density = 1\nshape = { regular = [1000, 1] }\ncopies = { count = 10000, step = [1, 0] }"),
       "s.toml:2:1: bodies[0]: a scene has at most 5000000 vertices, points, parts, knots and wrenches"},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(error_of(text), message) << text;
}

TEST(SceneToml, RefusesWhatIsNoToml) {
  // Each has its place and is one line.
  for (const std::string text : {"tumble = 1\n[//",
                                 "tumble = 1\n[&",
                                 "tumble = 1\n[[[",
                                 "[",
                                 "[[",
                                 "[[ \n",
                                 "tumble = 1\n[]",
                                 "tumble == 1",
                                 "tumble = 1\ntumble = 1",
                                 "tumble = \"",
                                 "tumble = '''",
                                 "\xEF\xBB\x9F-",
                                 "tumble = 1 \xEF\xBB\x9F",
                                 "tumble = 1\n\xC3\xA9 = 2",
                                 "# \xFF",
                                 "tumble = \xE3\x80\x81",
                                 "a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r.s.t = 1",
                                 "x = \"\\",
                                 "x = [1",
                                 "x = {",
                                 "x = [[[[",
                                 "x = 1e999",
                                 "\xEF\xBB\xBF\xEF\xBB\xBF",
                                 "a = \"\x01\"",
                                 "tumble = 1\r"}) {
    const std::string error = error_of(text);
    EXPECT_EQ(error.rfind("s.toml:", 0), 0u) << text << " -> " << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
  EXPECT_EQ(error_of("tumble = 1\ntitle = \"caf\xC3\xA9\" # \xC3\xA9 \xE2\x82\xAC\r\n"), "");
  EXPECT_EQ(error_of("tumble = 1\ntitle = \"\"\"a\\\n  b \xC3\xA9\"\"\"\n"), "") << "one line in two";
  EXPECT_EQ(
      error_of("\"tumble\" = 1\n[\"materials\" . 'x'] # ]\n\"friction\" = 0.1\nrestitution=0\n[[bodies]]\ndensity = 1\n"
               "parts = [ # [\n { shape = { square = 1 }, material = \"x\" }, { shape = { disc = 1 } }\n, ]\n"),
      "");
  EXPECT_EQ(error_of("\xEF\xBB\xBFtumble = 1"), "") << "a byte order mark";
  EXPECT_EQ(error_of("tumble = 1\ntitle = \"\"\"a\"\"\"\"\" # two quotes, then the end\n"), "");
  EXPECT_NE(error_of(std::string(100000, '[')), "");
  EXPECT_NE(error_of("x = " + std::string(100000, '[')), "");
  EXPECT_NE(error_of(std::string(k_max_scene_bytes + 1, '#')), "");
}

TEST(SceneToml, ReadsBackWhatItWritesBitForBit) {
  std::mt19937_64 random(20240611);
  for (int trial = 0; trial < 300; ++trial) {
    const Scene scene = random_scene(random);
    const std::string text = to_toml(scene);
    const Scene again = parse_scene(text);
    EXPECT_EQ(bits_of(again), bits_of(scene)) << text;
    EXPECT_EQ(to_toml(again), text);
  }
}

TEST(SceneToml, WritesTheMostBodiesThatItReads) {
  Scene scene =
      parse_scene(with_body("name = \"box\"\nshape = { square = 0.2 }\ndensity = 1\n"
                            "copies = [{ count = 1000, step = [0.3, 0] }, { count = 100, step = [0, 0.3] }]"));
  ASSERT_EQ(scene.bodies.size(), k_max_bodies);
  EXPECT_EQ(bits_of(parse_scene(to_toml(scene))), bits_of(scene));
}

TEST(SceneToml, RefusesToWriteWhatItWouldNotRead) {
  Scene scene;
  scene.duration = -1.0;
  EXPECT_THROW(to_toml(scene), std::invalid_argument);
}

TEST(SceneToml, EveryBlockOfTheFormatsPageIsAScene) {
  const std::string page = read(TUMBLE_SOURCE "/docs/scenes.md");
  int blocks = 0;
  for (std::size_t at = page.find("```toml\n"); at != std::string::npos; at = page.find("```toml\n", at)) {
    at += 8;
    const std::string text = page.substr(at, page.find("```", at) - at);
    EXPECT_EQ(error_of(text), "") << text;
    ++blocks;
  }
  EXPECT_GE(blocks, 6);
}

}  // namespace
}  // namespace tumble
