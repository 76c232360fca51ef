#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands.hpp"
#include "input.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "run_report.hpp"

#include "tumble/math/format.hpp"
#include "tumble/output/file.hpp"

namespace tumble::cli {
namespace {

// Contacts are kept only where a file shows them.
bool keeps_contacts(const RunOptions& options) {
  bool are_shown = false;
  for (const std::string& file : options.output.files) {
    const output::ContactUse use = output::contact_use(file, options.output.pictures);
    if (options.no_contacts && use == output::ContactUse::all) {
      throw std::invalid_argument(tumble::format("--no-contacts: {} holds nothing else", output::path_text(file)));
    }
    are_shown = are_shown || use != output::ContactUse::none;
  }
  return are_shown && !options.no_contacts;
}

Trajectory simulate(const Scene& scene, const SimulateSettings& settings, RunNotes& notes) {
  const InterruptGuard interrupt;
  Simulation simulation(scene, settings);
  Progress progress(simulation.num_steps(), simulation.trajectory().step_size, "s");
  while (!simulation.is_done() && !interrupt.is_interrupted()) {
    simulation.advance();
    notes.take(simulation);
    progress.show(simulation.step());
  }
  notes.is_interrupted = !simulation.is_done();
  return simulation.finish();
}

int end_of(const Trajectory& trajectory, const RunNotes& notes, double duration) {
  const double time = trajectory.time.back();
  if (notes.is_interrupted) {
    return report_failure(tumble::format("interrupted at {:.6g} s of {:.6g} s", time, duration), k_interrupted);
  }
  if (trajectory.status == LcpStatus::solved) return k_done;
  return report_failure(tumble::format("step {}, to {:.6g} s, was not solved: status {}, residual {:.3g}",
                                       trajectory.num_steps, time, to_string(trajectory.status), trajectory.residual),
                        k_numerical_failure);
}

}  // namespace

int run_scene(const RunOptions& options) {
  const auto& [files, pictures] = options.output;
  require_different(files);
  const Scene scene = read_scene(options.input);
  SimulateSettings settings = options.settings;
  const double duration = settings.duration > 0.0 ? settings.duration : scene.duration;
  for (const std::string& file : files) output::check_trajectory_writable(file, pictures, duration);
  settings.keeps_contacts = keeps_contacts(options);
  RunNotes notes;
  const Trajectory trajectory = simulate(scene, settings, notes);
  // A file that cannot be written does not cost the others.
  std::vector<std::string> written;
  std::exception_ptr failure;
  for (const std::string& file : files) {
    try {
      output::write_trajectory(trajectory, file, pictures);
      written.push_back(file);
    } catch (const std::exception&) {
      if (!failure) failure = std::current_exception();
    }
  }
  if (!options.report.quiet) {
    tumble::print("{}",
                  options.report.json ? run_json(trajectory, notes, written) : run_text(trajectory, notes, written));
  }
  if (failure) std::rethrow_exception(failure);
  return end_of(trajectory, notes, duration);
}

}  // namespace tumble::cli
