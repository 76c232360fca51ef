// What the instances of a sweep add up to, without keeping them: outcomes, moments and histograms of the measures, and
// both for the cells of a map over one or two swept quantities. Theory: docs/theory/statistics.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tumble/output/field.hpp"
#include "tumble/sweep/columns.hpp"
#include "tumble/sweep/histogram.hpp"

namespace tumble::sweep {

// How an instance ends. The first four: at rest, with this face up (see batch::DropMeasures).
enum class Outcome { face_0, face_1, face_2, face_3, moving, numerical, invalid };
inline constexpr std::size_t k_num_outcomes = 7;
inline constexpr std::size_t k_num_landed = 5;  // those of instances that were solved

struct Measure {
  std::string name;
  std::string unit;
  bool is_whole = false;
};

// A swept quantity in bins: bin k is [edges[k], edges[k + 1]), the last one with its upper edge.
struct CellAxis {
  std::string name;
  std::string unit;
  std::vector<double> edges;  // increasing
  bool is_logarithmic = false;

  std::size_t size() const { return edges.size() - 1; }
};

inline constexpr std::size_t k_most_bins = 256;  // of an axis
inline constexpr std::size_t k_drawn_bins = 48;  // of an axis of random values

// A bin around each value; where there are more than k_most_bins, neighbours share one.
CellAxis cells_of_values(const Axis& axis);

// Bins of equal width, or of equal ratio where 0 < low and `is_logarithmic`.
CellAxis cells_of_range(const std::string& name, const std::string& unit, double low, double high,
                        bool is_logarithmic = false);

struct Layout {
  std::vector<Measure> measures;
  std::vector<CellAxis> axes;  // none, one or two; the second one runs fastest over the cells

  std::size_t num_cells() const;  // 0 without axes
};

// Of the values of a measure over the instances that were solved.
struct Moments {
  std::int64_t count = 0;    // not NaN
  std::int64_t missing = 0;  // NaN: there is no such event
  double mean = 0.0;
  double squares = 0.0;  // sum of (value - mean)^2
  double min = 0.0;      // 0 if count is
  double max = 0.0;
};

using OutcomeCounts = std::array<std::int64_t, k_num_outcomes>;

class Statistics {
 public:
  // Throws std::invalid_argument for more than two axes.
  explicit Statistics(Layout layout);

  // The same as merge(statistics of the chunk alone). Needs the columns status, face, rest_time, the measures and the
  // axes; throws std::invalid_argument naming what is missing or out of range.
  void add(std::span<const Column> chunk);

  // Moments are rounded: those of the same chunks have the same bits if they are merged one by one in the order of the
  // chunks, however these were shared out before. Counts do not depend on the order. Both have the same layout.
  void merge(const Statistics& other);

  const Layout& layout() const { return layout_; }
  const OutcomeCounts& outcomes() const { return outcomes_; }
  const Moments& moments(std::size_t measure) const { return moments_[measure]; }
  const Histogram& histogram(std::size_t measure) const { return histograms_[measure]; }

  // Of a cell: num_cells() of them, those of the first axis' first bin first.
  const OutcomeCounts& outcomes_in(std::size_t cell) const { return cell_outcomes_[cell]; }
  // NaN where no instance has the measure.
  double mean_in(std::size_t cell, std::size_t measure) const;

  // As arrays of a file, and back; names begin with "statistics_". `from_fields` throws std::invalid_argument naming
  // the array that is missing or does not fit the layout.
  std::vector<output::Field> to_fields() const;
  static Statistics from_fields(Layout layout, std::span<const output::Field> fields);

 private:
  struct Sum {
    std::int64_t count = 0;
    double sum = 0.0;
  };

  void add_cells(std::span<const Column> chunk, std::span<const Outcome> outcomes);
  std::size_t at(std::size_t cell, std::size_t measure) const { return cell * layout_.measures.size() + measure; }

  Layout layout_;
  OutcomeCounts outcomes_{};
  std::vector<Moments> moments_;
  std::vector<Histogram> histograms_;
  std::vector<OutcomeCounts> cell_outcomes_;
  std::vector<Sum> cell_sums_;  // cells x measures
};

// The columns by name; nullptr if there is none.
const Column* find_column(std::span<const Column> columns, const std::string& name);

}  // namespace tumble::sweep
