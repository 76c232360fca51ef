#include "tumble/sweep/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tumble/math/bit_cast.hpp"

namespace tumble::sweep {
namespace {

constexpr int k_dropped_bits = 52 - 9;  // of the mantissa
constexpr double k_smallest = 0x1p-32;
constexpr double k_largest = 0x1p32;

std::int64_t leading_bits(double size) {
  return static_cast<std::int64_t>(bit_cast<std::uint64_t>(size) >> k_dropped_bits);
}

double start_of(std::int32_t bin) {
  return bit_cast<double>(static_cast<std::uint64_t>(bin - 1 + leading_bits(k_smallest)) << k_dropped_bits);
}

// Where in a bin its values are, as far as that is known.
BinEnds values_in(std::int32_t bin, double min, double max, bool is_whole) {
  BinEnds ends = bin == 0 ? BinEnds{0.0, 0.0} : ends_of(bin);
  if (is_whole) ends.low = ends.high = bin < 0 ? std::floor(ends.high) : std::ceil(ends.low);
  return {std::clamp(ends.low, min, max), std::clamp(ends.high, min, max)};
}

}  // namespace

std::int32_t bin_of(double x) {
  const double size = std::min(std::abs(x), k_largest);
  if (size < k_smallest) return 0;
  const auto bin = static_cast<std::int32_t>(leading_bits(size) - leading_bits(k_smallest) + 1);
  return x < 0.0 ? -bin : bin;
}

BinEnds ends_of(std::int32_t bin) {
  if (bin == 0) return {-k_smallest, k_smallest};
  const std::int32_t size = std::abs(bin);
  const BinEnds ends = {start_of(size), size == k_last_bin ? std::numeric_limits<double>::max() : start_of(size + 1)};
  return bin < 0 ? BinEnds{-ends.high, -ends.low} : ends;
}

Histogram make_histogram(std::span<const double> values) {
  std::vector<std::int64_t> dense(2 * k_last_bin + 1);
  std::int32_t first = k_last_bin, last = -k_last_bin;
  for (const double value : values) {
    const std::int32_t bin = bin_of(value);
    first = std::min(first, bin);
    last = std::max(last, bin);
    ++dense[static_cast<std::size_t>(bin + k_last_bin)];
  }
  Histogram histogram;
  for (std::int32_t bin = first; bin <= last; ++bin) {
    const std::int64_t count = dense[static_cast<std::size_t>(bin + k_last_bin)];
    if (count == 0) continue;
    histogram.bins.push_back(bin);
    histogram.counts.push_back(count);
  }
  return histogram;
}

void merge(Histogram& histogram, const Histogram& other) {
  Histogram sum;
  sum.bins.reserve(histogram.bins.size() + other.bins.size());
  sum.counts.reserve(sum.bins.capacity());
  std::size_t i = 0, j = 0;
  while (i < histogram.bins.size() || j < other.bins.size()) {
    const bool has_first = i < histogram.bins.size() && (j == other.bins.size() || histogram.bins[i] <= other.bins[j]);
    const bool has_second = j < other.bins.size() && (i == histogram.bins.size() || other.bins[j] <= histogram.bins[i]);
    sum.bins.push_back(has_first ? histogram.bins[i] : other.bins[j]);
    sum.counts.push_back((has_first ? histogram.counts[i++] : 0) + (has_second ? other.counts[j++] : 0));
  }
  histogram = std::move(sum);
}

std::int64_t total(const Histogram& histogram) {
  return std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::int64_t{0});
}

double quantile(const Histogram& histogram, double p, double min, double max, bool is_whole) {
  if (histogram.bins.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double wanted = p * static_cast<double>(total(histogram));
  double below = 0.0;
  for (std::size_t i = 0; i < histogram.bins.size(); ++i) {
    const auto count = static_cast<double>(histogram.counts[i]);
    if (below + count >= wanted) {
      const BinEnds ends = values_in(histogram.bins[i], min, max, is_whole);
      return ends.low + (wanted - below) / count * (ends.high - ends.low);
    }
    below += count;
  }
  return max;
}

std::vector<double> rebin(const Histogram& histogram, std::span<const double> edges, double min, double max,
                          bool is_whole) {
  std::vector<double> counts(edges.size() - 1, 0.0);
  for (std::size_t i = 0; i < histogram.bins.size(); ++i) {
    const auto [low, high] = values_in(histogram.bins[i], min, max, is_whole);
    const auto count = static_cast<double>(histogram.counts[i]);
    if (high < edges.front() || low > edges.back()) continue;
    auto k = static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end() - 1, low) - edges.begin());
    k = k == 0 ? 0 : k - 1;
    if (high <= low) {
      counts[k] += count;
      continue;
    }
    for (; k < counts.size() && edges[k] < high; ++k) {
      const double shared = std::min(high, edges[k + 1]) - std::max(low, edges[k]);
      counts[k] += count * std::max(0.0, shared) / (high - low);
    }
  }
  return counts;
}

}  // namespace tumble::sweep
