// The extension module tumble._sweep: sweeps, their summaries and pictures. Public face: the package tumble.sweep.
#include <atomic>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "without_gil.hpp"
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "tumble/output/file.hpp"
#include "tumble/scene/limits.hpp"
#include "tumble/sweep/answers.hpp"
#include "tumble/sweep/describe.hpp"
#include "tumble/sweep/plan.hpp"
#include "tumble/sweep/run.hpp"
#include "tumble/sweep/sweep_plots.hpp"

namespace tumble::python {
namespace {

namespace py = pybind11;
using sweep::Answers;

// A pending Ctrl-C is raised here; the thread gave the GIL away.
void tell(const py::object& progress, std::uint64_t done) {
  const py::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (!progress.is_none()) progress(done);
}

// `scene` is the text of the scene that is swept (str), or the folder that its file is named from (bytes).
sweep::Spec parse(const std::string& text, const std::string& name, const py::object& scene) {
  if (py::isinstance<py::str>(scene)) {
    return sweep::parse_spec(text, name, [&](const std::string&) { return scene.cast<std::string>(); });
  }
  const std::filesystem::path folder = scene.cast<std::string>();
  try {
    return sweep::parse_spec(
        text, name, [&](const std::string& file) { return output::read_file(folder / file, k_max_scene_bytes); });
  } catch (const std::runtime_error& error) {
    raise_os_error(error.what());
  }
}

// Of a shard: the instances. Of the sweep: the chunks.
py::dict plan(const std::string& text, const std::string& name, const py::object& scene, std::uint64_t index,
              std::uint64_t count) {
  const sweep::Spec spec = parse(text, name, scene);
  py::dict plan;
  plan["instances"] = sweep::num_instances(spec, {index, count});
  plan["chunks"] = sweep::num_chunks(spec);
  return plan;
}

Answers simulate(const std::string& text, const std::string& name, const py::object& scene, int threads,
                 const py::object& progress) {
  const sweep::Spec spec = parse(text, name, scene);
  std::optional<Answers> answers;
  without_gil(
      [&] { answers = sweep::simulate_answers(spec, threads, [&](std::uint64_t done) { tell(progress, done); }); });
  return std::move(*answers);
}

void begin(const std::string& text, const std::string& name, const py::object& scene, const std::string& folder,
           bool overwrite) {
  const sweep::Spec spec = parse(text, name, scene);
  without_gil([&] { sweep::Folder::begin(folder, spec, overwrite); });
}

// Of a folder that was begun: what the shard found and did. After Ctrl-C the chunks that are finished stay, and it is
// raised.
py::dict run_shard(const std::string& folder, std::uint64_t index, std::uint64_t count, int threads,
                   const py::object& progress) {
  std::exception_ptr raised;
  std::atomic<bool> is_interrupted = false;
  sweep::RunSettings settings;
  settings.shard = {index, count};
  settings.threads = threads;
  settings.is_interrupted = [&] { return is_interrupted.load(); };
  settings.progress = [&](std::uint64_t done) {
    try {
      if (!is_interrupted) tell(progress, done);
    } catch (...) {
      raised = std::current_exception();
      is_interrupted = true;
    }
  };
  sweep::RunReport report;
  without_gil([&] { report = sweep::run_sweep(sweep::Folder::open(folder), settings); });
  if (raised) std::rethrow_exception(raised);
  py::dict result;
  result["chunks"] = report.chunks;
  result["found"] = report.found;
  result["faults"] = report.faults;
  return result;
}

Answers read(const std::vector<std::string>& paths, int threads) {
  std::optional<Answers> answers;
  without_gil([&] {
    std::vector<sweep::Folder> folders;
    for (const std::string& path : paths) folders.push_back(sweep::Folder::open(path));
    answers = sweep::read_answers(sweep::Chunks(folders, threads));
  });
  return std::move(*answers);
}

using Values = py::array_t<double, py::array::c_style | py::array::forcecast>;

Answers from_columns(const std::string& text, const std::string& name, const py::object& scene,
                     const std::map<std::string, Values>& arrays) {
  const sweep::Spec spec = parse(text, name, scene);
  std::vector<sweep::Column> columns;
  for (const auto& [column, values] : arrays) {
    columns.push_back({column, "", std::vector<double>(values.data(), values.data() + values.size())});
  }
  std::optional<Answers> answers;
  without_gil([&] { answers = sweep::answers_of(spec, std::move(columns)); });
  return std::move(*answers);
}

template <class T>
std::vector<T> to_vector(const py::array& array) {
  const auto values = py::array_t<T, py::array::c_style | py::array::forcecast>(array);
  return {values.data(), values.data() + values.size()};
}

// Of the arrays whose names begin with "statistics_".
Answers from_statistics(const std::string& text, const std::string& name, const py::object& scene,
                        const std::map<std::string, py::array>& arrays) {
  const sweep::Spec spec = parse(text, name, scene);
  std::vector<output::Field> fields;
  for (const auto& [field, array] : arrays) {
    fields.push_back({field, "", {}, std::vector<double>{}});
    if (array.dtype().kind() == 'f') {
      fields.back().values = to_vector<double>(array);
    } else if (array.dtype().itemsize() == 4) {
      fields.back().values = to_vector<std::int32_t>(array);
    } else {
      fields.back().values = to_vector<std::int64_t>(array);
    }
  }
  return sweep::answers_of(spec, fields);
}

// Doubles as a view of the memory of `self`, whole numbers as a copy.
py::dict columns_of(const py::object& self) {
  py::dict columns;
  for (const sweep::Column& column : self.cast<const Answers&>().columns) {
    py::array array = py::array_t<double>(static_cast<py::ssize_t>(column.values.size()), column.values.data(), self);
    if (column.is_whole) array = py::array_t<std::int32_t, py::array::forcecast>(array);
    array.attr("flags").attr("writeable") = false;
    columns[py::str(column.name)] = array;
  }
  return columns;
}

py::dict units_of(const Answers& answers) {
  py::dict units;
  for (const sweep::Column& column : answers.columns) units[py::str(column.name)] = column.unit;
  return units;
}

sweep::Summary summary_of(const Answers& answers) {
  return sweep::summarise(answers.statistics, sweep::facts_of(answers.spec));
}

// The bytes of a picture: .png, or .svg.
py::bytes draw(const Answers& answers, const std::string& kind, int width, int height, bool is_svg) {
  std::string bytes;
  without_gil([&] {
    const sweep::PlotSettings settings{kind, width, height};
    const std::optional<sweep::Fan> fan = sweep::shows_fan(settings) ? sweep::fan_of(answers.spec) : std::nullopt;
    const sweep::Summary summary = summary_of(answers);
    const sweep::PlotSource source{answers.statistics, summary, fan ? &*fan : nullptr};
    bytes = is_svg ? sweep::to_plot_svg(source, settings) : sweep::to_plot_png(source, settings);
  });
  return bytes;
}

}  // namespace
}  // namespace tumble::python

PYBIND11_MODULE(_sweep, module) {
  using namespace pybind11::literals;
  using namespace tumble;
  using sweep::Answers;
  namespace py = pybind11;
  module.doc() = "Compiled part of tumble.sweep.";
  py::class_<Answers>(module, "Answers")
      .def("__len__", [](const Answers& answers) { return sweep::num_instances(answers.spec); })
      .def_property_readonly("spec", [](const Answers& answers) { return answers.spec.text; })
      .def_property_readonly("scene", [](const Answers& a) { return a.spec.scene ? a.spec.scene->text : ""; })
      .def_property_readonly("columns", &python::columns_of)
      .def_property_readonly("units", &python::units_of)
      .def_property_readonly("summary_text", [](const Answers& a) { return to_text(python::summary_of(a)); })
      .def_property_readonly("summary_csv", [](const Answers& a) { return to_csv(python::summary_of(a)); })
      .def_property_readonly("summary_json", [](const Answers& a) { return to_json(python::summary_of(a)); })
      .def("draw", &python::draw, "kind"_a, "width"_a, "height"_a, "is_svg"_a);
  module.def("plan", &python::plan, "text"_a, "name"_a, "scene"_a, "index"_a = 0, "count"_a = 1);
  module.def("simulate", &python::simulate, "text"_a, "name"_a, "scene"_a, "threads"_a, "progress"_a);
  module.def("begin", &python::begin, "text"_a, "name"_a, "scene"_a, "folder"_a, "overwrite"_a);
  module.def("run_shard", &python::run_shard, "folder"_a, "index"_a, "count"_a, "threads"_a, "progress"_a);
  module.def("read", &python::read, "folders"_a, "threads"_a);
  module.def("from_columns", &python::from_columns, "text"_a, "name"_a, "scene"_a, "columns"_a);
  module.def("from_statistics", &python::from_statistics, "text"_a, "name"_a, "scene"_a, "arrays"_a);
}
