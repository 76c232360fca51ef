// Pictures of scenes with all kinds of bodies; picture_test.cpp has those of the drop.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "record_samples.hpp"

#include "tumble/output/animation.hpp"
#include "tumble/output/draw_bodies.hpp"
#include "tumble/output/gif.hpp"
#include "tumble/output/impulses.hpp"
#include "tumble/output/outline.hpp"
#include "tumble/output/strobe.hpp"
#include "tumble/scene/scene_toml.hpp"
#include "tumble/trajectory/simulate.hpp"

namespace tumble::output {
namespace {

using test::has;

Trajectory run(const std::string& text) { return simulate(parse_scene("tumble = 1\n" + text)); }

constexpr const char* k_all_shapes = R"(
  duration = 0.2
  bodies = [
    { kind = "fixed", shape = { half_plane = [0, 1] }, surface_speed = 1 },
    { kind = "fixed", shape = { terrain = [[-4, 1], [-3, 0], [-2, -0.5], [3, 1]] } },
    { kind = "fixed", shape = { rectangle = [1, 0.2], rounding = 0.1 }, position = [0, 1], surface_speed = -2 },
    { kind = "fixed", shape = { segment = [[2, 0], [2, 3]] } },
    { kind = "kinematic", shape = { square = 0.3 }, position = [-1, 2], angular_velocity = 3 },
    { shape = { regular = [5, 0.2] }, mass = 1, position = [0, 3] },
    { shape = { disc = 0.2 }, mass = 1, position = [0.5, 3] },
    { shape = { ellipse = [0.3, 0.1] }, mass = 1, position = [1, 3] },
    { shape = { capsule = [0.3, 0.1] }, mass = 1, position = [1.5, 3] },
    { shape = { regular = [3, 0.2], rounding = 0.05 }, mass = 1, position = [-0.5, 3] },
    { shape = { segment = [[-0.2, 0], [0.2, 0]] }, mass = 1, moment_of_inertia = 1, centre_of_mass = [0, 0], position = [-1, 3] },
    { parts = [{ shape = { square = 0.2 } }, { shape = { disc = 0.2 }, position = [0.2, 0] }], mass = 1, position = [-1.5, 3] },
  ])";

TEST(ScenePicture, ShowsEveryShape) {
  const Trajectory trajectory = run(k_all_shapes);
  EXPECT_TRUE(to_strobe_png(trajectory).starts_with("\x89PNG"));
  const std::string svg = to_strobe_svg(trajectory);
  EXPECT_TRUE(has(svg, "</svg>"));
  EXPECT_FALSE(has(svg, "nan") || has(svg, "inf"));
  EXPECT_TRUE(to_gif(trajectory, 320, 200).starts_with("GIF89a"));
  EXPECT_TRUE(to_strobe_png(trajectory) == to_strobe_png(trajectory)) << "the same bytes";
}

TEST(ScenePicture, OfScenesWithoutBodiesOrMotion) {
  for (const char* text : {"", "bodies = [{ kind = 'fixed', shape = { half_plane = [3, 4] } }]",
                           "bodies = [{ kind = 'fixed', shape = { disc = 1e9 }, position = [0, -1e9] }]",
                           "bodies = [{ kind = 'kinematic', shape = { disc = 1e-9 } }]",
                           "bodies = [{ kind = 'kinematic', shape = { disc = 1e-12 }, position = [1e12, 1e12] }]"}) {
    const Trajectory trajectory = run(std::string("duration = 0.01\n") + text);
    EXPECT_TRUE(to_strobe_png(trajectory).starts_with("\x89PNG")) << text;
    EXPECT_TRUE(to_gif(trajectory, 160, 160).starts_with("GIF89a")) << text;
  }
}

TEST(ScenePicture, OfBodiesBesideHugeOnesIsQuick) {
  const Trajectory trajectory = run(R"(duration = 0.01
    bodies = [
      { kind = "fixed", shape = { rectangle = [1e12, 1e12] }, position = [0, -5e11], surface_speed = 1 },
      { kind = "fixed", shape = { terrain = [[-1e12, 1], [1e12, 1]] }, surface_speed = 1e9 },
      { shape = { disc = 0.1 }, mass = 1, position = [0, 2] },
    ])");
  const std::string svg = to_strobe_svg(trajectory);
  EXPECT_LT(svg.size(), 500'000u);
  EXPECT_FALSE(has(svg, "nan") || has(svg, "inf"));
}

Body body_of(const std::string& shape) {
  const std::string extra = "mass = 1, moment_of_inertia = 1, centre_of_mass = [0, 0]";
  return parse_scene("tumble = 1\nbodies = [{ shape = " + shape + ", " + extra + " }]").bodies[0];
}

constexpr View k_view = {{0.0, 0.0, 400.0, 300.0}, {0.0, 0.0}, 100.0};

// The area that the points enclose [px^2].
double area_of(const std::vector<Vector2>& points) {
  double area = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) area += 0.5 * cross(points[i], points[(i + 1) % points.size()]);
  return area;
}

TEST(Outline, EnclosesTheAreaOfTheShape) {
  for (const char* shape : {"{ disc = 0.5 }", "{ ellipse = [0.5, 0.2] }", "{ capsule = [0.4, 0.1] }",
                            "{ square = 0.3 }", "{ regular = [7, 0.4], rounding = 0.1 }"}) {
    const Body body = body_of(shape);
    const BodyOutline outline = outline_of(body, k_view);
    const double area = 100.0 * 100.0 * area_moments(body.parts[0].shape).area;
    // Chords are at most 0.06 px inside of arcs, which are at most 314 px long.
    EXPECT_NEAR(area_of(outline.parts[0].points), area, 0.06 * 315.0) << shape;
    EXPECT_LE(area_of(outline.parts[0].points), area * (1.0 + 1e-12)) << shape;
    EXPECT_GT(length(outline.mark.to - outline.mark.from) + outline.mark.radius, 1.0) << "a mark shows rotation";
  }
}

TEST(Outline, OfAHalfPlaneRunsAlongItsBoundaryThroughTheView) {
  const Scene scene = parse_scene(R"(tumble = 1
    bodies = [{ kind = "fixed", shape = { half_plane = [3, 4], offset = 1 }, position = [0.5, 0], angle = 0.3 }])");
  const Body& body = scene.bodies[0];
  const BodyOutline outline = outline_of(body, k_view);
  const auto& plane = std::get<HalfPlane>(body.parts[0].shape);
  ASSERT_EQ(outline.parts[0].kind, LineKind::ground);
  for (const Vector2 point : outline.parts[0].points) EXPECT_NEAR(dot(plane.normal, point), 100.0, 1e-9);
  // Solid is on the right side of the way.
  const Vector2 way = outline.parts[0].points[1] - outline.parts[0].points[0];
  EXPECT_LT(dot(plane.normal, turned_right(way)), 0.0);
}

TEST(Outline, IsCutAtTheEdgeOfAnArea) {
  const Area area{0.0, 0.0, 10.0, 10.0};
  const std::vector<Point> cut = clipped({{-1e9, 5.0}, {5.0, -1e9}, {1e9, 5.0}, {5.0, 1e9}}, area);
  for (const Point point : cut) {
    EXPECT_TRUE(point.x >= -1e-6 && point.x <= 10.0 + 1e-6 && point.y >= -1e-6 && point.y <= 10.0 + 1e-6);
  }
  EXPECT_TRUE(clipped({{20.0, 20.0}, {30.0, 20.0}, {25.0, 30.0}}, area).empty());
  Point a{-10.0, 0.0}, b{30.0, 20.0};
  ASSERT_TRUE(clip_line(a, b, area));
  EXPECT_NEAR(a.x, 0.0, 1e-12);
  EXPECT_NEAR(a.y, 5.0, 1e-12);
  EXPECT_NEAR(b.x, 10.0, 1e-12);
  EXPECT_NEAR(b.y, 10.0, 1e-12);
  Point c{-10.0, 0.0}, d{10.0, 30.0};
  EXPECT_FALSE(clip_line(c, d, area));
}

TEST(Sight, HoldsTheMotionAndWhatIsFixedNearIt) {
  const Sight sight = sight_of(run(R"(duration = 1
    gravity = [0, 0]
    bodies = [
      { kind = "fixed", shape = { rectangle = [100, 1] }, position = [0, -1.5] },
      { kind = "fixed", shape = { disc = 1 }, position = [0, 50] },
      { kind = "fixed", shape = { half_plane = [-1, 0], offset = -7 } },
      { shape = { rectangle = [1, 2] }, mass = 1, velocity = [4, 0] },
    ])"));
  EXPECT_NEAR(sight.box.low.y, -2.0, 1e-9) << "the belt below is near";
  EXPECT_NEAR(sight.box.high.y, 1.0, 1e-9) << "the disc is not";
  EXPECT_NEAR(sight.box.high.x, 7.0, 1e-9) << "up to the wall";
  EXPECT_NEAR(sight.box.low.x, -0.5 - 0.3 * 5.0, 1e-9) << "of the belt a piece to the left";
  EXPECT_FALSE(sight.has_ground);
}

TEST(Sight, LeavesOutTheFewThatGoFar) {
  const char* crowd = R"(duration = 1
    gravity = [0, 0]
    [[bodies]]
    shape = { disc = 0.5 }
    mass = 1
    copies = { count = 30, step = [2, 0] }
    [[bodies]]
    shape = { disc = 0.5 }
    mass = 1
    position = [0, 3]
    velocity = [0, 1000]
  )";
  const Sight sight = sight_of(run(crowd));
  EXPECT_NEAR(sight.box.low.x, -0.5, 1e-9);
  EXPECT_NEAR(sight.box.high.x, 58.5, 1e-9);
  EXPECT_LT(sight.box.high.y, 60.0);
}

TEST(ScenePicture, ConveyorsRun) {
  const auto picture_at = [](const std::string& speed, int frame) {
    const Trajectory trajectory = run(
        "duration = 1\nbodies = [{ kind = 'fixed', shape = { rectangle = [4, 1] }, surface_speed = " + speed + " }]");
    Animation animation(trajectory, 320, 200, 1.0, k_max_gif_frames);
    std::vector<std::uint32_t> pixels;
    for (int i = 0; i <= frame; ++i) pixels = animation.draw(i);
    for (std::size_t row = 0; row < 200; ++row) {  // without the words at the right
      std::fill_n(pixels.begin() + static_cast<std::ptrdiff_t>(320 * row + 230), 90, 0u);
    }
    return pixels;
  };
  EXPECT_EQ(picture_at("0", 0), picture_at("0", 7));
  EXPECT_NE(picture_at("1", 0), picture_at("1", 7));
  EXPECT_NE(picture_at("1", 0), picture_at("-1", 0)) << "chevrons point along the motion";
}

TEST(Impulses, ActOnTheDynamicBody) {
  const char* order[] = {"{ kind = 'fixed', shape = { half_plane = [0, 1] } }",
                         "{ shape = { disc = 0.25 }, mass = 2, position = [0, 0.25] }"};
  for (const bool floor_first : {true, false}) {
    const Trajectory trajectory = run(std::string("gravity = [0, -8]\nstep_size = 0.125\nduration = 0.5\nbodies = [") +
                                      order[floor_first ? 0 : 1] + ", " + order[floor_first ? 1 : 0] + "]");
    const std::vector<Impulse> impulses = largest_of_each_touch(trajectory);
    ASSERT_EQ(impulses.size(), 1u) << "one touch of four steps";
    EXPECT_EQ(impulses[0].step, 4) << "of equal ones the last";
    EXPECT_EQ(impulses[0].normal, (Vector2{0.0, 1.0}));
    EXPECT_EQ(impulses[0].along_normal, 2.0);
    EXPECT_EQ(impulses_at_end(trajectory).size(), 1u);
  }
}

TEST(Impulses, AreCountedTouchByTouch) {
  const Trajectory trajectory = run(R"(duration = 1.5
    materials.default.restitution = 0.5
    bodies = [
      { kind = "fixed", shape = { half_plane = [0, 1] } },
      { shape = { disc = 0.1 }, mass = 1, position = [0, 1.1] },
    ])");
  const std::vector<Impulse> touches = largest_of_each_touch(trajectory);
  ASSERT_GT(touches.size(), 4u);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_NEAR(touches[i].size / touches[i - 1].size, 0.5, 0.02) << "each bounce half as strong as the one before";
  }
}

TEST(BodyColours, AreThoseOfTheKind) {
  const Trajectory trajectory = run(R"(duration = 0.01
    [[bodies]]
    name = "box"
    shape = { square = 1 }
    mass = 1
    copies = { count = 2, step = [2, 0] }
    [[bodies]]
    name = "ball"
    shape = { disc = 1 }
    mass = 1
    position = [0, 5]
  )");
  const std::vector<BodyColours> colours = body_colours(trajectory.scene);
  EXPECT_EQ(colours[0].fill.red, colours[1].fill.red);
  EXPECT_NE(colours[0].fill.red, colours[2].fill.red);
}

}  // namespace
}  // namespace tumble::output
