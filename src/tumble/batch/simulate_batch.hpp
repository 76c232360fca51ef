// Many drops of the document's model at once: SIMD lanes within a core, chunks over the cores. Each comes out bit for
// bit as drop::simulate gives it alone, whatever the instruction set, the number of threads and the neighbours.
// Theory and figures: docs/theory/batch.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "tumble/batch/measure_settings.hpp"
#include "tumble/drop/parameters.hpp"
#include "tumble/math/instruction_set.hpp"
#include "tumble/math/vector.hpp"

namespace tumble::batch {

// How N drops begin: (x, y, theta) [m, m, rad] and (vx, vy, omega) [m/s, m/s, rad/s], N x 3, row after row.
template <class Real>
struct DropStarts {
  std::span<const Real> q0;
  std::span<const Real> v0;

  std::size_t size() const { return q0.size() / 3; }
  Vector3 pose(std::size_t i) const { return {q0[3 * i], q0[3 * i + 1], q0[3 * i + 2]}; }
  Vector3 velocity(std::size_t i) const { return {v0[3 * i], v0[3 * i + 1], v0[3 * i + 2]}; }
};

// The parameters of N drops. Each array has N entries, or one that holds for all, or none: the document's value then.
// Units and ranges as in drop::Parameters.
struct DropParameters {
  std::span<const double> l{}, m{}, mu{}, eps{}, dt{}, delta{}, g{};
  int columns = 150;
};

// Of drop i alone. Throws nothing: the values may be out of range.
drop::Parameters parameters_at(const DropParameters& parameters, std::size_t i);

enum class DropStatus : std::uint8_t {
  solved,     // all columns are good
  numerical,  // a step left the range of double arithmetic, or of Real; the columns before it are good
  invalid,    // start or parameters are NaN or out of range, nothing was computed: `what_is_invalid` says why
};

// What is told of a drop without its trajectory. Times are those of columns, column k being at k dt.
struct DropMeasures {
  double last_contact;   // end of the last step with a contact force [s]; NaN if there was none
  double rest_time;      // from when on speeds stay at or below rest_speed [s]; NaN if they do not at the end
  double max_impulse;    // largest normal impulse f_n dt of a step [N s]; 0 if there was none
  double energy_lost;    // kinetic and potential energy at the start less that at the end [J]; delta's lifts add some
  double escape_time;    // first column whose x is not in [x_min, x_max] [s]; NaN if there is none
  std::int32_t impacts;  // steps with a contact force whose step before had none
  std::int32_t face;  // side of the square that is up at the end: 0 the one at +y in the body frame, 1 at +x, 2 at -y,
                      // 3 at -x; -1 if the drop was not solved
};

struct BatchSettings {
  int every = 0;    // columns that are kept: 0 the last alone; k >= 1 those numbered 0, k, 2k, ...
  int threads = 0;  // 0: one for each core
  MeasureSettings measures{};
  // The widest there is, unless the environment variable TUMBLE_INSTRUCTION_SET names another.
  std::optional<InstructionSet> instruction_set{};
  // Called now and then from the calling thread with the number of drops done; what it throws ends the batch.
  std::function<void(std::size_t num_done)> watch{};
};

// Where results go; an empty array is not wanted.
template <class Real>
struct DropResults {
  std::span<Real> q{}, v{};            // N x 3 x kept_columns. NaN where a drop has no good column
  std::span<DropStatus> status{};      // N
  std::span<std::int32_t> columns{};   // N; columns that are good, all of them if solved
  std::span<DropMeasures> measures{};  // N
};

// Columns of q and v for settings.every: 1, or ceil(columns / every).
std::size_t kept_columns(int columns, int every);

// Drops N squares. Real = double: the numbers of drop::simulate, bit for bit. Real = float: the same steps in single
// precision, itself bit-equal everywhere; what single precision cannot hold is computed in double and rounded.
// Throws std::invalid_argument for arrays of wrong lengths, settings out of range and parameters common to all that are
// out of range; what is wrong with one drop alone is that drop's status. Results are complete when it returns; when it
// throws they hold anything.
template <class Real>
void simulate_batch(const DropStarts<Real>& starts, const DropParameters& parameters, const BatchSettings& settings,
                    const DropResults<Real>& results);

// The line that drop::simulate would refuse drop i with; empty if it would not.
std::string what_is_invalid(const DropStarts<double>& starts, const DropParameters& parameters, std::size_t i);

}  // namespace tumble::batch
