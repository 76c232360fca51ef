#include "tumble/trajectory/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "tumble/math/format.hpp"

namespace tumble {
namespace {

void require_positive_or_default(double value, const char* field) {
  if (!(std::isfinite(value) && value >= 0.0)) {
    throw std::invalid_argument(tumble::format("{}: must be > 0 s, or 0 for the scene's own, got {}", field, value));
  }
}

}  // namespace

EnergyLedger energies(const Scene& scene, const State& state) {
  EnergyLedger energy;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.kind != BodyKind::dynamic) continue;
    const BodyState& b = state.bodies[i];
    const Vector3& v = b.velocity;
    energy.kinetic += 0.5 * body.mass * v[0] * v[0];
    energy.kinetic += 0.5 * body.mass * v[1] * v[1];
    energy.kinetic += 0.5 * body.moment_of_inertia * v[2] * v[2];
    energy.potential -= body.mass * (scene.gravity.x * b.pose.position.x + scene.gravity.y * b.pose.position.y);
  }
  return energy;
}

void add_step(EnergyLedger& sum, const EnergyLedger& step) {
  sum.kinetic = step.kinetic;
  sum.potential = step.potential;
  sum.external_work += step.external_work;
  sum.friction_loss += step.friction_loss;
  sum.impact_loss += step.impact_loss;
  sum.damping_loss += step.damping_loss;
  sum.stabilisation_work += step.stabilisation_work;
  sum.created += step.created;
}

void validate(const SimulateSettings& settings) {
  require_positive_or_default(settings.step_size, "step_size");
  require_positive_or_default(settings.duration, "duration");
  if (settings.sample_every < 1) {
    throw std::invalid_argument(tumble::format("sample_every: must be >= 1, got {}", settings.sample_every));
  }
  validate(settings.step);
}

RunSettings run_settings(const Scene& scene, const SimulateSettings& settings) {
  validate(settings);
  const double step_size = settings.step_size > 0.0 ? settings.step_size : scene.step_size;
  const double duration = settings.duration > 0.0 ? settings.duration : scene.duration;
  const double steps = duration / step_size;
  if (!(steps <= k_max_steps)) {
    throw std::invalid_argument(
        tumble::format("duration: must be at most {:g} steps of {} s, got {} s", k_max_steps, step_size, duration));
  }
  // Up to the end asked for, or past it by less than a step; a last step of nothing but round-off is none.
  const auto num_steps = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(steps * (1.0 - 1e-12))));
  return {step_size, num_steps, settings.step};
}

void advance(const Scene& scene, const RunSettings& settings, StepWorkspace& workspace, State& state,
             StepReport& report, RunSummary& summary) {
  const LcpStatus status = time_step(scene, settings.step_size, settings.step, state, workspace, &report);
  ++summary.num_steps;
  state.time = static_cast<double>(summary.num_steps) * settings.step_size;
  summary.residual = std::max(summary.residual, report.residual);
  const bool is_close = status == LcpStatus::iteration_limit || status == LcpStatus::numerical;
  if (is_close && report.residual <= k_largest_residual_to_go_on) {
    if (summary.num_inexact_steps == 0) summary.first_inexact = state.time;
    ++summary.num_inexact_steps;
  } else {
    summary.status = status;
  }
  const double created = report.energy.created;
  if (created > 0.0) {
    if (summary.num_creating_steps == 0) summary.first_creation = state.time;
    ++summary.num_creating_steps;
    summary.created_energy += created;
  }
  summary.is_complete = summary.num_steps == settings.num_steps && summary.status == LcpStatus::solved;
}

Simulation::Simulation(const Scene& scene, const SimulateSettings& settings) : settings_(settings) {
  trajectory_.scene = scene;
  workspace_ = std::make_unique<StepWorkspace>(trajectory_.scene);
  run_ = run_settings(trajectory_.scene, settings);
  trajectory_.step_size = run_.step_size;
  state_ = initial_state(trajectory_.scene);
  since_sample_ = energies(trajectory_.scene, state_);
  sample();
}

void Simulation::sample() {
  trajectory_.time.push_back(state_.time);
  trajectory_.states.insert(trajectory_.states.end(), state_.bodies.begin(), state_.bodies.end());
  trajectory_.energy.push_back(since_sample_);
  since_sample_ = {};
}

void Simulation::advance() {
  if (is_done()) return;
  tumble::advance(trajectory_.scene, run_, *workspace_, state_, report_, trajectory_);
  add_step(since_sample_, report_.energy);
  if (settings_.keeps_contacts) {
    StepContacts at_work{step(), {}};
    for (const ContactRecord& record : report_.contacts) {
      if (record.mode != ContactMode::open) at_work.contacts.push_back(record);
    }
    if (!at_work.contacts.empty()) trajectory_.contacts.push_back(std::move(at_work));
  }
  if (is_done() || step() % settings_.sample_every == 0) sample();
}

Trajectory Simulation::finish() {
  if (trajectory_.time.back() != state_.time) sample();
  return std::move(trajectory_);
}

Trajectory simulate(const Scene& scene, const SimulateSettings& settings) {
  Simulation simulation(scene, settings);
  while (!simulation.is_done()) simulation.advance();
  return simulation.finish();
}

}  // namespace tumble
