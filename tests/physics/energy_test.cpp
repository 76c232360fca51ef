// Energy is never made from nothing, and not lost where nothing takes it.
#include <algorithm>
#include <cmath>
#include <vector>

#include "closed_form.hpp"
#include "scene_builder.hpp"
#include <gtest/gtest.h>

namespace tumble::physics {
namespace {

constexpr double k_step_size = 1e-3;
constexpr double k_accepted_drift = 1e-3;  // [-] over 10^4 bounces

struct EnergyRun {
  int bounces = 0;
  double first = 0.0, last = 0.0;  // [J] kinetic and potential
  double largest_rise = 0.0;       // [-] above the least before, of the first
};

EnergyRun run(const Scene& scene, int bounces) {
  Simulation simulation = start(scene, k_step_size, 1e5);
  const auto total = [&] {
    const EnergyLedger energy = energies(scene, simulation.state());
    return energy.kinetic + energy.potential;
  };
  EnergyRun result;
  result.first = result.last = total();
  double least = result.first;
  run_until(simulation, [&](const State&, const StepReport& report) {
    if (!has_impulse(report)) return false;
    const double now = total();
    result.largest_rise = std::max(result.largest_rise, (now - least) / result.first);
    least = std::min(least, now);
    return ++result.bounces == bounces;
  });
  result.last = total();
  return result;
}

// Elastic, smooth, in a box whose lower left corner is the origin, so that potential energies are positive.
Scene elastic(std::vector<Body> bodies, double width, double height) {
  std::vector<Body> all = {fixed(level()), fixed(ceiling(height)), fixed(wall_on_the_left(0.0)),
                           fixed(wall_on_the_right(width))};
  all.insert(all.end(), bodies.begin(), bodies.end());
  return scene_of(law(0.0, 1.0), all);
}

void expect_conserved(const Scene& scene, int bounces) {
  const EnergyRun result = run(scene, bounces);
  EXPECT_EQ(result.bounces, bounces);
  EXPECT_LE(result.largest_rise, 1e-12);  // round-off of a step
  EXPECT_LE(std::abs(result.last - result.first), k_accepted_drift * result.first);
}

TEST(Energy, ElasticBallKeepsItForTenThousandBounces) {
  expect_conserved(scene_of(law(0.0, 1.0), {fixed(level()), dynamic(disc(0.1), 0.3, {{0.0, 1.1}, 0.0})}), 10000);
}

TEST(Energy, ElasticBallInABoxKeepsItForTenThousandBounces) {
  expect_conserved(elastic({dynamic(disc(0.1), 0.3, {{0.7, 0.6}, 0.0}, {3.1, 1.7, 2.0})}, 2.0, 1.5), 10000);
}

TEST(Energy, ElasticSquareKeepsItForTenThousandBounces) {
  expect_conserved(elastic({dynamic(square(0.2), 0.3, {{0.7, 0.9}, 0.5}, {1.1, 0.7, 2.0})}, 2.0, 1.5), 10000);
}

TEST(Energy, ElasticEllipseKeepsItForTenThousandBounces) {
  expect_conserved(elastic({dynamic(ellipse(0.2, 0.1), 0.3, {{0.7, 0.9}, 0.5}, {1.1, 0.7, 2.0})}, 2.0, 1.5), 10000);
}

TEST(Energy, ElasticDiscsKeepItForTenThousandBounces) {
  std::vector<Body> discs;
  for (int i = 0; i < 8; ++i) {
    discs.push_back(dynamic(disc(0.05 + 0.01 * i), 0.1 * (1 + i), {{0.3 + 0.45 * (i % 4), 0.5 + 0.5 * (i / 4)}, 0.0},
                            {0.7 * std::cos(1.3 * i), 0.7 * std::sin(2.1 * i), 0.0}));
  }
  expect_conserved(elastic(discs, 2.0, 1.5), 10000);
}

}  // namespace
}  // namespace tumble::physics
