// The module of the browser page. Every function returns its result or {error: text}; tumble.d.mts has the types.
#include <cmath>

#include "run.hpp"
#include "scene_edit.hpp"

#include "tumble/math/format.hpp"
#include "tumble/output/csv.hpp"
#include "tumble/output/drop_trajectory.hpp"
#include "tumble/output/trajectory_csv.hpp"
#include "tumble/scene/scene_toml.hpp"

namespace tumble::wasm {

val guarded_call(val (*make)(void*), void* closure) {
  try {
    return make(closure);
  } catch (const std::exception& error) {
    val object = val::object();
    set(object, "error", std::string(error.what()));
    return object;
  }
}

namespace {

val handle(std::shared_ptr<Run> run) { return val(std::move(run)); }

struct DropStart {
  Vector3 q0, v0;
  drop::Parameters parameters;
};

DropStart drop_start(const val& spec) {
  DropStart start{triple_at(spec, "q0"), triple_at(spec, "v0"), {}};
  drop::Parameters& p = start.parameters;
  p.l = number_at(spec, "l");
  p.m = number_at(spec, "m");
  p.mu = number_at(spec, "mu");
  p.eps = number_at(spec, "eps");
  p.dt = number_at(spec, "dt");
  p.delta = number_at(spec, "delta");
  p.g = number_at(spec, "g");
  const double columns = number_at(spec, "columns");
  if (!(columns >= 2.0 && columns <= drop::k_max_columns && columns == std::floor(columns)))
    throw std::invalid_argument(
        tumble::format("columns: must be a whole number in [2, {}], got {}", drop::k_max_columns, columns));
  p.columns = static_cast<int>(columns);
  return start;
}

val simulate_drop(const val& spec) {
  return guarded([&] {
    const DropStart start = drop_start(spec);
    return handle(Run::of_record(drop::simulate_with_record(start.q0, start.v0, start.parameters)));
  });
}

// The same square on the same ground as a scene, for the general step.
val drop_as_scene(const val& spec) {
  return guarded([&] {
    const DropStart start = drop_start(spec);
    validate(start.parameters);
    return val(to_toml(output::drop_scene(start.q0, start.v0, start.parameters)));
  });
}

val simulate_scene(const std::string& toml, const val& options) {
  return guarded([&] {
    SimulateSettings settings;
    settings.step_size = number_at(options, "step_size");
    settings.duration = number_at(options, "duration");
    settings.sample_every = static_cast<int>(number_at(options, "sample_every"));
    if (options["solver"].as<std::string>() == "fast") settings.step.solver = ContactSolver::fast;
    return val(std::make_shared<SceneRun>(parse_scene(toml), settings));
  });
}

val read_record(const std::string& text, const std::string& name) {
  return guarded([&] { return handle(Run::of_record(output::parse_record_csv(text, name))); });
}

val read_trajectory(const std::string& toml, const std::string& samples, const std::string& samples_name,
                    const std::string& contacts, const std::string& contacts_name) {
  return guarded([&] {
    Trajectory trajectory =
        output::parse_trajectory_csv(parse_scene(toml), samples, samples_name, contacts, contacts_name);
    return handle(Run::of_trajectory(std::move(trajectory)));
  });
}

val describe_scene(const std::string& toml, const std::string& name) {
  return guarded([&] { return describe(parse_scene(toml, name)); });
}

val edit_scene(const std::string& toml, const val& edits) {
  return guarded([&] {
    Scene scene = parse_scene(toml);
    apply_edits(scene, edits);
    return val(to_toml(scene));
  });
}

val problem(const Run& run, int k) {
  return guarded([&] { return run.problem(k); });
}
val impulse_planes(const Run& run, int k) {
  return guarded([&] { return run.impulse_planes(k); });
}
val csv(const Run& run, const std::string& table) {
  return guarded([&] { return val(run.csv(table)); });
}
val trajectory(const Run& run) {
  return guarded([&] { return run.trajectory(); });
}
val scene(const Run& run) {
  return guarded([&] { return run.scene(); });
}
val finish(SceneRun& run) {
  return guarded([&] { return handle(run.finish()); });
}

}  // namespace

EMSCRIPTEN_BINDINGS(tumble) {
  using namespace emscripten;
  constant("version", std::string(TUMBLE_VERSION));
  class_<Run>("Run")
      .smart_ptr<std::shared_ptr<Run>>("Run")
      .function("trajectory", &trajectory)
      .function("record", &Run::record)
      .function("scene", &scene)
      .function("body_series", &Run::body_series)
      .function("problem", &problem)
      .function("impulse_planes", &impulse_planes)
      .function("csv", &csv);
  class_<SceneRun>("SceneRun")
      .smart_ptr<std::shared_ptr<SceneRun>>("SceneRun")
      .function("advance", &SceneRun::advance)
      .function("finish", &finish);
  function("simulate_drop", &simulate_drop);
  function("drop_as_scene", &drop_as_scene);
  function("simulate_scene", &simulate_scene);
  function("read_record", &read_record);
  function("read_trajectory", &read_trajectory);
  function("describe_scene", &describe_scene);
  function("edit_scene", &edit_scene);
}

}  // namespace tumble::wasm
