// What a sweep says in a table: which outcome how often, with 95 % intervals, and where the measures lie.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tumble/sweep/intervals.hpp"
#include "tumble/sweep/statistics.hpp"

namespace tumble::sweep {

// What of the sweep the statistics do not know.
struct Facts {
  std::string title;
  std::vector<std::string> swept;  // "theta: 0 to 1.5 rad, 12 values"
  double rest_speed = 0.0;         // see batch::MeasureSettings
  bool is_drawn = true;            // something is random
};

struct Share {
  Outcome outcome;
  std::int64_t count;
  double share;       // of those solved; NaN where none was
  Interval interval;  // of the probability
};

// Over the instances that were solved and have the measure. NaN where there are too few.
struct MeasureSummary {
  Measure measure;
  std::int64_t count;
  std::int64_t missing;  // solved, without the event that is measured
  double mean;
  Interval interval;                                                   // of the mean
  double deviation;                                                    // root of the sum of squares over count - 1
  double min, low, first_quartile, median, third_quartile, high, max;  // low, high: 5 % and 95 % are below
};

struct Summary {
  Facts facts;
  std::int64_t instances;
  std::int64_t solved;
  std::int64_t numerical;
  std::int64_t invalid;
  std::vector<Share> shares;  // of the k_num_landed outcomes of those solved
  std::vector<MeasureSummary> measures;
};

Summary summarise(const Statistics& statistics, const Facts& facts);

// "+y up", ..., "still moving", "numerical", "invalid".
const char* name_of(Outcome outcome);

std::string to_text(const Summary& summary);  // for reading, ends with a line break
std::string to_csv(
    const Summary& summary);  // a line for each outcome and measure; empty cells where there is no number
std::string to_json(const Summary& summary);  // null where there is no number

}  // namespace tumble::sweep
