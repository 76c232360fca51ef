// Rollouts against runs one by one, exactly; what they tell of a run; and what they refuse.
#include "tumble/batch/rollout.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "tumble/scene/scene_toml.hpp"
#include "tumble/trajectory/simulate.hpp"

namespace tumble::batch {
namespace {

using Index = std::size_t;
constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

Scene named_scene(const std::string& name) {
  std::ifstream file(std::string(TUMBLE_SOURCE) + "/scenes/" + name + ".toml", std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return parse_scene(text.str(), name);
}

// A box over the ground, of two materials that are a pair.
Scene box_over_ground() {
  Scene scene;
  scene.materials = {{"wood", {0.4, 0.4, 0.3}}, {"stone", {0.6, 0.7, 0.1}}};
  Body& ground = scene.bodies.emplace_back();
  ground.name = "ground";
  ground.kind = BodyKind::fixed;
  ground.parts = {{HalfPlane{{0.0, 1.0}, 0.0}, 1}};
  Body& box = scene.bodies.emplace_back();
  box.name = "box";
  box.parts = {{square(0.2), 0}};
  set_mass(box, 0.3);
  box.pose = {{0.0, 0.5}, 0.3};
  scene.step_size = 0.005;
  scene.duration = 1.0;
  return scene;
}

// Arrays of results, and those of starts and parameters that the instances refer to.
struct Case {
  Scene scene;
  Instances instances;
  std::vector<double> pose, velocity;
  std::vector<std::vector<double>> values;
  std::vector<Varied> varied;

  void vary(Quantity quantity, int index, std::vector<double> numbers) {
    values.push_back(std::move(numbers));
    varied.push_back({quantity, index, {}});
  }
  const Instances& finish(Index count) {
    instances = {count, pose, velocity, varied};
    for (Index k = 0; k < varied.size(); ++k) instances.varied[k].values = values[k];
    return instances;
  }
};

struct Results {
  std::vector<double> time, pose, velocity;
  std::vector<LcpStatus> status;
  std::vector<RolloutMeasures> measures;
  Index bodies = 0;

  double pose_at(Index i, Index b, Index c, Index k) const {
    return pose[((i * bodies + b) * 3 + c) * time.size() + k];
  }
};

Results run(const Scene& scene, const Instances& instances, const RolloutSettings& settings) {
  Results r;
  r.time = sample_times(scene, settings);
  r.bodies = movable_bodies(scene).size();
  const Index size = instances.count * r.bodies * 3 * r.time.size();
  r.pose.resize(size);
  r.velocity.resize(size);
  r.status.resize(instances.count);
  r.measures.resize(instances.count);
  rollout(scene, instances, settings, {r.pose, r.velocity, r.status, r.measures});
  return r;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}
bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof(double)) == 0; }

bool same_bits(const Results& a, const Results& b) {
  return same_bits(a.time, b.time) && same_bits(a.pose, b.pose) && same_bits(a.velocity, b.velocity) &&
         same_bits(a.status, b.status) && same_bits(a.measures, b.measures);
}

// Starts near those of the scene, and other masses, laws and gravity for each.
Case random_case(const std::string& name, Index count, unsigned seed) {
  Case c;
  c.scene = named_scene(name);
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const std::vector<int> bodies = movable_bodies(c.scene);
  for (Index i = 0; i < count; ++i) {
    for (const int index : bodies) {
      const Body& body = c.scene.bodies[static_cast<Index>(index)];
      const Pose& p = body.pose;
      c.pose.insert(c.pose.end(), {p.position.x + uniform(-0.01, 0.01), p.position.y + uniform(0.0, 0.02),
                                   i % 4 == 3 ? -0.0 : p.angle + uniform(-0.1, 0.1)});
      const Vector3& v = body.velocity;
      c.velocity.insert(c.velocity.end(), {v[0] + uniform(-1, 1), v[1] + uniform(-1, 1), v[2] + uniform(-3, 3)});
    }
  }
  const auto vary = [&](Quantity quantity, int index, double low, double high) {
    std::vector<double> values(count);
    for (double& value : values) value = uniform(low, high);
    c.vary(quantity, index, values);
  };
  const int num_laws = static_cast<int>(c.scene.materials.size() + c.scene.pairs.size());
  for (int law = 0; law < num_laws; ++law) {
    vary(Quantity::restitution, law, 0.0, 0.9);
    if (law % 2 == 0) vary(Quantity::static_friction, law, 0.8, 0.9);
    vary(Quantity::friction, law, 0.0, 0.8);
  }
  for (const int index : bodies) {
    const Body& body = c.scene.bodies[static_cast<Index>(index)];
    if (body.kind != BodyKind::dynamic) continue;
    if (index % 2 == 0) vary(Quantity::moment_of_inertia, index, 0.5 * body.moment_of_inertia, body.moment_of_inertia);
    vary(Quantity::mass, index, 0.5 * body.mass, 2.0 * body.mass);
  }
  vary(Quantity::gravity_x, 0, -1.0, 1.0);
  vary(Quantity::gravity_y, 0, -10.0, -5.0);
  c.finish(count);
  return c;
}

// Of instance i, with what `simulate` gives for its scene.
void expect_as_simulated(const Results& results, const Case& c, const RolloutSettings& settings, Index i) {
  SimulateSettings one{settings.step_size, settings.duration, std::max(settings.every, 1), false, settings.step};
  if (settings.every == 0) one.sample_every = std::numeric_limits<int>::max();
  const Trajectory run = simulate(instance_scene(c.scene, c.instances, i), one);
  ASSERT_EQ(results.status[i], run.status);
  EXPECT_EQ(results.measures[i].num_steps, run.num_steps);
  EXPECT_EQ(results.measures[i].residual, run.residual);
  EXPECT_EQ(results.measures[i].num_inexact_steps, run.num_inexact_steps);
  EXPECT_EQ(results.measures[i].num_creating_steps, run.num_creating_steps);
  EXPECT_EQ(results.measures[i].created_energy, run.created_energy);
  const std::vector<int> bodies = movable_bodies(c.scene);
  const Index samples = results.time.size();
  if (run.is_complete && settings.every > 0) {
    ASSERT_TRUE(same_bits(results.time, run.time));
  }
  Index differing = 0;
  for (Index k = 0; k < samples; ++k) {
    const bool is_reached = settings.every == 0 || k < run.time.size();
    for (Index b = 0; b < bodies.size(); ++b) {
      const Index sample = settings.every == 0 ? run.time.size() - 1 : std::min(k, run.time.size() - 1);
      const BodyState& body = run.bodies(sample)[static_cast<Index>(bodies[b])];
      const Vector3 pose = {body.pose.position.x, body.pose.position.y, body.pose.angle};
      for (Index n = 0; n < 3; ++n) {
        const Index at = ((i * bodies.size() + b) * 3 + n) * samples + k;
        differing += is_reached ? !same_bits(results.pose[at], pose[n]) : !std::isnan(results.pose[at]);
        differing +=
            is_reached ? !same_bits(results.velocity[at], body.velocity[n]) : !std::isnan(results.velocity[at]);
      }
    }
  }
  EXPECT_EQ(differing, 0u);
}

struct Named {
  const char* name;
  int steps;
};

class RolloutOf : public testing::TestWithParam<Named> {};

TEST_P(RolloutOf, TheInstancesAreWhatSimulateGivesForEach) {
  constexpr Index count = 12;
  const Case c = random_case(GetParam().name, count, 1);
  for (const int every : {0, 7}) {
    RolloutSettings settings;
    settings.every = every;
    settings.duration = GetParam().steps * c.scene.step_size;
    settings.threads = 2;
    const Results results = run(c.scene, c.instances, settings);
    for (Index i = 0; i < count; ++i) {
      SCOPED_TRACE(testing::Message() << GetParam().name << ", every " << every << ", instance " << i);
      expect_as_simulated(results, c, settings, i);
    }
    // Another division of the work: other neighbours come before each in the memory of a thread.
    for (const int threads : {1, 3, 16}) {
      settings.threads = threads;
      EXPECT_TRUE(same_bits(results, run(c.scene, c.instances, settings))) << threads << " threads";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(NamedScenes, RolloutOf,
                         testing::Values(Named{"drop", 1500}, Named{"billiard", 800}, Named{"bouncing_balls", 800},
                                         Named{"capsule_and_rounded", 800}, Named{"compound", 800},
                                         Named{"conveyor", 800}, Named{"ellipse_drop", 800}, Named{"funnel", 200},
                                         Named{"pusher", 500}, Named{"stack", 60}, Named{"terrain", 800},
                                         Named{"tilting_table", 300}, Named{"wedge", 300}, Named{"dominoes", 100}),
                         [](const auto& named) { return std::string(named.param.name); });

// In long chunks of one thread, a start may follow on one that differs from it in little, or in nothing.
TEST(Rollout, IsIndependentOfWhatCameBefore) {
  const Case c = random_case("compound", 3, 2);
  const Index width = movable_bodies(c.scene).size() * 3;
  Case many;
  many.scene = c.scene;
  std::mt19937 random(3);
  std::vector<Index> which;
  for (Index i = 0; i < 2000; ++i) {
    which.push_back(random() % 3);
    const auto row = [&](const std::vector<double>& rows) {
      const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(which[i] * width);
      return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(width));
    };
    for (const double x : row(c.pose)) many.pose.push_back(x);
    for (const double x : row(c.velocity)) many.velocity.push_back(x);
  }
  RolloutSettings settings;
  settings.duration = 20 * c.scene.step_size;
  settings.threads = 1;
  Case alone = c;
  alone.varied.clear();
  const Results expected = run(c.scene, alone.finish(3), settings);
  const Results results = run(many.scene, many.finish(2000), settings);
  Index differing = 0;
  for (Index i = 0; i < 2000; ++i) {
    for (Index n = 0; n < width; ++n) {
      differing += !same_bits(results.pose[i * width + n], expected.pose[which[i] * width + n]);
    }
  }
  EXPECT_EQ(differing, 0u);
}

TEST(Rollout, WithoutArraysRunsTheScene) {
  Case c;
  c.scene = box_over_ground();
  RolloutSettings settings;
  settings.every = 10;
  const Results results = run(c.scene, c.finish(3), settings);
  for (Index i = 0; i < 3; ++i) expect_as_simulated(results, c, settings, i);
  EXPECT_TRUE(run(c.scene, c.finish(0), settings).status.empty());
}

TEST(Rollout, EditsWhatAHandWould) {
  Case c;
  c.scene = box_over_ground();
  c.scene.pairs = {{0, 1, {0.5, 0.5, 0.2}}};
  c.pose = {1, 2, 3, 4, 5, 6};
  c.velocity = {7, 8, 9};
  c.vary(Quantity::static_friction, 0, {0.9, 0.8});
  c.vary(Quantity::friction, 0, {0.1, 0.2});
  c.vary(Quantity::friction, 2, {0.35});
  c.vary(Quantity::restitution, 1, {0.7, 0.6});
  c.vary(Quantity::mass, 1, {0.7, 1.1});
  c.vary(Quantity::gravity_x, 0, {2.0});
  c.vary(Quantity::gravity_y, 0, {-1.0, -2.0});
  Scene second = c.scene;
  second.materials[0].law.friction = 0.2;
  second.materials[0].law.static_friction = 0.8;
  second.materials[1].law.restitution = 0.6;
  second.pairs[0].law.friction = second.pairs[0].law.static_friction = 0.35;
  set_mass(second.bodies[1], 1.1);
  second.bodies[1].pose = {{4, 5}, 6};
  second.bodies[1].velocity = {7, 8, 9};
  second.gravity = {2.0, -2.0};
  EXPECT_EQ(instance_scene(c.scene, c.finish(2), 1), second);
  c.vary(Quantity::moment_of_inertia, 1, {0.01});
  second.bodies[1].moment_of_inertia = 0.01;
  EXPECT_EQ(instance_scene(c.scene, c.finish(2), 1), second);
}

// A moment of inertia that no even filling has.
TEST(Rollout, KeepsTheRadiusOfGyration) {
  Case c;
  c.scene = box_over_ground();
  c.scene.bodies[1].moment_of_inertia = 0.01;
  c.vary(Quantity::mass, 1, {0.6});
  EXPECT_DOUBLE_EQ(instance_scene(c.scene, c.finish(1), 0).bodies[1].moment_of_inertia, 0.02);
}

TEST(Rollout, MovesBodiesWhoseStartIsFree) {
  const Scene scene = named_scene("pusher");
  std::vector<int> free;
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i) {
    const Body& body = scene.bodies[static_cast<Index>(i)];
    if (body.kind != BodyKind::fixed && body.motion.empty()) free.push_back(i);
  }
  EXPECT_EQ(movable_bodies(scene), free);
  EXPECT_LT(free.size(), scene.bodies.size());
}

// One bad instance.

TEST(Rollout, ABadInstanceTouchesNoOther) {
  const Index count = 40, width = 3;
  Case c;
  c.scene = box_over_ground();
  for (Index i = 0; i < count; ++i) {
    const double x = 0.01 * static_cast<double>(i);
    c.pose.insert(c.pose.end(), {x, 0.4 + x, x});
    c.velocity.insert(c.velocity.end(), {x, -x, 1.0});
  }
  std::vector<double> mass(count, 0.3), friction(count, 0.4), static_friction(count, 0.5), restitution(count, 0.2);
  std::vector<double> gravity(count, -9.81);
  const auto run_case = [&] {
    c.values = {mass, friction, static_friction, restitution, gravity};
    c.varied = {{Quantity::mass, 1, {}},
                {Quantity::friction, 0, {}},
                {Quantity::static_friction, 0, {}},
                {Quantity::restitution, 0, {}},
                {Quantity::gravity_y, 0, {}}};
    RolloutSettings settings;
    settings.threads = 2;
    return run(c.scene, c.finish(count), settings);
  };
  const Results good = run_case();
  std::map<Index, std::string> bad;
  const auto spoil = [&](std::vector<double>& values, Index at, Index i, double value, const char* word) {
    values[at] = value;
    bad[i] = word;
  };
  spoil(c.pose, 0 * width + 0, 0, k_nan, "bodies[1] 'box': pose.position.x");
  spoil(c.pose, 3 * width + 1, 3, HUGE_VAL, "pose.position.y");
  spoil(c.pose, 4 * width + 2, 4, 1e10, "pose.angle");
  spoil(c.velocity, 7 * width + 0, 7, k_nan, "velocity[0]");
  spoil(c.velocity, 8 * width + 1, 8, 1e10, "velocity[1]");
  spoil(c.velocity, 9 * width + 2, 9, -HUGE_VAL, "velocity[2]");
  spoil(mass, 11, 11, 0.0, "mass");
  spoil(mass, 12, 12, k_nan, "mass");
  spoil(mass, 13, 13, 5e-60, "moment_of_inertia");
  spoil(friction, 20, 20, -0.1, "materials[0].friction");
  spoil(friction, 21, 21, 0.6, "materials[0].static_friction");
  spoil(static_friction, 22, 22, k_nan, "static_friction");
  spoil(restitution, 30, 30, 1.1, "materials[0].restitution");
  spoil(gravity, 39, 39, k_nan, "gravity.y");
  const Results results = run_case();
  for (Index i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    const std::string why = what_is_invalid(c.scene, c.instances, i);
    if (bad.contains(i)) {
      EXPECT_EQ(results.status[i], LcpStatus::bad_input);
      EXPECT_NE(why.find(bad[i]), std::string::npos) << why;
      EXPECT_EQ(results.measures[i].num_steps, 0);
      EXPECT_TRUE(std::isnan(results.measures[i].residual));
      for (Index n = 0; n < 3; ++n) EXPECT_TRUE(std::isnan(results.pose[i * 3 + n]));
    } else {
      EXPECT_EQ(why, "");
      EXPECT_EQ(results.status[i], LcpStatus::solved);
      EXPECT_EQ(std::memcmp(&results.pose[i * 3], &good.pose[i * 3], 3 * sizeof(double)), 0);
      EXPECT_EQ(std::memcmp(&results.measures[i], &good.measures[i], sizeof(RolloutMeasures)), 0);
    }
  }
}

// What is told of a run.

TEST(Rollout, TellsOfARun) {
  Case c;
  c.scene = box_over_ground();
  c.pose = {0, 0.5, 0.3, 0, 0.1, 0, 0, 50, 0};
  c.velocity = {0, 0, 0, 0, 0, 0, 30, 0, 0};
  RolloutSettings settings;
  settings.duration = 2.0;
  settings.measures.x_max = 10.0;
  const Results results = run(c.scene, c.finish(3), settings);
  const Trajectory bounces =
      simulate(instance_scene(c.scene, c.instances, 0), {.step_size = 0, .duration = 2.0, .sample_every = 1});
  // The one pair of bodies: in which steps they push each other.
  std::map<std::int64_t, double> impulses;
  for (const StepContacts& step : bounces.contacts) {
    for (const ContactRecord& record : step.contacts) impulses[step.step] += record.normal_impulse;
  }
  std::erase_if(impulses, [](const auto& entry) { return !(entry.second > 0.0); });
  std::int64_t impacts = 0;
  double largest = 0.0;
  for (const auto& [step, impulse] : impulses) {
    impacts += impulses.contains(step - 1) ? 0 : 1;
    largest = std::max(largest, impulse);
  }
  double rest_time = 0.0;
  for (Index k = 0; k + 1 < bounces.time.size(); ++k) {
    const Vector3& v = bounces.bodies(k)[1].velocity;
    if (std::hypot(v[0], v[1], v[2] * std::sqrt(0.04 / 6.0)) > settings.measures.rest_speed)
      rest_time = bounces.time[k + 1];
  }
  const RolloutMeasures& m = results.measures[0];
  EXPECT_GT(impacts, 3);
  EXPECT_EQ(m.impacts, impacts);
  EXPECT_EQ(m.max_impulse, largest);
  EXPECT_EQ(m.last_contact, static_cast<double>(impulses.rbegin()->first) * bounces.step_size);
  EXPECT_EQ(m.rest_time, rest_time);
  EXPECT_GT(m.rest_time, 0.5);
  EXPECT_LT(m.rest_time, 2.0);
  const EnergyLedger &first = bounces.energy.front(), &last = bounces.energy.back();
  EXPECT_EQ(m.energy_lost, first.kinetic + first.potential - (last.kinetic + last.potential));
  EXPECT_NEAR(m.energy_lost, 0.3 * 9.81 * 0.4, 1e-6);  // from 0.5 m to rest at 0.1 m
  // Up to the round-off of 400 sums of about 1 J.
  EXPECT_NEAR(m.energy_lost, m.energy.friction_loss + m.energy.impact_loss - m.energy.stabilisation_work, 1e-12);
  EXPECT_TRUE(std::isnan(m.escape_time));
  // At rest from the start.
  EXPECT_EQ(results.measures[1].rest_time, 0.0);
  EXPECT_EQ(results.measures[1].impacts, 1);
  EXPECT_EQ(results.measures[1].last_contact, 2.0);
  // Flies.
  EXPECT_TRUE(std::isnan(results.measures[2].rest_time));
  EXPECT_TRUE(std::isnan(results.measures[2].last_contact));
  EXPECT_EQ(results.measures[2].impacts, 0);
  EXPECT_NEAR(results.measures[2].escape_time, 10.0 / 30.0, c.scene.step_size);
}

TEST(Rollout, KeepsWhatIsAskedFor) {
  Case c;
  c.scene = box_over_ground();
  c.scene.duration = 0.1;  // 20 steps
  RolloutSettings settings;
  settings.every = 8;
  EXPECT_EQ(sample_times(c.scene, settings), (std::vector<double>{0, 8 * 0.005, 16 * 0.005, 20 * 0.005}));
  settings.every = 0;
  EXPECT_EQ(sample_times(c.scene, settings), std::vector<double>{20 * 0.005});
  std::vector<LcpStatus> status(2);
  rollout(c.scene, c.finish(2), settings, {{}, {}, status, {}});
  EXPECT_EQ(status, (std::vector{LcpStatus::solved, LcpStatus::solved}));
}

// Interruption.

TEST(Rollout, IsWatchedFromTheCallingThreadAndEndsWithinARun) {
  Case c;
  c.scene = box_over_ground();
  struct Stop {};
  for (const int threads : {1, 2}) {
    RolloutSettings settings;
    settings.duration = 1e6;  // 2e8 steps: minutes
    settings.threads = threads;
    const auto caller = std::this_thread::get_id();
    int calls = 0;
    settings.watch = [&](Index done) {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      EXPECT_EQ(done, 0u);
      if (++calls == 3) throw Stop{};
    };
    EXPECT_THROW(run(c.scene, c.finish(4), settings), Stop);
    EXPECT_EQ(calls, 3);
  }
}

// What is refused.

std::string refusal(const Case& c, const RolloutSettings& settings = {}) {
  try {
    run(c.scene, c.instances, settings);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing refused";
}

TEST(Rollout, RefusesInOneLine) {
  const auto with = [](auto change) {
    Case c;
    c.scene = box_over_ground();
    change(c);
    c.finish(4);
    return refusal(c);
  };
  EXPECT_EQ(with([](Case& c) { c.pose.resize(13); }), "pose: must have 4 x 3 numbers, or 3 for all instances, got 13");
  EXPECT_EQ(with([](Case& c) {
              c.velocity = {0, k_nan, 0};
            }),
            "bodies[1] 'box': velocity[1]: must be in [-1000000000, 1000000000] m/s, got nan");
  EXPECT_EQ(with([](Case& c) { c.vary(Quantity::mass, 1, {-1.0}); }),
            "bodies[1] 'box': mass: must be in [1e-60, 1e+60] kg, got -1");
  EXPECT_EQ(with([](Case& c) { c.vary(Quantity::mass, 0, {1.0}); }),
            "mass of ground: only dynamic bodies have one, got it for a fixed one");
  EXPECT_EQ(with([](Case& c) { c.vary(Quantity::mass, 2, {1.0}); }),
            "mass: must be of one of the 2 bodies, got the index 2");
  EXPECT_EQ(with([](Case& c) { c.vary(Quantity::friction, -1, {1.0}); }),
            "friction: must be of one of the 2 materials and pairs, got the index -1");
  EXPECT_EQ(with([](Case& c) {
              c.vary(Quantity::friction, 1, {1.0, 2.0});
            }),
            "friction of stone: must have 4 x 1 numbers, or 1 for all instances, got 2");
  EXPECT_EQ(with([](Case& c) { c.vary(Quantity::static_friction, 0, {0.3}); }),
            "materials[0].static_friction: must be >= friction, which is 0.4, got 0.3");
  EXPECT_EQ(with([](Case& c) {
              c.vary(Quantity::static_friction, 0, {0.3});
              c.vary(Quantity::friction, 0, {0.1, 0.2, 0.3, 0.1});
            }),
            "nothing refused");
  EXPECT_EQ(with([](Case& c) {
              c.vary(Quantity::restitution, 0, {0.3});
              c.vary(Quantity::restitution, 0, {0.3});
            }),
            "restitution of wood: must be given once, got it twice");
  Case c;
  c.scene = box_over_ground();
  c.finish(1);
  RolloutSettings settings;
  settings.every = -1;
  EXPECT_EQ(refusal(c, settings), "every: must be >= 0, got -1");
  settings = {};
  settings.measures.rest_speed = k_nan;
  EXPECT_EQ(refusal(c, settings), "rest_speed: must be >= 0 m/s, got nan");
  settings = {};
  settings.measures.x_min = 1.0;
  settings.measures.x_max = 0.0;
  EXPECT_EQ(refusal(c, settings), "x_min: must be <= x_max, which is 0 m, got 1 m");
  settings = {};
  settings.threads = 1025;
  EXPECT_EQ(refusal(c, settings), "threads: must be in [0, 1024], 0 for one for each core, got 1025");
  EXPECT_THROW(instance_scene(c.scene, c.instances, 1), std::invalid_argument);
  std::vector<double> few(5);
  EXPECT_THROW(rollout(c.scene, c.instances, {}, {few, {}, {}, {}}), std::invalid_argument);
}

}  // namespace
}  // namespace tumble::batch
