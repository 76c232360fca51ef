#include "tumble/batch/simulate_batch.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "tumble/batch/column_writer.hpp"
#include "tumble/batch/drop_lanes.hpp"
#include "tumble/batch/drop_measures.hpp"
#include "tumble/batch/parallel.hpp"
#include "tumble/drop/drop.hpp"
#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"

namespace tumble::batch {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

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

// ---- One drop ----

template <class Real>
Vector3 row(std::span<const Real> rows, std::size_t i) {
  return {rows[3 * i], rows[3 * i + 1], rows[3 * i + 2]};
}

bool is_valid(const drop::Parameters& parameters) {
  try {
    validate(parameters);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

// True if no number of a step comes near the ends of the range as long as speeds do not: what `advance_drops` of Real
// asks of parameters.
template <class Real>
bool is_tame(const drop::Parameters& p) {
  const double largest = sizeof(Real) == 8 ? 0x1p200 : 0x1p20;
  const auto is_moderate = [&](double value) { return value >= 1.0 / largest && value <= largest; };
  return is_moderate(p.l) && is_moderate(p.m) && is_moderate(p.dt) && is_moderate(p.dt / p.m) && p.mu <= 0x1p20;
}

// ---- A block of drops ----

// True if Real can hold the numbers.
template <class Real>
bool is_in_range(const drop::State& state) {
  const auto fits = [](double x) { return std::isfinite(static_cast<Real>(x)); };
  return std::all_of(state.q.begin(), state.q.end(), fits) && std::all_of(state.v.begin(), state.v.end(), fits);
}

template <class Real>
class BlockRunner {
 public:
  BlockRunner(const DropStarts<Real>& starts, const DropParameters& parameters, const BatchSettings& settings,
              const DropResults<Real>& results)
      : starts_(starts),
        parameters_(parameters),
        settings_(settings),
        results_(results),
        advance_(advance_drops<Real>(settings.instruction_set ? *settings.instruction_set : instruction_set())),
        bounds_{static_cast<Real>(settings.measures.rest_speed * settings.measures.rest_speed),
                static_cast<Real>(settings.measures.x_min), static_cast<Real>(settings.measures.x_max)},
        has_common_parameters_(all_common(parameters)),
        common_(common_parameters(parameters)),
        writer_(settings.every == 0 ? nullptr : results.q.data(), settings.every == 0 ? nullptr : results.v.data(),
                kept_columns(parameters.columns, settings.every)) {
    put_parameters_of_all();
  }

  void run(std::size_t first, std::size_t count) {
    load(first, count);
    const auto* const bounds = results_.measures.empty() ? nullptr : &bounds_;
    const int num_steps = parameters_.columns - 1;
    if (settings_.every == 0) {
      advance_(block_, states_, states_, count, 0, num_steps, bounds);
    } else {
      advance_and_keep(first, count, bounds);
    }
    for (std::size_t j = 0; j < count; ++j) finish(first + j, j);
  }

 private:
  drop::Parameters parameters_of(std::size_t i) const {
    return has_common_parameters_ ? common_ : parameters_at(parameters_, i);
  }

  drop::State start_of(std::size_t i) const { return {row(starts_.q0, i), row(starts_.v0, i)}; }

  void put_parameters(std::size_t j, const drop::Parameters& p) {
    block_.half_l[j] = static_cast<Real>(0.5 * p.l);
    block_.inverse_m[j] = static_cast<Real>(1.0 / p.m);
    block_.inverse_I[j] = static_cast<Real>(1.0 / moment_of_inertia(p));
    block_.mu[j] = static_cast<Real>(p.mu);
    block_.bounce[j] = static_cast<Real>(1.0 + p.eps);
    block_.dt[j] = static_cast<Real>(p.dt);
    block_.delta[j] = static_cast<Real>(p.delta);
    block_.g[j] = static_cast<Real>(p.g);
    block_.clear_height[j] = static_cast<Real>(p.delta + 0.7072 * p.l);
    block_.gyration[j] = static_cast<Real>(p.l * p.l / 6.0);
  }

  void put_parameters_of_all() {
    put_parameters(0, common_);
    for (Real* const array : {block_.half_l, block_.inverse_m, block_.inverse_I, block_.mu, block_.bounce, block_.dt,
                              block_.delta, block_.g, block_.clear_height, block_.gyration}) {
      std::fill(array + 1, array + DropBlock<Real>::k_capacity, array[0]);
    }
  }

  // Kept columns come into being where the writer wants them; `states_` are the last ones in the end.
  void advance_and_keep(std::size_t first, std::size_t count, const MeasureBounds<Real>* bounds) {
    const int num_steps = parameters_.columns - 1;
    const auto copy = [](States<Real> from, States<Real> to) {
      for (std::size_t c = 0; c < 6; ++c) std::copy_n(from[c], ColumnWriter<Real>::k_most_drops, to[c]);
    };
    writer_.begin(first, count);
    States<Real> from = writer_.next();
    copy(states_, from);
    writer_.add();
    for (int column = 0; column < num_steps;) {
      const int steps = std::min(settings_.every, num_steps - column);
      const bool is_kept = steps == settings_.every;
      const States<Real> to = is_kept ? writer_.next() : states_;
      advance_(block_, from, to, count, column, steps, bounds);
      if (is_kept) writer_.add();
      column += steps;
      from = to;
    }
    if (from.first != states_.first) copy(from, states_);
  }

  void put_state(std::size_t j, const Vector3& q, const Vector3& v) {
    for (std::size_t c = 0; c < 3; ++c) {
      states_[c][j] = static_cast<Real>(q[c]);
      states_[3 + c][j] = static_cast<Real>(v[c]);
    }
  }

  void load(std::size_t first, std::size_t count) {
    const bool measures = !results_.measures.empty();
    const bool common_is_tame = is_tame<Real>(common_);
    for (std::size_t j = 0; j < count; ++j) {
      const Vector3 q0 = row(starts_.q0, first + j), v0 = row(starts_.v0, first + j);
      is_valid_[j] = all_finite(q0) && all_finite(v0);
      bool tame = common_is_tame;
      if (!has_common_parameters_) {
        const drop::Parameters p = parameters_of(first + j);
        is_valid_[j] = is_valid_[j] && is_valid(p);
        tame = is_tame<Real>(p);
        put_parameters(j, is_valid_[j] && tame ? p : drop::Parameters{});
      }
      block_.is_ordinary[j] = is_valid_[j] && tame ? Real(1) : Real(0);
      if (is_valid_[j] && tame) {
        put_state(j, q0, v0);
      } else {
        put_state(j, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
      }
      if (measures) note(first + j, j);
    }
    for (std::size_t j = count; j % k_padding != 0; ++j) put_state(j, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
  }

  void note(std::size_t i, std::size_t j) {
    const NotedColumns noted = note_start(start_of(i), parameters_of(i), settings_.measures);
    block_.last_contact[j] = static_cast<Real>(noted.last_contact);
    block_.impacts[j] = static_cast<Real>(noted.impacts);
    block_.max_force_time[j] = static_cast<Real>(noted.max_force_time);
    block_.last_moving[j] = static_cast<Real>(noted.last_moving);
    block_.escape[j] = static_cast<Real>(noted.escape);
    block_.was_closed[j] = Real(0);
  }

  // Results of drop i, which is number j of the block; columns are there already.
  void finish(std::size_t i, std::size_t j) {
    if (!is_valid_[j]) {
      fill_rows(i, 0);
      tell(i, DropStatus::invalid, 0, {});
      if (!results_.measures.empty()) results_.measures[i] = no_measures();
      return;
    }
    const std::array<Real, 6> last = {states_[0][j], states_[1][j], states_[2][j],
                                      states_[3][j], states_[4][j], states_[5][j]};
    if (block_.is_ordinary[j] == Real(0) || !all_finite(last)) {
      run_alone(i);
      return;
    }
    tell(i, DropStatus::solved, parameters_.columns, last);
    if (results_.measures.empty()) return;
    const NotedColumns noted{block_.last_contact[j], block_.impacts[j], block_.max_force_time[j], block_.last_moving[j],
                             block_.escape[j]};
    results_.measures[i] = drop_measures(noted, start_of(i), {{last[0], last[1], last[2]}, {last[3], last[4], last[5]}},
                                         parameters_.columns, DropStatus::solved, parameters_of(i));
  }

  void tell(std::size_t i, DropStatus status, int columns, const std::array<Real, 6>& last) {
    if (!results_.status.empty()) results_.status[i] = status;
    if (!results_.columns.empty()) results_.columns[i] = columns;
    if (settings_.every != 0 || status == DropStatus::invalid) return;
    for (std::size_t c = 0; c < 3; ++c) {
      if (!results_.q.empty()) results_.q[3 * i + c] = last[c];
      if (!results_.v.empty()) results_.v[3 * i + c] = last[3 + c];
    }
  }

  // NaN in the kept columns of drop i from number `from` on.
  void fill_rows(std::size_t i, std::size_t from) {
    const std::size_t kept = kept_columns(parameters_.columns, settings_.every);
    for (const std::span<Real> rows : {results_.q, results_.v}) {
      for (std::size_t r = 3 * i; r < 3 * i + 3 && !rows.empty(); ++r) {
        std::fill(rows.begin() + static_cast<std::ptrdiff_t>(r * kept + from),
                  rows.begin() + static_cast<std::ptrdiff_t>((r + 1) * kept), static_cast<Real>(k_nan));
      }
    }
  }

  void put_column(std::size_t i, std::size_t kept_column, const drop::State& state) {
    const std::size_t kept = kept_columns(parameters_.columns, settings_.every);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t place = (3 * i + c) * kept + kept_column;
      if (!results_.q.empty()) results_.q[place] = static_cast<Real>(state.q[c]);
      if (!results_.v.empty()) results_.v[place] = static_cast<Real>(state.v[c]);
    }
  }

  // A drop that is not ordinary, step by step in double.
  void run_alone(std::size_t i) {
    const drop::Parameters p = parameters_of(i);
    const auto every = static_cast<std::size_t>(settings_.every);
    const drop::State start = start_of(i);
    drop::State state = start;
    NotedColumns noted = note_start(start, p, settings_.measures);
    DropStatus status = DropStatus::solved;
    if (every != 0) put_column(i, 0, state);
    bool was_closed = false;
    int columns = 1;
    for (; columns < p.columns; ++columns) {
      const auto [next, step] = drop::step_with_record(state.q, state.v, p);
      if (step.status != LcpStatus::solved || !is_in_range<Real>(next)) {
        status = DropStatus::numerical;
        break;
      }
      state = next;
      note_column(noted, columns, state, step.z[0], was_closed, p, settings_.measures);
      was_closed = step.z[0] > 0.0;
      const auto column = static_cast<std::size_t>(columns);
      if (every != 0 && column % every == 0) put_column(i, column / every, state);
    }
    if (every != 0) fill_rows(i, kept_columns(columns, settings_.every));
    std::array<Real, 6> last;
    for (std::size_t c = 0; c < 3; ++c) {
      last[c] = static_cast<Real>(state.q[c]);
      last[3 + c] = static_cast<Real>(state.v[c]);
    }
    tell(i, status, columns, last);
    if (!results_.measures.empty()) results_.measures[i] = drop_measures(noted, start, state, columns, status, p);
  }

  const DropStarts<Real>& starts_;
  const DropParameters& parameters_;
  const BatchSettings& settings_;
  const DropResults<Real>& results_;
  AdvanceDrops<Real>* advance_;
  MeasureBounds<Real> bounds_;
  bool has_common_parameters_;
  drop::Parameters common_;
  bool is_valid_[DropBlock<Real>::k_capacity];
  DropBlock<Real> block_;
  alignas(64) Real numbers_[6 * DropBlock<Real>::k_capacity];
  States<Real> states_{numbers_, DropBlock<Real>::k_capacity};
  ColumnWriter<Real> writer_;
};

// Small enough for all threads to have some, and for a watch to be called now and then: about 30 ms of steps. Of no
// influence on the results.
template <class Real>
std::size_t drops_of_a_block(std::size_t count, int columns, int every, std::size_t threads) {
  constexpr std::size_t k_most_steps = 5'000'000;
  const auto padded = [](std::size_t drops) { return drops / k_padding * k_padding; };
  const std::size_t most = every == 0 ? DropBlock<Real>::k_capacity : ColumnWriter<Real>::k_most_drops;
  const std::size_t share = padded(count / (4 * threads)) + k_padding;
  return std::min({most, share, padded(k_most_steps / static_cast<std::size_t>(columns)) + k_padding});
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
    drop::step_with_record(row(starts.q0, i), row(starts.v0, i), parameters_at(parameters, i));
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

template <class Real>
void simulate_batch(const DropStarts<Real>& starts, const DropParameters& parameters, const BatchSettings& settings,
                    const DropResults<Real>& results) {
  validate(settings);
  validate(common_parameters(parameters));
  require_lengths(starts, parameters, settings, results);
  const std::size_t count = starts.size();
  const auto threads = static_cast<std::size_t>(settings.threads == 0 ? num_cores() : settings.threads);
  const std::size_t block_size = drops_of_a_block<Real>(count, parameters.columns, settings.every, threads);
  const std::size_t num_blocks = (count + block_size - 1) / block_size;
  const std::size_t num_runners = std::min(threads, std::max<std::size_t>(num_blocks, 1));
  std::vector<std::optional<BlockRunner<Real>>> runners(num_runners);
  const auto run_block = [&](std::size_t block, std::size_t worker) {
    if (!runners[worker]) runners[worker].emplace(starts, parameters, settings, results);
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
