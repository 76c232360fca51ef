#include "tumble/output/drop_trajectory.hpp"

#include <limits>

#include "tumble/math/format.hpp"
#include "tumble/output/record_fields.hpp"

namespace tumble::output {
namespace {

// In the step from this column to the next.
ContactRecord contact_of(const drop::Record& record, int column) {
  const drop::Parameters& p = record.parameters;
  const drop::StepRecord& step = record.steps[static_cast<std::size_t>(column)];
  const auto corner = static_cast<std::size_t>(step.corner);
  const auto [x, y] = corner_positions(record.trajectory.q_at(column), p)[corner];
  ContactRecord result;
  result.contact.normal = {0.0, 1.0};
  result.contact.point_a = {x, y - step.gap};
  result.contact.point_b = {x, y};
  result.contact.gap = step.gap;
  result.contact.radius_a = std::numeric_limits<double>::infinity();
  result.contact.feature = static_cast<std::uint32_t>(step.corner);
  result.contact.body_b = 1;
  result.law = {p.mu, p.mu, p.eps};
  const drop::Jacobian J = drop::get_contacts(record.trajectory.q_at(column), p).J;
  const Vector3 before = record.trajectory.v_at(column), after = record.trajectory.v_at(column + 1);
  result.normal_velocity = dot(J.n, before);
  result.tangential_velocity = dot(J.t, before);
  result.normal_velocity_after = dot(J.n, after);
  result.tangential_velocity_after = dot(J.t, after);
  result.restitution = p.eps;
  result.normal_impulse = step.z[0] * p.dt;
  result.friction_impulse = (step.z[2] - step.z[1]) * p.dt;
  result.mode = step.mode;
  return result;
}

}  // namespace

Scene drop_scene(const Vector3& q0, const Vector3& v0, const drop::Parameters& parameters) {
  const drop::Parameters& p = parameters;
  Scene scene;
  scene.title = tumble::format("Drop of a square of side {:.6g} m", p.l);
  scene.materials = {{"default", {p.mu, p.mu, p.eps}}};
  scene.gravity = {0.0, -p.g};
  scene.step_size = p.dt;
  scene.duration = (p.columns - 1) * p.dt;
  Body floor;
  floor.name = "floor";
  floor.kind = BodyKind::fixed;
  floor.parts.push_back({HalfPlane{{0.0, 1.0}, 0.0}});
  Body square;
  square.name = "square";
  const double h = 0.5 * p.l;
  square.parts.push_back({RoundedPolygon{{{-h, -h}, {h, -h}, {h, h}, {-h, h}}}});
  square.mass = p.m;
  square.moment_of_inertia = p.m * p.l * p.l / 6.0;
  square.pose = {{q0[0], q0[1]}, q0[2]};
  square.velocity = v0;
  scene.bodies = {floor, square};
  return scene;
}

Trajectory trajectory_of(const drop::Record& record) {
  check_record(record);
  Trajectory trajectory;
  trajectory.scene = drop_scene(record.trajectory.q_at(0), record.trajectory.v_at(0), record.parameters);
  trajectory.step_size = record.parameters.dt;
  const int columns = record.trajectory.columns;
  for (int k = 0; k < columns; ++k) {
    const Vector3 q = record.trajectory.q_at(k);
    trajectory.time.push_back(k * record.parameters.dt);
    trajectory.states.push_back({});
    trajectory.states.push_back({{{q[0], q[1]}, q[2]}, record.trajectory.v_at(k)});
    EnergyLedger energy;
    energy.kinetic = kinetic_at(record, k);
    energy.potential = potential_at(record, k);
    trajectory.energy.push_back(energy);
    const drop::StepRecord& step = record.steps[static_cast<std::size_t>(k)];
    const bool is_at_work = step.z[0] > 0.0 && step.status == LcpStatus::solved;
    if (is_at_work && k + 1 < columns) trajectory.contacts.push_back({k + 1, {contact_of(record, k)}});
  }
  trajectory.num_steps = columns - 1;
  trajectory.status = record.trajectory.status;
  trajectory.is_complete = columns == record.parameters.columns;
  return trajectory;
}

}  // namespace tumble::output
