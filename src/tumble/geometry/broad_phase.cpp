#include "tumble/geometry/broad_phase.hpp"

#include <algorithm>
#include <cmath>

namespace tumble {
namespace {

constexpr std::size_t k_few = 20;       // boxes: each against each is faster
constexpr double k_strip_height = 2.0;  // mean heights of a box
constexpr double k_tall = 8.0;          // strips
constexpr double k_most_strips = 1e15;  // numbers of strips fit into 64 bits
constexpr std::int64_t k_tall_mark = INT64_MIN;

}  // namespace

const std::vector<BoxPair>& BroadPhase::find(const std::vector<Box>& boxes) {
  pairs_.clear();
  if (boxes.size() <= k_few) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t j = i + 1; j < boxes.size(); ++j) {
        if (overlap(boxes[i], boxes[j])) pairs_.push_back({static_cast<int>(i), static_cast<int>(j)});
      }
    }
    return pairs_;
  }
  sort_by_x(boxes);
  assign_strips();
  sweep_strips();
  sweep_tall();
  return pairs_;
}

// By insertion: between two calls the order hardly changes. The first time from scratch.
void BroadPhase::sort_by_x(const std::vector<Box>& boxes) {
  const auto before = [&](int i, int j) { return boxes[i].low.x < boxes[j].low.x; };
  if (order_.size() != boxes.size()) {
    order_.resize(boxes.size());
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<int>(i);
    std::sort(order_.begin(), order_.end(), before);
  }
  for (std::size_t i = 1; i < order_.size(); ++i) {
    const int index = order_[i];
    std::size_t j = i;
    for (; j > 0 && before(index, order_[j - 1]); --j) order_[j] = order_[j - 1];
    order_[j] = index;
  }
  entries_.clear();
  for (const int index : order_) entries_.push_back({boxes[index], index, 0, 0});
}

void BroadPhase::assign_strips() {
  double height = 0.0;
  for (const Entry& e : entries_) height += e.box.high.y - e.box.low.y;
  const double per_height = static_cast<double>(entries_.size()) / (k_strip_height * height);
  tall_.clear();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    Entry& e = entries_[i];
    const double low = std::floor(e.box.low.y * per_height), high = std::floor(e.box.high.y * per_height);
    const bool fits = low > -k_most_strips && high < k_most_strips && high - low < k_tall;
    if (!fits) tall_.push_back(static_cast<int>(i));
    e.low = fits ? static_cast<std::int64_t>(low) : k_tall_mark;
    e.high = fits ? static_cast<std::int64_t>(high) : k_tall_mark;
  }
}

void BroadPhase::add(const Entry& a, const Entry& b) {
  pairs_.push_back({std::min(a.index, b.index), std::max(a.index, b.index)});
}

void BroadPhase::sweep_strips() {
  // Boxes of each strip, still in the order of x: by counting.
  const std::int64_t buckets = static_cast<std::int64_t>(entries_.size()) + 1;
  const auto bucket_of = [&](std::int64_t strip) {
    return static_cast<std::size_t>(((strip % buckets) + buckets) % buckets);
  };
  bucket_.assign(static_cast<std::size_t>(buckets) + 1, 0);
  const auto for_strips = [&](auto&& visit) {
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      const Entry& e = entries_[i];
      if (e.low == k_tall_mark) continue;
      for (std::int64_t strip = e.low; strip <= e.high; ++strip) visit(InStrip{static_cast<int>(i), strip});
    }
  };
  for_strips([&](const InStrip& s) { ++bucket_[bucket_of(s.strip) + 1]; });
  for (std::size_t k = 1; k < bucket_.size(); ++k) bucket_[k] += bucket_[k - 1];
  in_strips_.resize(static_cast<std::size_t>(bucket_.back()));
  for_strips([&](const InStrip& s) { in_strips_[static_cast<std::size_t>(bucket_[bucket_of(s.strip)]++)] = s; });

  std::size_t begin = 0;
  for (std::size_t k = 0; k + 1 < bucket_.size(); ++k) {
    const std::size_t end = static_cast<std::size_t>(bucket_[k]);
    for (std::size_t i = begin; i < end; ++i) {
      const Entry& a = entries_[static_cast<std::size_t>(in_strips_[i].entry)];
      for (std::size_t j = i + 1; j < end; ++j) {
        const Entry& b = entries_[static_cast<std::size_t>(in_strips_[j].entry)];
        if (b.box.low.x > a.box.high.x) break;
        // Two boxes may share several strips: they count in the lowest of those.
        const bool counts = in_strips_[i].strip == in_strips_[j].strip && in_strips_[i].strip == std::max(a.low, b.low);
        if (counts && overlap(a.box, b.box)) add(a, b);
      }
    }
    begin = end;
  }
}

void BroadPhase::sweep_tall() {
  for (const int t : tall_) {
    const Entry& tall = entries_[static_cast<std::size_t>(t)];
    for (std::size_t i = 0; i < entries_.size() && entries_[i].box.low.x <= tall.box.high.x; ++i) {
      const bool other_is_tall = entries_[i].low == k_tall_mark;
      if ((!other_is_tall || static_cast<int>(i) > t) && overlap(tall.box, entries_[i].box)) add(tall, entries_[i]);
    }
  }
}

}  // namespace tumble
