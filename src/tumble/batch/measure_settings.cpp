#include "tumble/batch/measure_settings.hpp"

#include <stdexcept>

#include "tumble/math/format.hpp"

namespace tumble::batch {

void validate(const MeasureSettings& settings) {
  if (!(settings.rest_speed >= 0.0)) {
    throw std::invalid_argument(tumble::format("rest_speed: must be >= 0 m/s, got {}", settings.rest_speed));
  }
  if (!(settings.x_min <= settings.x_max)) {
    throw std::invalid_argument(
        tumble::format("x_min: must be <= x_max, which is {} m, got {} m", settings.x_max, settings.x_min));
  }
}

}  // namespace tumble::batch
