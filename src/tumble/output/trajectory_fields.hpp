// What the files of a scene's course hold, by name: the one list behind .csv, .npz and .h5.
#pragma once

#include <array>
#include <vector>

#include "tumble/output/field.hpp"
#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

inline constexpr std::array<ContactMode, 4> k_contact_modes = {ContactMode::open, ContactMode::stick,
                                                               ContactMode::slip_left, ContactMode::slip_right};

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

// The numbers of a contact that are no vectors.
struct ContactField {
  const char* name;
  const char* unit;
  double* (*place)(ContactRecord& record);

  double value(const ContactRecord& record) const { return *place(const_cast<ContactRecord&>(record)); }  // reads only
};

inline constexpr std::array<ContactField, 11> k_contact_fields = {
    {{"gap", "m", [](ContactRecord& r) { return &r.contact.gap; }},
     {"normal_velocity", "m/s", [](ContactRecord& r) { return &r.normal_velocity; }},
     {"tangential_velocity", "m/s", [](ContactRecord& r) { return &r.tangential_velocity; }},
     {"normal_velocity_after", "m/s", [](ContactRecord& r) { return &r.normal_velocity_after; }},
     {"tangential_velocity_after", "m/s", [](ContactRecord& r) { return &r.tangential_velocity_after; }},
     {"normal_impulse", "N s", [](ContactRecord& r) { return &r.normal_impulse; }},
     {"friction_impulse", "N s", [](ContactRecord& r) { return &r.friction_impulse; }},
     {"restitution", "", [](ContactRecord& r) { return &r.restitution; }},
     {"law_friction", "", [](ContactRecord& r) { return &r.law.friction; }},
     {"law_static_friction", "", [](ContactRecord& r) { return &r.law.static_friction; }},
     {"law_restitution", "", [](ContactRecord& r) { return &r.law.restitution; }}}};

// Throws std::invalid_argument if the sizes within the trajectory disagree, or a contact is of no body or step.
void check_trajectory(const Trajectory& trajectory);

// All of a trajectory as arrays; docs/formats.md lists them.
std::vector<Field> to_fields(const Trajectory& trajectory);

}  // namespace tumble::output
