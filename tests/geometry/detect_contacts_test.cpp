#include "tumble/geometry/detect_contacts.hpp"

#include "../allocations.hpp"
#include "shapes_at_random.hpp"

namespace tumble::test {
namespace {

Scene random_scene(std::mt19937& random, int bodies) {
  Scene scene;
  scene.materials.push_back({});
  for (int i = 0; i < bodies; ++i) {
    Body body;
    body.kind = random() % 5 ? BodyKind::dynamic : BodyKind::fixed;
    const int parts = 1 + static_cast<int>(random() % 2);
    for (int k = 0; k < parts; ++k) {
      body.parts.push_back({random() % 3 ? Shape(random_polygon(random)) : Shape(random_ellipse(random))});
    }
    if (i % 10 == 3) {
      body.kind = BodyKind::fixed;
      body.parts = {{HalfPlane{{0, 1}, -2}}, {Terrain{{{-3, 0}, {0, -1}, {3, 0}}}}};
    }
    body.pose = {{0, 0}, 0};
    scene.bodies.push_back(body);
  }
  return scene;
}

std::vector<Contact> brute_force(const Scene& scene, const std::vector<Pose>& poses, const std::vector<double>& reach) {
  std::vector<Contact> contacts;
  const int n = static_cast<int>(scene.bodies.size());
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      const Body &body_a = scene.bodies[a], &body_b = scene.bodies[b];
      if (body_a.kind != BodyKind::dynamic && body_b.kind != BodyKind::dynamic) continue;
      for (int i = 0; i < static_cast<int>(body_a.parts.size()); ++i) {
        for (int k = 0; k < static_cast<int>(body_b.parts.size()); ++k) {
          for (const ContactPoint& c : contacts_of(body_a.parts[i].shape, frame_of(poses[a]), body_b.parts[k].shape,
                                                   frame_of(poses[b]), reach[a] + reach[b])) {
            contacts.push_back({c, a, b, i, k});
          }
        }
      }
    }
  }
  return contacts;
}

bool same(const Contact& c, const Contact& d) {
  return c.normal == d.normal && c.point_a == d.point_a && c.point_b == d.point_b && c.gap == d.gap &&
         c.feature == d.feature && c.body_a == d.body_a && c.body_b == d.body_b && c.part_a == d.part_a &&
         c.part_b == d.part_b;
}

// Also that neither the frames before nor the finder's age change a bit.
TEST(DetectContacts, FindsWhatABruteForceFinds) {
  std::mt19937 random(1);
  std::size_t seen = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Scene scene = random_scene(random, 40);
    ContactFinder finder(scene);
    for (int call = 0; call < 5; ++call) {
      std::vector<Pose> poses;
      std::vector<double> reach;
      for (const Body& body : scene.bodies) {
        poses.push_back(body.kind == BodyKind::fixed && call > 1 ? Pose{{1, 1}, 0} : random_pose(random, 4.0));
        reach.push_back(0.05 * static_cast<double>(random() % 3));
      }
      const std::vector<Contact>& found = finder.find(poses, reach);
      const std::vector<Contact> expected = brute_force(scene, poses, reach);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_TRUE(same(found[i], expected[i])) << i;
      seen += found.size();
    }
  }
  EXPECT_GT(seen, 1000u);
}

// The boxes of one call serve the next ones for as long as bodies stay near: none may be missed as they move on.
TEST(DetectContacts, FindsTheSameWhileBodiesMoveOn) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::size_t seen = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const Scene scene = random_scene(random, 40);
    ContactFinder finder(scene);
    std::vector<Pose> poses;
    std::vector<double> reach;
    std::vector<Vector3> velocity;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      poses.push_back(random_pose(random, 5.0));
      reach.push_back(0.02 * static_cast<double>(random() % 3));
      const double speed = i % 3 == 0 ? 0.0 : 0.02;
      velocity.push_back({speed * unit(random), speed * unit(random), speed * unit(random)});
    }
    for (int call = 0; call < 40; ++call) {
      const std::vector<Contact>& found = finder.find(poses, reach);
      const std::vector<Contact> expected = brute_force(scene, poses, reach);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_TRUE(same(found[i], expected[i])) << i;
      seen += found.size();
      for (std::size_t i = 0; i < poses.size(); ++i) {
        poses[i].position = poses[i].position + Vector2{velocity[i][0], velocity[i][1]};
        poses[i].angle += velocity[i][2];
      }
    }
  }
  EXPECT_GT(seen, 1000u);
}

TEST(DetectContacts, TakesNothingFromTheHeapOnceWarm) {
  if (!counts_allocations()) GTEST_SKIP() << "allocations are not counted in this build";
  std::mt19937 random(2);
  const Scene scene = random_scene(random, 40);
  ContactFinder finder(scene);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) poses.push_back(random_pose(random, 3.0));
  const std::vector<double> reach(poses.size(), 0.1);
  finder.find(poses, reach);
  const long before = num_allocations();
  for (Pose& f : poses) f.position.x += 1e-6;
  finder.find(poses, reach);
  EXPECT_EQ(num_allocations(), before);
}

}  // namespace
}  // namespace tumble::test
