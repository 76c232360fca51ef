// What a sweep is: which starts and parameters, what is measured, what is kept. The format is in docs/sweep.md.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tumble/batch/rollout.hpp"
#include "tumble/batch/simulate_batch.hpp"
#include "tumble/scene/scene.hpp"

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

// What a quantity of a scene is in a rollout.
struct SceneTarget {
  enum class Kind { pose, velocity, varied };
  Kind kind = Kind::pose;
  int index = 0;       // into movable_bodies, of `varied` as batch::Varied::index
  int coordinate = 0;  // of pose or velocity: x, y, angle
  batch::Quantity quantity = batch::Quantity::mass;
};

struct Quantity {
  std::string name;
  std::string unit;
  Source source;
  std::uint64_t draw;  // its number among the draws of an instance
  SceneTarget target{};
};

enum class Keep {
  columns,     // a row for each instance
  statistics,  // the summary alone
};

// Instances that are computed at once. Statistics of chunks are those of pieces, merged in order.
inline constexpr std::uint64_t k_piece = 65536;
inline constexpr std::uint64_t k_scene_piece = 1024;  // of scenes, whose runs take milliseconds

// Runs of this scene in place of drops.
struct SceneModel {
  Scene scene;
  std::string text;  // that it was read from
  int body = 0;      // the one that is measured, index into movable_bodies
};

struct Spec {
  std::string title;
  std::uint64_t seed = 0;
  std::uint64_t samples = 1;      // instances of each cell
  std::uint64_t chunk = k_piece;  // instances whose results are stored at once
  Keep keep = Keep::columns;
  // All of the drop, or those that differ from the scene; those swept first, in the order of the text.
  std::vector<Quantity> quantities;
  int columns = 150;  // of each drop, the start included
  std::optional<SceneModel> scene{};
  batch::MeasureSettings measures{};
  std::string text{};  // that it was read from
};

inline constexpr std::uint64_t k_max_chunks = 1'000'000;
inline constexpr std::uint64_t k_max_chunk = 16'777'216;
inline constexpr std::uint64_t k_max_instances = k_max_chunks * k_max_chunk;
inline constexpr std::size_t k_max_axis = 1'000'000;
inline constexpr std::size_t k_max_spec_bytes = std::size_t{64} << 20;

// The text of the scene file that a spec names.
using ReadScene = std::function<std::string(const std::string& file)>;

// Throws std::invalid_argument "<name>:<line>:<column>: <field>: <what is allowed>, <what is there>", one line.
// A scene is refused where there is no `read_scene`; what that throws and what parse_scene throws is passed on.
Spec parse_spec(std::string_view text, const std::string& name = "spec", const ReadScene& read_scene = {});

// A number that tells sweeps apart: of everything that results depend on, the version of Tumble included.
std::uint64_t fingerprint(const Spec& spec);

}  // namespace tumble::sweep
