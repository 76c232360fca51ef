#include "tumble/sweep/plan.hpp"

#include <algorithm>

#include "tumble/math/distributions.hpp"

namespace tumble::sweep {
namespace {

std::size_t size_of(const Quantity& quantity) {
  const auto* grid = std::get_if<Grid>(&quantity.source);
  return grid == nullptr ? 1 : grid->values.size();
}

struct Filler {
  void operator()(const Constant& source) const { std::fill(values.begin(), values.end(), source.value); }
  void operator()(const Grid& source) const {
    std::uint64_t instances_per_value = spec.samples;
    for (std::size_t k = quantity + 1; k < spec.quantities.size(); ++k) {
      instances_per_value *= size_of(spec.quantities[k]);
    }
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] = source.values[(first + k) / instances_per_value % source.values.size()];
    }
  }
  void operator()(const Uniform& source) const {
    draw([&](std::uint64_t word) { return uniform(word, source.low, source.high); });
  }
  void operator()(const Normal& source) const {
    draw([&](std::uint64_t word) { return normal(word, source.mean, source.deviation); });
  }
  void operator()(const LogUniform& source) const {
    draw([&](std::uint64_t word) { return log_uniform(word, source.low, source.high); });
  }

  template <class Function>
  void draw(Function value_of) const {
    const std::uint64_t number = spec.quantities[quantity].draw;
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = value_of(draw_word(spec.seed, first + k, number));
  }

  const Spec& spec;
  std::size_t quantity;
  std::uint64_t first;
  std::span<double> values;
};

}  // namespace

std::uint64_t num_instances(const Spec& spec) {
  std::uint64_t product = spec.samples;
  for (const Quantity& quantity : spec.quantities) product *= size_of(quantity);
  return product;
}

std::uint64_t num_chunks(const Spec& spec) { return (num_instances(spec) - 1) / spec.chunk + 1; }

Slice slice_of_chunk(const Spec& spec, std::uint64_t chunk) {
  const std::uint64_t first = chunk * spec.chunk;
  return {first, static_cast<std::size_t>(std::min(spec.chunk, num_instances(spec) - first))};
}

std::vector<Axis> axes_of(const Spec& spec) {
  std::vector<Axis> axes;
  for (const auto& [name, unit, source, draw, target] : spec.quantities) {
    if (const auto* grid = std::get_if<Grid>(&source)) axes.push_back({name, unit, grid->values});
  }
  return axes;
}

bool is_swept(const Quantity& quantity) { return !std::holds_alternative<Constant>(quantity.source); }

void fill_values(const Spec& spec, std::size_t quantity, std::uint64_t first, std::span<double> values) {
  std::visit(Filler{spec, quantity, first, values}, spec.quantities[quantity].source);
}

}  // namespace tumble::sweep
