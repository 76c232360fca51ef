#include "tumble/batch/reference_run.hpp"

#include <array>
#include <vector>

#include "tumble/batch/simulate_batch.hpp"
#include "tumble/math/bit_hash.hpp"
#include "tumble/math/distributions.hpp"

namespace tumble::batch {
namespace {

constexpr std::size_t k_count = 2000;
constexpr int k_columns = 301, k_every = 10;

// l m mu eps dt delta g, x y theta vx vy omega.
using Numbers = std::array<double, 13>;

Numbers numbers_of_drop(std::size_t i) {
  const double angle = i % 10 == 0 ? 1e7 : 10.0;
  const Numbers low = {0.05, 0.1, 0.0, 0.0, 0.001, 0.0, 1.0, -1.0, 0.0, -angle, -3.0, -3.0, -20.0};
  const Numbers high = {1.0, 5.0, 1.5, 1.0, 0.02, 0.002, 20.0, 1.0, 2.0, angle, 3.0, 1.0, 20.0};
  Numbers numbers;
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = uniform(draw_word(1, i, k), low[k], high[k]);
  return numbers;
}

template <class Real>
void add_drops(BitHash& hash, InstructionSet set) {
  std::vector<Real> q0, v0;
  std::array<std::vector<double>, 7> values;
  for (std::size_t i = 0; i < k_count; ++i) {
    const Numbers numbers = numbers_of_drop(i);
    for (std::size_t k = 0; k < 7; ++k) values[k].push_back(numbers[k]);
    for (std::size_t k = 7; k < 13; ++k) (k < 10 ? q0 : v0).push_back(static_cast<Real>(numbers[k]));
  }
  const std::size_t kept = 3 * k_count * kept_columns(k_columns, k_every);
  std::vector<Real> q(kept), v(kept);
  std::vector<DropMeasures> measures(k_count);
  simulate_batch<Real>({q0, v0},
                       {values[0], values[1], values[2], values[3], values[4], values[5], values[6], k_columns},
                       {.every = k_every, .instruction_set = set}, {.q = q, .v = v, .measures = measures});
  hash.add(q);
  hash.add(v);
  for (const DropMeasures& m : measures) {
    // NaN, "none", has other bits on other machines.
    for (const double value : {m.last_contact, m.rest_time, m.max_impulse, m.energy_lost, m.escape_time,
                               static_cast<double>(m.impacts), static_cast<double>(m.face)}) {
      hash.add(value == value ? value : -1.0);
    }
  }
}

}  // namespace

std::uint64_t reference_hash(InstructionSet set) {
  BitHash hash;
  add_drops<double>(hash, set);
  add_drops<float>(hash, set);
  return hash.value();
}

}  // namespace tumble::batch
