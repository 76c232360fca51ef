// tumble._core: many runs of a scene at once. Public face: tumble/_rollout.py.
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "convert_trajectory.hpp"
#include "without_gil.hpp"

#include "tumble/batch/rollout.hpp"
#include "tumble/math/format.hpp"

namespace tumble::python {
namespace {

using namespace py::literals;
using batch::Quantity;
using batch::RolloutMeasures;
using Index = std::size_t;

Quantity as_quantity(const std::string& name) {
  constexpr std::array names = {
      std::pair{"mass", Quantity::mass}, std::pair{"moment_of_inertia", Quantity::moment_of_inertia},
      std::pair{"friction", Quantity::friction}, std::pair{"static_friction", Quantity::static_friction},
      std::pair{"restitution", Quantity::restitution}};
  for (const auto& [word, quantity] : names) {
    if (name == word) return quantity;
  }
  throw std::invalid_argument(tumble::format("quantity: unknown, got {}", name));
}

py::dtype measures_dtype() {
  constexpr auto energy = offsetof(RolloutMeasures, energy);
  constexpr std::array fields = {
      Field{"residual", "f8", offsetof(RolloutMeasures, residual)},
      Field{"created_energy", "f8", offsetof(RolloutMeasures, created_energy)},
      Field{"last_contact", "f8", offsetof(RolloutMeasures, last_contact)},
      Field{"rest_time", "f8", offsetof(RolloutMeasures, rest_time)},
      Field{"max_impulse", "f8", offsetof(RolloutMeasures, max_impulse)},
      Field{"energy_lost", "f8", offsetof(RolloutMeasures, energy_lost)},
      Field{"escape_time", "f8", offsetof(RolloutMeasures, escape_time)},
      Field{"kinetic", "f8", energy + offsetof(EnergyLedger, kinetic)},
      Field{"potential", "f8", energy + offsetof(EnergyLedger, potential)},
      Field{"external_work", "f8", energy + offsetof(EnergyLedger, external_work)},
      Field{"friction_loss", "f8", energy + offsetof(EnergyLedger, friction_loss)},
      Field{"impact_loss", "f8", energy + offsetof(EnergyLedger, impact_loss)},
      Field{"damping_loss", "f8", energy + offsetof(EnergyLedger, damping_loss)},
      Field{"stabilisation_work", "f8", energy + offsetof(EnergyLedger, stabilisation_work)},
      Field{"num_steps", "i8", offsetof(RolloutMeasures, num_steps)},
      Field{"num_inexact_steps", "i8", offsetof(RolloutMeasures, num_inexact_steps)},
      Field{"num_creating_steps", "i8", offsetof(RolloutMeasures, num_creating_steps)},
      Field{"impacts", "i8", offsetof(RolloutMeasures, impacts)},
  };
  return dtype_of(fields, sizeof(RolloutMeasures));
}

// The instances, in arrays of their own: what the caller does to his later changes nothing.
class Inputs {
 public:
  Inputs(const Inputs&) = delete;
  Inputs& operator=(const Inputs&) = delete;
  explicit Inputs(const SceneHandle& handle)
      : handle_(handle), scene_(handle_.scene), bodies_(batch::movable_bodies(scene_)) {}

  // (N, 3) or (3,) of one body; the others keep theirs.
  void set_start_of(bool is_pose, int body, const std::string& name, const py::handle& object) {
    const auto found = std::find(bodies_.begin(), bodies_.end(), body);
    if (found == bodies_.end()) {
      throw std::invalid_argument(
          tumble::format("{}: must be of a dynamic body, or a kinematic one without motion", name));
    }
    const bool is_common = num_dimensions(object, name.c_str()) == 1;
    const Array rows = is_common ? as_array(object, name.c_str(), {3})
                                 : as_array(object, name.c_str(), {-1, 3}, "(N, 3), or (3,) for all");
    add(is_pose, name, rows, is_common ? 1 : rows.shape(0), static_cast<Index>(found - bodies_.begin()), 1);
  }

  // (N, B, 3) or (B, 3); (N, 3) if B is 1.
  void set_starts(bool is_pose, const std::string& name, const py::handle& object) {
    const auto count = static_cast<py::ssize_t>(bodies_.size());
    const py::ssize_t dimensions = num_dimensions(object, name.c_str());
    const std::string words = count == 1 ? "(N, 3), or (N, 1, 3), for the one body that moves"
                                         : tumble::format("(N, {0}, 3), or ({0}, 3) for all", count);
    if (count == 1 && dimensions == 1) return set_start_of(is_pose, bodies_[0], name, object);
    const bool is_flat = dimensions == 2;
    const Array rows = is_flat ? as_array(object, name.c_str(), {count == 1 ? -1 : count, 3}, words)
                               : as_array(object, name.c_str(), {-1, count, 3}, words);
    add(is_pose, name, rows, is_flat && count != 1 ? 1 : rows.shape(0), 0, bodies_.size());
  }

  void vary(const std::string& quantity, int index, const std::string& name, const py::handle& object) {
    add_varied(as_quantity(quantity), index, name, as_values(object, name));
  }

  // Of two surfaces of one material, or of the two of a pair.
  void vary_law(const std::string& quantity, const py::handle& a, const py::handle& b, const std::string& name,
                const py::handle& object) {
    int index = handle_.find_material(a, name);
    if (!b.is_none()) {
      const auto both = std::minmax({index, handle_.find_material(b, name)});
      const auto found = std::find_if(scene_.pairs.begin(), scene_.pairs.end(), [&](const MaterialPair& p) {
        return std::minmax({p.a, p.b}) == both;
      });
      if (found == scene_.pairs.end()) {
        throw std::invalid_argument(
            tumble::format("{}: must be of two materials that Scene.add_pair has made a pair", name));
      }
      index = static_cast<int>(scene_.materials.size()) + static_cast<int>(found - scene_.pairs.begin());
    }
    vary(quantity, index, name, object);
  }

  // Of all materials and pairs.
  void vary_all_laws(const std::string& quantity, const py::handle& object) {
    const std::vector<double> values = as_values(object, quantity);
    for (Index k = 0; k < scene_.materials.size() + scene_.pairs.size(); ++k) {
      add_varied(as_quantity(quantity), static_cast<int>(k), quantity, values);
    }
  }

  // (N, 2) or (2,).
  void set_gravity(const py::handle& object) {
    const bool is_common = num_dimensions(object, "gravity") == 1;
    const Array rows =
        is_common ? as_array(object, "gravity", {2}) : as_array(object, "gravity", {-1, 2}, "(N, 2), or (2,) for all");
    for (const Index axis : {0, 1}) {
      std::vector<double> values;
      for (py::ssize_t i = 0; i < rows.size() / 2; ++i) values.push_back(rows.data()[2 * i + static_cast<long>(axis)]);
      add_varied(axis == 0 ? Quantity::gravity_x : Quantity::gravity_y, 0, "gravity", std::move(values));
    }
  }

  // To be called when all is set.
  void finish() {
    instances_.count = has_count_ ? count_ : 1;
    fill(poses_, true);
    fill(velocities_, false);
    instances_.pose = pose_;
    instances_.velocity = velocity_;
    for (Index k = 0; k < values_.size(); ++k) instances_.varied[k].values = values_[k];
  }

  const Scene& scene() const { return scene_; }
  const std::vector<int>& bodies() const { return bodies_; }
  const batch::Instances& instances() const { return instances_; }

 private:
  struct Block {
    Array rows;
    Index count, first_body, num_bodies;
  };

  // All arrays with more than one entry must have as many.
  void agree(const std::string& name, Index count) {
    if (count == 1) return;
    if (has_count_ && count != count_) {
      throw std::invalid_argument(
          tumble::format("{}: must have {} entries as {}, or one, got {}", name, count_, counted_by_, count));
    }
    count_ = count;
    counted_by_ = name;
    has_count_ = true;
  }

  void add(bool is_pose, const std::string& name, const Array& rows, py::ssize_t count, Index first, Index bodies) {
    agree(name, static_cast<Index>(count));
    (is_pose ? poses_ : velocities_).push_back({rows, static_cast<Index>(count), first, bodies});
  }

  static std::vector<double> as_values(const py::handle& object, const std::string& name) {
    if (num_dimensions(object, name.c_str()) == 0) return {as_number(object, name.c_str())};
    return as_vector(as_array(object, name.c_str(), {-1}, "(N,), or be a number"));
  }

  void add_varied(Quantity quantity, int index, const std::string& name, std::vector<double> values) {
    agree(name, values.size());
    values_.push_back(std::move(values));
    instances_.varied.push_back({quantity, index, {}});
  }

  // From the blocks, and the scene where there is none.
  void fill(std::vector<Block>& blocks, bool is_pose) {
    if (blocks.empty()) return;
    const bool is_common = std::all_of(blocks.begin(), blocks.end(), [](const Block& b) { return b.count == 1; });
    std::vector<double>& values = is_pose ? pose_ : velocity_;
    const Index width = 3 * bodies_.size(), count = is_common ? 1 : instances_.count;
    values.reserve(count * width);
    for (Index i = 0; i < count; ++i) {
      for (const int body : bodies_) {
        const auto& [position, angle] = scene_.bodies[static_cast<Index>(body)].pose;
        const Vector3& v = scene_.bodies[static_cast<Index>(body)].velocity;
        const Vector3 start = is_pose ? Vector3{position.x, position.y, angle} : v;
        values.insert(values.end(), start.begin(), start.end());
      }
    }
    for (const Block& block : blocks) {
      const Index part = 3 * block.num_bodies;
      for (Index i = 0; i < count; ++i) {
        const double* from = block.rows.data() + (block.count == 1 ? 0 : i * part);
        std::copy(from, from + part, values.data() + i * width + 3 * block.first_body);
      }
    }
    blocks.clear();
  }

  SceneHandle handle_;
  const Scene& scene_;
  std::vector<int> bodies_;
  batch::Instances instances_;
  std::vector<Block> poses_, velocities_;
  std::vector<double> pose_, velocity_;
  std::vector<std::vector<double>> values_;
  Index count_ = 1;
  std::string counted_by_;
  bool has_count_ = false;
};

template <class T>
std::span<T> span_of(py::array& array) {
  return {static_cast<T*>(array.mutable_data()), static_cast<Index>(array.size())};
}

py::dict run(const Inputs& inputs, const batch::RolloutSettings& settings) {
  static const auto* dtype = new py::dtype(measures_dtype());  // never freed: the interpreter may be gone by then
  const std::vector<double> time = batch::sample_times(inputs.scene(), settings);
  const auto count = static_cast<py::ssize_t>(inputs.instances().count);
  std::vector<py::ssize_t> shape = {count, static_cast<py::ssize_t>(inputs.bodies().size()), 3};
  if (settings.every > 0) shape.push_back(static_cast<py::ssize_t>(time.size()));
  py::array pose(py::dtype::of<double>(), shape), velocity(py::dtype::of<double>(), shape);
  py::array status(py::dtype::of<std::uint8_t>(), count), measures(*dtype, count);
  static_assert(sizeof(LcpStatus) == 1);
  const batch::RolloutResults results = {span_of<double>(pose), span_of<double>(velocity), span_of<LcpStatus>(status),
                                         span_of<RolloutMeasures>(measures)};
  {
    const py::gil_scoped_release without_gil;
    batch::rollout(inputs.scene(), inputs.instances(), settings, results);
  }
  return py::dict("time"_a = to_numpy(time), "pose"_a = pose, "velocity"_a = velocity, "status"_a = status,
                  "measures"_a = measures);
}

batch::RolloutSettings as_settings(const py::dict& fields) {
  const auto field = [&](const char* name) { return py::object(fields[name]); };
  constexpr int most = std::numeric_limits<int>::max();
  batch::RolloutSettings settings;
  if (!field("step_size").is_none()) {
    settings.step_size = as_number_in(k_step_size_range, field("step_size"), "step_size");
  }
  if (!field("duration").is_none()) settings.duration = as_number_in(k_duration_range, field("duration"), "duration");
  settings.every = as_whole_number(field("every"), "every", 0, most);
  settings.step = as_step_settings(field("solver"), field("num_sweeps"));
  settings.threads = as_whole_number(field("threads"), "threads", 0, 1024);
  settings.measures.rest_speed = as_number(field("rest_speed"), "rest_speed");
  if (!field("region").is_none()) {
    const Array region = as_array(field("region"), "region", {2});
    if (!(region.data()[0] <= region.data()[1])) {
      throw std::invalid_argument(tumble::format("region: must be (x_min, x_max) [m] with x_min <= x_max, got {}",
                                                 short_repr(field("region"))));
    }
    settings.measures.x_min = region.data()[0];
    settings.measures.x_max = region.data()[1];
  }
  settings.watch = watch_for_python(field("progress"));
  return settings;
}

}  // namespace

void bind_rollout(py::module_& module) {
  py::class_<Inputs>(module, "RolloutInputs")
      .def(py::init<const SceneHandle&>(), "scene"_a)
      .def("set_starts", &Inputs::set_starts, "is_pose"_a, "name"_a, "values"_a)
      .def("set_start_of", &Inputs::set_start_of, "is_pose"_a, "body"_a, "name"_a, "values"_a)
      .def("vary", &Inputs::vary, "quantity"_a, "index"_a, "name"_a, "values"_a)
      .def("vary_law", &Inputs::vary_law, "quantity"_a, "a"_a, "b"_a, "name"_a, "values"_a)
      .def("vary_all_laws", &Inputs::vary_all_laws, "quantity"_a, "values"_a)
      .def("set_gravity", &Inputs::set_gravity, "values"_a)
      .def("finish", &Inputs::finish)
      .def(
          "run", [](const Inputs& inputs, const py::dict& settings) { return run(inputs, as_settings(settings)); },
          "settings"_a)
      .def("scene", [](const Inputs& inputs) { return handle_of(inputs.scene()); })
      .def(
          "scene_of",
          [](const Inputs& inputs, Index i) {
            return handle_of(batch::instance_scene(inputs.scene(), inputs.instances(), i));
          },
          "instance"_a)
      .def(
          "what_is_invalid",
          [](const Inputs& inputs, Index i) { return batch::what_is_invalid(inputs.scene(), inputs.instances(), i); },
          "instance"_a)
      .def_property_readonly("bodies",
                             [](const Inputs& inputs) {
                               py::list bodies;
                               for (const int body : inputs.bodies()) bodies.append(body);
                               return bodies;
                             })
      .def_property_readonly("count", [](const Inputs& inputs) { return inputs.instances().count; });
}

}  // namespace tumble::python
