#include "measure_engines.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "../lcp/median.hpp"
#include "first_flight.hpp"
#include "overlap.hpp"

namespace tumble::bench {
namespace {

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

int steps_of(const World& world, double step_size) { return static_cast<int>(std::lround(world.duration / step_size)); }

// Building a world is not timed, its steps are, from the first to the last.
double seconds_per_step(const World& world, double step_size, const Engine& engine, double at_least) {
  const int num_steps = steps_of(world, step_size);
  double seconds = 0.0;
  int num_runs = 0;
  for (; num_runs == 0 || seconds < at_least; ++num_runs) {
    const Run run = engine.build(world, step_size);
    const double start = processor_seconds();
    run.advance(num_steps);
    seconds += processor_seconds() - start;
  }
  return seconds / num_runs / num_steps;
}

std::vector<Motion> motions(const World& world, const Run& run) {
  std::vector<Motion> all;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) all.push_back(run.motion(static_cast<int>(i)));
  return all;
}

bool is_lost(const Motion& m) {
  // Not "below": NaN is lost too.
  return !(m.pose.position.y > -1.0) || !std::isfinite(m.pose.position.x) || !std::isfinite(m.pose.angle);
}

double overlap_now(const World& world, const std::vector<Motion>& now) {
  std::vector<Outline> bodies;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!is_lost(now[i])) bodies.push_back(placed(world.bodies[i].outline, now[i].pose));
  }
  return deepest_overlap(bodies, world.walls);
}

double kinetic_energy(const WorldBody& body, const Vector3& v) {
  return 0.5 * (body.mass * (v[0] * v[0] + v[1] * v[1]) + body.moment_of_inertia * v[2] * v[2]);
}

// The largest distance between where the two poses put a point of the outline.
double distance_between(const Outline& outline, const Pose& a, const Pose& b) {
  double largest = length(a.position - b.position);  // of a disc: which way it has turned counts at its rim alone
  const Frame frame_a = frame_of(a), frame_b = frame_of(b);
  for (const Vector2& p : outline.vertices) {
    largest = std::max(largest, length(point_to_world(frame_a, p) - point_to_world(frame_b, p)));
  }
  return largest;
}

// Compares each body with its exact first flight at the last step that every engine can be asked for.
class FlightErrors {
 public:
  FlightErrors(const World& world, double step_size) : world_(world), step_size_(step_size) {
    if (world.question != Question::bounce) return;
    for (const WorldBody& body : world.bodies) flights_.push_back(FirstFlight::of(world, body));
  }

  void look(int step, const std::vector<Motion>& now) {
    for (std::size_t i = 0; i < flights_.size(); ++i) {
      if (!flights_[i] || step != step_to_judge(*flights_[i])) continue;
      errors_.push_back(
          distance_between(world_.bodies[i].outline, flights_[i]->pose_at(step * step_size_), now[i].pose));
    }
  }

  std::optional<double> middle() const {
    if (errors_.empty()) return std::nullopt;
    return median(errors_);
  }

 private:
  // Two steps before the second touch, so that an engine that notices it early has not; -1 if the flight is not four
  // steps long.
  int step_to_judge(const FirstFlight& flight) const {
    if (flight.end_time() - flight.impact_time() < 4.0 * step_size_) return -1;
    return static_cast<int>(std::floor(flight.end_time() / step_size_)) - 2;
  }

  const World& world_;
  double step_size_;
  std::vector<std::optional<FirstFlight>> flights_;
  std::vector<double> errors_;
};

Quality quality_of(const World& world, double step_size, const Engine& engine) {
  const int num_steps = steps_of(world, step_size);
  const Run run = engine.build(world, step_size);
  FlightErrors flight_errors(world, step_size);
  Quality quality;
  std::vector<Motion> now;
  for (int step = 1; step <= num_steps; ++step) {
    run.advance(1);
    now = motions(world, run);
    flight_errors.look(step, now);
    quality.end_overlap = overlap_now(world, now);
    quality.deepest_overlap = std::max(quality.deepest_overlap, quality.end_overlap);
  }
  for (std::size_t i = 0; i < now.size(); ++i) {
    const WorldBody& body = world.bodies[i];
    quality.num_lost += is_lost(now[i]) ? 1 : 0;
    quality.kinetic_energy += kinetic_energy(body, now[i].velocity) / static_cast<double>(now.size());
    const Vector2 moved = now[i].pose.position - body.pose.position;
    quality.drift_x = std::max(quality.drift_x, std::abs(moved.x));
    quality.drift_y = std::max(quality.drift_y, std::abs(moved.y));
  }
  quality.num_contacts = run.num_contacts();
  quality.flight_error = flight_errors.middle();
  return quality;
}

}  // namespace

std::vector<Measurement> measure(const std::vector<World>& worlds, const std::vector<Engine>& engines, double step_size,
                                 int rounds, double at_least, const std::function<void(std::size_t)>& progress) {
  std::vector<Measurement> measurements;
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    const auto first = measurements.size();
    for (std::size_t e = 0; e < engines.size(); ++e) {
      measurements.push_back({w, e, quality_of(worlds[w], step_size, engines[e]), {}});
    }
    for (int round = 0; round < rounds; ++round) {
      for (std::size_t e = 0; e < engines.size(); ++e) {
        measurements[first + e].seconds_per_step.push_back(
            seconds_per_step(worlds[w], step_size, engines[e], at_least));
      }
    }
    progress(w + 1);
  }
  return measurements;
}

}  // namespace tumble::bench
