#include "tumble/drop/parameters.hpp"

#include <cmath>
#include <stdexcept>

#include "tumble/math/format.hpp"

namespace tumble::drop {
namespace {

void require(bool holds, const char* field, const char* range, double value, const char* unit) {
  if (holds) return;
  throw std::invalid_argument(
      tumble::format("{}: must be {}, got {}{}{}", field, range, value, *unit ? " " : "", unit));
}

bool is_positive(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

double moment_of_inertia(const Parameters& p) { return p.m * (p.l * p.l / 6.0); }

void validate(const Parameters& p) {
  require(is_positive(p.l), "l", "finite and > 0", p.l, "m");
  require(is_positive(p.m), "m", "finite and > 0", p.m, "kg");
  require(std::isfinite(p.mu) && p.mu >= 0.0, "mu", "finite and >= 0", p.mu, "");
  require(p.eps >= 0.0 && p.eps <= 1.0, "eps", "in [0, 1]", p.eps, "");
  require(is_positive(p.dt), "dt", "finite and > 0", p.dt, "s");
  require(std::isfinite(p.delta) && p.delta >= 0.0, "delta", "finite and >= 0", p.delta, "m");
  require(std::isfinite(p.g), "g", "finite", p.g, "m/s^2");
  if (p.columns < 2 || p.columns > k_max_columns) {
    throw std::invalid_argument(tumble::format("columns: must be in [2, {}], got {}", k_max_columns, p.columns));
  }
  const double inertia = moment_of_inertia(p);
  require(inertia > 1e-300 && inertia < 1e300 && p.m > 1e-300 && p.m < 1e300, "m, l",
          "such that m and the moment of inertia m l^2 / 6 lie in (1e-300, 1e300)", inertia, "kg m^2");
}

}  // namespace tumble::drop
