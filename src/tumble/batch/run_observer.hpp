// What is told of a run, gathered step by step. Not a public header.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "tumble/batch/rollout.hpp"

namespace tumble::batch {

// Of one run after another.
class RunObserver {
 public:
  explicit RunObserver(const MeasureSettings& settings)
      : fast_(settings.rest_speed * settings.rest_speed), x_min_(settings.x_min), x_max_(settings.x_max) {}

  void start(const Scene& scene, const State& state) {
    sum_ = energies(scene, state);
    energy_at_start_ = sum_.kinetic + sum_.potential;
    max_impulse_ = 0.0;
    last_contact_ = escape_time_ = std::numeric_limits<double>::quiet_NaN();
    impacts_ = 0;
    rest_time_ = 0.0;
    is_fast_ = false;
    pushing_.clear();
    squared_gyration_.clear();
    for (const Body& body : scene.bodies) {
      squared_gyration_.push_back(body.kind == BodyKind::dynamic ? body.moment_of_inertia / body.mass : -1.0);
    }
    look_at_bodies(state);
  }

  void look(const State& state, const StepReport& report) {
    add_step(sum_, report.energy);
    look_at_contacts(state.time, report.contacts);
    look_at_bodies(state);
  }

  RolloutMeasures measures(const RunSummary& run) const {
    constexpr double never = std::numeric_limits<double>::quiet_NaN();
    return {run.residual,           run.created_energy,
            last_contact_,          is_fast_ ? never : rest_time_,
            max_impulse_,           energy_at_start_ - (sum_.kinetic + sum_.potential),
            escape_time_,           sum_,
            run.num_steps,          run.num_inexact_steps,
            run.num_creating_steps, impacts_};
  }

 private:
  using BodyPair = std::pair<int, int>;

  void look_at_bodies(const State& state) {
    const bool was_fast = std::exchange(is_fast_, false);
    for (std::size_t i = 0; i < squared_gyration_.size(); ++i) {
      if (squared_gyration_[i] < 0.0) continue;
      const Vector3& v = state.bodies[i].velocity;
      is_fast_ = is_fast_ || v[0] * v[0] + v[1] * v[1] + squared_gyration_[i] * v[2] * v[2] > fast_;
      const double x = state.bodies[i].pose.position.x;
      if ((x < x_min_ || x > x_max_) && !(escape_time_ >= 0.0)) escape_time_ = state.time;
    }
    if (was_fast && !is_fast_) rest_time_ = state.time;
  }

  // The contacts of two bodies follow one another, pairs in order.
  void look_at_contacts(double time, const std::vector<ContactRecord>& contacts) {
    pushed_.swap(pushing_);
    pushing_.clear();
    for (auto c = contacts.begin(); c != contacts.end();) {
      const BodyPair bodies = {c->contact.body_a, c->contact.body_b};
      double impulse = 0.0;
      for (; c != contacts.end() && BodyPair(c->contact.body_a, c->contact.body_b) == bodies; ++c) {
        impulse += c->normal_impulse;
      }
      if (!(impulse > 0.0)) continue;
      pushing_.push_back(bodies);
      max_impulse_ = std::max(max_impulse_, impulse);
      last_contact_ = time;
      if (!std::binary_search(pushed_.begin(), pushed_.end(), bodies)) ++impacts_;
    }
  }

  double fast_, x_min_, x_max_;
  EnergyLedger sum_;
  double energy_at_start_ = 0.0, max_impulse_ = 0.0, last_contact_ = 0.0, escape_time_ = 0.0, rest_time_ = 0.0;
  bool is_fast_ = false;
  std::int64_t impacts_ = 0;
  std::vector<BodyPair> pushing_, pushed_;  // in this step, in the step before
  std::vector<double> squared_gyration_;    // I / m of each body; < 0 unless dynamic
};

}  // namespace tumble::batch
