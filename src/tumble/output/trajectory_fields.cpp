#include "tumble/output/trajectory_fields.hpp"

#include <stdexcept>

#include "tumble/math/format.hpp"
#include "tumble/scene/scene_toml.hpp"

namespace tumble::output {
namespace {

constexpr int k_format_version = 1;

using Codes = std::vector<std::int32_t>;
using Numbers = std::vector<std::int64_t>;

// A value of each contact at work, one after the other.
template <class Value, class Get>
std::vector<Value> collect(const Trajectory& trajectory, Get get) {
  std::vector<Value> values;
  for (const StepContacts& step : trajectory.contacts) {
    for (const ContactRecord& record : step.contacts) values.push_back(static_cast<Value>(get(step, record)));
  }
  return values;
}

template <class Get>
std::vector<double> collect_vectors(const Trajectory& trajectory, Get get) {
  std::vector<double> values;
  for (const StepContacts& step : trajectory.contacts) {
    for (const ContactRecord& record : step.contacts) {
      const Vector2 vector = get(record.contact);
      values.insert(values.end(), {vector.x, vector.y});
    }
  }
  return values;
}

void add_samples(const Trajectory& trajectory, std::vector<Field>& fields) {
  const std::size_t T = trajectory.time.size(), B = trajectory.scene.bodies.size();
  std::vector<double> pose, velocity;
  pose.reserve(3 * T * B);
  velocity.reserve(3 * T * B);
  for (const BodyState& state : trajectory.states) {
    const auto& [position, angle] = state.pose;
    pose.insert(pose.end(), {position.x, position.y, angle});
    velocity.insert(velocity.end(), state.velocity.begin(), state.velocity.end());
  }
  fields.push_back({"time", "s", {T}, trajectory.time});
  fields.push_back({"pose", "m, m, rad", {T, B, 3}, std::move(pose)});
  fields.push_back({"velocity", "m/s, m/s, rad/s", {T, B, 3}, std::move(velocity)});
  for (const EnergyField& field : k_energy_fields) {
    std::vector<double> values;
    for (const EnergyLedger& energy : trajectory.energy) values.push_back(energy.*field.member);
    fields.push_back({field.name, "J", {T}, std::move(values)});
  }
}

// Row k of the offsets and row k + 1 enclose the contacts of step k + 1.
Numbers contact_offsets(const Trajectory& trajectory) {
  Numbers offsets(static_cast<std::size_t>(trajectory.num_steps) + 1, 0);
  for (const StepContacts& step : trajectory.contacts) {
    offsets[static_cast<std::size_t>(step.step)] = static_cast<std::int64_t>(step.contacts.size());
  }
  for (std::size_t k = 1; k < offsets.size(); ++k) offsets[k] += offsets[k - 1];
  return offsets;
}

void add_contacts(const Trajectory& trajectory, std::vector<Field>& fields) {
  Numbers offsets = contact_offsets(trajectory);
  const auto N = static_cast<std::size_t>(offsets.back());
  const auto add_shaped = [&](const char* name, const char* unit, std::vector<std::size_t> shape, auto values) {
    fields.push_back({tumble::format("contact_{}", name), unit, std::move(shape), std::move(values)});
  };
  const auto add = [&](const char* name, const char* unit, auto values) {
    add_shaped(name, unit, {N}, std::move(values));
  };
  using Step = StepContacts;
  using Record = ContactRecord;
  fields.push_back({"contact_offsets", "", {offsets.size()}, std::move(offsets)});
  add("step", "", collect<std::int64_t>(trajectory, [](const Step& s, const Record&) { return s.step; }));
  add("body_a", "", collect<std::int32_t>(trajectory, [](const Step&, const Record& r) { return r.contact.body_a; }));
  add("body_b", "", collect<std::int32_t>(trajectory, [](const Step&, const Record& r) { return r.contact.body_b; }));
  add("part_a", "", collect<std::int32_t>(trajectory, [](const Step&, const Record& r) { return r.contact.part_a; }));
  add("part_b", "", collect<std::int32_t>(trajectory, [](const Step&, const Record& r) { return r.contact.part_b; }));
  add("feature", "", collect<std::int64_t>(trajectory, [](const Step&, const Record& r) { return r.contact.feature; }));
  add("mode", "",
      collect<std::int32_t>(trajectory, [](const Step&, const Record& r) { return static_cast<int>(r.mode); }));
  add_shaped("point_a", "m", {N, 2}, collect_vectors(trajectory, [](const Contact& c) { return c.point_a; }));
  add_shaped("point_b", "m", {N, 2}, collect_vectors(trajectory, [](const Contact& c) { return c.point_b; }));
  add_shaped("normal", "", {N, 2}, collect_vectors(trajectory, [](const Contact& c) { return c.normal; }));
  for (const ContactField& field : k_contact_fields) {
    add(field.name, field.unit,
        collect<double>(trajectory, [&](const Step&, const Record& record) { return field.value(record); }));
  }
}

bool is_of_scene(const Contact& contact, const Scene& scene) {
  const auto is_body = [&](int body, int part) {
    return body >= 0 && static_cast<std::size_t>(body) < scene.bodies.size() && part >= 0 &&
           static_cast<std::size_t>(part) < scene.bodies[static_cast<std::size_t>(body)].parts.size();
  };
  return is_body(contact.body_a, contact.part_a) && is_body(contact.body_b, contact.part_b);
}

}  // namespace

void check_trajectory(const Trajectory& trajectory) {
  const std::size_t T = trajectory.time.size(), B = trajectory.scene.bodies.size();
  if (T == 0 || trajectory.energy.size() != T || trajectory.states.size() != T * B) {
    throw std::invalid_argument(tumble::format(
        "trajectory: must have one or more times, as many energies and {} states for each, got {} times, "
        "{} energies and "
        "{} states",
        B, T, trajectory.energy.size(), trajectory.states.size()));
  }
  std::int64_t before = 0;
  for (const StepContacts& step : trajectory.contacts) {
    if (step.step <= before || step.step > trajectory.num_steps) {
      throw std::invalid_argument(tumble::format(
          "trajectory: contacts must be of steps in [1, {}], each later than the one before, got {} behind {}",
          trajectory.num_steps, step.step, before));
    }
    before = step.step;
    for (const ContactRecord& record : step.contacts) {
      if (is_of_scene(record.contact, trajectory.scene)) continue;
      throw std::invalid_argument(
          tumble::format("trajectory: a contact of step {} is of no body of the scene", step.step));
    }
  }
}

std::vector<Field> to_fields(const Trajectory& trajectory) {
  check_trajectory(trajectory);
  const std::vector<std::string> labels = body_labels(trajectory.scene);
  const std::vector<std::string> modes = names_of_codes<ContactMode>(static_cast<int>(k_contact_modes.size()));
  std::vector<Field> fields = {
      {"format_version", "", {}, Codes{k_format_version}},
      {"scene", "", {}, std::vector<std::string>{to_toml(trajectory.scene)}},
      {"body_names", "", {labels.size()}, labels},
      {"step_size", "s", {}, std::vector<double>{trajectory.step_size}},
      {"num_steps", "", {}, Numbers{trajectory.num_steps}},
      {"status", "", {}, std::vector<std::string>{std::string(to_string(trajectory.status))}},
      {"residual", "", {}, std::vector<double>{trajectory.residual}},
      {"num_inexact_steps", "", {}, Numbers{trajectory.num_inexact_steps}},
      {"first_inexact", "s", {}, std::vector<double>{trajectory.first_inexact}},
      {"is_complete", "", {}, Codes{trajectory.is_complete ? 1 : 0}},
      {"num_creating_steps", "", {}, Numbers{trajectory.num_creating_steps}},
      {"created_energy", "J", {}, std::vector<double>{trajectory.created_energy}},
      {"first_creation", "s", {}, std::vector<double>{trajectory.first_creation}},
      {"mode_names", "", {modes.size()}, modes},
  };
  add_samples(trajectory, fields);
  add_contacts(trajectory, fields);
  return fields;
}

}  // namespace tumble::output
