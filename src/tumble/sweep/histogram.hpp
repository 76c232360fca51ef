// A histogram that fits any range: 512 bins for each power of two of either sign, so that quantiles are good to 0.2 %
// of their value before the range is known. Counts are whole numbers: the order of adding does not matter.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tumble::sweep {

// The bins that are not empty, by increasing number. Bin 0 holds |x| < 2^-32, bin -k the negatives of bin k.
struct Histogram {
  std::vector<std::int32_t> bins;
  std::vector<std::int64_t> counts;
};

inline constexpr std::int32_t k_last_bin = 64 * 512 + 1;  // of 2^32 and all above

// `x` is not NaN.
std::int32_t bin_of(double x);

// Where the bin begins and ends.
struct BinEnds {
  double low;
  double high;
};
BinEnds ends_of(std::int32_t bin);

Histogram make_histogram(std::span<const double> values);

void merge(Histogram& histogram, const Histogram& other);

std::int64_t total(const Histogram& histogram);

// The value below which the share p in [0, 1] of all lies; between min and max, those of the values; of whole numbers
// one of them. NaN of an empty histogram.
double quantile(const Histogram& histogram, double p, double min, double max, bool is_whole);

// How many values lie in each of the bins between the edges, the last one included. Where an edge cuts a bin of the
// histogram, its count is shared by length.
std::vector<double> rebin(const Histogram& histogram, std::span<const double> edges, double min, double max,
                          bool is_whole);

}  // namespace tumble::sweep
