// Steps take no memory from the heap.
#include "../allocations.hpp"
#include <gtest/gtest.h>

#include "tumble/drop/drop.hpp"

namespace tumble::drop {
namespace {

TEST(Allocations, AStepMakesNone) {
  if (!test::counts_allocations()) GTEST_SKIP() << "only glibc without a sanitizer lets a program count all of them";
  State state{{0.0, 0.2, 0.5}, {1.0, -2.0, 3.0}};
  int num_contacts = 0;
  const long before = test::num_allocations();
  for (int k = 0; k < 500; ++k) {
    const auto [next, record] = step_with_record(state.q, state.v);
    if (record.z[0] > 0.0) ++num_contacts;
    state = next;
  }
  EXPECT_EQ(test::num_allocations(), before);
  EXPECT_GT(num_contacts, 10);
}

TEST(Allocations, ATrajectoryMakesTwo) {  // q and v
  if (!test::counts_allocations()) GTEST_SKIP() << "only glibc without a sanitizer lets a program count all of them";
  const long before = test::num_allocations();
  const Trajectory trajectory = simulate({0.0, 0.2, 0.5}, {1.0, -2.0, 3.0}, {.columns = 1000});
  EXPECT_EQ(test::num_allocations(), before + 2);
  EXPECT_EQ(trajectory.columns, 1000);
}

}  // namespace
}  // namespace tumble::drop
