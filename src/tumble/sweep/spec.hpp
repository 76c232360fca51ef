// What a sweep is: which starts and parameters, what is measured, what is kept. The format is in docs/sweep.md.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tumble/batch/simulate_batch.hpp"

namespace tumble::sweep {

// Where the values of a quantity come from. A grid's are those of an axis; the others but constants are drawn.
struct Constant {
  double value;
};
struct Grid {
  std::vector<double> values;
};
struct Uniform {
  double low, high;
};
struct Normal {
  double mean, deviation;
};
struct LogUniform {
  double low, high;  // > 0
};
using Source = std::variant<Constant, Grid, Uniform, Normal, LogUniform>;

struct Quantity {
  std::string name;
  std::string unit;
  Source source;
  std::uint64_t draw;  // its number among the draws of an instance
};

enum class Keep {
  columns,     // a row for each instance
  statistics,  // the summary alone
};

// Instances that are computed at once. Statistics of chunks are those of pieces, merged in order.
inline constexpr std::uint64_t k_piece = 65536;

struct Spec {
  std::string title;
  std::uint64_t seed = 0;
  std::uint64_t samples = 1;      // instances of each cell
  std::uint64_t chunk = k_piece;  // instances whose results are stored at once
  Keep keep = Keep::columns;
  std::vector<Quantity> quantities;  // all of the model; those swept first, in the order of the text
  int columns = 150;                 // of each run, the start included
  batch::MeasureSettings measures{};
  std::string text{};  // that it was read from
};

inline constexpr std::uint64_t k_max_instances = 1'000'000'000'000'000;
inline constexpr std::uint64_t k_max_chunks = 1'000'000;
inline constexpr std::uint64_t k_max_chunk = 16'777'216;
inline constexpr std::size_t k_max_axis = 1'000'000;
inline constexpr std::size_t k_max_spec_bytes = std::size_t{64} << 20;

// Throws std::invalid_argument "<name>:<line>:<column>: <field>: <what is allowed>, <what is there>", one line.
Spec parse_spec(std::string_view text, const std::string& name = "spec");

// A number that tells sweeps apart: of everything that results depend on, the version of Tumble included.
std::uint64_t fingerprint(const Spec& spec);

}  // namespace tumble::sweep
