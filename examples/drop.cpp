// Drops the square from the course's start and prints its impacts. Twin: drop.py.
#include "tumble/drop/drop.hpp"

#include <cstdio>
#include <numbers>
#include <string>

int main() {
  const tumble::drop::Record record =
      tumble::drop::simulate_with_record({0.0, 1.5, 30 * std::numbers::pi / 180}, {0.0, -0.2, 0.0});
  const double dt = record.parameters.dt;

  std::printf("time [s]  gap [mm]  mode        impulse [N s]\n");
  for (int k = 0; k + 1 < record.trajectory.columns; ++k) {
    const tumble::drop::StepRecord& step = record.steps[static_cast<std::size_t>(k)];
    if (step.z[0] <= 0.0) continue;
    const std::string mode(to_string(step.mode));
    std::printf("%8.2f  %8.2f  %-10s  %13.5f\n", k * dt, 1000 * step.gap, mode.c_str(), step.z[0] * dt);
  }
  const tumble::Vector3 q = record.trajectory.q_at(record.trajectory.columns - 1);
  std::printf("end: x = %.6f m, y = %.6f m, theta = %.6f rad\n", q[0], q[1], q[2]);
}
