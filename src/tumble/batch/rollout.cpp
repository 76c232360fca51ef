#include "tumble/batch/rollout.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "tumble/batch/instance_editor.hpp"
#include "tumble/batch/parallel.hpp"
#include "tumble/batch/run_observer.hpp"
#include "tumble/math/format.hpp"
#include "tumble/step/step_parts.hpp"
#include "tumble/trajectory/simulate.hpp"

namespace tumble::batch {
namespace {

using Index = std::size_t;
using Clock = std::chrono::steady_clock;

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr auto k_watch_every = std::chrono::milliseconds(20);
constexpr Index k_max_chunk = 64;          // instances: then handing out chunks costs nothing
constexpr Index k_chunks_per_thread = 16;  // fewer than that, and threads would wait for the last one

RunSettings checked_run_settings(const Scene& scene, const RolloutSettings& settings) {
  if (settings.every < 0) throw std::invalid_argument(tumble::format("every: must be >= 0, got {}", settings.every));
  require_threads(settings.threads);
  validate(settings.measures);
  validate(scene);
  return run_settings(scene, {.step_size = settings.step_size, .duration = settings.duration, .step = settings.step});
}

Index num_samples(const RunSettings& run, int every) {
  if (every == 0) return 1;
  const std::int64_t steps = run.num_steps;
  return static_cast<Index>(1 + steps / every + (steps % every != 0 ? 1 : 0));
}

template <class T>
void require_size(const char* field, std::span<T> array, Index size) {
  if (array.empty() || array.size() == size) return;
  throw std::invalid_argument(tumble::format("{}: must have {} entries, or none, got {}", field, size, array.size()));
}

// Gives the memory of the steps the masses and laws of an instance, as if it had been made for it.
void take(const Scene& scene, const InstanceEditor& editor, StepWorkspace& workspace) {
  StepWorkspace::Parts& parts = workspace.parts();
  for (const int body : editor.masses()) parts.take_mass(scene, static_cast<Index>(body));
  if (editor.edits_laws()) parts.take_laws(scene);
}

// What a thread works with.
struct Worker {
  Worker(const Scene& of, const RolloutSettings& settings) : scene(of), workspace(scene), observer(settings.measures) {}

  Scene scene;  // that of the instance at hand
  StepWorkspace workspace;
  RunObserver observer;
  State state;
  StepReport report;
};

class Rollout {
 public:
  Rollout(const Scene& scene, const Instances& instances, const RolloutSettings& settings,
          const RolloutResults& results)
      : scene_(scene),
        settings_(settings),
        results_(results),
        run_(checked_run_settings(scene, settings)),
        editor_(scene, instances),
        count_(instances.count),
        samples_(num_samples(run_, settings.every)),
        workers_(static_cast<Index>(settings.threads == 0 ? num_cores() : settings.threads)) {
    editor_.require_common_in_range();
    const Index size = count_ * editor_.bodies().size() * 3 * samples_;
    require_size("results.pose", results.pose, size);
    require_size("results.velocity", results.velocity, size);
    require_size("results.status", results.status, count_);
    require_size("results.measures", results.measures, count_);
  }

  void run() {
    const Index per_chunk = std::clamp<Index>(count_ / (workers_.size() * k_chunks_per_thread), 1, k_max_chunk);
    const Index num_chunks = (count_ + per_chunk - 1) / per_chunk;
    const auto work = [&](Index chunk, Index worker) {
      if (!workers_[worker]) workers_[worker] = std::make_unique<Worker>(scene_, settings_);
      const Index end = std::min(count_, (chunk + 1) * per_chunk);
      for (Index i = chunk * per_chunk; i < end && !is_over_; ++i) {
        run_instance(i, *workers_[worker], worker == 0);
        num_done_.fetch_add(1);
      }
    };
    const auto watch = settings_.watch ? std::function<void(Index)>([this](Index) { look(); }) : nullptr;
    for_each_chunk(num_chunks, settings_.threads, work, watch);
  }

 private:
  // Tells the caller how far it is. If that throws, all threads end within a step.
  void look() {
    if (is_over_) return;
    try {
      settings_.watch(num_done_.load());
    } catch (...) {
      is_over_ = true;
      throw;
    }
    due_ = Clock::now() + k_watch_every;
  }

  void run_instance(Index i, Worker& w, bool is_calling_thread) {
    editor_.edit(i, w.scene);
    if (!editor_.is_valid(w.scene)) return refuse(i);
    take(w.scene, editor_, w.workspace);
    w.state = initial_state(w.scene);
    w.observer.start(w.scene, w.state);
    RunSummary summary;
    const bool keeps_course = settings_.every > 0;
    if (keeps_course) keep(i, 0, w.state);
    Index kept = keeps_course ? 1 : 0;
    while (!is_done(run_, summary) && !is_over_) {
      if (!step(w, summary)) return end(i, kept, w, summary);
      const bool is_due = keeps_course && summary.num_steps % settings_.every == 0;
      if (is_due || is_done(run_, summary)) keep(i, kept++, w.state);
      if (is_calling_thread && settings_.watch && Clock::now() >= due_) look();
    }
    end(i, kept, w, summary);
  }

  // False if the state has left the range of doubles, which no step can begin with.
  bool step(Worker& w, RunSummary& summary) const {
    try {
      advance(w.scene, run_, w.workspace, w.state, w.report, summary);
      w.observer.look(w.state, w.report);
      return true;
    } catch (const std::invalid_argument&) {
      summary.status = LcpStatus::numerical;
      return false;
    }
  }

  void end(Index i, Index kept, const Worker& w, const RunSummary& summary) {
    for (; kept < samples_; ++kept) blank(i, kept);
    if (!results_.status.empty()) results_.status[i] = summary.status;
    if (!results_.measures.empty()) results_.measures[i] = w.observer.measures(summary);
  }

  void refuse(Index i) {
    for (Index k = 0; k < samples_; ++k) blank(i, k);
    if (!results_.status.empty()) results_.status[i] = LcpStatus::bad_input;
    if (results_.measures.empty()) return;
    const EnergyLedger none = {k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan};
    results_.measures[i] = {k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, none, 0, 0, 0, 0};
  }

  // Sets number c of body b in sample k of instance i.
  void put(std::span<double> array, Index i, Index b, Index c, Index k, double value) const {
    array[((i * editor_.bodies().size() + b) * 3 + c) * samples_ + k] = value;
  }

  void keep(Index i, Index k, const State& state) {
    for (Index b = 0; b < editor_.bodies().size(); ++b) {
      const auto& [pose, velocity] = state.bodies[static_cast<Index>(editor_.bodies()[b])];
      if (!results_.pose.empty()) {
        put(results_.pose, i, b, 0, k, pose.position.x);
        put(results_.pose, i, b, 1, k, pose.position.y);
        put(results_.pose, i, b, 2, k, pose.angle);
      }
      if (results_.velocity.empty()) continue;
      for (Index c = 0; c < 3; ++c) put(results_.velocity, i, b, c, k, velocity[c]);
    }
  }

  void blank(Index i, Index k) {
    for (const std::span<double> array : {results_.pose, results_.velocity}) {
      if (array.empty()) continue;
      for (Index b = 0; b < editor_.bodies().size(); ++b) {
        for (Index c = 0; c < 3; ++c) put(array, i, b, c, k, k_nan);
      }
    }
  }

  const Scene& scene_;
  const RolloutSettings& settings_;
  const RolloutResults& results_;
  RunSettings run_;
  InstanceEditor editor_;
  Index count_, samples_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::atomic<Index> num_done_ = 0;
  std::atomic<bool> is_over_ = false;
  Clock::time_point due_ = Clock::now() + k_watch_every;  // of the calling thread
};

}  // namespace

std::vector<double> sample_times(const Scene& scene, const RolloutSettings& settings) {
  const RunSettings run = checked_run_settings(scene, settings);
  std::vector<double> times(num_samples(run, settings.every));
  for (Index k = 0; k < times.size(); ++k) {
    const std::int64_t step = settings.every == 0 ? run.num_steps : static_cast<std::int64_t>(k) * settings.every;
    times[k] = static_cast<double>(std::min(step, run.num_steps)) * run.step_size;
  }
  return times;
}

void rollout(const Scene& scene, const Instances& instances, const RolloutSettings& settings,
             const RolloutResults& results) {
  Rollout(scene, instances, settings, results).run();
}

}  // namespace tumble::batch
