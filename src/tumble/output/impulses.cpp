#include "tumble/output/impulses.hpp"

#include <algorithm>
#include <cmath>

namespace tumble::output {

std::vector<Impulse> contact_impulses(const drop::Record& record) {
  std::vector<Impulse> impulses;
  for (int k = 0; k < record.trajectory.columns; ++k) {
    const drop::StepRecord& step = record.steps[static_cast<std::size_t>(k)];
    if (!(step.z[0] > 0.0) || step.status != LcpStatus::solved) continue;
    Impulse impulse;
    impulse.column = k;
    impulse.normal = step.z[0] * record.parameters.dt;
    impulse.tangent = (step.z[2] - step.z[1]) * record.parameters.dt;
    impulse.size = std::hypot(impulse.normal, impulse.tangent);
    impulse.mode = step.mode;
    if (std::isfinite(impulse.size) && impulse.size > 0.0) impulses.push_back(impulse);
  }
  return impulses;
}

double largest_size(const std::vector<Impulse>& impulses) {
  double largest = 0.0;
  for (const Impulse& impulse : impulses) largest = std::max(largest, impulse.size);
  return largest;
}

std::vector<Impulse> keep_largest(std::vector<Impulse> impulses, std::size_t count, double smallest) {
  std::erase_if(impulses, [&](const Impulse& impulse) { return impulse.size < smallest; });
  std::stable_sort(impulses.begin(), impulses.end(),
                   [](const Impulse& a, const Impulse& b) { return a.size > b.size; });
  if (impulses.size() > count) impulses.resize(count);
  std::sort(impulses.begin(), impulses.end(), [](const Impulse& a, const Impulse& b) { return a.column < b.column; });
  return impulses;
}

}  // namespace tumble::output
