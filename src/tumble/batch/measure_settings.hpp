// What the measures of a run ask about, the same for drops and scenes.
#pragma once

#include <limits>

namespace tumble::batch {

struct MeasureSettings {
  // Bounds sqrt(v_x^2 + v_y^2 + (I / m) omega^2) [m/s], >= 0: the speed that all of the kinetic energy would give. A
  // square has I / m = l^2 / 6.
  double rest_speed = 0.2;
  double x_min = -std::numeric_limits<double>::infinity();  // [m], the region that a body may escape from
  double x_max = std::numeric_limits<double>::infinity();   // [m], >= x_min
};

// Throws std::invalid_argument naming the field, its value and what is allowed.
void validate(const MeasureSettings& settings);

}  // namespace tumble::batch
