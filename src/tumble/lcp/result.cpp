#include "tumble/lcp/result.hpp"

namespace tumble {

std::string_view to_string(LcpStatus status) {
  switch (status) {
    case LcpStatus::solved: return "solved";
    case LcpStatus::no_solution_proved: return "no_solution_proved";
    case LcpStatus::ray_unproven: return "ray_unproven";
    case LcpStatus::iteration_limit: return "iteration_limit";
    case LcpStatus::numerical: return "numerical";
    case LcpStatus::infeasible: return "infeasible";
    case LcpStatus::bad_input: return "bad_input";
  }
  return "unknown";
}

std::string_view to_string(LcpRung rung) {
  switch (rung) {
    case LcpRung::none: return "none";
    case LcpRung::warm_start: return "warm_start";
    case LcpRung::closed_form: return "closed_form";
    case LcpRung::contact_modes: return "contact_modes";
    case LcpRung::lemke: return "lemke";
    case LcpRung::lemke_lu: return "lemke_lu";
    case LcpRung::lemke_quad: return "lemke_quad";
    case LcpRung::ridge: return "ridge";
    case LcpRung::exact: return "exact";
    case LcpRung::enumerate: return "enumerate";
    case LcpRung::nlgs: return "nlgs";
    case LcpRung::murty: return "murty";
    case LcpRung::dantzig: return "dantzig";
    case LcpRung::newton: return "newton";
    case LcpRung::pgs: return "pgs";
  }
  return "unknown";
}

}  // namespace tumble
