// Times of the contacts of two shapes, and of all contacts of a scene.
#include <vector>

#include <benchmark/benchmark.h>

#include "tumble/geometry/detect_contacts.hpp"
#include "tumble/geometry/pair_contacts.hpp"

namespace {

using namespace tumble;

RoundedPolygon box(double width, double height) {
  const double x = width / 2, y = height / 2;
  return {{{-x, -y}, {x, -y}, {x, y}, {-x, y}}, 0.0};
}

// Two shapes already in place; reach 0.01.
void pair_contacts(benchmark::State& state, Shape a, Pose pose_a, Shape b, Pose pose_b) {
  PlacedShape placed_a = placed_shape(a), placed_b = placed_shape(b);
  place(placed_a, frame_of(pose_a));
  place(placed_b, frame_of(pose_b));
  ContactPoints contacts;
  for (auto _ : state) {
    contacts.clear();
    append_sorted_contacts(placed_a, placed_b, 0.01, contacts);
    benchmark::DoNotOptimize(contacts.data());
    benchmark::ClobberMemory();
  }
  state.counters["contacts"] = static_cast<double>(contacts.size());
}
BENCHMARK_CAPTURE(pair_contacts, box on box, box(1, 1), {{0, 0}, 0}, box(1, 1), {{0.1, 1.001}, 1e-3});
BENCHMARK_CAPTURE(pair_contacts, box by box apart, box(1, 1), {{0, 0}, 0}, box(1, 1), {{0.5, 1.2}, 0.1});
BENCHMARK_CAPTURE(pair_contacts, box on half plane, box(1, 1), {{0, 0.501}, 1e-3}, HalfPlane{{0, 1}, 0}, {});
BENCHMARK_CAPTURE(pair_contacts, disc on disc, RoundedPolygon{{{0, 0}}, 0.5}, {}, RoundedPolygon{{{0, 0}}, 0.5},
                  {{0.6, 0.8}, 0});
BENCHMARK_CAPTURE(pair_contacts, ellipse on ellipse, Ellipse{1, 0.5, {}}, {}, Ellipse{1, 0.3, {}}, {{0.4, 0.795}, 0.2});
BENCHMARK_CAPTURE(pair_contacts, thin ellipse on ellipse, Ellipse{1, 0.001, {}}, {}, Ellipse{1, 0.3, {}},
                  {{0.4, 0.36}, 0.2});
BENCHMARK_CAPTURE(pair_contacts, ellipses deep in one another, Ellipse{1, 0.5, {}}, {}, Ellipse{1, 0.3, {}},
                  {{0.1, 0.1}, 0.2});
BENCHMARK_CAPTURE(pair_contacts, ellipse on box, Ellipse{1, 0.5, {}}, {{0, 1.0}, 0.1}, box(2, 1), {});
BENCHMARK_CAPTURE(pair_contacts, box on terrain, box(1, 1), {{0, 0.501}, 1e-3},
                  Terrain{{{-2, 0}, {-1, 0}, {-0.2, 0}, {0.3, 0}, {1, 0}, {2, 0}}}, {});

// One square over a half-plane, as a simulation of one body asks for it each step.
void find_one_body(benchmark::State& state) {
  Scene scene;
  scene.bodies.resize(2);
  scene.bodies[0].kind = BodyKind::fixed;
  scene.bodies[0].parts = {{HalfPlane{{0, 1}, 0}}};
  scene.bodies[1].parts = {{box(1, 1)}};
  ContactFinder finder(scene);
  std::vector<Pose> poses = {{}, {{0, 0.501}, 1e-3}};
  const std::vector<double> reach = {0.0, 0.01};
  for (auto _ : state) {
    poses[1].position.x += 1e-9;
    benchmark::DoNotOptimize(finder.find(poses, reach).data());
  }
}
BENCHMARK(find_one_body);

// Boxes side by side and on one another over a half-plane, nearly touching; each has moved since the last call.
void find_grid(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  Scene scene;
  scene.bodies.resize(1);
  scene.bodies[0].kind = BodyKind::fixed;
  scene.bodies[0].parts = {{HalfPlane{{0, 1}, 0}}};
  std::vector<Pose> poses = {{}};
  for (int i = 0; i < side * side; ++i) {
    scene.bodies.emplace_back().parts = {{box(1, 1)}};
    poses.push_back({{1.001 * (i % side), 0.5 + 1.001 * (i / side)}, 1e-4 * (i % 7)});
  }
  ContactFinder finder(scene);
  const std::vector<double> reach(poses.size(), 0.005);
  std::size_t contacts = 0;
  double shift = 1e-9;
  for (auto _ : state) {
    for (std::size_t i = 1; i < poses.size(); ++i) poses[i].position.x += shift;
    shift = -shift;
    contacts = finder.find(poses, reach).size();
    benchmark::DoNotOptimize(contacts);
  }
  state.counters["contacts"] = static_cast<double>(contacts);
}
BENCHMARK(find_grid)->Arg(10)->Arg(32)->Arg(100);

}  // namespace
