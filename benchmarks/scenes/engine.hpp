// What is compared: engines, each with its settings.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "worlds.hpp"

namespace tumble::bench {

struct Motion {
  Pose pose;           // of the centre of mass
  Vector3 velocity{};  // v_x, v_y, omega
};

// A world inside an engine. Copies share it.
struct Run {
  std::function<void(int count)> advance;  // timed: so many steps
  std::function<Motion(int body)> motion;  // in the order of World::bodies
  std::function<int()> num_contacts;       // points that touch, by the engine's own count
};

struct Engine {
  std::string name;
  std::string settings;  // in a few words
  std::string remark;    // what a reader of its row must know; the same for all settings of one name
  std::function<Run(const World& world, double step_size)> build;
};

// One entry for each of the settings that are compared; empty if the package was not found when this was built.
std::vector<Engine> box2d_engines();
std::vector<Engine> chipmunk_engines();
std::vector<Engine> tumble_engines();

}  // namespace tumble::bench
