#include "tumble/step/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "tumble/math/format.hpp"
#include "tumble/step/step_parts.hpp"

namespace tumble {
namespace {

using Index = std::size_t;
using Parts = StepWorkspace::Parts;

// The body may be pushed a little within a step without a second look for contacts: [-] of its size.
constexpr double k_slack = 0.005;
constexpr int k_max_looks = 30;

bool is_finite(const BodyState& b) {
  // 0 times a number is 0 only if that is finite.
  const double zero = 0.0 * b.pose.position.x + 0.0 * b.pose.position.y + 0.0 * b.pose.angle + 0.0 * b.velocity[0] +
                      0.0 * b.velocity[1] + 0.0 * b.velocity[2];
  return zero == 0.0;
}

void check(const Scene& scene, double step_size, const State& state) {
  if (!(std::isfinite(step_size) && step_size > 0.0)) {
    throw std::invalid_argument(tumble::format("step_size: must be > 0 s, got {}", step_size));
  }
  if (state.bodies.size() != scene.bodies.size()) {
    throw std::invalid_argument(tumble::format("state.bodies: must have one entry per body of the scene ({}), got {}",
                                               scene.bodies.size(), state.bodies.size()));
  }
  for (Index i = 0; i < state.bodies.size(); ++i) {
    if (is_finite(state.bodies[i])) continue;
    throw std::invalid_argument(tumble::format("state.bodies[{}] ({}): must be finite", i, scene.bodies[i].name));
  }
}

// Where a kinematic body goes.
void prescribe(const Body& body, double h, const State& state, Index i, Parts& parts) {
  const Pose now = state.bodies[i].pose, next = prescribed_pose(body, state.time + h);
  const Vector2 way = next.position - now.position;
  parts.travel[i] = {way.x, way.y, next.angle - now.angle};
  for (Index j = 0; j < 3; ++j) parts.velocity[i][j] = parts.travel[i][j] / h;
  parts.free_velocity[i] = parts.middle_velocity[i] = parts.next_velocity[i] = parts.velocity[i];
  const double turn = std::abs(parts.travel[i][2]);
  parts.reach[i] = length(way) + (turn > 0.0 ? turn * parts.radius[i] : 0.0);
}

// How a dynamic body moves by its forces.
void fall(const Body& body, Vector2 gravity, double h, const State& state, Index i, Parts& parts) {
  Vector3& wrench = parts.wrench[i];
  wrench = {};
  if (!body.wrenches.empty()) wrench = mean_wrench(body, state.time, state.time + h);
  const Vector3 force = {body.mass * gravity.x + wrench[0], body.mass * gravity.y + wrench[1], wrench[2]};
  const Vector3 damping = {body.linear_damping, body.linear_damping, body.angular_damping};
  const Vector3 &v = state.bodies[i].velocity, &inverse_mass = parts.inverse_mass[i];
  Vector3 free;
  for (Index j = 0; j < 3; ++j) {
    free[j] = v[j] + h * (inverse_mass[j] * force[j]);
    if (damping[j] > 0.0) free[j] /= 1.0 + h * damping[j];
    const double middle = 0.5 * (v[j] + free[j]);
    parts.force[i][j] = force[j];
    parts.velocity[i][j] = v[j];
    parts.free_velocity[i][j] = parts.next_velocity[i][j] = parts.force_velocity[i][j] = free[j];
    parts.middle_velocity[i][j] = middle;
    parts.travel[i][j] = h * middle;
  }
  const double speed = std::sqrt(std::max(v[0] * v[0] + v[1] * v[1], free[0] * free[0] + free[1] * free[1]));
  const double spin = std::max(std::abs(v[2]), std::abs(free[2]));
  parts.reach[i] = h * (speed + spin * parts.radius[i]) + k_slack * parts.radius[i];
}

// The motion of all bodies as if there were no contacts, and how far each can get.
void predict(const Scene& scene, double h, const State& state, Parts& parts) {
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    parts.poses[i] = state.bodies[i].pose;
    if (body.kind == BodyKind::dynamic) fall(body, scene.gravity, h, state, i, parts);
    if (body.kind == BodyKind::kinematic) prescribe(body, h, state, i, parts);
  }
}

// True if no body went further than its contacts were looked for; else they are looked for further away. Bodies that
// touch nothing go as predicted.
bool are_within_reach(Parts& parts) {
  bool is_within = true;
  for (const int i : parts.island_contact) {
    const BodyContact& rows = parts.contacts[static_cast<Index>(i)].rows;
    for (const int body : {rows.body_a, rows.body_b}) {
      if (body < 0) continue;
      const auto b = static_cast<Index>(body);
      if (is_within_reach(parts, b)) continue;
      parts.reach[b] = 2.0 * way_of(parts, b);
      is_within = false;
    }
  }
  return is_within;
}

// Looks for contacts that the motion found would run through, where it takes bodies elsewhere than thought before.
// False if the contacts are the same as before.
bool find_more_contacts(const Scene& scene, double h, const State& state, Parts& parts, int& looks) {
  if (parts.contacts.empty() && parts.fast_pairs.empty()) return false;
  const bool may_look = looks < k_max_looks;
  const bool is_within = !may_look || are_within_reach(parts);
  if (!is_within) look_further(scene, h, state, parts);
  const bool has_overrun = list_overrun(h, parts);
  const bool meets = may_look && add_contacts_on_way(scene, h, parts);
  looks += !is_within || meets ? 1 : 0;
  return !is_within || has_overrun || meets;
}

void fill_report(const Scene& scene, double h, const State& state, Parts& parts, StepReport& report) {
  EnergyLedger& energy = report.energy;
  report.contacts.clear();
  for (StepContact& c : parts.contacts) {
    if (!c.is_listed) {
      c.speed_after = velocity_at(c.rows, parts.next_velocity);
      c.mode = ContactMode::open;
      c.sticks = false;
      c.impulse = c.total_impulse = c.work = {};
    }
    report.contacts.push_back({c.contact, c.tangent, c.places.on_a, c.places.on_b, *c.law, c.bend, c.speed[0],
                               c.speed[1], c.speed_after[0], c.speed_after[1], c.total_impulse[0], c.total_impulse[1],
                               c.restitution, c.sticks ? ContactMode::stick : c.mode});
    energy.impact_loss -= c.work[0];
    energy.friction_loss -= c.work[1];
    energy.external_work -= c.total_impulse[0] * c.rows.offset + c.total_impulse[1] * c.rows.tangent_offset;
  }
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.kind != BodyKind::dynamic) continue;
    const Vector3 &v = parts.velocity[i], &next = parts.next_velocity[i], &travel = parts.travel[i];
    const Vector2 x = state.bodies[i].pose.position;
    energy.potential -= body.mass * (scene.gravity.x * x.x + scene.gravity.y * x.y);
    for (Index j = 0; j < 3; ++j) {
      const double middle = 0.5 * h * (v[j] + parts.force_velocity[i][j]);
      energy.kinetic += 0.5 * parts.mass[i][j] * next[j] * next[j];
      energy.external_work += parts.wrench[i][j] * travel[j];
      energy.stabilisation_work += parts.force[i][j] * (middle - travel[j]);
      const double damping = j < 2 ? body.linear_damping : body.angular_damping;
      if (damping > 0.0) energy.damping_loss += damping * parts.mass[i][j] * parts.free_velocity[i][j] * middle;
    }
  }
  // Bodies that stop on their way do not fall all of it.
  if (parts.has_stopped)
    energy.created = std::max(energy.created, energy.stabilisation_work - energy.friction_loss - energy.impact_loss);
}

// What became of the islands: the worst of them, and their sums.
StepReport summary_of(const Parts& parts) {
  StepReport summary;
  for (Index i = 0; i + 1 < parts.island_begin.size(); ++i) {
    const int first = parts.island_contact[static_cast<Index>(parts.island_begin[i])];
    const IslandOutcome& outcome = parts.contacts[static_cast<Index>(first)].outcome;
    if (outcome.status != LcpStatus::solved) summary.status = outcome.status;
    summary.residual = std::max(summary.residual, outcome.residual);
    summary.factorisations += outcome.factorisations;
    summary.energy.created += outcome.created;
    summary.num_islands += outcome.is_at_work ? 1 : 0;
  }
  return summary;
}

// The state at the end of the step.
void advance(const Scene& scene, double h, State& state, const Parts& parts) {
  state.time += h;
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    BodyState& body = state.bodies[i];
    const Vector3& travel = parts.travel[i];
    if (scene.bodies[i].kind == BodyKind::fixed) continue;
    if (scene.bodies[i].kind == BodyKind::kinematic) {
      body.pose = prescribed_pose(scene.bodies[i], state.time);
    } else {
      body.pose.position = body.pose.position + Vector2{travel[0], travel[1]};
      body.pose.angle += travel[2];
    }
    body.velocity = parts.next_velocity[i];
  }
  state.contacts.clear();
  for (const StepContact& c : parts.contacts) {
    if (!c.is_listed || c.mode == ContactMode::open) continue;
    const Contact& k = c.contact;
    state.contacts.push_back({k.body_a, k.body_b, k.part_a, k.part_b, k.feature, c.mode, c.sticks, c.restitution > 0.0,
                              c.impulse[0], c.impulse[1]});
  }
}

}  // namespace

StepWorkspace::Parts::Parts(const Scene& scene) : finder(scene) {
  const Index n = scene.bodies.size();
  take_laws(scene);
  mass.assign(n, Vector3{});
  inverse_mass.assign(n, Vector3{});
  for (Index i = 0; i < n; ++i) {
    const Body& body = scene.bodies[i];
    if (body.kind == BodyKind::dynamic) take_mass(scene, i);
    radius.push_back(radius_of(body));
    sizes.emplace_back();
    for (const Part& part : body.parts) sizes.back().push_back(size_of(part.shape));
  }
  poses.resize(n);
  reach.assign(n, 0.0);
  was_held.assign(n, false);
  for (std::vector<Vector3>* values : {&velocity, &force, &wrench, &free_velocity, &middle_velocity, &next_velocity,
                                       &travel, &shift, &way_velocity, &force_velocity}) {
    values->assign(n, Vector3{});
  }
  parent.resize(n);
  island_of.resize(n);
  local_body.assign(n, -1);
}

void StepWorkspace::Parts::take_laws(const Scene& scene) {
  laws.clear();
  for (Index a = 0; a < scene.materials.size(); ++a) {
    for (Index b = 0; b < scene.materials.size(); ++b) {
      laws.push_back(contact_law(scene, static_cast<int>(a), static_cast<int>(b)));
    }
  }
}

void StepWorkspace::Parts::take_mass(const Scene& scene, std::size_t body) {
  const Vector3 m = {scene.bodies[body].mass, scene.bodies[body].mass, scene.bodies[body].moment_of_inertia};
  mass[body] = m;
  inverse_mass[body] = {1.0 / m[0], 1.0 / m[1], 1.0 / m[2]};
}

StepWorkspace::StepWorkspace(const Scene& scene) {
  validate(scene);
  parts_ = std::make_unique<Parts>(scene);
}
StepWorkspace::~StepWorkspace() = default;
StepWorkspace::StepWorkspace(StepWorkspace&&) noexcept = default;
StepWorkspace& StepWorkspace::operator=(StepWorkspace&&) noexcept = default;

void validate(const StepSettings& settings) {
  if (settings.num_sweeps < 1) {
    throw std::invalid_argument(tumble::format("num_sweeps: must be >= 1, got {}", settings.num_sweeps));
  }
}

LcpStatus time_step(const Scene& scene, double h, const StepSettings& settings, State& state, StepWorkspace& workspace,
                    StepReport* report) {
  check(scene, h, state);
  validate(settings);
  Parts& parts = workspace.parts();
  predict(scene, h, state, parts);
  prepare_contacts(scene, h, state, parts);
  int looks = 0;
  do {
    do {
      step_islands(h, settings, parts);
    } while (find_more_contacts(scene, h, state, parts, looks));
  } while (separate_islands(h, settings, parts) && find_more_contacts(scene, h, state, parts, looks));
  stop_at_impacts(h, parts);
  const StepReport summary = summary_of(parts);
  advance(scene, h, state, parts);
  if (report) {
    std::vector<ContactRecord> contacts = std::move(report->contacts);  // its memory
    *report = summary;
    report->contacts = std::move(contacts);
    fill_report(scene, h, state, parts, *report);
  }
  return summary.status;
}

}  // namespace tumble
