// tumble._core: whole runs of scenes and what they give. Public face: tumble/_simulate.py, tumble/_trajectory.py.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "convert_trajectory.hpp"

#include "tumble/lcp/one_contact.hpp"
#include "tumble/math/format.hpp"
#include "tumble/scene/suggestion.hpp"
#include "tumble/trajectory/simulate.hpp"

namespace tumble::python {
namespace {

using namespace py::literals;

// A row of the contact table: the fields of ContactRecord, flat.
struct ContactRow {
  std::int64_t step;
  double time;  // at its end
  std::int32_t body_a, body_b, part_a, part_b;
  std::uint32_t feature;
  std::array<char32_t, 11> mode;  // ends the 8 bytes begun by feature
  std::array<double, 2> point_a, point_b, normal;
  double gap, normal_velocity, tangential_velocity, normal_velocity_after, tangential_velocity_after;
  double normal_impulse, friction_impulse, restitution, law_friction, law_static_friction, law_restitution;
};

py::dtype contact_dtype() {
  constexpr std::array fields = {
      Field{"step", "i8", offsetof(ContactRow, step)},
      Field{"time", "f8", offsetof(ContactRow, time)},
      Field{"body_a", "i4", offsetof(ContactRow, body_a)},
      Field{"body_b", "i4", offsetof(ContactRow, body_b)},
      Field{"part_a", "i4", offsetof(ContactRow, part_a)},
      Field{"part_b", "i4", offsetof(ContactRow, part_b)},
      Field{"feature", "u4", offsetof(ContactRow, feature)},
      Field{"mode", "U11", offsetof(ContactRow, mode)},
      Field{"point_a", "2f8", offsetof(ContactRow, point_a)},
      Field{"point_b", "2f8", offsetof(ContactRow, point_b)},
      Field{"normal", "2f8", offsetof(ContactRow, normal)},
      Field{"gap", "f8", offsetof(ContactRow, gap)},
      Field{"normal_velocity", "f8", offsetof(ContactRow, normal_velocity)},
      Field{"tangential_velocity", "f8", offsetof(ContactRow, tangential_velocity)},
      Field{"normal_velocity_after", "f8", offsetof(ContactRow, normal_velocity_after)},
      Field{"tangential_velocity_after", "f8", offsetof(ContactRow, tangential_velocity_after)},
      Field{"normal_impulse", "f8", offsetof(ContactRow, normal_impulse)},
      Field{"friction_impulse", "f8", offsetof(ContactRow, friction_impulse)},
      Field{"restitution", "f8", offsetof(ContactRow, restitution)},
      Field{"law_friction", "f8", offsetof(ContactRow, law_friction)},
      Field{"law_static_friction", "f8", offsetof(ContactRow, law_static_friction)},
      Field{"law_restitution", "f8", offsetof(ContactRow, law_restitution)},
  };
  return dtype_of(fields, sizeof(ContactRow));
}

py::dtype energy_dtype() {
  constexpr std::array fields = {
      Field{"kinetic", "f8", offsetof(EnergyLedger, kinetic)},
      Field{"potential", "f8", offsetof(EnergyLedger, potential)},
      Field{"external_work", "f8", offsetof(EnergyLedger, external_work)},
      Field{"friction_loss", "f8", offsetof(EnergyLedger, friction_loss)},
      Field{"impact_loss", "f8", offsetof(EnergyLedger, impact_loss)},
      Field{"damping_loss", "f8", offsetof(EnergyLedger, damping_loss)},
      Field{"stabilisation_work", "f8", offsetof(EnergyLedger, stabilisation_work)},
      Field{"created", "f8", offsetof(EnergyLedger, created)},
  };
  return dtype_of(fields, sizeof(EnergyLedger));
}

std::array<double, 2> as_pair(Vector2 v) { return {v.x, v.y}; }

ContactRow as_row(const ContactRecord& record, std::int64_t step, double time) {
  const Contact& contact = record.contact;
  ContactRow row{};
  row.step = step;
  row.time = time;
  row.body_a = contact.body_a;
  row.body_b = contact.body_b;
  row.part_a = contact.part_a;
  row.part_b = contact.part_b;
  row.feature = contact.feature;
  const std::string_view mode = to_string(record.mode);
  std::copy(mode.begin(), mode.end(), row.mode.begin());
  row.point_a = as_pair(contact.point_a);
  row.point_b = as_pair(contact.point_b);
  row.normal = as_pair(contact.normal);
  row.gap = contact.gap;
  row.normal_velocity = record.normal_velocity;
  row.tangential_velocity = record.tangential_velocity;
  row.normal_velocity_after = record.normal_velocity_after;
  row.tangential_velocity_after = record.tangential_velocity_after;
  row.normal_impulse = record.normal_impulse;
  row.friction_impulse = record.friction_impulse;
  row.restitution = record.restitution;
  row.law_friction = record.law.friction;
  row.law_static_friction = record.law.static_friction;
  row.law_restitution = record.law.restitution;
  return row;
}

// (T, B, 3), a view of the three numbers that begin `offset` bytes into each state.
py::array states_view(const py::object& self, std::size_t offset) {
  static_assert(sizeof(BodyState) == 6 * sizeof(double) && sizeof(Pose) == 3 * sizeof(double));
  const auto& trajectory = self.cast<const Trajectory&>();
  const auto samples = static_cast<py::ssize_t>(trajectory.time.size());
  const auto bodies = static_cast<py::ssize_t>(trajectory.scene.bodies.size());
  constexpr auto stride = static_cast<py::ssize_t>(sizeof(BodyState));
  const auto* first = reinterpret_cast<const char*>(trajectory.states.data()) + offset;
  return read_only(py::array(py::dtype::of<double>(), {samples, bodies, py::ssize_t{3}},
                             {bodies * stride, stride, py::ssize_t{sizeof(double)}}, first, self));
}

using TrajectoryClass = py::class_<Trajectory, std::shared_ptr<Trajectory>>;

void bind_trajectory_class(py::module_& module) {
  TrajectoryClass(module, "Trajectory")
      .def("scene", [](const Trajectory& t) { return handle_of(t.scene); })
      .def("time",
           [](const py::object& self) {
             const std::vector<double>& time = self.cast<const Trajectory&>().time;
             return read_only(py::array_t<double>(static_cast<py::ssize_t>(time.size()), time.data(), self));
           })
      .def("pose", [](const py::object& self) { return states_view(self, offsetof(BodyState, pose)); })
      .def("velocity", [](const py::object& self) { return states_view(self, offsetof(BodyState, velocity)); })
      .def("energy", [](const py::object& self) { return to_numpy(self.cast<const Trajectory&>().energy, self); })
      .def("contacts", [](const Trajectory& t) { return to_numpy(t.contacts, t.step_size); })
      .def_readonly("step_size", &Trajectory::step_size)
      .def_readonly("num_steps", &Trajectory::num_steps)
      .def_property_readonly("status", [](const Trajectory& t) { return py::str(to_string(t.status)); })
      .def_readonly("residual", &Trajectory::residual)
      .def_readonly("num_inexact_steps", &Trajectory::num_inexact_steps)
      .def_readonly("first_inexact", &Trajectory::first_inexact)
      .def_readonly("is_complete", &Trajectory::is_complete)
      .def_readonly("num_creating_steps", &Trajectory::num_creating_steps)
      .def_readonly("created_energy", &Trajectory::created_energy)
      .def_readonly("first_creation", &Trajectory::first_creation);
}

SimulateSettings as_settings(const py::handle& step_size, const py::handle& duration, const py::handle& sample_every,
                             const py::handle& solver, const py::handle& num_sweeps, const py::handle& contacts) {
  SimulateSettings settings;
  if (!step_size.is_none()) settings.step_size = as_number_in(k_step_size_range, step_size, "step_size");
  if (!duration.is_none()) settings.duration = as_number_in(k_duration_range, duration, "duration");
  settings.sample_every = as_positive_count(sample_every, "sample_every");
  settings.keeps_contacts = as_flag(contacts, "contacts");
  settings.step = as_step_settings(solver, num_sweeps);
  return settings;
}

// A run that is advanced for some time and then looked at: for Ctrl-C, and for showing how far it is.
void run_for(Simulation& simulation, double seconds) {
  using Clock = std::chrono::steady_clock;
  const py::gil_scoped_release without_gil;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  while (!simulation.is_done() && Clock::now() < end) simulation.advance();
}

}  // namespace

StepSettings as_step_settings(const py::handle& solver, const py::handle& num_sweeps) {
  constexpr std::array<std::string_view, 2> words = {"exact", "fast"};
  const std::string word = as_text(solver, "solver");
  if (word != words[0] && word != words[1]) {
    throw std::invalid_argument(
        tumble::format("solver: must be the name of a solver, got {}{}", shown(word), suggestion(word, words)));
  }
  return {word == words[0] ? ContactSolver::exact : ContactSolver::fast, as_positive_count(num_sweeps, "num_sweeps")};
}

int as_whole_number(const py::handle& object, const char* field, int low, int high) {
  const bool is_whole = PyIndex_Check(object.ptr()) && !PyBool_Check(object.ptr());
  const long value =
      is_whole ? PyLong_AsLong(py::reinterpret_steal<py::object>(PyNumber_Index(object.ptr())).ptr()) : -1;
  const bool is_long = is_whole && !PyErr_Occurred();
  PyErr_Clear();
  if (is_long && value >= low && value <= high) return static_cast<int>(value);
  throw std::invalid_argument(
      tumble::format("{}: must be a whole number in [{}, {}], got {}", field, low, high, short_repr(object)));
}

int as_positive_count(const py::handle& object, const char* field) {
  return as_whole_number(object, field, 1, std::numeric_limits<int>::max());
}

py::dtype dtype_of(std::span<const Field> fields, std::size_t size) {
  py::list names, formats, offsets;
  for (const Field& field : fields) {
    names.append(field.name);
    formats.append(field.format);
    offsets.append(field.offset);
  }
  return py::dtype(names, formats, offsets, static_cast<py::ssize_t>(size));
}

py::array to_numpy(std::span<const StepContacts> steps, double step_size) {
  static const auto* dtype = new py::dtype(contact_dtype());  // never freed: the interpreter may be gone by then
  std::size_t count = 0;
  for (const StepContacts& step : steps) count += step.contacts.size();
  py::array array(*dtype, static_cast<py::ssize_t>(count));
  auto* row = static_cast<ContactRow*>(array.mutable_data());
  for (const StepContacts& step : steps) {
    const double time = static_cast<double>(step.step) * step_size;
    for (const ContactRecord& record : step.contacts) *row++ = as_row(record, step.step, time);
  }
  return read_only(std::move(array));
}

py::array to_numpy(std::span<const EnergyLedger> rows, const py::handle& owner) {
  static const auto* dtype = new py::dtype(energy_dtype());
  return read_only(py::array(*dtype, static_cast<py::ssize_t>(rows.size()), rows.data(), owner));
}

void bind_trajectory(py::module_& module) {
  bind_trajectory_class(module);
  py::class_<Simulation>(module, "Run")
      .def(py::init([](const SceneHandle& scene, const py::object& step_size, const py::object& duration,
                       const py::object& sample_every, const py::object& solver, const py::object& num_sweeps,
                       const py::object& contacts) {
             return std::make_unique<Simulation>(
                 scene.scene, as_settings(step_size, duration, sample_every, solver, num_sweeps, contacts));
           }),
           "scene"_a, "step_size"_a, "duration"_a, "sample_every"_a, "solver"_a, "num_sweeps"_a, "contacts"_a)
      .def("run_for", &run_for, "seconds"_a)
      .def_property_readonly("is_done", &Simulation::is_done)
      .def_property_readonly("time", &Simulation::time)
      .def_property_readonly("step", &Simulation::step)
      .def_property_readonly("num_steps", &Simulation::num_steps)
      .def("finish", [](Simulation& simulation) { return std::make_shared<Trajectory>(simulation.finish()); });
}

}  // namespace tumble::python
