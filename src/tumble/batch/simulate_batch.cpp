#include "tumble/batch/simulate_batch.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "tumble/batch/block_runner.hpp"
#include "tumble/batch/parallel.hpp"
#include "tumble/drop/drop.hpp"
#include "tumble/math/format.hpp"

namespace tumble::batch {
namespace {

struct NamedParameter {
  const char* name;
  std::span<const double> DropParameters::*values;
  double drop::Parameters::*field;
};

constexpr NamedParameter k_parameters[] = {
    {"l", &DropParameters::l, &drop::Parameters::l},    {"m", &DropParameters::m, &drop::Parameters::m},
    {"mu", &DropParameters::mu, &drop::Parameters::mu}, {"eps", &DropParameters::eps, &drop::Parameters::eps},
    {"dt", &DropParameters::dt, &drop::Parameters::dt}, {"delta", &DropParameters::delta, &drop::Parameters::delta},
    {"g", &DropParameters::g, &drop::Parameters::g}};

// ---- What is refused as a whole ----

template <class T>
void require_length(std::span<T> array, const char* name, std::size_t length) {
  if (array.empty() || array.size() == length) return;
  throw std::invalid_argument(tumble::format("{}: must have {} numbers, got {}", name, length, array.size()));
}

template <class Real>
void require_lengths(const DropStarts<Real>& starts, const DropParameters& parameters, const BatchSettings& settings,
                     const DropResults<Real>& results) {
  if (starts.q0.size() % 3 != 0 || starts.q0.size() != starts.v0.size()) {
    throw std::invalid_argument(
        tumble::format("q0, v0: must both be N x 3, got {} and {} numbers", starts.q0.size(), starts.v0.size()));
  }
  const std::size_t count = starts.size();
  for (const auto& [name, values, field] : k_parameters) {
    const std::size_t length = (parameters.*values).size();
    if (length > 1 && length != count) {
      throw std::invalid_argument(tumble::format("{}: must have 1 or {} values, got {}", name, count, length));
    }
  }
  const std::size_t kept = 3 * count * kept_columns(parameters.columns, settings.every);
  require_length(results.q, "results.q", kept);
  require_length(results.v, "results.v", kept);
  require_length(results.status, "results.status", count);
  require_length(results.columns, "results.columns", count);
  require_length(results.measures, "results.measures", count);
}

void validate(const BatchSettings& settings) {
  require_threads(settings.threads);
  if (settings.every < 0) throw std::invalid_argument(tumble::format("every: must be >= 0, got {}", settings.every));
  validate(settings.measures);
  if (settings.instruction_set && !has_instruction_set(*settings.instruction_set)) {
    throw std::invalid_argument(
        tumble::format("instruction_set: this machine has no {}", to_string(*settings.instruction_set)));
  }
}

bool is_common(std::span<const double> values) { return values.size() <= 1; }

// The values that hold for all, and the document's in place of those that each drop has its own of.
drop::Parameters common_parameters(const DropParameters& parameters) {
  drop::Parameters common;
  for (const auto& [name, values, field] : k_parameters) {
    if ((parameters.*values).size() == 1) common.*field = (parameters.*values)[0];
  }
  common.columns = parameters.columns;
  return common;
}

bool all_common(const DropParameters& parameters) {
  const auto is_common_in = [&](const NamedParameter& p) { return is_common(parameters.*p.values); };
  return std::all_of(std::begin(k_parameters), std::end(k_parameters), is_common_in);
}

// Small enough for all threads to have some, and for a watch to be called now and then: about 30 ms of steps. Of no
// influence on the results.
template <class Real>
std::size_t drops_of_a_block(std::size_t count, int columns, int every, std::size_t threads) {
  constexpr std::size_t k_most_steps = 5'000'000;
  const auto padded = [](std::size_t drops) { return drops / k_padding * k_padding; };
  const std::size_t share = padded(count / (4 * threads)) + k_padding;
  return std::min({BlockRunner<Real>::most_drops(every), share,
                   padded(k_most_steps / static_cast<std::size_t>(columns)) + k_padding});
}

}  // namespace

drop::Parameters parameters_at(const DropParameters& parameters, std::size_t i) {
  drop::Parameters p;
  for (const auto& [name, values, field] : k_parameters) {
    const std::span<const double> array = parameters.*values;
    if (!array.empty()) p.*field = array[array.size() == 1 ? 0 : i];
  }
  p.columns = parameters.columns;
  return p;
}

std::size_t kept_columns(int columns, int every) {
  return every == 0 ? 1
                    : (static_cast<std::size_t>(columns) + static_cast<std::size_t>(every) - 1) /
                          static_cast<std::size_t>(every);
}

std::string what_is_invalid(const DropStarts<double>& starts, const DropParameters& parameters, std::size_t i) {
  try {
    drop::step_with_record(starts.pose(i), starts.velocity(i), parameters_at(parameters, i));
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

template <class Real>
void simulate_batch(const DropStarts<Real>& starts, const DropParameters& parameters, const BatchSettings& settings,
                    const DropResults<Real>& results) {
  validate(settings);
  const drop::Parameters common_values = common_parameters(parameters);
  validate(common_values);
  require_lengths(starts, parameters, settings, results);
  const drop::Parameters* const common = all_common(parameters) ? &common_values : nullptr;
  const std::size_t count = starts.size();
  const auto threads = static_cast<std::size_t>(settings.threads == 0 ? num_cores() : settings.threads);
  const std::size_t block_size = drops_of_a_block<Real>(count, parameters.columns, settings.every, threads);
  const std::size_t num_blocks = (count + block_size - 1) / block_size;
  const std::size_t num_runners = std::min(threads, std::max<std::size_t>(num_blocks, 1));
  std::vector<std::optional<BlockRunner<Real>>> runners(num_runners);
  const auto run_block = [&](std::size_t block, std::size_t worker) {
    if (!runners[worker]) runners[worker].emplace(starts, parameters, common, settings, results);
    const std::size_t first = block * block_size;
    runners[worker]->run(first, std::min(block_size, count - first));
  };
  std::function<void(std::size_t)> watch;
  if (settings.watch) watch = [&](std::size_t done) { settings.watch(std::min(count, done * block_size)); };
  for_each_chunk(num_blocks, static_cast<int>(num_runners), run_block, watch);
}

template void simulate_batch(const DropStarts<double>&, const DropParameters&, const BatchSettings&,
                             const DropResults<double>&);
template void simulate_batch(const DropStarts<float>&, const DropParameters&, const BatchSettings&,
                             const DropResults<float>&);

}  // namespace tumble::batch
