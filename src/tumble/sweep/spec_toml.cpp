#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "tumble/drop/parameters.hpp"
#include "tumble/scene/toml_reader.hpp"
#include "tumble/sweep/spec.hpp"

namespace tumble::sweep {
namespace {

using toml_reading::Value;

// A quantity of the drop, with the document's value.
struct Known {
  std::string_view name;
  Range range;
  double otherwise;
};
constexpr double k_thirty_degrees = 0.52359877559829887;
constexpr drop::Parameters k_usual{};
constexpr std::array<Known, 6> k_start = {{{"x", k_coordinate_range, 0.0},
                                           {"y", k_coordinate_range, 1.5},
                                           {"theta", k_angle_range, k_thirty_degrees},
                                           {"vx", k_speed_range, 0.0},
                                           {"vy", k_speed_range, -0.2},
                                           {"omega", k_angular_velocity_range, 0.0}}};
constexpr std::array<Known, 7> k_parameters = {{{"l", k_size_range, k_usual.l},
                                                {"m", k_mass_range, k_usual.m},
                                                {"mu", k_friction_range, k_usual.mu},
                                                {"eps", k_restitution_range, k_usual.eps},
                                                {"dt", k_step_size_range, k_usual.dt},
                                                {"delta", k_rounding_range, k_usual.delta},
                                                {"g", k_gravity_range, k_usual.g}}};

double read_number(const Value& value, const Range& range) {
  return range.unit == k_angle_range.unit ? value.angle() : value.number(range);
}

Grid read_range(const Value& value, const Range& range) {
  const std::vector<Value> entries = value.list(3, 3);
  const double first = read_number(entries[0], range);
  const double last = read_number(entries[1], range);
  const auto count = static_cast<std::size_t>(entries[2].integer(2, static_cast<std::int64_t>(k_max_axis)));
  Grid grid;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(count - 1);
    grid.values.push_back(k + 1 == count ? last : first + share * (last - first));
  }
  return grid;
}

Grid read_list(const Value& value, const Range& range) {
  Grid grid;
  for (const Value& entry : value.list(1, k_max_axis)) grid.values.push_back(read_number(entry, range));
  return grid;
}

std::array<double, 2> read_ends(const Value& value, const Range& range) {
  const std::vector<Value> entries = value.list(2, 2);
  const std::array<double, 2> ends = {read_number(entries[0], range), read_number(entries[1], range)};
  if (ends[0] > ends[1]) value.refuse_with(fmt::format("must be [low, high], got [{}, {}]", ends[0], ends[1]));
  return ends;
}

Source read_source(const Value& value, const Range& range) {
  if (!value.is_table()) return Constant{read_number(value, range)};
  value.allow_keys({"range", "list", "uniform", "normal", "log_uniform"});
  const auto entries = value.entries();
  if (entries.size() != 1) {
    value.refuse_with(
        "must be a number or one of range, list, uniform, normal and log_uniform, like "
        "{ uniform = [0, 1] }");
  }
  const auto& [key, entry] = entries[0];
  if (key == "range") return read_range(entry, range);
  if (key == "list") return read_list(entry, range);
  if (key == "normal") {
    const std::vector<Value> pair = entry.list(2, 2);
    const double deviation = read_number(pair[1], range);
    if (deviation < 0.0) pair[1].refuse_with(fmt::format("a standard deviation must be >= 0, got {}", deviation));
    return Normal{read_number(pair[0], range), deviation};
  }
  const auto [low, high] = read_ends(entry, range);
  if (key == "uniform") return Uniform{low, high};
  if (low <= 0.0) entry.refuse_with(fmt::format("must have a low end > 0, got {}", low));
  return LogUniform{low, high};
}

bool is_constant(const Quantity& quantity) { return std::holds_alternative<Constant>(quantity.source); }

bool is_drawn(const Quantity& quantity) {
  return !is_constant(quantity) && !std::holds_alternative<Grid>(quantity.source);
}

class SpecReader {
 public:
  Spec read(const Value& root) {
    root.allow_keys({"sweep", "title", "seed", "samples", "chunk", "keep", "start", "parameters", "measures"});
    root.at("sweep").integer(1, 1);
    spec_.title = root.text_or("title", "");
    for (const auto& [key, value] : root.entries()) {
      if (key == "start") read_quantities(value, k_start, 0);
      if (key == "parameters") read_quantities(value, k_parameters, k_start.size());
    }
    add_usual(k_start, 0);
    add_usual(k_parameters, k_start.size());
    // Where constants stand in the text makes no difference.
    std::stable_sort(spec_.quantities.begin(), spec_.quantities.end(), [](const Quantity& a, const Quantity& b) {
      return is_constant(a) != is_constant(b) ? is_constant(b) : is_constant(a) && a.draw < b.draw;
    });
    if (const auto measures = root.find("measures")) read_measures(*measures);
    read_keep(root);
    read_counts(root);
    return spec_;
  }

 private:
  void read_quantities(const Value& table, std::span<const Known> known, std::uint64_t first_draw) {
    const bool has_steps = known.size() == k_parameters.size();
    if (has_steps) {
      table.allow_keys({"l", "m", "mu", "eps", "dt", "delta", "g", "steps"});
    } else {
      table.allow_keys({"x", "y", "theta", "vx", "vy", "omega"});
    }
    for (const auto& [key, value] : table.entries()) {
      if (key == "steps") {
        spec_.columns = static_cast<int>(value.integer(1, drop::k_max_columns - 1)) + 1;
        continue;
      }
      const auto found = std::find_if(known.begin(), known.end(), [&](const Known& k) { return k.name == key; });
      add(*found, read_source(value, found->range), first_draw + static_cast<std::uint64_t>(found - known.begin()));
    }
  }

  void add_usual(std::span<const Known> known, std::uint64_t first_draw) {
    for (const Known& one : known) {
      const auto has_name = [&](const Quantity& quantity) { return quantity.name == one.name; };
      if (std::none_of(spec_.quantities.begin(), spec_.quantities.end(), has_name)) {
        add(one, Constant{one.otherwise}, first_draw);
      }
      ++first_draw;
    }
  }

  void add(const Known& known, Source source, std::uint64_t draw) {
    spec_.quantities.push_back({std::string(known.name), std::string(known.range.unit), std::move(source), draw});
  }

  void read_measures(const Value& table) {
    table.allow_keys({"rest_speed", "region"});
    spec_.measures.rest_speed =
        table.number_or("rest_speed", {0.0, k_speed_range.high, k_speed_range.unit}, spec_.measures.rest_speed);
    const std::optional<Value> region = table.find("region");
    if (!region) return;
    const auto [low, high] = read_ends(*region, k_coordinate_range);
    spec_.measures.x_min = low;
    spec_.measures.x_max = high;
  }

  void read_keep(const Value& root) {
    const std::optional<Value> value = root.find("keep");
    if (!value) return;
    const std::string word = value->text();
    if (word != "columns" && word != "statistics") {
      value->refuse_with(fmt::format("must be 'columns' or 'statistics', got {}", shown(word)));
    }
    spec_.keep = word == "columns" ? Keep::columns : Keep::statistics;
  }

  static std::uint64_t count_or(const Value& root, std::string_view key, std::int64_t low, std::uint64_t high,
                                std::uint64_t otherwise) {
    const std::optional<Value> value = root.find(key);
    return value ? static_cast<std::uint64_t>(value->integer(low, static_cast<std::int64_t>(high))) : otherwise;
  }

  void read_counts(const Value& root) {
    spec_.seed = count_or(root, "seed", 0, std::numeric_limits<std::int64_t>::max(), spec_.seed);
    spec_.samples = count_or(root, "samples", 1, k_max_instances, spec_.samples);
    const std::uint64_t usual_chunk = spec_.keep == Keep::columns ? k_piece : 16 * k_piece;
    spec_.chunk = count_or(root, "chunk", 1, k_max_chunk, usual_chunk);
    if (spec_.samples > 1 && std::none_of(spec_.quantities.begin(), spec_.quantities.end(), is_drawn)) {
      root.at("samples").refuse_with(fmt::format(
          "must be 1 where nothing is drawn (uniform, normal, log_uniform), as all would be the same; got {}",
          spec_.samples));
    }
    std::uint64_t instances = spec_.samples;
    for (const Quantity& quantity : spec_.quantities) {
      const auto* grid = std::get_if<Grid>(&quantity.source);
      if (grid == nullptr) continue;
      if (instances > k_max_instances / grid->values.size()) {
        root.refuse_with(fmt::format("a sweep has at most {} instances", k_max_instances));
      }
      instances *= grid->values.size();
    }
    if ((instances - 1) / spec_.chunk >= k_max_chunks) {
      const std::uint64_t least = (instances - 1) / k_max_chunks + 1;
      const Value place = root.find("chunk").value_or(root);
      place.refuse_with(least > k_max_chunk
                            ? fmt::format("{} instances are more than a sweep can have: {} chunks of {}", instances,
                                          k_max_chunks, k_max_chunk)
                            : fmt::format("chunk must be at least {} for {} instances, got {}: a sweep has at most {} "
                                          "chunks",
                                          least, instances, spec_.chunk, k_max_chunks));
    }
  }

  Spec spec_;
};

}  // namespace

Spec parse_spec(std::string_view text, const std::string& name) {
  const toml::table root = toml_reading::parse_table(text, name);
  Spec spec = SpecReader().read(Value(root, "", name));
  spec.text = text;
  return spec;
}

}  // namespace tumble::sweep
