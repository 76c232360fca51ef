#include "closed_form.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tumble::physics {

std::vector<ClosedForm> closed_forms() {
  std::vector<ClosedForm> all;
  for (auto part : {flights, bounces, impacts, slides, rolls, rocks, forces, thresholds}) {
    std::vector<ClosedForm> some = part();
    all.insert(all.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
  }
  return all;
}

double largest_error(const ClosedForm& form, double step_size) {
  double largest = 0.0;
  for (const double share : {1.0, 0.98, 0.97, 0.95, 0.93, 0.91, 0.9, 0.88, 0.86, 0.84, 0.82, 0.81}) {
    largest = std::max(largest, form.error(share * step_size));
  }
  return largest;
}

double observed_order(const std::vector<double>& errors) {
  double sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0;
  const auto n = static_cast<double>(errors.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double x = std::log(k_step_sizes[i]), y = std::log(errors[i]);
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

Vector2 impulse_between(const StepReport& report, int body_a, int body_b) {
  Vector2 sum;
  for (const ContactRecord& record : report.contacts) {
    if (record.contact.body_a != body_a || record.contact.body_b != body_b) continue;
    sum = sum + record.normal_impulse * record.contact.normal + record.friction_impulse * record.tangent;
  }
  return sum;
}

}  // namespace tumble::physics
