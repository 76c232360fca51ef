// All closed forms, at all step sizes of the table.
#include "closed_form.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace tumble::physics {
namespace {

class ClosedFormTest : public testing::TestWithParam<ClosedForm> {};

// The order seen at step sizes of milliseconds is not yet that of the limit.
constexpr double k_order_tolerance = 0.2;

TEST_P(ClosedFormTest, IsMet) {
  const ClosedForm& form = GetParam();
  if (*form.not_met_because) GTEST_SKIP() << form.not_met_because;
  std::vector<double> errors;
  for (const double h : k_step_sizes) {
    errors.push_back(largest_error(form, h));
    if (form.order == 0.0 || h <= 1e-3) {
      EXPECT_LE(errors.back(), form.bound) << form.name << ", step size " << h;
    }
  }
  if (form.order == 0.0) return;
  for (const double error : errors) {
    if (error > k_round_off) {
      EXPECT_GE(observed_order(errors), form.order - k_order_tolerance) << form.name;
      return;
    }
  }
}

std::string name_of(const testing::TestParamInfo<ClosedForm>& info) {
  std::string name;
  bool is_start = true;
  for (const char c : info.param.name) {
    const bool is_word = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (is_word) name += is_start && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    is_start = !is_word;
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Physics, ClosedFormTest, testing::ValuesIn(closed_forms()), name_of);

}  // namespace
}  // namespace tumble::physics
