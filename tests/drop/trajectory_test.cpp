// Part 4: trajectories and their records.
#include <cmath>

#include <gtest/gtest.h>

#include "tumble/drop/drop.hpp"

namespace tumble::drop {
namespace {

const Vector3 k_course_q0 = {0.0, 1.5, 0.5235987755982988};
const Vector3 k_course_v0 = {0.0, -0.2, 0.0};

TEST(Simulate, IsTheStepRepeated) {
  const Trajectory trajectory = simulate(k_course_q0, k_course_v0);
  ASSERT_EQ(trajectory.columns, 150);
  State state{k_course_q0, k_course_v0};
  for (int k = 0; k < 150; ++k) {
    EXPECT_EQ(trajectory.q_at(k), state.q);
    EXPECT_EQ(trajectory.v_at(k), state.v);
    state = step(state.q, state.v);
  }
}

// Free fall of the document's scheme has a closed form: y_k = y0 + k dt vy0 - g dt^2 k (k + 1) / 2, first order in dt.
TEST(Simulate, FallsAsTheSchemeSaysAndConvergesWithOrderOne) {
  const double time = 0.4, g = 9.81;
  double previous_error = 0.0;
  for (const int steps : {40, 80, 160, 320}) {
    const double dt = time / steps;
    const Trajectory trajectory = simulate({0, 10, 0}, {0, -0.2, 0}, {.dt = dt, .columns = steps + 1});
    const double y = trajectory.q_at(steps)[1];
    EXPECT_NEAR(y, 10 - 0.2 * time - g * dt * dt * steps * (steps + 1) / 2.0, 1e-12);  // steps * 1e-16 * 10
    const double error = std::abs(y - (10 - 0.2 * time - 0.5 * g * time * time));
    if (previous_error > 0.0) {
      EXPECT_NEAR(std::log2(previous_error / error), 1.0, 1e-6);
    }
    previous_error = error;
  }
}

TEST(Record, HoldsTheTrajectoryAndOneStepPerColumn) {
  const Record record = simulate_with_record(k_course_q0, k_course_v0);
  const Trajectory trajectory = simulate(k_course_q0, k_course_v0);
  EXPECT_EQ(record.trajectory.q, trajectory.q);
  EXPECT_EQ(record.trajectory.v, trajectory.v);
  ASSERT_EQ(record.steps.size(), 150u);
  for (int k = 0; k < 150; ++k) {
    const StepRecord& s = record.steps[static_cast<std::size_t>(k)];
    EXPECT_EQ(s.gap, get_contacts(trajectory.q_at(k)).phi);
    EXPECT_EQ(s.corner, corner_index(trajectory.q_at(k)));
    EXPECT_LE(s.residual, 1e-14);
    EXPECT_EQ(s.z[0] > 0.0, s.mode != ContactMode::open);
    if (s.gap >= 0.001) {
      EXPECT_EQ(s.z, Vector4{});
    }
  }
}

TEST(Record, StopsWhereTheNumbersLeaveTheRangeOfDouble) {
  const Record record = simulate_with_record({0, 1, 0}, {1e150, 0, 0}, {.dt = 1e158, .g = 0.0, .columns = 50});
  EXPECT_EQ(record.trajectory.status, LcpStatus::numerical);
  EXPECT_EQ(record.trajectory.columns, 2);  // the second step would reach 2e308
  EXPECT_EQ(record.steps.size(), 2u);
  EXPECT_EQ(record.steps.back().status, LcpStatus::numerical);
  EXPECT_EQ(record.trajectory.q.size(), 6u);
  EXPECT_EQ(record.trajectory.q_at(1)[0], 1e150 * 1e158);
}

// The speed grows by 1e154 m/s each step: within two steps its square leaves the range of double.
TEST(Record, StopsWhereAnEnergyLeavesTheRangeOfDouble) {
  const Parameters parameters{.m = 1.5, .dt = 1.0, .g = -1e154, .columns = 50};
  const Record record = simulate_with_record({0, 1, 0}, {0, 0, 0}, parameters);
  EXPECT_EQ(record.trajectory.status, LcpStatus::numerical);
  EXPECT_EQ(record.trajectory.columns, 2);  // 0.75 kg (1e154 m/s)^2 is in range, four times that is not
  EXPECT_EQ(record.steps.size(), 2u);
  EXPECT_TRUE(std::isfinite(kinetic_energy(record.trajectory.v_at(1), parameters)));
  EXPECT_THROW(simulate_with_record({0, 1, 0}, {0, 2e154, 0}, parameters), std::invalid_argument);
  EXPECT_THROW(simulate_with_record({0, 1e160, 0}, {0, 0, 0}, parameters), std::invalid_argument);
  EXPECT_EQ(simulate({0, 1, 0}, {0, 2e154, 0}).columns, 150);  // states have no energies
}

}  // namespace
}  // namespace tumble::drop
