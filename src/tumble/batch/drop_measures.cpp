#include "tumble/batch/drop_measures.hpp"

#include <cmath>
#include <limits>

namespace tumble::batch {
namespace {

constexpr double k_none = std::numeric_limits<double>::quiet_NaN();

bool is_moving(const drop::State& state, const drop::Parameters& p, const MeasureSettings& settings) {
  const Vector3& v = state.v;
  const double speed_squared = (v[0] * v[0] + v[1] * v[1]) + p.l * p.l / 6.0 * (v[2] * v[2]);
  return speed_squared > settings.rest_speed * settings.rest_speed;
}

bool is_outside(const drop::State& state, const MeasureSettings& settings) {
  return state.q[0] < settings.x_min || state.q[0] > settings.x_max;
}

}  // namespace

std::int32_t face_up(double theta) {
  const double quarters = std::floor(theta * 0x1.45f306dc9c883p-1 + 0.5);
  return static_cast<std::int32_t>(quarters - 4.0 * std::floor(0.25 * quarters));
}

NotedColumns note_start(const drop::State& start, const drop::Parameters& parameters, const MeasureSettings& settings) {
  NotedColumns noted;
  if (is_moving(start, parameters, settings)) noted.last_moving = 0.0;
  if (is_outside(start, settings)) noted.escape = 0.0;
  return noted;
}

void note_column(NotedColumns& noted, int column, const drop::State& state, double f_n, bool was_closed,
                 const drop::Parameters& parameters, const MeasureSettings& settings) {
  if (f_n > 0.0) noted.last_contact = column;
  if (f_n > 0.0 && !was_closed) noted.impacts += 1.0;
  if (f_n * parameters.dt > noted.max_force_time) noted.max_force_time = f_n * parameters.dt;
  if (is_moving(state, parameters, settings)) noted.last_moving = column;
  if (noted.escape < 0.0 && is_outside(state, settings)) noted.escape = column;
}

DropMeasures drop_measures(const NotedColumns& noted, const drop::State& start, const drop::State& last, int columns,
                           DropStatus status, const drop::Parameters& parameters) {
  const auto energy = [&](const drop::State& state) {
    return drop::kinetic_energy(state.v, parameters) + drop::potential_energy(state.q, parameters);
  };
  const bool rests = noted.last_moving < columns - 1.0;
  return {.last_contact = noted.last_contact < 0.0 ? k_none : noted.last_contact * parameters.dt,
          .rest_time = rests ? (noted.last_moving + 1.0) * parameters.dt : k_none,
          .max_impulse = noted.max_force_time,
          .energy_lost = energy(start) - energy(last),
          .escape_time = noted.escape < 0.0 ? k_none : noted.escape * parameters.dt,
          .impacts = static_cast<std::int32_t>(noted.impacts),
          .face = status == DropStatus::solved ? face_up(last.q[2]) : -1};
}

DropMeasures no_measures() { return {k_none, k_none, 0.0, k_none, k_none, 0, -1}; }

}  // namespace tumble::batch
