// What holds in every step of every scene.
#pragma once

#include <string>
#include <vector>

#include "tumble/trajectory/simulate.hpp"

namespace tumble::physics {

// Each adds a line for every law that a step has broken. `before` and `after` are the states around the step, `report`
// is of it.

// For each body, mass times change of velocity is the sum of the impulses of contacts, gravity, wrenches and damping,
// and so is the change of angular momentum: to round-off.
void check_momentum(const Scene& scene, double step_size, const State& before, const State& after,
                    const StepReport& report, std::vector<std::string>& broken);

// Signorini's condition and Coulomb's law in each contact, and that the mode says what the contact does. To the
// residual that the solver accepts.
void check_contacts(const Scene& scene, double step_size, const State& before, const StepReport& report,
                    std::vector<std::string>& broken);

// The ledger closes to 1e-12 of what it sums, its energies are those of the state, and contacts take energy away where
// none is reported as created.
void check_energy(const Scene& scene, const State& before, const State& after, const StepReport& report,
                  std::vector<std::string>& broken);

// All of them.
std::vector<std::string> broken_laws(const Scene& scene, double step_size, const State& before, const State& after,
                                     const StepReport& report);

}  // namespace tumble::physics
