// Records and comparisons that the tests of the files and pictures share.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tumble/drop/drop.hpp"

namespace tumble::output::test {

// The document's first start, some columns of it.
inline drop::Record course_record(int columns = 150) {
  drop::Parameters parameters;
  parameters.columns = columns;
  return drop::simulate_with_record({0.0, 1.5, 0.5235987755982988}, {0.0, -0.2, 0.0}, parameters);
}

// Stops with a failed step: its state leaves the range of double.
inline drop::Record failed_record() {
  drop::Parameters parameters;
  parameters.columns = 40;
  parameters.g = 4e153;
  parameters.dt = 0.4;
  return drop::simulate_with_record({0.0, 10.0, 0.1}, {1.0, -0.2, 3.0}, parameters);
}

// Equal as bits: -0.0 differs from 0.0 and NaN equals itself.
inline bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof(double)) == 0; }

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

inline void expect_same(const drop::Record& a, const drop::Record& b) {
  EXPECT_EQ(a.parameters, b.parameters);
  EXPECT_EQ(a.trajectory.columns, b.trajectory.columns);
  EXPECT_EQ(a.trajectory.status, b.trajectory.status);
  EXPECT_TRUE(same_bits(a.trajectory.q, b.trajectory.q));
  EXPECT_TRUE(same_bits(a.trajectory.v, b.trajectory.v));
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t k = 0; k < a.steps.size(); ++k) {
    EXPECT_TRUE(same_bits(a.steps[k].gap, b.steps[k].gap)) << k;
    EXPECT_EQ(a.steps[k].corner, b.steps[k].corner) << k;
    for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(same_bits(a.steps[k].z[i], b.steps[k].z[i])) << k;
    EXPECT_EQ(a.steps[k].mode, b.steps[k].mode) << k;
    EXPECT_EQ(a.steps[k].status, b.steps[k].status) << k;
    EXPECT_TRUE(same_bits(a.steps[k].residual, b.steps[k].residual)) << k;
  }
}

// What the exception says; "" and a failure if there is none of this type.
template <class Exception, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another exception: " << error.what();
    return "";
  }
  ADD_FAILURE() << "no exception";
  return "";
}

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace tumble::output::test
