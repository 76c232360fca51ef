#include "tumble/output/trajectory_csv.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"
#include "tumble/output/csv_reader.hpp"
#include "tumble/output/trajectory_fields.hpp"
#include "tumble/trajectory/simulate.hpp"

namespace tumble::output {
namespace {

constexpr std::string_view k_first_contact_columns =
    "step,t [s],body_a,body_b,part_a,part_b,feature,mode,x_a [m],y_a [m],x_b [m],y_b [m],normal_x,normal_y";

// A cell of a word, which may hold commas [RFC 4180].
std::string cell(std::string_view word) {
  if (word.find_first_of(",\"") == std::string_view::npos) return std::string(word);
  std::string quoted;
  for (const char c : word) quoted.append(c == '"' ? 2 : 1, c);
  return tumble::format("\"{}\"", quoted);
}

std::string comments(const Trajectory& trajectory, std::string_view table) {
  return tumble::format(
      "# tumble {} 1\n# title = {}\n# step_size = {} s\n# steps = {}\n# status = {}\n# residual = {}\n# complete = {}\n"
      "# created_energy = {} J\n",
      table, trajectory.scene.title, to_text(trajectory.step_size), trajectory.num_steps, to_string(trajectory.status),
      to_text(trajectory.residual), trajectory.is_complete ? "yes" : "no", to_text(trajectory.created_energy));
}

std::string sample_columns(const Scene& scene) {
  std::string text = "t [s]";
  for (const EnergyField& field : k_energy_fields) text += tumble::format(",{} [J]", field.name);
  const std::vector<std::string> labels = body_labels(scene);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (scene.bodies[i].kind == BodyKind::fixed) continue;
    for (const char* column : {"x [m]", "y [m]", "angle [rad]", "vx [m/s]", "vy [m/s]", "omega [rad/s]"}) {
      text.append(",").append(cell(tumble::format("{}.{}", labels[i], column)));
    }
  }
  return text;
}

std::string contact_columns() {
  std::string text(k_first_contact_columns);
  for (const ContactField& field : k_contact_fields) {
    text +=
        *field.unit == '\0' ? tumble::format(",{}", field.name) : tumble::format(",{} [{}]", field.name, field.unit);
  }
  return text;
}

void append(std::string& row, double value) { row.append(",").append(to_text(value)); }
void append(std::string& row, Vector2 value) {
  append(row, value.x);
  append(row, value.y);
}

// ---- Reading ----

using Labels = std::map<std::string, int, std::less<>>;  // index of each body

Labels index_of_labels(const Scene& scene) {
  Labels indices;
  int index = 0;
  for (const std::string& label : body_labels(scene)) indices[label] = index++;
  return indices;
}

// All of `comments`, in its order.
void parse_comments(LineReader& lines, Trajectory& trajectory) {
  lines.expect("# tumble samples 1");
  lines.expect(tumble::format("# title = {}", trajectory.scene.title));
  trajectory.step_size = lines.number("step_size", "s");
  if (!(trajectory.step_size > 0.0) || std::isinf(trajectory.step_size)) {
    lines.refuse(1, tumble::format("step_size: must be finite and > 0, got {}", trajectory.step_size));
  }
  trajectory.num_steps = lines.whole("steps", std::int64_t{0}, static_cast<std::int64_t>(k_max_steps));
  trajectory.status = lines.word("status", k_lcp_statuses);
  trajectory.residual = lines.number("residual", "");
  trajectory.is_complete = lines.yes_or_no("complete");
  trajectory.created_energy = lines.number("created_energy", "J");
}

Vector2 parse_vector(Row& row) {
  const double x = row.number();
  return {x, row.number()};
}

void parse_sample(Row row, Trajectory& trajectory) {
  const Row::Cell time = Row(row).next();
  const double t = row.number();
  const std::vector<double>& before = trajectory.time;
  if (before.empty() ? t != 0.0 : t <= before.back()) {
    row.refuse(time, before.empty() ? "must be 0, the start" : tumble::format("must be > {}", before.back()));
  }
  EnergyLedger energy;
  for (const EnergyField& field : k_energy_fields) energy.*field.member = row.number();
  std::vector<BodyState> bodies;
  for (const Body& body : trajectory.scene.bodies) {
    BodyState state{body.pose, {}};
    if (body.kind != BodyKind::fixed) {
      state.pose.position = parse_vector(row);
      state.pose.angle = row.number();
      for (double& value : state.velocity) value = row.number();
    }
    bodies.push_back(state);
  }
  trajectory.time.push_back(t);
  trajectory.energy.push_back(energy);
  trajectory.states.insert(trajectory.states.end(), bodies.begin(), bodies.end());
}

void parse_samples(LineReader& lines, Trajectory& trajectory) {
  parse_comments(lines, trajectory);
  const std::int64_t count = lines.whole("samples", std::int64_t{1}, trajectory.num_steps + 1);
  const std::string columns = sample_columns(trajectory.scene);
  const std::vector<std::string> names = column_names(columns);
  lines.check_room("samples", static_cast<std::size_t>(count), names.size());
  lines.expect_columns(columns);
  for (std::int64_t k = 0; k < count; ++k) {
    parse_sample(Row(lines, names, lines.next(tumble::format("sample {} of {}", k + 1, count))), trajectory);
  }
  lines.expect_end(static_cast<std::size_t>(count));
}

// A body named by its label; index above `low`.
int parse_body(Row& row, const Labels& labels, int low) {
  const Row::Cell cell = row.next();
  const auto found = labels.find(unquoted(cell.text));
  if (found == labels.end()) row.refuse(cell, "must be the name of a body of the scene");
  if (found->second <= low) row.refuse(cell, "must stand behind body_a in the scene");
  return found->second;
}

int parse_part(Row& row, const Body& body) { return row.whole(0, static_cast<int>(body.parts.size()) - 1); }

void parse_contact(Row row, const Labels& labels, Trajectory& trajectory) {
  std::vector<StepContacts>& steps = trajectory.contacts;
  const std::int64_t step =
      row.whole(steps.empty() ? std::int64_t{1} : steps.back().step, std::int64_t{trajectory.num_steps});
  row.time(static_cast<double>(step) * trajectory.step_size, "step times step_size");
  ContactRecord record;
  Contact& contact = record.contact;
  contact.body_a = parse_body(row, labels, -1);
  contact.body_b = parse_body(row, labels, contact.body_a);
  const std::vector<Body>& bodies = trajectory.scene.bodies;
  contact.part_a = parse_part(row, bodies[static_cast<std::size_t>(contact.body_a)]);
  contact.part_b = parse_part(row, bodies[static_cast<std::size_t>(contact.body_b)]);
  contact.feature = row.whole(std::uint32_t{0}, std::numeric_limits<std::uint32_t>::max());
  record.mode = row.word(k_contact_modes);
  record.place_a = contact.point_a = parse_vector(row);
  record.place_b = contact.point_b = parse_vector(row);
  contact.normal = parse_vector(row);
  record.tangent = turned_right(contact.normal);
  for (const ContactField& field : k_contact_fields) *field.place(record) = row.number();
  if (steps.empty() || steps.back().step != step) steps.push_back({step, {}});
  steps.back().contacts.push_back(record);
}

void parse_contacts(LineReader& lines, Trajectory& trajectory) {
  // The same run as that of the samples, so the same comments.
  const std::string header = comments(trajectory, "contacts");
  for (std::string_view rest = header; !rest.empty();) {
    const std::size_t end = rest.find('\n');
    lines.expect(rest.substr(0, end));
    rest.remove_prefix(end + 1);
  }
  const std::string columns = contact_columns();
  lines.expect_columns(columns);
  const std::vector<std::string> names = column_names(columns);
  const Labels labels = index_of_labels(trajectory.scene);
  while (!lines.is_at_end()) parse_contact(Row(lines, names, lines.next("a contact")), labels, trajectory);
}

}  // namespace

std::string samples_csv_header(const Trajectory& trajectory) {
  return tumble::format("{}# samples = {}\n{}\n", comments(trajectory, "samples"), trajectory.time.size(),
                        sample_columns(trajectory.scene));
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
  return comments(trajectory, "contacts") + contact_columns() + '\n';
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
      text +=
          tumble::format("{},{},{},{},{},{},{},{}", step.step, time, labels[static_cast<std::size_t>(contact.body_a)],
                         labels[static_cast<std::size_t>(contact.body_b)], contact.part_a, contact.part_b,
                         contact.feature, to_string(record.mode));
      for (const Vector2 value : {contact.point_a, contact.point_b, contact.normal}) append(text, value);
      for (const ContactField& field : k_contact_fields) append(text, field.value(record));
      text += '\n';
    }
  }
  return text;
}

Trajectory parse_trajectory_csv(Scene scene, std::string_view samples, const std::string& samples_name,
                                std::string_view contacts, const std::string& contacts_name) {
  validate(scene);
  Trajectory trajectory;
  trajectory.scene = std::move(scene);
  LineReader lines(samples, samples_name);
  parse_samples(lines, trajectory);
  if (!contacts.empty()) {
    LineReader contact_lines(contacts, contacts_name);
    parse_contacts(contact_lines, trajectory);
  }
  return trajectory;
}

}  // namespace tumble::output
