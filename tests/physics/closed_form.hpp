// Motions with known answers, each with its error at any step size.
#pragma once

#include <cmath>
#include <functional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tumble/trajectory/simulate.hpp"

namespace tumble::physics {

struct ClosedForm {
  std::string name;     // what happens, and what is compared
  std::string formula;  // and its source
  double order;         // of the error in the step size; 0: exact up to round-off at every step size
  double bound;         // of the error, at 1 ms; where the order is 0 at every step size
  std::function<double(double step_size)> error;  // [-], relative; throws std::runtime_error if a step is not solved
  const char* not_met_because = "";               // what of the simulator is known not to be right yet
};

inline std::ostream& operator<<(std::ostream& out, const ClosedForm& form) { return out << form.name; }

inline ClosedForm not_met(ClosedForm form, const char* because) {
  form.not_met_because = because;
  return form;
}

std::vector<ClosedForm> closed_forms();
// Its parts.
std::vector<ClosedForm> flights();
std::vector<ClosedForm> bounces();
std::vector<ClosedForm> impacts();
std::vector<ClosedForm> slides();
std::vector<ClosedForm> rolls();
std::vector<ClosedForm> rocks();
std::vector<ClosedForm> forces();
std::vector<ClosedForm> thresholds();

// The largest error at step sizes a little below the one given: where in a step an impact falls is a matter of chance.
double largest_error(const ClosedForm& form, double step_size);

// The step sizes of the table [s], from large to small.
inline constexpr double k_step_sizes[] = {4e-3, 2e-3, 1e-3, 5e-4};

// The slope of log(error) over log(step size) by least squares, at those step sizes.
double observed_order(const std::vector<double>& errors);

// Round-off of motions of up to some thousand steps [-].
inline constexpr double k_round_off = 1e-12;

// Steps until `is_over(state, report)`, or the time is over, and returns whether it was. Throws std::runtime_error if a
// step is not solved.
template <class IsOver>
bool run_until(Simulation& simulation, IsOver is_over) {
  while (!simulation.is_done()) {
    simulation.advance();
    if (simulation.report().status != LcpStatus::solved) throw std::runtime_error("a step was not solved");
    if (is_over(simulation.state(), simulation.report())) return true;
  }
  return false;
}

inline Simulation start(const Scene& scene, double step_size, double duration) {
  return Simulation(scene,
                    {.step_size = step_size, .duration = duration, .sample_every = 1 << 30, .keeps_contacts = false});
}

// The state at the first step that ends at or after a time.
inline State state_after(const Scene& scene, double step_size, double duration) {
  Simulation simulation = start(scene, step_size, duration);
  run_until(simulation, [](const State&, const StepReport&) { return false; });
  return simulation.state();
}

inline double relative(double value, double right) { return std::abs(value - right) / std::abs(right); }

// The sum of the impulses on body b of all contacts of bodies a, b, as a vector in the world [N s].
Vector2 impulse_between(const StepReport& report, int body_a, int body_b);

inline bool has_impulse(const StepReport& report) {
  for (const ContactRecord& contact : report.contacts) {
    if (contact.normal_impulse > 0.0) return true;
  }
  return false;
}

// A contact slips, by more than round-off.
inline bool has_slip(const StepReport& report) {
  constexpr double round_off = 1e-12;  // [m/s]
  for (const ContactRecord& contact : report.contacts) {
    const bool is_slip = contact.mode == ContactMode::slip_left || contact.mode == ContactMode::slip_right;
    if (is_slip && std::abs(contact.tangential_velocity_after) > round_off) return true;
  }
  return false;
}

// An impact without rebound takes two steps: in the first one the gap closes.
inline void finish_impact(Simulation& simulation) {
  for (int i = 0; i < 2; ++i) simulation.advance();
}

}  // namespace tumble::physics
