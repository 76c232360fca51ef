// 95 % confidence intervals. Theory: docs/theory/statistics.md.
#pragma once

#include <cstdint>

namespace tumble::sweep {

struct Interval {
  double low;
  double high;
};

// Of the probability of something that happened `count` times in `total` independent trials: Wilson's score interval
// [Wilson 1927]. NaN where total is 0.
Interval interval_of_share(std::int64_t count, std::int64_t total);

// Of the mean of a distribution of which `count` independent draws have this mean and this sum of squared deviations:
// by Student's t. NaN where there are fewer than two.
Interval interval_of_mean(std::int64_t count, double mean, double squares);

// t with P(|T| > t) = 0.05 for Student's t with that many degrees of freedom, >= 1; to 2e-8 of t.
double student_t_95(std::int64_t degrees);

}  // namespace tumble::sweep
