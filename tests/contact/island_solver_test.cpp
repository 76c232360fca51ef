// The impulses of an island against the LCP that they have to solve, and against the general solver and enumeration.
#include "tumble/contact/island_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "problems.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/residual.hpp"
#include "tumble/lcp/solve.hpp"
#include "tumble/math/vector2.hpp"

namespace tumble {
namespace {

using problems::Random;
using Index = std::size_t;

constexpr double k_accepted_residual = 1e-10;  // what `ContactSolver::exact` promises
// Velocities of the same solution found in two ways, over the largest speed: impulses to a residual of 1e-10 move
// bodies by that times their response, which is ten times that of a contact for the thinnest of them.
constexpr double k_same_velocity = 1e-9;

struct Solved {
  IslandSolution result;
  std::vector<ContactMode> modes;
  std::vector<double> impulses;
  std::vector<Vector3> velocity;
};

Solved solve_from(const ContactSystem& system, const std::vector<ContactMode>& modes,
                  const std::vector<double>& impulses) {
  IslandSolver solver;
  solver.system = system;
  solver.modes = modes;
  solver.impulses = impulses;
  const IslandSolution result = solver.solve({});
  return {result, solver.modes, solver.impulses, solver.velocity};
}

Solved solve(const ContactSystem& system) {
  const Index m = system.contacts.size();
  return solve_from(system, std::vector<ContactMode>(m, ContactMode::open), std::vector<double>(2 * m, 0.0));
}

// z of `as_lcp(system)` for these impulses and velocities.
std::vector<double> as_z(const ContactSystem& system, const Solved& solved) {
  const Index m = system.contacts.size();
  std::vector<double> z(4 * m);
  for (Index i = 0; i < m; ++i) {
    z[i] = solved.impulses[2 * i];
    z[m + 2 * i] = std::max(solved.impulses[2 * i + 1], 0.0);
    z[m + 2 * i + 1] = std::max(-solved.impulses[2 * i + 1], 0.0);
    z[3 * m + i] = std::abs(velocity_at(system.contacts[i], solved.velocity)[1]);
  }
  return z;
}

double difference(const std::vector<Vector3>& a, const std::vector<Vector3>& b, const ContactSystem& system) {
  double largest = 0.0, size = 1e-300;
  for (Index i = 0; i < a.size(); ++i) {
    for (Index k = 0; k < 3; ++k) {
      const double arm = std::sqrt(system.inverse_mass[i][0] / system.inverse_mass[i][k]);  // of gyration, for turning
      largest = std::max(largest, arm * std::abs(a[i][k] - b[i][k]));
      size = std::max({size, arm * std::abs(system.velocity[i][k]), arm * std::abs(b[i][k])});
    }
  }
  return largest / size;
}

void expect_solves(const ContactSystem& system, const Solved& solved) {
  EXPECT_EQ(solved.result.status, LcpStatus::solved) << "residual " << solved.result.residual;
  EXPECT_LE(solved.result.residual, k_accepted_residual);
  EXPECT_LE(residual(as_lcp(system), as_z(system, solved)).largest(), k_accepted_residual);
  for (Index i = 0; i < system.contacts.size(); ++i) {
    EXPECT_GE(solved.impulses[2 * i], 0.0);
    EXPECT_LE(std::abs(solved.impulses[2 * i + 1]), system.contacts[i].friction * solved.impulses[2 * i] * (1 + 1e-15));
  }
  // The velocities are those of the impulses.
  EXPECT_LT(difference(solved.velocity, velocities_after(system, as_z(system, solved)), system), 1e-12);
}

// A contact in direction `angle` from a to b at `arm_a` and `arm_b` from the centres of mass.
BodyContact contact_of(int a, int b, double angle, const Vector2& arm_a, const Vector2& arm_b, double friction) {
  const double nx = std::cos(angle), ny = std::sin(angle), tx = -ny, ty = nx;
  BodyContact contact;
  contact.body_a = a;
  contact.body_b = b;
  contact.friction = friction;
  contact.normal_a = {-nx, -ny, -(arm_a.x * ny - arm_a.y * nx)};
  contact.tangent_a = {-tx, -ty, -(arm_a.x * ty - arm_a.y * tx)};
  contact.normal_b = {nx, ny, arm_b.x * ny - arm_b.y * nx};
  contact.tangent_b = {tx, ty, arm_b.x * ty - arm_b.y * tx};
  return contact;
}

// Bodies of 0.5 to 2 m; the ground and other bodies touch them anywhere. Masses up to `mass_ratio` apart. No offset, so
// that there is a solution: bodies at rest are one without impulses.
ContactSystem random_system(Random& random, int num_bodies, int num_contacts, double largest_friction,
                            double mass_ratio = 10.0) {
  ContactSystem system;
  for (int b = 0; b < num_bodies; ++b) {
    const double mass = std::pow(mass_ratio, random.uniform(0.0, 1.0)), gyration = random.uniform(0.2, 0.7);
    system.inverse_mass.push_back({1.0 / mass, 1.0 / mass, 1.0 / (mass * gyration * gyration)});
    system.velocity.push_back({random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-2.0, 2.0)});
  }
  for (int i = 0; i < num_contacts; ++i) {
    const int b = random.below(num_bodies);
    int a = random.below(num_bodies + 1) - 1;
    if (a == b) a = -1;
    const Vector2 arm_a{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    const Vector2 arm_b{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    const double friction = random.one_in(4) ? 0.0 : random.uniform(0.0, largest_friction);
    system.contacts.push_back(contact_of(a, b, random.uniform(-3.14, 3.14), arm_a, arm_b, friction));
  }
  return system;
}

std::vector<Index> shuffled(Random& random, Index count) {
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index{0});
  for (Index i = count; i-- > 1;) std::swap(order[i], order[static_cast<Index>(random.below(static_cast<int>(i) + 1))]);
  return order;
}

// The same system with body and contact k where `bodies[k]` and `contacts[k]` were; of every second contact the bodies
// change places.
ContactSystem in_other_order(const ContactSystem& system, const std::vector<Index>& bodies,
                             const std::vector<Index>& contacts) {
  std::vector<int> place(bodies.size());
  ContactSystem moved;
  for (Index k = 0; k < bodies.size(); ++k) {
    place[bodies[k]] = static_cast<int>(k);
    moved.inverse_mass.push_back(system.inverse_mass[bodies[k]]);
    moved.velocity.push_back(system.velocity[bodies[k]]);
  }
  for (Index k = 0; k < contacts.size(); ++k) {
    BodyContact contact = system.contacts[contacts[k]];
    if (contact.body_a >= 0) contact.body_a = place[static_cast<Index>(contact.body_a)];
    if (contact.body_b >= 0) contact.body_b = place[static_cast<Index>(contact.body_b)];
    if (k % 2 == 1) {
      std::swap(contact.body_a, contact.body_b);
      std::swap(contact.normal_a, contact.normal_b);
      std::swap(contact.tangent_a, contact.tangent_b);
    }
    moved.contacts.push_back(contact);
  }
  return moved;
}

// In the order of `system`.
std::vector<Vector3> velocities_in_other_order(Random& random, const ContactSystem& system) {
  const std::vector<Index> bodies = shuffled(random, system.velocity.size());
  const ContactSystem moved = in_other_order(system, bodies, shuffled(random, system.contacts.size()));
  const Solved solved = solve(moved);
  expect_solves(moved, solved);
  std::vector<Vector3> velocity(bodies.size());
  for (Index k = 0; k < bodies.size(); ++k) velocity[bodies[k]] = solved.velocity[k];
  return velocity;
}

bool has_failed() { return testing::Test::HasFailure(); }

TEST(IslandSolver, SolvesTheLcpOfRandomBodies) {
  Random random(51);
  for (int trial = 0; trial < 1000 && !has_failed(); ++trial) {
    const ContactSystem system = random_system(random, 1 + trial % 5, 1 + trial % 12, trial % 3 == 0 ? 2.0 : 0.7);
    SCOPED_TRACE(trial);
    expect_solves(system, solve(system));
  }
}

// What the rounding of impulses and velocities can make of the residual: that of the terms that contact velocities are
// sums of, over the largest speed before the impulses. It is large where impulses are that cancel.
double rounding_of(const ContactSystem& system, const Solved& solved) {
  std::vector<Vector3> terms = system.velocity;
  for (Vector3& v : terms) {
    for (double& entry : v) entry = std::abs(entry);
  }
  for (Index i = 0; i < system.contacts.size(); ++i) {
    for_bodies(system.contacts[i], [&](Index b, const Vector3& normal, const Vector3& tangent) {
      for (Index k = 0; k < 3; ++k) {
        terms[b][k] += system.inverse_mass[b][k] * (std::abs(normal[k] * solved.impulses[2 * i]) +
                                                    std::abs(tangent[k] * solved.impulses[2 * i + 1]));
      }
    });
  }
  double largest = 0.0, speed = 1e-300;
  for (const BodyContact& contact : system.contacts) {
    double n = 0.0, t = 0.0;
    for_bodies(contact, [&](Index b, const Vector3& normal, const Vector3& tangent) {
      for (Index k = 0; k < 3; ++k) {
        n += std::abs(normal[k]) * terms[b][k];
        t += std::abs(tangent[k]) * terms[b][k];
      }
    });
    largest = std::max({largest, n, t});
    const auto [u_n, u_t] = velocity_at(contact, system.velocity);
    speed = std::max({speed, std::abs(u_n), std::abs(u_t)});
  }
  constexpr double unit = 1.1102230246251565e-16, sums = 10.0;  // roundings that a velocity is a sum of
  return sums * unit * largest / speed;
}

// Towers, pyramids, piles, wedges, jamming rods, and wild ones with bodies a million apart in mass: all solvable.
TEST(IslandSolver, SolvesEveryFamilyOfContactProblems) {
  for (const problems::Family& family : problems::families()) {
    for (std::uint64_t i = 0; i < 240; ++i) {
      Random random = problems::random_of(52, i);
      const ContactSystem system = family.make(random, 1 + i % 12);
      SCOPED_TRACE(testing::Message() << family.name << " " << i);
      const Solved solved = solve(system);
      EXPECT_EQ(solved.result.status, LcpStatus::solved);
      EXPECT_LE(solved.result.residual, k_accepted_residual);
      EXPECT_LE(residual(as_lcp(system), as_z(system, solved)).largest(),
                k_accepted_residual + rounding_of(system, solved));
    }
  }
}

// Without friction the kinetic energy that the velocities minimise is strictly convex: they are unique.
TEST(IslandSolver, MovesBodiesWithoutFrictionAsTheGeneralSolverDoes) {
  Random random(53);
  for (int trial = 0; trial < 400 && !has_failed(); ++trial) {
    const ContactSystem system = random_system(random, 1 + trial % 5, 1 + trial % 12, 0.0);
    SCOPED_TRACE(trial);
    const Solved solved = solve(system);
    expect_solves(system, solved);
    const LcpResult dense = solve_lcp(as_lcp(system));
    ASSERT_EQ(dense.status, LcpStatus::solved);
    EXPECT_LT(difference(solved.velocity, velocities_after(system, dense.z), system), k_same_velocity);
    EXPECT_LT(difference(velocities_in_other_order(random, system), solved.velocity, system), k_same_velocity);
  }
}

// Every solution of up to three contacts is known: where all have one motion, all orders find it.
TEST(IslandSolver, FindsTheOneMotionWithFrictionInEveryOrder) {
  Random random(54);
  int num_unique = 0;
  for (int trial = 0; trial < 150 && !has_failed(); ++trial) {
    const ContactSystem system = random_system(random, 1 + trial % 3, 1 + trial % 3, trial % 4 == 0 ? 2.0 : 0.7);
    SCOPED_TRACE(trial);
    const Solved solved = solve(system);
    expect_solves(system, solved);
    const std::vector<LcpResult> all = enumerate_solutions(as_lcp(system));
    ASSERT_FALSE(all.empty());
    const std::vector<Vector3> first = velocities_after(system, all.front().z);
    double spread = 0.0;
    for (const LcpResult& other : all)
      spread = std::max(spread, difference(velocities_after(system, other.z), first, system));
    if (spread > k_same_velocity) continue;
    ++num_unique;
    EXPECT_LT(difference(solved.velocity, first, system), k_same_velocity);
    EXPECT_LT(difference(velocities_in_other_order(random, system), first, system), k_same_velocity);
  }
  EXPECT_GT(num_unique, 130);
}

TEST(IslandSolver, LeavesASolutionAsItIs) {
  Random random(55);
  for (int trial = 0; trial < 300; ++trial) {
    const ContactSystem system = random_system(random, 1 + trial % 5, 1 + trial % 12, 0.7);
    const Solved solved = solve(system);
    const Solved again = solve_from(system, solved.modes, solved.impulses);
    SCOPED_TRACE(trial);
    EXPECT_EQ(again.result.status, LcpStatus::solved);
    EXPECT_EQ(again.result.factorisations, 0);
    EXPECT_EQ(again.modes, solved.modes);
    EXPECT_EQ(again.impulses, solved.impulses);
    EXPECT_EQ(again.velocity, solved.velocity);
  }
}

// The same contact twice, and once more: loads share, velocities are those of one.
TEST(IslandSolver, TakesContactsThatAreThereSeveralTimes) {
  Random random(56);
  for (int trial = 0; trial < 300 && !has_failed(); ++trial) {
    const bool has_friction = trial % 2 == 1;
    const ContactSystem system = random_system(random, 1 + trial % 4, 1 + trial % 4, has_friction ? 0.7 : 0.0);
    ContactSystem repeated = system;
    for (int copy = 0; copy < 2; ++copy) {
      repeated.contacts.insert(repeated.contacts.end(), system.contacts.begin(), system.contacts.end());
    }
    SCOPED_TRACE(trial);
    const Solved solved = solve(repeated);
    expect_solves(repeated, solved);
    if (!has_friction) {
      EXPECT_LT(difference(solved.velocity, solve(system).velocity, system), k_same_velocity);
    }
  }
}

// A square of 1 m in a frame, touched at all four corners from below and from above, and at rest on four points: more
// contacts than it has ways to move.
TEST(IslandSolver, HoldsABodyAtMoreContactsThanItNeeds) {
  const double gravity = -9.81 * 0.01;
  for (const double friction : {0.0, 0.5}) {
    for (const double spin : {0.0, 1.0}) {
      ContactSystem system;
      system.inverse_mass = {{1.0, 1.0, 6.0}};
      system.velocity = {{0.3, gravity, spin}};
      for (const double x : {-0.5, -0.2, 0.2, 0.5}) {
        system.contacts.push_back(contact_of(-1, 0, 1.5707963267948966, {}, {x, -0.5}, friction));
        system.contacts.push_back(contact_of(-1, 0, -1.5707963267948966, {}, {x, 0.5}, friction));
      }
      SCOPED_TRACE(testing::Message() << "friction " << friction << ", spin " << spin);
      const Solved solved = solve(system);
      expect_solves(system, solved);
      // Neither up nor down nor turning; friction takes what it can of the slide, here all of it if it can press.
      EXPECT_NEAR(solved.velocity[0][1], 0.0, 1e-12);
      EXPECT_NEAR(solved.velocity[0][2], 0.0, 1e-12);
      if (friction == 0.0) {
        EXPECT_NEAR(solved.velocity[0][0], 0.3, 1e-12);
      }
      if (friction > 0.0 && spin == 0.0) {
        EXPECT_LT(solved.velocity[0][0], 0.3 - friction * 9.81 * 0.01 + 1e-12);
      }
    }
  }
}

// A box of 1 m on another that stands on the ground, on two corners each, at rest under gravity: masses 1 to 1e6 and
// the other way round.
TEST(IslandSolver, HoldsStacksOfMassesAMillionApart) {
  const double gravity = -9.81 * 0.01;
  for (const double top_mass : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    for (const double friction : {0.0, 0.5}) {
      ContactSystem system;
      system.inverse_mass = {{1.0, 1.0, 6.0}, {1.0 / top_mass, 1.0 / top_mass, 6.0 / top_mass}};
      system.velocity = {{0.0, gravity, 0.0}, {0.0, gravity, 0.0}};
      for (const double x : {-0.5, 0.5}) {
        system.contacts.push_back(contact_of(-1, 0, 1.5707963267948966, {}, {x, -0.5}, friction));
        system.contacts.push_back(contact_of(0, 1, 1.5707963267948966, {x, 0.5}, {x, -0.5}, friction));
      }
      SCOPED_TRACE(testing::Message() << "top " << top_mass << " kg, friction " << friction);
      const Solved solved = solve(system);
      expect_solves(system, solved);
      for (Index b = 0; b < 2; ++b) {
        for (Index k = 0; k < 3; ++k) EXPECT_NEAR(solved.velocity[b][k], 0.0, k_same_velocity * std::abs(gravity));
      }
      const double top_load = -gravity * top_mass, ground_load = -gravity * (1.0 + top_mass);
      EXPECT_NEAR(solved.impulses[2] + solved.impulses[6], top_load, k_same_velocity * top_load);
      EXPECT_NEAR(solved.impulses[0] + solved.impulses[4], ground_load, k_same_velocity * ground_load);
    }
  }
}

TEST(IslandSolver, SolvesRandomBodiesOfMassesAMillionApart) {
  Random random(57);
  for (int trial = 0; trial < 400 && !has_failed(); ++trial) {
    const ContactSystem system = random_system(random, 2 + trial % 4, 1 + trial % 12, 0.7, 1e6);
    SCOPED_TRACE(trial);
    expect_solves(system, solve(system));
  }
}

// Restitution, gaps and conveyors: offsets of any size, with those systems left out that the general solver does not
// solve either.
TEST(IslandSolver, SolvesSystemsWithOffsetsWhereTheGeneralSolverDoes) {
  Random random(58);
  int num_solved = 0;
  for (int trial = 0; trial < 400; ++trial) {
    ContactSystem system = random_system(random, 1 + trial % 5, 1 + trial % 8, 0.7);
    for (BodyContact& contact : system.contacts) {
      contact.offset = random.uniform(-0.2, 1.0);
      contact.tangent_offset = random.uniform(-1.0, 1.0);
    }
    if (solve_lcp(as_lcp(system)).status != LcpStatus::solved) continue;
    ++num_solved;
    SCOPED_TRACE(trial);
    expect_solves(system, solve(system));
  }
  EXPECT_GT(num_solved, 300);
}

}  // namespace
}  // namespace tumble
