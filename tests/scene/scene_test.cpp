#include "tumble/scene/scene.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace tumble {
namespace {

std::string error_of(const Scene& scene) {
  try {
    validate(scene);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

Body box() {
  Body body;
  body.name = "box";
  body.parts = {{square(0.2)}};
  body.mass = 0.3;
  body.moment_of_inertia = 0.002;
  return body;
}

Scene two_bodies() {
  Scene scene;
  scene.materials = {{"wood", {0.5, 0.6, 0.2}}, {"ice", {0.02, 0.03, 0.8}}};
  scene.pairs = {{1, 0, {0.1, 0.1, 0.0}}};
  Body ground;
  ground.name = "ground";
  ground.kind = BodyKind::fixed;
  ground.parts = {{HalfPlane{{0.0, 1.0}, 0.0}}};
  scene.bodies = {ground, box()};
  return scene;
}

std::string error_after(const std::function<void(Scene&)>& change) {
  Scene scene = two_bodies();
  change(scene);
  return error_of(scene);
}

TEST(Scene, MixesLawsByTheirGeometricMeansOrByTheirPair) {
  Scene scene = two_bodies();
  EXPECT_EQ(contact_law(scene, 0, 0), scene.materials[0].law);
  EXPECT_EQ(contact_law(scene, 0, 1), scene.pairs[0].law);
  EXPECT_EQ(contact_law(scene, 1, 0), scene.pairs[0].law);
  scene.pairs.clear();
  const ContactLaw mixed = contact_law(scene, 0, 1);
  EXPECT_DOUBLE_EQ(mixed.friction, 0.1);
  EXPECT_DOUBLE_EQ(mixed.restitution, 0.4);
  EXPECT_EQ(mixed, contact_law(scene, 1, 0));
}

TEST(Scene, NamesWhatIsWrong) {
  EXPECT_EQ(error_of(two_bodies()), "");
  EXPECT_EQ(error_of(Scene{}), "");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_after([](Scene& s) { s.bodies[1].mass = 0.0; }),
            "bodies[1] 'box': mass: must be in [1e-60, 1e+60] kg, got 0");
  EXPECT_EQ(error_after([&](Scene& s) { s.bodies[1].pose.position.y = nan; }),
            "bodies[1] 'box': pose.position.y: must be in [-1000000000000, 1000000000000] m, got nan");
  EXPECT_EQ(error_after([](Scene& s) { s.bodies[1].parts[0].material = 2; }),
            "bodies[1] 'box': parts[0].material: must be an index of one of the 2 materials, got 2");
  EXPECT_EQ(error_after([](Scene& s) {
              s.bodies[1].parts[0].shape = HalfPlane{{0.0, 1.0}, 0.0};
            }),
            "bodies[1] 'box': parts[0].shape: a half-plane must belong to a fixed body, got a dynamic one");
  EXPECT_EQ(error_after([](Scene& s) {
              s.bodies[1].parts[0].shape = Terrain{{{0, 0}, {1, 0}}};
            }),
            "bodies[1] 'box': parts[0].shape: terrain must belong to a fixed or kinematic body, got a dynamic one");
  EXPECT_EQ(error_after([](Scene& s) {
              s.bodies[1].parts[0].shape = RoundedPolygon{{{0, 0}, {0, 1}, {1, 0}}, 0.0};
            }),
            "bodies[1] 'box': parts[0].shape.vertices: must run counter-clockwise, got clockwise; write them in the "
            "opposite order");
  EXPECT_EQ(error_after([](Scene& s) {
              s.bodies[1].wrenches = {{1.0, {}, 0.0}, {1.0, {}, 0.0}};
            }),
            "bodies[1] 'box': wrenches[1].time: must be later than 1 s, that of the entry before, got 1");
  EXPECT_EQ(error_after([](Scene& s) { s.bodies[0].mass = 1.0; }),
            "bodies[0] 'ground': mass: only dynamic bodies have one, got it for a fixed one");
  EXPECT_EQ(error_after([](Scene& s) {
              s.bodies[0].velocity = {1.0, 0.0, 0.0};
            }),
            "bodies[0] 'ground': velocity: must be 0 for a fixed body");
  EXPECT_EQ(error_after([](Scene& s) {
              s.bodies[1].motion = {{0.0, {}}};
            }),
            "bodies[1] 'box': motion: only kinematic bodies have one, got it for a dynamic one");
  EXPECT_EQ(error_after([](Scene& s) { s.bodies[1].name = "ground"; }),
            "bodies[1].name: must differ from that of bodies[0], got 'ground' twice");
  EXPECT_EQ(error_after([](Scene& s) { s.bodies[1].name = "a\nb"; }),
            "bodies[1]: name: must be UTF-8 without control characters");
  EXPECT_EQ(error_after([](Scene& s) { s.bodies[1].parts.clear(); }),
            "bodies[1] 'box': parts: must have 1 to 1000 entries, got 0");
  EXPECT_EQ(error_after([](Scene& s) { s.materials[1].law.static_friction = 0.01; }),
            "materials[1].static_friction: must be >= friction, which is 0.02, got 0.01");
  EXPECT_EQ(error_after([](Scene& s) { s.materials[1].law.restitution = 1.1; }),
            "materials[1].restitution: must be in [0, 1], got 1.1");
  EXPECT_EQ(error_after([](Scene& s) { s.materials[1].name = "wood"; }),
            "materials[1].name: must differ from that of materials[0], got 'wood' twice");
  EXPECT_EQ(error_after([](Scene& s) {
              s.pairs.push_back({0, 1, {}});
            }),
            "pairs: must name two materials once, got 'wood' and 'ice' twice");
  EXPECT_EQ(error_after([](Scene& s) { s.pairs[0].a = 0; }),
            "pairs[0].b: must be another material than a, got 0 twice");
  EXPECT_EQ(error_after([](Scene& s) { s.step_size = 0.0; }), "step_size: must be in [1e-12, 1000000000000] s, got 0");
  EXPECT_NE(error_after([&](Scene& s) { s.gravity.x = nan; }), "");
  EXPECT_NE(error_after([&](Scene& s) { s.duration = nan; }), "");
  EXPECT_NE(error_after([&](Scene& s) { s.bodies[1].velocity[2] = nan; }), "");
  EXPECT_NE(error_after([&](Scene& s) { s.bodies[1].linear_damping = -1.0; }), "");
  EXPECT_NE(error_after([&](Scene& s) { s.bodies[1].wrenches = {{0.0, {nan, 0.0}, 0.0}}; }), "");
}

TEST(Scene, HoldsKinematicBodiesToTheirKnots) {
  const auto error_with = [](const std::function<void(Body&)>& change) {
    Scene scene = two_bodies();
    Body pusher;
    pusher.name = "pusher";
    pusher.kind = BodyKind::kinematic;
    pusher.parts = {{square(0.1)}};
    pusher.pose = {{1.0, 0.0}, 0.0};
    pusher.motion = {{0.0, pusher.pose}, {2.0, {{0.0, 0.0}, 0.0}}};
    change(pusher);
    scene.bodies.push_back(pusher);
    return error_of(scene);
  };
  EXPECT_EQ(error_with([](Body&) {}), "");
  EXPECT_EQ(error_with([](Body& b) { b.velocity[0] = 1.0; }),
            "bodies[2] 'pusher': velocity: must be 0 for a body with motion, whose knots give it");
  EXPECT_EQ(
      error_with([](Body& b) { b.pose.position.x = 2.0; }),
      "bodies[2] 'pusher': motion[0]: must be at the pose of the body, (2, 0) m and 0 rad, got (1, 0) m and 0 rad");
  EXPECT_NE(error_with([](Body& b) { b.motion[0].time = -1.0; }), "");
}

TEST(Scene, CountsUtf8AsText) {
  const auto is_name = [](const std::string& name) {
    return error_after([&](Scene& s) { s.bodies[1].name = name; }).empty();
  };
  EXPECT_TRUE(is_name("b\xC3\xBCrste \xE2\x82\xAC \xF0\x9F\x98\x80"));
  EXPECT_FALSE(is_name("\xC3"));
  EXPECT_FALSE(is_name("\xC0\xAF")) << "two bytes for what takes one";
  EXPECT_FALSE(is_name("\xED\xA0\x80")) << "half of a pair of UTF-16";
  EXPECT_FALSE(is_name("\xF4\x90\x80\x80")) << "beyond the last code";
  EXPECT_FALSE(is_name("\xC2\x9B")) << "a control character that terminals act on";
  EXPECT_FALSE(is_name(std::string("a\0b", 3)));
  EXPECT_FALSE(is_name(std::string(101, 'a')));
}

TEST(Scene, MassOfPartsIsThatOfTheWhole) {
  // Two rectangles side by side are one of the double width.
  std::vector<Part> halves = {{moved(rectangle(1.0, 0.5), {{0.5, 0.0}, 0.0})},
                              {moved(rectangle(1.0, 0.5), {{-0.5, 0.0}, 0.0})}};
  const MassProperties sum = mass_properties(halves, 3.0);
  const MassProperties whole = mass_properties({{rectangle(2.0, 0.5)}}, 3.0);
  EXPECT_EQ(sum.centre_of_mass, Vector2{});
  EXPECT_DOUBLE_EQ(sum.mass, 3.0);
  EXPECT_DOUBLE_EQ(sum.mass, whole.mass);
  EXPECT_DOUBLE_EQ(sum.moment_of_inertia, whole.moment_of_inertia);
  EXPECT_DOUBLE_EQ(whole.moment_of_inertia, 3.0 * 4.25 / 12.0);
  EXPECT_THROW(mass_properties({{segment({0, 0}, {1, 0})}}, 1.0), std::invalid_argument);
  EXPECT_THROW(mass_properties(halves, 0.0), std::invalid_argument);
  EXPECT_THROW(mass_properties({}, 1.0), std::invalid_argument);
}

TEST(Scene, MovingTheOriginMovesNothingInTheWorld) {
  Body body = box();
  body.parts.push_back({ellipse(0.3, 0.1), 0, 0.0});
  body.pose = {{1.0, 2.0}, 0.7};
  body.velocity = {0.1, 0.2, 3.0};
  Body moved_body = body;
  const Vector2 origin{0.3, -0.4};
  move_origin(moved_body, origin);
  const Frame before = frame_of(body.pose);
  const Frame after = frame_of(moved_body.pose);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2 a = point_to_world(before, std::get<RoundedPolygon>(body.parts[0].shape).vertices[i]);
    const Vector2 b = point_to_world(after, std::get<RoundedPolygon>(moved_body.parts[0].shape).vertices[i]);
    EXPECT_NEAR(a.x, b.x, 1e-15);
    EXPECT_NEAR(a.y, b.y, 1e-15);
  }
  const Vector2 centre = point_to_world(after, std::get<Ellipse>(moved_body.parts[1].shape).pose.position);
  EXPECT_NEAR(centre.x, 1.0, 1e-15);
  EXPECT_NEAR(centre.y, 2.0, 1e-15);
  // v' = v + omega x r
  const Vector2 arm = direction_to_world(before, origin);
  EXPECT_DOUBLE_EQ(moved_body.velocity[0], 0.1 - 3.0 * arm.y);
  EXPECT_DOUBLE_EQ(moved_body.velocity[1], 0.2 + 3.0 * arm.x);
}

TEST(Scene, DensityPutsTheOriginAtTheCentreOfMass) {
  Body body;
  body.parts = {{moved(square(0.2), {{0.1, 0.1}, 0.0})}};
  set_density(body, 7.5);
  EXPECT_DOUBLE_EQ(body.mass, 0.3);
  EXPECT_DOUBLE_EQ(body.moment_of_inertia, 0.3 * 0.04 / 6.0);
  EXPECT_EQ(body.pose.position, (Vector2{0.1, 0.1}));
  EXPECT_NEAR(std::get<RoundedPolygon>(body.parts[0].shape).vertices[0].x, -0.1, 1e-16);
  Body triangle;
  triangle.parts = {{regular_polygon(3, 0.1)}};
  set_density(triangle, 1.0);
  EXPECT_EQ(triangle.pose.position, Vector2{}) << "rounding of its own sum moves no body";
}

TEST(Scene, MassIsSpreadEvenly) {
  Body body;
  body.parts = {{moved(square(0.2), {{0.1, 0.1}, 0.0})}};
  Body filled = body;
  set_mass(body, 0.3);
  set_density(filled, 7.5);
  EXPECT_EQ(body.mass, 0.3);
  EXPECT_DOUBLE_EQ(body.moment_of_inertia, filled.moment_of_inertia);
  EXPECT_EQ(body.pose, filled.pose);
  EXPECT_THROW(set_mass(body, 0.0), std::invalid_argument);
}

TEST(Scene, EqualsWhatHoldsTheSame) {
  const Scene scene = two_bodies();
  EXPECT_EQ(scene, two_bodies());
  const auto after = [&](auto change) {
    Scene other = scene;
    change(other);
    return other;
  };
  EXPECT_NE(scene, after([](Scene& s) { s.bodies[1].pose.angle = 1e-300; }));
  EXPECT_NE(scene, after([](Scene& s) { std::get<RoundedPolygon>(s.bodies[1].parts[0].shape).rounding = 0.1; }));
  EXPECT_NE(scene, after([](Scene& s) { s.pairs[0].law.friction = 0.2; }));
  EXPECT_NE(scene, after([](Scene& s) { s.bodies[1].wrenches = {{}}; }));
}

TEST(Scene, KindsHaveNames) {
  EXPECT_EQ(to_string(BodyKind::dynamic), "dynamic");
  EXPECT_EQ(to_string(BodyKind::kinematic), "kinematic");
  EXPECT_EQ(to_string(BodyKind::fixed), "fixed");
}

TEST(Scene, LabelsItsBodiesDifferently) {
  Scene scene;
  scene.bodies.resize(5);
  scene.bodies[0].name = "a";
  scene.bodies[3].name = "body2";
  scene.bodies[4].name = "body2_";
  EXPECT_EQ(body_labels(scene), (std::vector<std::string>{"a", "body1", "body2__", "body2", "body2_"}));
}

}  // namespace
}  // namespace tumble
