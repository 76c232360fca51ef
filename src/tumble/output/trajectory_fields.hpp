// What the files of a scene's course hold, by name.
#pragma once

#include <array>

#include "tumble/step/step_report.hpp"

namespace tumble::output {

struct EnergyField {
  const char* name;
  double EnergyLedger::*member;  // [J]
};

inline constexpr std::array<EnergyField, 8> k_energy_fields = {
    {{"kinetic", &EnergyLedger::kinetic},
     {"potential", &EnergyLedger::potential},
     {"external_work", &EnergyLedger::external_work},
     {"friction_loss", &EnergyLedger::friction_loss},
     {"impact_loss", &EnergyLedger::impact_loss},
     {"damping_loss", &EnergyLedger::damping_loss},
     {"stabilisation_work", &EnergyLedger::stabilisation_work},
     {"created", &EnergyLedger::created}}};

}  // namespace tumble::output
