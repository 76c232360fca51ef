// Statistics as arrays of a file, and back.
#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "tumble/math/format.hpp"
#include "tumble/sweep/statistics.hpp"

namespace tumble::sweep {
namespace {

using output::Field;

class Reader {
 public:
  explicit Reader(std::span<const Field> fields) : fields_(fields) {}

  // `size` entries, or any number where it is negative.
  template <class T>
  const std::vector<T>& get(const std::string& name, std::ptrdiff_t size) const {
    for (const Field& field : fields_) {
      if (field.name != name) continue;
      const auto* values = std::get_if<std::vector<T>>(&field.values);
      if (values == nullptr) throw std::invalid_argument(tumble::format("{}: has numbers of another type", name));
      if (size >= 0 && values->size() != static_cast<std::size_t>(size)) {
        throw std::invalid_argument(tumble::format("{}: must have {} entries, has {}", name, size, values->size()));
      }
      return *values;
    }
    throw std::invalid_argument(tumble::format("{}: is missing", name));
  }

 private:
  std::span<const Field> fields_;
};

template <class T>
Field make_field(const char* name, std::vector<std::size_t> shape, std::vector<T> values) {
  return {name, "", std::move(shape), std::move(values)};
}

template <class Source, class Member>
auto collect(const Source& source, Member member) {
  std::vector<std::remove_cvref_t<decltype(source[0].*member)>> values;
  for (const auto& entry : source) values.push_back(entry.*member);
  return values;
}

template <class Target, class Member, class T>
void spread(Target& target, Member member, const std::vector<T>& values) {
  for (std::size_t k = 0; k < target.size(); ++k) target[k].*member = values[k];
}

void read_histogram(Histogram& histogram, const std::int32_t* bins, const std::int64_t* counts, std::size_t size) {
  histogram.bins.assign(bins, bins + size);
  histogram.counts.assign(counts, counts + size);
  for (std::size_t i = 0; i < size; ++i) {
    const bool is_good = std::abs(bins[i]) <= k_last_bin && (i == 0 || bins[i - 1] < bins[i]) && counts[i] > 0;
    if (!is_good) throw std::invalid_argument(tumble::format("statistics_bin: entry {} is damaged", i));
  }
}

}  // namespace

// Cells that no instance lies in are left out.
std::vector<Field> Statistics::to_fields() const {
  const std::size_t measures = layout_.measures.size();
  std::vector<std::int32_t> sizes, bins;
  std::vector<std::int64_t> counts;
  for (const Histogram& histogram : histograms_) {
    sizes.push_back(static_cast<std::int32_t>(histogram.bins.size()));
    bins.insert(bins.end(), histogram.bins.begin(), histogram.bins.end());
    counts.insert(counts.end(), histogram.counts.begin(), histogram.counts.end());
  }
  std::vector<std::int32_t> cells;
  std::vector<std::int64_t> cell_outcomes, cell_counts;
  std::vector<double> cell_sums;
  for (std::size_t cell = 0; cell < cell_outcomes_.size(); ++cell) {
    if (cell_outcomes_[cell] == OutcomeCounts{}) continue;
    cells.push_back(static_cast<std::int32_t>(cell));
    cell_outcomes.insert(cell_outcomes.end(), cell_outcomes_[cell].begin(), cell_outcomes_[cell].end());
    for (std::size_t m = 0; m < measures; ++m) {
      cell_counts.push_back(cell_sums_[at(cell, m)].count);
      cell_sums.push_back(cell_sums_[at(cell, m)].sum);
    }
  }
  const std::size_t num_bins = bins.size(), num_cells = cells.size();
  return {make_field("statistics_outcomes", {k_num_outcomes},
                     std::vector<std::int64_t>(outcomes_.begin(), outcomes_.end())),
          make_field("statistics_count", {measures}, collect(moments_, &Moments::count)),
          make_field("statistics_missing", {measures}, collect(moments_, &Moments::missing)),
          make_field("statistics_mean", {measures}, collect(moments_, &Moments::mean)),
          make_field("statistics_squares", {measures}, collect(moments_, &Moments::squares)),
          make_field("statistics_min", {measures}, collect(moments_, &Moments::min)),
          make_field("statistics_max", {measures}, collect(moments_, &Moments::max)),
          make_field("statistics_bins", {measures}, std::move(sizes)),
          make_field("statistics_bin", {num_bins}, std::move(bins)),
          make_field("statistics_bin_count", {num_bins}, std::move(counts)),
          make_field("statistics_cell", {num_cells}, std::move(cells)),
          make_field("statistics_cell_outcomes", {num_cells, k_num_outcomes}, std::move(cell_outcomes)),
          make_field("statistics_cell_count", {num_cells, measures}, std::move(cell_counts)),
          make_field("statistics_cell_sum", {num_cells, measures}, std::move(cell_sums))};
}

Statistics Statistics::from_fields(Layout layout, std::span<const Field> fields) {
  Statistics result(std::move(layout));
  const Reader reader(fields);
  const auto measures = static_cast<std::ptrdiff_t>(result.layout_.measures.size());
  const auto& outcomes = reader.get<std::int64_t>("statistics_outcomes", k_num_outcomes);
  std::copy(outcomes.begin(), outcomes.end(), result.outcomes_.begin());
  spread(result.moments_, &Moments::count, reader.get<std::int64_t>("statistics_count", measures));
  spread(result.moments_, &Moments::missing, reader.get<std::int64_t>("statistics_missing", measures));
  spread(result.moments_, &Moments::mean, reader.get<double>("statistics_mean", measures));
  spread(result.moments_, &Moments::squares, reader.get<double>("statistics_squares", measures));
  spread(result.moments_, &Moments::min, reader.get<double>("statistics_min", measures));
  spread(result.moments_, &Moments::max, reader.get<double>("statistics_max", measures));

  const auto& sizes = reader.get<std::int32_t>("statistics_bins", measures);
  const auto& bins = reader.get<std::int32_t>("statistics_bin", -1);
  const auto& counts = reader.get<std::int64_t>("statistics_bin_count", static_cast<std::ptrdiff_t>(bins.size()));
  std::size_t next = 0;
  for (std::size_t m = 0; m < sizes.size(); ++m) {
    if (sizes[m] < 0 || static_cast<std::size_t>(sizes[m]) > bins.size() - next) {
      throw std::invalid_argument(tumble::format("statistics_bins: entry {} is damaged", m));
    }
    const auto size = static_cast<std::size_t>(sizes[m]);
    read_histogram(result.histograms_[m], bins.data() + next, counts.data() + next, size);
    next += size;
  }

  const auto& cells = reader.get<std::int32_t>("statistics_cell", -1);
  const auto num_cells = static_cast<std::ptrdiff_t>(cells.size());
  const auto& cell_outcomes =
      reader.get<std::int64_t>("statistics_cell_outcomes", num_cells * static_cast<std::ptrdiff_t>(k_num_outcomes));
  const auto& cell_counts = reader.get<std::int64_t>("statistics_cell_count", num_cells * measures);
  const auto& cell_sums = reader.get<double>("statistics_cell_sum", num_cells * measures);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto cell = static_cast<std::size_t>(cells[k]);
    if (cells[k] < 0 || cell >= result.cell_outcomes_.size()) {
      throw std::invalid_argument(tumble::format("statistics_cell: entry {} is damaged", k));
    }
    std::copy_n(cell_outcomes.begin() + static_cast<std::ptrdiff_t>(k * k_num_outcomes), k_num_outcomes,
                result.cell_outcomes_[cell].begin());
    for (std::size_t m = 0; m < sizes.size(); ++m) {
      result.cell_sums_[result.at(cell, m)] = {cell_counts[k * sizes.size() + m], cell_sums[k * sizes.size() + m]};
    }
  }
  return result;
}

}  // namespace tumble::sweep
