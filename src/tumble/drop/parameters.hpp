// The document's parameters, with its names and its values.
#pragma once

namespace tumble::drop {

struct Parameters {
  double l = 0.2;        // side of the square [m], > 0
  double m = 0.3;        // mass [kg], > 0
  double mu = 0.3;       // coefficient of friction [-], >= 0
  double eps = 0.5;      // coefficient of restitution [-], in [0, 1]
  double dt = 0.01;      // time step [s], > 0
  double delta = 0.001;  // contact threshold and lift [m], >= 0
  double g = 9.81;       // gravitational acceleration, downwards [m/s^2]
  int columns = 150;     // columns of a trajectory, the initial state included, in [2, k_max_columns]

  bool operator==(const Parameters&) const = default;
};

// m l^2 / 6 [kg m^2], about the centre of mass.
double moment_of_inertia(const Parameters& parameters);

inline constexpr int k_max_columns = 10'000'000;

// Throws std::invalid_argument naming field, value, unit and allowed range. Sizes so far apart that the moment of
// inertia m l^2 / 6 leaves the range of double are refused too.
void validate(const Parameters& parameters);

}  // namespace tumble::drop
