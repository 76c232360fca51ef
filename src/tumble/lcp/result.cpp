#include "tumble/lcp/result.hpp"

namespace tumble {

std::string_view to_string(LcpStatus status) {
  switch (status) {
    case LcpStatus::solved: return "solved";
    case LcpStatus::no_solution_proved: return "no_solution_proved";
    case LcpStatus::ray_unproven: return "ray_unproven";
    case LcpStatus::iteration_limit: return "iteration_limit";
    case LcpStatus::numerical: return "numerical";
  }
  return "unknown";
}

}  // namespace tumble
