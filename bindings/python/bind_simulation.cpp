// tumble._core: a scene step by step, with forces and motions from outside. Public face: tumble/_simulation.py.
#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "convert_trajectory.hpp"

#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"

namespace tumble::python {
namespace {

using namespace py::literals;
using Index = std::size_t;

// What was set from outside, in place of what the scene says of a body.
struct Orders {
  std::vector<Wrench> wrenches;  // dynamic bodies
  Pose pose;                     // kinematic bodies: where it would have been at time 0, and its velocity
  Vector3 velocity{};
};

// All that the next steps depend on.
struct Snapshot {
  State state;
  std::int64_t step = 0;
  std::map<int, Orders> orders;  // by body
};

// Sets a flag as long as it lives.
struct Busy {
  explicit Busy(bool& flag_of) : flag(flag_of) { flag = true; }
  ~Busy() { flag = false; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;
  bool& flag;
};

class Stepper {
 public:
  Stepper(const SceneHandle& scene, double step_size, const StepSettings& settings)
      : scene_(scene), now_(scene.scene), step_size_(step_size), settings_(settings), workspace_(now_) {
    reset();
  }

  void reset() { restore({initial_state(scene_.scene), 0, {}}); }

  const Snapshot& snapshot() const { return snapshot_; }

  void restore(const Snapshot& snapshot) {
    require_idle();
    if (snapshot.state.bodies.size() != now_.bodies.size()) {
      throw std::invalid_argument(tumble::format("state: must be of a scene of {} bodies, got {}", now_.bodies.size(),
                                                 snapshot.state.bodies.size()));
    }
    for (const auto& [body, orders] : snapshot_.orders) now_.bodies[as_index(body)] = start_of(body);
    snapshot_ = snapshot;
    for (const auto& [body, orders] : snapshot_.orders) obey(body, orders);
    report_ = {};
    report_.energy = energies(now_, snapshot_.state);
  }

  // Up to `steps` steps; ends with the first one that is not solved. Energies are summed over them.
  LcpStatus advance(int steps) {
    using Clock = std::chrono::steady_clock;
    require_idle();
    const Busy busy(is_busy_);
    EnergyLedger sum;
    report_.status = LcpStatus::solved;
    bool is_interrupted = false;
    for (int done = 0; done < steps && report_.status == LcpStatus::solved && !is_interrupted;) {
      {
        const py::gil_scoped_release without_gil;
        const auto end = Clock::now() + std::chrono::milliseconds(50);
        do {
          step(sum);
          ++done;
        } while (done < steps && report_.status == LcpStatus::solved && Clock::now() < end);
      }
      is_interrupted = done < steps && PyErr_CheckSignals() != 0;
    }
    report_.energy = sum;
    if (is_interrupted) throw py::error_already_set();
    return report_.status;
  }

  // Moves a body; what its contacts did before is forgotten.
  void set_pose(int body, const Pose& pose) {
    require_idle();
    BodyState& state = snapshot_.state.bodies[as_index(body)];
    if (kind_of(body) == BodyKind::fixed) refuse_kind("pose", "fixed bodies stay where they are", body);
    state.pose = pose;
    if (kind_of(body) == BodyKind::kinematic) drive(body, state.velocity);
    std::erase_if(snapshot_.state.contacts,
                  [&](const ContactMemory& c) { return c.body_a == body || c.body_b == body; });
    report_.energy = energies(now_, snapshot_.state);
  }

  void set_velocity(int body, const Vector3& velocity) {
    require_idle();
    if (kind_of(body) == BodyKind::fixed) refuse_kind("velocity", "fixed bodies have none", body);
    snapshot_.state.bodies[as_index(body)].velocity = velocity;
    if (kind_of(body) == BodyKind::kinematic) drive(body, velocity);
    report_.energy = energies(now_, snapshot_.state);
  }

  void set_wrench(int body, const Wrench& wrench) {
    require_idle();
    if (kind_of(body) != BodyKind::dynamic) refuse_kind("force", "only dynamic bodies feel it", body);
    Orders& orders = snapshot_.orders[body];
    orders.wrenches = {wrench};
    obey(body, orders);
  }

  const SceneHandle& scene() const { return scene_; }
  const StepReport& report() const { return report_; }
  double step_size() const { return step_size_; }

 private:
  static Index as_index(int body) { return static_cast<Index>(body); }
  const Body& start_of(int body) const { return scene_.scene.bodies[as_index(body)]; }
  BodyKind kind_of(int body) const { return start_of(body).kind; }

  [[noreturn]] void refuse_kind(const char* field, const char* why, int body) const {
    const std::string& name = start_of(body).name;
    throw std::invalid_argument(tumble::format("{}: {}, got body {}", field, why,
                                               name.empty() ? std::to_string(body) : tumble::format("'{}'", name)));
  }

  void require_idle() const {
    if (is_busy_) throw std::runtime_error("simulation: is being advanced by another thread");
  }

  // From now on the kinematic body keeps this velocity.
  void drive(int body, const Vector3& velocity) {
    const Pose& now = snapshot_.state.bodies[as_index(body)].pose;
    const double time = snapshot_.state.time;
    Orders& orders = snapshot_.orders[body];
    orders.velocity = velocity;
    orders.pose = {now.position - time * Vector2{velocity[0], velocity[1]}, now.angle - time * velocity[2]};
    obey(body, orders);
  }

  void obey(int body, const Orders& orders) {
    Body& now = now_.bodies[as_index(body)];
    now.wrenches = orders.wrenches;
    if (now.kind != BodyKind::kinematic) return;
    now.motion.clear();
    now.pose = orders.pose;
    now.velocity = orders.velocity;
  }

  void step(EnergyLedger& sum) {
    State& state = snapshot_.state;
    time_step(now_, step_size_, settings_, state, workspace_, &report_);
    state.time = static_cast<double>(++snapshot_.step) * step_size_;
    add_step(sum, report_.energy);
  }

  const SceneHandle scene_;  // as it was given
  Scene now_;                // with the orders
  double step_size_;
  StepSettings settings_;
  StepWorkspace workspace_;  // of now_
  Snapshot snapshot_;
  StepReport report_;
  bool is_busy_ = false;
};

Vector3 as_velocity(const py::handle& velocity, const py::handle& angular_velocity, const Vector3& otherwise) {
  Vector3 value = otherwise;
  if (!velocity.is_none()) {
    const Vector2 v = as_vector2(k_speed_range, velocity, "velocity");
    value = {v.x, v.y, value[2]};
  }
  if (!angular_velocity.is_none()) {
    value[2] = as_number_in(k_angular_velocity_range, angular_velocity, "angular_velocity");
  }
  return value;
}

py::array_t<double> poses(const State& state) {
  std::vector<double> values;
  for (const BodyState& b : state.bodies)
    values.insert(values.end(), {b.pose.position.x, b.pose.position.y, b.pose.angle});
  return to_numpy(values, static_cast<py::ssize_t>(state.bodies.size()), 3);
}

py::array_t<double> velocities(const State& state) {
  std::vector<double> values;
  for (const BodyState& b : state.bodies) values.insert(values.end(), b.velocity.begin(), b.velocity.end());
  return to_numpy(values, static_cast<py::ssize_t>(state.bodies.size()), 3);
}

std::unique_ptr<Stepper> make_stepper(const SceneHandle& scene, const py::handle& step_size, const py::handle& solver,
                                      const py::handle& num_sweeps) {
  const double h =
      step_size.is_none() ? scene.scene.step_size : as_number_in(k_step_size_range, step_size, "step_size");
  return std::make_unique<Stepper>(scene, h, as_step_settings(solver, num_sweeps));
}

void set_pose(Stepper& stepper, int body, const py::handle& position, const py::handle& angle) {
  Pose pose = stepper.snapshot().state.bodies[static_cast<Index>(body)].pose;
  if (!position.is_none()) pose.position = as_vector2(k_coordinate_range, position, "position");
  if (!angle.is_none()) pose.angle = as_angle(angle, "angle");
  stepper.set_pose(body, pose);
}

}  // namespace

void bind_simulation(py::module_& module) {
  py::class_<Snapshot>(module, "Snapshot").def_property_readonly("time", [](const Snapshot& s) {
    return s.state.time;
  });
  py::class_<Stepper>(module, "Stepper")
      .def(py::init(&make_stepper), "scene"_a, "step_size"_a, "solver"_a, "num_sweeps"_a)
      .def("reset", &Stepper::reset)
      .def("snapshot", [](const Stepper& s) { return s.snapshot(); })
      .def("restore", &Stepper::restore, "snapshot"_a)
      .def(
          "advance",
          [](Stepper& s, const py::object& steps) {
            return py::str(to_string(s.advance(as_positive_count(steps, "steps"))));
          },
          "steps"_a)
      .def("set_pose", &set_pose, "body"_a, "position"_a, "angle"_a)
      .def(
          "set_velocity",
          [](Stepper& s, int body, const py::object& velocity, const py::object& angular_velocity) {
            const Vector3& now = s.snapshot().state.bodies[static_cast<Index>(body)].velocity;
            s.set_velocity(body, as_velocity(velocity, angular_velocity, now));
          },
          "body"_a, "velocity"_a, "angular_velocity"_a)
      .def(
          "set_wrench",
          [](Stepper& s, int body, const py::object& force, const py::object& torque) {
            s.set_wrench(
                body, {0.0, as_vector2(k_force_range, force, "force"), as_number_in(k_torque_range, torque, "torque")});
          },
          "body"_a, "force"_a, "torque"_a)
      .def("scene", [](const Stepper& s) { return s.scene(); })
      .def("pose", [](const Stepper& s) { return poses(s.snapshot().state); })
      .def("velocity", [](const Stepper& s) { return velocities(s.snapshot().state); })
      .def("energy", [](const Stepper& s) { return to_numpy(std::span(&s.report().energy, 1)); })
      .def("contacts",
           [](const Stepper& s) {
             const StepContacts step{s.snapshot().step, s.report().contacts};
             return to_numpy(std::span(&step, 1), s.step_size());
           })
      .def_property_readonly("time", [](const Stepper& s) { return s.snapshot().state.time; })
      .def_property_readonly("num_steps", [](const Stepper& s) { return s.snapshot().step; })
      .def_property_readonly("step_size", &Stepper::step_size)
      .def_property_readonly("status", [](const Stepper& s) { return py::str(to_string(s.report().status)); })
      .def_property_readonly("residual", [](const Stepper& s) { return s.report().residual; });
}

}  // namespace tumble::python
