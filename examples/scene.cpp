// Two boxes on a slope of 25 degrees: rubber sticks, ice slides. Twin: scene.py.
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>

#include "tumble/trajectory/simulate.hpp"

int main() {
  using namespace tumble;
  constexpr double angle = 25.0 / 180.0 * std::numbers::pi;
  Scene scene;
  scene.title = "Two boxes on a slope";
  scene.duration = 1.0;
  scene.materials = {{"wood", {0.4, 0.4, 0.0}}, {"rubber", {0.9, 0.9, 0.0}}, {"ice", {0.1, 0.1, 0.0}}};
  Body slope;
  slope.name = "slope";
  slope.kind = BodyKind::fixed;
  slope.parts = {{half_plane({0.0, 1.0})}};
  slope.pose.angle = angle;
  scene.bodies = {slope};
  for (const auto& [material, x] : {std::pair{1, 0.5}, std::pair{2, -0.5}}) {
    Body box;
    box.name = scene.materials[static_cast<std::size_t>(material)].name;
    box.parts = {{moved(square(0.25), {{x, 0.125}, 0.0}), material}};  // drawn on level ground, then turned with it
    box.pose.angle = angle;
    set_mass(box, 2.0);
    scene.bodies.push_back(box);
  }

  SimulateSettings settings;
  settings.sample_every = 250;
  const Trajectory run = simulate(scene, settings);
  std::printf("time [s]  way of rubber [m]  way of ice [m]\n");
  for (std::size_t k = 0; k < run.time.size(); ++k) {
    const auto way = [&](std::size_t body) {
      return run.bodies(k)[body].pose.position.x - run.bodies(0)[body].pose.position.x;
    };
    std::printf("%8.3f  %17.6f  %14.6f\n", run.time[k], way(1), way(2));
  }
  double impulse = 0.0;
  std::string mode;
  for (const ContactRecord& record : run.contacts.back().contacts) {
    if (record.contact.body_b != 2) continue;
    impulse += record.normal_impulse;
    if (mode.empty()) mode = to_string(record.mode);
  }
  std::printf("the slope carries %.6f N of the ice, %s\n", impulse / run.step_size, mode.c_str());
  const std::string status(to_string(run.status));
  std::printf("%s, largest residual below 1e-10: %s\n", status.c_str(), run.residual < 1e-10 ? "yes" : "no");
}
