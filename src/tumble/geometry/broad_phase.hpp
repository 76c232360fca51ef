// Which of many boxes overlap.
#pragma once

#include <cstdint>
#include <vector>

#include "tumble/geometry/placed_shape.hpp"

namespace tumble {

// Indices of two boxes, first < second.
struct BoxPair {
  int first = 0, second = 0;
};

// Sweep and prune in strips: the plane is cut into horizontal strips about twice as high as a box; in each, boxes in
// the order of their lower x meet those that begin before they end. Boxes higher than a few strips are swept over all.
// What is kept from call to call is the order in x, which saves sorting and changes no result.
class BroadPhase {
 public:
  // Each overlapping pair once, in no certain order. Valid until the next call.
  const std::vector<BoxPair>& find(const std::vector<Box>& boxes);

 private:
  struct Entry {
    Box box;
    int index = 0;
    std::int64_t low = 0, high = 0;  // strips
  };
  struct InStrip {
    int entry = 0;           // index into entries_
    std::int64_t strip = 0;  // strips that are many apart share a bucket
  };

  void sort_by_x(const std::vector<Box>& boxes);
  void assign_strips();
  void sweep_strips();
  void sweep_tall();
  void add(const Entry& a, const Entry& b);

  std::vector<int> order_;
  std::vector<Entry> entries_;  // by lower x
  std::vector<int> tall_;       // of entries_
  std::vector<InStrip> in_strips_;
  std::vector<int> bucket_;
  std::vector<BoxPair> pairs_;
};

}  // namespace tumble
