#include "tumble/batch/block_runner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tumble/batch/drop_measures.hpp"
#include "tumble/math/numeric.hpp"

namespace tumble::batch {
namespace {

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

// True if Real can hold the numbers.
template <class Real>
bool is_in_range(const drop::State& state) {
  const auto fits = [](double x) { return std::isfinite(static_cast<Real>(x)); };
  return std::all_of(state.q.begin(), state.q.end(), fits) && std::all_of(state.v.begin(), state.v.end(), fits);
}

}  // namespace

template <class Real>
BlockRunner<Real>::BlockRunner(const DropStarts<Real>& starts, const DropParameters& parameters,
                               const drop::Parameters* common, const BatchSettings& settings,
                               const DropResults<Real>& results)
    : starts_(starts),
      parameters_(parameters),
      settings_(settings),
      results_(results),
      advance_(advance_drops<Real>(settings.instruction_set ? *settings.instruction_set : instruction_set())),
      bounds_{static_cast<Real>(settings.measures.rest_speed * settings.measures.rest_speed),
              static_cast<Real>(settings.measures.x_min), static_cast<Real>(settings.measures.x_max)},
      has_common_parameters_(common != nullptr),
      common_(common != nullptr ? *common : drop::Parameters{}),
      writer_(settings.every == 0 ? nullptr : results.q.data(), settings.every == 0 ? nullptr : results.v.data(),
              kept_columns(parameters.columns, settings.every)) {
  put_parameters_of_all();
}

template <class Real>
void BlockRunner<Real>::run(std::size_t first, std::size_t count) {
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

template <class Real>
drop::Parameters BlockRunner<Real>::parameters_of(std::size_t i) const {
  return has_common_parameters_ ? common_ : parameters_at(parameters_, i);
}

template <class Real>
drop::State BlockRunner<Real>::start_of(std::size_t i) const {
  return {starts_.pose(i), starts_.velocity(i)};
}

template <class Real>
void BlockRunner<Real>::put_parameters(std::size_t j, const drop::Parameters& p) {
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

template <class Real>
void BlockRunner<Real>::put_parameters_of_all() {
  put_parameters(0, common_);
  for (Real* const array : {block_.half_l, block_.inverse_m, block_.inverse_I, block_.mu, block_.bounce, block_.dt,
                            block_.delta, block_.g, block_.clear_height, block_.gyration}) {
    std::fill(array + 1, array + DropBlock<Real>::k_capacity, array[0]);
  }
}

// Kept columns come into being where the writer wants them; `states_` are the last ones in the end.
template <class Real>
void BlockRunner<Real>::advance_and_keep(std::size_t first, std::size_t count, const MeasureBounds<Real>* bounds) {
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

template <class Real>
void BlockRunner<Real>::put_state(std::size_t j, const Vector3& q, const Vector3& v) {
  for (std::size_t c = 0; c < 3; ++c) {
    states_[c][j] = static_cast<Real>(q[c]);
    states_[3 + c][j] = static_cast<Real>(v[c]);
  }
}

template <class Real>
void BlockRunner<Real>::load(std::size_t first, std::size_t count) {
  const bool measures = !results_.measures.empty();
  const bool common_is_tame = is_tame<Real>(common_);
  for (std::size_t j = 0; j < count; ++j) {
    const Vector3 q0 = starts_.pose(first + j), v0 = starts_.velocity(first + j);
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

template <class Real>
void BlockRunner<Real>::note(std::size_t i, std::size_t j) {
  const NotedColumns noted = note_start(start_of(i), parameters_of(i), settings_.measures);
  block_.last_contact[j] = static_cast<Real>(noted.last_contact);
  block_.impacts[j] = static_cast<Real>(noted.impacts);
  block_.max_force_time[j] = static_cast<Real>(noted.max_force_time);
  block_.last_moving[j] = static_cast<Real>(noted.last_moving);
  block_.escape[j] = static_cast<Real>(noted.escape);
  block_.was_closed[j] = Real(0);
}

// Results of drop i, which is number j of the block; columns are there already.
template <class Real>
void BlockRunner<Real>::finish(std::size_t i, std::size_t j) {
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

template <class Real>
void BlockRunner<Real>::tell(std::size_t i, DropStatus status, int columns, const std::array<Real, 6>& last) {
  if (!results_.status.empty()) results_.status[i] = status;
  if (!results_.columns.empty()) results_.columns[i] = columns;
  if (settings_.every != 0 || status == DropStatus::invalid) return;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!results_.q.empty()) results_.q[3 * i + c] = last[c];
    if (!results_.v.empty()) results_.v[3 * i + c] = last[3 + c];
  }
}

// NaN in the kept columns of drop i from number `from` on.
template <class Real>
void BlockRunner<Real>::fill_rows(std::size_t i, std::size_t from) {
  const std::size_t kept = kept_columns(parameters_.columns, settings_.every);
  for (const std::span<Real> rows : {results_.q, results_.v}) {
    for (std::size_t r = 3 * i; r < 3 * i + 3 && !rows.empty(); ++r) {
      std::fill(rows.begin() + static_cast<std::ptrdiff_t>(r * kept + from),
                rows.begin() + static_cast<std::ptrdiff_t>((r + 1) * kept), std::numeric_limits<Real>::quiet_NaN());
    }
  }
}

template <class Real>
void BlockRunner<Real>::put_column(std::size_t i, std::size_t kept_column, const drop::State& state) {
  const std::size_t kept = kept_columns(parameters_.columns, settings_.every);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t place = (3 * i + c) * kept + kept_column;
    if (!results_.q.empty()) results_.q[place] = static_cast<Real>(state.q[c]);
    if (!results_.v.empty()) results_.v[place] = static_cast<Real>(state.v[c]);
  }
}

// A drop that is not ordinary, step by step in double.
template <class Real>
void BlockRunner<Real>::run_alone(std::size_t i) {
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

template class BlockRunner<double>;
template class BlockRunner<float>;

}  // namespace tumble::batch
