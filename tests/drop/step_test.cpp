// Parts 2 and 3: the LCP of the document and one step.
#include <cmath>
#include <limits>
#include <stdexcept>

#include "../random_contact.hpp"
#include <gtest/gtest.h>

#include "tumble/drop/drop.hpp"
#include "tumble/lcp/enumerate.hpp"

namespace tumble::drop {
namespace {

// A square that touches the ground at an angle, with random velocity: contact in nearly every mode.
State random_touching_state(test::Random& random, const Parameters& p) {
  const double theta = random.uniform(-7.0, 7.0);
  const double height = -get_contacts({0, 0, theta}, p).phi;
  return {{random.uniform(-1, 1), height + random.uniform(-0.03, 1.0) * p.delta, theta},
          {random.uniform(-3, 3), random.uniform(-3, 1), random.uniform(-20, 20)}};
}

// The display of the document, entry by entry, with its own matrices.
TEST(FormLcp, IsTheDocumentsDisplay) {
  test::Random random(30);
  const Parameters p{.l = 0.4, .m = 0.7, .mu = 0.45, .eps = 0.8, .dt = 0.002, .g = 3.7};
  const Vector3 M = {p.m, p.m, p.m * p.l * p.l / 6.0};
  const Vector3 f_e = {0.0, -p.g * M[1], 0.0};
  for (int i = 0; i < 200; ++i) {
    const State s = random_touching_state(random, p);
    const auto [J, phi] = get_contacts(s.q, p);
    const auto [V, right] = form_lcp(J, s.v, p);
    const std::array<Vector3, 3> rows = {J.n, Vector3{-J.t[0], -J.t[1], -J.t[2]}, J.t};  // the document's J hat
    for (std::size_t a = 0; a < 3; ++a) {
      double from_v = 0.0, from_f_e = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        from_v += rows[a][k] * s.v[k];
        from_f_e += rows[a][k] * p.dt * f_e[k] / M[k];
      }
      EXPECT_NEAR(right[a], (a == 0 ? 1.0 + p.eps : 1.0) * from_v + from_f_e, 1e-14);  // velocities up to 10
      for (std::size_t b = 0; b < 3; ++b) {
        double sum = 0.0;
        for (std::size_t k = 0; k < 3; ++k) sum += rows[a][k] * rows[b][k] / M[k];
        EXPECT_NEAR(V[a][b], sum * p.dt, 1e-16);  // entries up to 0.02
      }
    }
    EXPECT_EQ(right[3], 0.0);
    EXPECT_EQ(V[3], (Vector4{p.mu, -1, -1, 0}));
    EXPECT_EQ((Vector3{V[0][3], V[1][3], V[2][3]}), (Vector3{0, 1, 1}));
  }
}

TEST(SolveLCP, SolvesContactsAndOtherProblems) {
  const Vector3 stick = solve_LCP({{{1, 0, 0, 0}, {0, 4, -4, 1}, {0, -4, 4, 1}, {.5, -1, -1, 0}}}, {-1, -.1, .1, 0});
  EXPECT_NEAR(stick[0], 1.0, 1e-15);
  EXPECT_NEAR(stick[1] - stick[2], .025, 1e-15);
  const Vector3 diagonal = solve_LCP({{{2, 0, 0, 0}, {0, 4, 0, 0}, {0, 0, 8, 0}, {0, 0, 0, 1}}}, {-2, 4, -2, 0});
  EXPECT_EQ(diagonal, (Vector3{1.0, 0.0, 0.25}));
  // A solution that Lemke ends on a ray for.
  const Vector3 game = solve_LCP({{{0, 0, 10, 30}, {0, 0, 20, 15}, {10, 30, 0, 0}, {20, 15, 0, 0}}}, {-1, -1, -1, -1});
  EXPECT_GT(game[0] + game[1], 0.01);
}

TEST(SolveLCP, SaysSoIfThereIsNoSolution) {
  const Matrix4 V = {{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  try {
    solve_LCP(V, {-1, 0, 0, 0});
    FAIL() << "a problem without a solution was solved";
  } catch (const NoSolution& error) {
    EXPECT_EQ(error.status, LcpStatus::no_solution_proved);
    EXPECT_NE(std::string(error.what()).find("no_solution_proved"), std::string::npos);
  }
}

// Against every vertex solution, also where V is not symmetric or has no contact structure.
TEST(SolveLCP, AgreesWithEnumerationOnAnyMatrix) {
  test::Random random(31);
  int num_unsolvable = 0;
  for (int i = 0; i < 3000; ++i) {
    Matrix4 V;
    Vector4 p;
    LcpProblem problem;
    for (auto& row : V) {
      for (double& entry : row) problem.M.push_back(entry = std::floor(random.uniform(-3, 4)));
    }
    for (double& entry : p) problem.q.push_back(entry = std::floor(random.uniform(-3, 3)));
    const std::vector<LcpResult> all = enumerate_solutions(problem);
    if (all.empty()) {
      ++num_unsolvable;
      EXPECT_THROW(solve_LCP(V, p), NoSolution);
      continue;
    }
    const Vector3 f = solve_LCP(V, p);
    const bool is_known = std::any_of(all.begin(), all.end(), [&](const LcpResult& s) {
      return std::abs(s.z[0] - f[0]) + std::abs(s.z[1] - f[1]) + std::abs(s.z[2] - f[2]) < 1e-9;
    });
    EXPECT_TRUE(is_known) << i;
  }
  EXPECT_GT(num_unsolvable, 100);
}

TEST(Step, IsFreeFallAboveDelta) {
  const State s = step({1, 2, 3}, {4, 5, 6});
  EXPECT_EQ(s.v, (Vector3{4, 5 - 0.01 * 9.81, 6}));
  EXPECT_EQ(s.q, (Vector3{1 + 0.01 * 4, 2 + 0.01 * s.v[1], 3 + 0.01 * 6}));
}

// Contact is phi < delta, strictly; the lift is added whenever in contact, also while the corner separates.
TEST(Step, LiftsInContactOnly) {
  const Parameters p{.delta = 0.5};
  const Vector3 at_delta = {0, 0.6, 0};  // phi = 0.6 - 0.1
  ASSERT_EQ(get_contacts(at_delta, p).phi, 0.5);
  const State free = step(at_delta, {0, 2, 0}, p);
  EXPECT_EQ(free.q[1], 0.6 + 0.01 * free.v[1]);
  const Vector3 below = {0, 0.599, 0};
  const RecordedStep separating = step_with_record(below, {0, 2, 0}, p);
  EXPECT_EQ(separating.record.mode, ContactMode::open);
  EXPECT_EQ(separating.record.z[0], 0.0);
  EXPECT_EQ(separating.state.q[1], 0.599 + 0.01 * separating.state.v[1] + 0.5);
}

// Newton's law of the document: the corner leaves with -eps times its speed, up to the gravity of one step.
TEST(Step, ReversesTheNormalVelocityOfTheCorner) {
  test::Random random(32);
  for (int i = 0; i < 2000; ++i) {
    const Parameters p{.mu = random.uniform(0, 1.3), .eps = random.uniform(0, 1)};
    const State before = random_touching_state(random, p);
    const auto [after, record] = step_with_record(before.q, before.v, p);
    ASSERT_EQ(record.status, LcpStatus::solved);
    const Jacobian J = get_contacts(before.q, p).J;
    const double f_n = record.z[0], f_t = record.z[2] - record.z[1];
    EXPECT_GE(f_n, 0.0);
    EXPECT_LE(std::abs(f_t), p.mu * f_n * (1 + 1e-15));
    if (f_n > 0.0) {
      EXPECT_NEAR(dot(J.n, after.v), -p.eps * dot(J.n, before.v), 1e-13);  // speeds up to 10
    }
    const double slip = dot(J.t, after.v);
    switch (record.mode) {
      case ContactMode::open: EXPECT_EQ(f_n, 0.0); break;
      case ContactMode::stick: EXPECT_NEAR(slip, 0.0, 1e-13); break;
      case ContactMode::slip_left:
        EXPECT_LT(slip, 1e-13);
        EXPECT_NEAR(f_t, p.mu * f_n, 1e-12 * f_n);
        break;
      case ContactMode::slip_right:
        EXPECT_GT(slip, -1e-13);
        EXPECT_NEAR(f_t, -p.mu * f_n, 1e-12 * f_n);
        break;
    }
    // Momentum: the change is the impulse of gravity and contact.
    EXPECT_NEAR(p.m * (after.v[0] - before.v[0]), p.dt * f_t, 1e-14);
    EXPECT_NEAR(p.m * (after.v[1] - before.v[1]), p.dt * (f_n - p.m * p.g), 1e-14);
  }
}

// Thomson and Tait: the work of an impulse is the impulse times the mean of the velocities before and after.
TEST(Step, ChangesTheEnergyByTheWorkOfTheImpulses) {
  test::Random random(33);
  for (int i = 0; i < 2000; ++i) {
    const Parameters p{.g = 0.0};
    const State before = random_touching_state(random, p);
    const auto [after, record] = step_with_record(before.q, before.v, p);
    const Jacobian J = get_contacts(before.q, p).J;
    const double f_n = record.z[0], f_t = record.z[2] - record.z[1];
    const double work =
        0.5 * p.dt * (f_n * (dot(J.n, before.v) + dot(J.n, after.v)) + f_t * (dot(J.t, before.v) + dot(J.t, after.v)));
    EXPECT_NEAR(kinetic_energy(after.v, p) - kinetic_energy(before.v, p), work, 1e-14);  // energies up to 3 J
  }
}

// Closed forms of single impacts without gravity, from the theory of planar impact: v after, to the digits given.
TEST(Step, AgreesWithClosedFormImpacts) {
  struct Impact {
    double degrees, mu, eps;
    Vector3 before, after;
  };
  const Impact impacts[] = {
      {20, .3, .5, {0, -2, 0}, {0.75560496, 0.51868320, -8.05318660}},    // slip all the way
      {20, .3, .5, {3, -2, 0}, {2.70993606, -0.26366394, -21.14308397}},  // stick
      {20, .3, .5, {-1, -2, 0}, {-0.24439504, 0.51868320, -8.05318660}},  // slip all the way
      {30, .5, .5, {.2, -2, 0}, {0.70245191, 0.81177858, -5.14230485}},   // stick
      {45, .3, .5, {0, -2, 0}, {0, 1, 0}},                                // no slip
      {45, .3, .5, {1, -2, 0}, {0.75, 1, -5.30330086}},                   // stick
  };
  for (const Impact& impact : impacts) {
    const Parameters p{.mu = impact.mu, .eps = impact.eps, .g = 0.0};
    const double theta = impact.degrees * std::acos(-1.0) / 180.0;
    const Vector3 q = {0, -get_contacts({0, 0, theta}, p).phi, theta};
    const State after = step(q, impact.before, p);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(after.v[k], impact.after[k], 6e-9) << impact.degrees;
  }
}

TEST(Step, MovesAlongTheGroundWithTheFrame) {
  test::Random random(34);
  const Parameters p;
  for (int i = 0; i < 500; ++i) {
    const State s = random_touching_state(random, p);
    const State here = step({0.0, s.q[1], s.q[2]}, s.v, p);
    const State there = step({1024.0, s.q[1], s.q[2]}, s.v, p);
    EXPECT_EQ(here.v, there.v);
    EXPECT_EQ(here.q[1], there.q[1]);
    EXPECT_EQ(here.q[2], there.q[2]);
  }
}

TEST(Step, MirrorsAMirroredState) {
  test::Random random(35);
  for (int i = 0; i < 2000; ++i) {
    const Parameters p{.mu = random.uniform(0, 1.3), .eps = random.uniform(0, 1)};
    const State s = random_touching_state(random, p);
    const State a = step(s.q, s.v, p);
    const State b = step({-s.q[0], s.q[1], -s.q[2]}, {-s.v[0], s.v[1], -s.v[2]}, p);
    EXPECT_EQ(b.q, (Vector3{-a.q[0], a.q[1], -a.q[2]}));
    EXPECT_EQ(b.v, (Vector3{-a.v[0], a.v[1], -a.v[2]}));
  }
}

TEST(Step, ReportsNumbersBeyondDouble) {
  const double huge = std::numeric_limits<double>::max();
  EXPECT_EQ(step_with_record({0, 0, 0}, {0, -huge, 0}).record.status, LcpStatus::numerical);
  EXPECT_THROW(step({0, 0, 0}, {0, -huge, 0}), NoSolution);
  EXPECT_EQ(step_with_record({huge, 5, 0}, {huge, 0, 0}, {.dt = 10.0}).record.status, LcpStatus::numerical);
}

}  // namespace
}  // namespace tumble::drop
