#include "tumble/output/trajectory_csv.hpp"

#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "tumble/math/numeric.hpp"
#include "tumble/output/trajectory_fields.hpp"

namespace tumble::output {
namespace {

constexpr std::string_view k_contact_columns =
    "step,t [s],body_a,body_b,part_a,part_b,feature,mode,x_a [m],y_a [m],x_b [m],y_b [m],normal_x,normal_y";

// A cell of a word, which may hold commas [RFC 4180].
std::string cell(std::string_view word) {
  if (word.find_first_of(",\"") == std::string_view::npos) return std::string(word);
  std::string quoted;
  for (const char c : word) quoted.append(c == '"' ? 2 : 1, c);
  return fmt::format("\"{}\"", quoted);
}

std::string comments(const Trajectory& trajectory, std::string_view table) {
  return fmt::format(
      "# tumble {} 1\n# title = {}\n# step_size = {} s\n# steps = {}\n# status = {}\n# residual = {}\n# complete = {}\n"
      "# created_energy = {} J\n",
      table, trajectory.scene.title, to_text(trajectory.step_size), trajectory.num_steps, to_string(trajectory.status),
      to_text(trajectory.residual), trajectory.is_complete ? "yes" : "no", to_text(trajectory.created_energy));
}

void append(std::string& row, double value) { row.append(",").append(to_text(value)); }
void append(std::string& row, Vector2 value) {
  append(row, value.x);
  append(row, value.y);
}

}  // namespace

std::string samples_csv_header(const Trajectory& trajectory) {
  std::string text = comments(trajectory, "samples") + fmt::format("# samples = {}\n", trajectory.time.size());
  text += "t [s]";
  for (const EnergyField& field : k_energy_fields) text += fmt::format(",{} [J]", field.name);
  const std::vector<std::string> labels = body_labels(trajectory.scene);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (trajectory.scene.bodies[i].kind == BodyKind::fixed) continue;
    for (const char* column : {"x [m]", "y [m]", "angle [rad]", "vx [m/s]", "vy [m/s]", "omega [rad/s]"}) {
      text.append(",").append(cell(fmt::format("{}.{}", labels[i], column)));
    }
  }
  return text + '\n';
}

std::string samples_csv_rows(const Trajectory& trajectory, std::size_t first, std::size_t last) {
  std::string text;
  for (std::size_t k = first; k < last; ++k) {
    text += to_text(trajectory.time[k]);
    for (const EnergyField& field : k_energy_fields) append(text, trajectory.energy[k].*field.member);
    for (std::size_t i = 0; i < trajectory.scene.bodies.size(); ++i) {
      if (trajectory.scene.bodies[i].kind == BodyKind::fixed) continue;
      const BodyState& body = trajectory.bodies(k)[i];
      append(text, body.pose.position);
      append(text, body.pose.angle);
      for (const double value : body.velocity) append(text, value);
    }
    text += '\n';
  }
  return text;
}

std::string contacts_csv_header(const Trajectory& trajectory) {
  std::string text = comments(trajectory, "contacts").append(k_contact_columns);
  for (const ContactField& field : k_contact_fields) {
    text += *field.unit == '\0' ? fmt::format(",{}", field.name) : fmt::format(",{} [{}]", field.name, field.unit);
  }
  return text + '\n';
}

std::string contacts_csv_rows(const Trajectory& trajectory, std::size_t first, std::size_t last) {
  std::vector<std::string> labels = body_labels(trajectory.scene);
  for (std::string& label : labels) label = cell(label);
  std::string text;
  for (std::size_t i = first; i < last; ++i) {
    const StepContacts& step = trajectory.contacts[i];
    const std::string time = to_text(static_cast<double>(step.step) * trajectory.step_size);
    for (const ContactRecord& record : step.contacts) {
      const Contact& contact = record.contact;
      text += fmt::format("{},{},{},{},{},{},{},{}", step.step, time, labels[static_cast<std::size_t>(contact.body_a)],
                          labels[static_cast<std::size_t>(contact.body_b)], contact.part_a, contact.part_b,
                          contact.feature, to_string(record.mode));
      for (const Vector2 value : {contact.point_a, contact.point_b, contact.normal}) append(text, value);
      for (const ContactField& field : k_contact_fields) append(text, field.value(record));
      text += '\n';
    }
  }
  return text;
}

}  // namespace tumble::output
