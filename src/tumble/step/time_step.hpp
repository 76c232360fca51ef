// One step of a scene.
#pragma once

#include <memory>

#include "tumble/contact/island_solver.hpp"
#include "tumble/scene/scene.hpp"
#include "tumble/step/state.hpp"
#include "tumble/step/step_report.hpp"

namespace tumble {

struct StepSettings {
  ContactSolver solver = ContactSolver::exact;
  int num_sweeps = 24;  // of the fast solver, >= 1
};

// Throws std::invalid_argument, naming the field, for a setting outside its range.
void validate(const StepSettings& settings);

// Memory of the steps of one scene, which must outlive it. Its loss changes no result. One per thread.
class StepWorkspace {
 public:
  // Throws std::invalid_argument as `validate(scene)`.
  explicit StepWorkspace(const Scene& scene);
  ~StepWorkspace();
  StepWorkspace(StepWorkspace&&) noexcept;
  StepWorkspace& operator=(StepWorkspace&&) noexcept;

  struct Parts;  // private to the step: step_parts.hpp
  Parts& parts() { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

// Advances the state by step_size [s]. Theory and proofs: docs/theory/step.md. With v_f = v + h M^-1 F the velocity
// without contacts, for the bodies of each island, that is, those that are or may come in touch:
//   - nothing is touched along q + h (v + v_f) / 2: that is where they go, with v_f;
//   - nothing bounces: one LCP for the velocity at the end, u_n >= -gap / h [Stewart & Trinkle 1996], which is also the
//     one the bodies move with. It never gains energy;
//   - something bounces: one LCP for the way, from (v + v_f) / 2, until gaps close; one for the velocity after, from
//     v_f, with u_n >= restitution times the speed of approach where a gap closed.
// The report is filled if there is one. Numerical trouble is a status there, and the return value; where it is not
// `solved`, the state is the best found. Throws std::invalid_argument if the state does not fit the scene or is not
// finite, or step_size is not positive.
LcpStatus time_step(const Scene& scene, double step_size, const StepSettings& settings, State& state,
                    StepWorkspace& workspace, StepReport* report = nullptr);

}  // namespace tumble
