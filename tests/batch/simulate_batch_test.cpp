#include "tumble/batch/simulate_batch.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "../random_contact.hpp"
#include <gtest/gtest.h>

#include "tumble/drop/drop.hpp"

namespace tumble::batch {
namespace {

using test::Random;
constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

// Starts and parameters of N drops.
struct Drops {
  std::vector<double> q0, v0;
  std::array<std::vector<double>, 7> values;  // l m mu eps dt delta g
  int columns = 150;

  std::size_t size() const { return q0.size() / 3; }
  DropStarts<double> starts() const { return {q0, v0}; }
  DropParameters parameters() const {
    return {values[0], values[1], values[2], values[3], values[4], values[5], values[6], columns};
  }
  void add(const Vector3& q, const Vector3& v, const std::array<double, 7>& numbers) {
    q0.insert(q0.end(), q.begin(), q.end());
    v0.insert(v0.end(), v.begin(), v.end());
    for (std::size_t k = 0; k < 7; ++k) values[k].push_back(numbers[k]);
  }
};

// Squares of all sizes, much friction, angles of many turns.
void add_usual(Drops& drops, Random& random) {
  const double l = random.uniform(0.05, 1.0), m = random.uniform(0.1, 5.0), mu = random.uniform(0.0, 3.0);
  const double eps = random.uniform(0.0, 1.0), dt = random.uniform(0.001, 0.02), delta = random.uniform(0.0, 0.002);
  const double g = random.uniform(1.0, 20.0), x = random.uniform(-1.0, 1.0), y = random.uniform(0.0, 2.0);
  const double theta = random.uniform(-10.0, 10.0), vx = random.uniform(-3.0, 3.0), vy = random.uniform(-3.0, 1.0);
  const double omega = random.uniform(-20.0, 20.0);
  drops.add({x, y, theta}, {vx, vy, omega}, {l, m, mu, eps, dt, delta, g});
}

// Numbers from all over the range of double, and starts that lie flat, stand on a corner or are at rest.
void add_wild(Drops& drops, Random& random) {
  const auto wild = [&](double low, double high) {
    const double size = random.log_uniform(low, high);
    return random.uniform(0.0, 1.0) < 0.5 ? size : -size;
  };
  const double reach = random.uniform(0.0, 1.0) < 0.5 ? 30.0 : 600.0;
  const double l = random.log_uniform(-reach / 3, reach / 3), m = random.log_uniform(-reach / 2, reach / 2);
  const double mu = random.uniform(0.0, 4.0) < 1.0 ? 0.0 : random.log_uniform(-reach, reach);
  const double eps = std::floor(random.uniform(0.0, 3.0)) / 2.0, dt = random.log_uniform(-reach / 2, 10.0);
  const double delta = random.uniform(0.0, 2.0) < 1.0 ? 0.0 : random.log_uniform(-reach, 1.0);
  const double g = random.uniform(0.0, 4.0) < 1.0 ? 0.0 : wild(-reach, reach);
  const double quarters = std::floor(random.uniform(-9.0, 9.0));
  const double theta = random.uniform(0.0, 3.0) < 1.0   ? quarters * 0.78539816339744831
                       : random.uniform(0.0, 2.0) < 1.0 ? wild(-60.0, 2.0)
                                                        : wild(-10.0, 30.0);
  const double y = l * random.uniform(-0.2, 1.2);
  const double x = random.uniform(0.0, 2.0) < 1.0 ? -0.0 : wild(-10.0, reach);
  const double vx = random.uniform(0.0, 2.0) < 1.0 ? -0.0 : wild(-reach, reach);
  const double vy = random.uniform(0.0, 2.0) < 1.0 ? 0.0 : wild(-reach, reach);
  const double omega = random.uniform(0.0, 2.0) < 1.0 ? -0.0 : wild(-reach, 20.0);
  drops.add({x, y, theta}, {vx, vy, omega}, {l, m, mu, eps, dt, delta, g});
}

template <class Real>
struct Arrays {
  std::vector<Real> q, v;
  std::vector<DropStatus> status;
  std::vector<std::int32_t> columns;
  std::vector<DropMeasures> measures;
};

template <class Real>
Arrays<Real> run(const DropStarts<Real>& starts, const DropParameters& parameters, const BatchSettings& settings) {
  const std::size_t count = starts.size(), kept = 3 * count * kept_columns(parameters.columns, settings.every);
  Arrays<Real> arrays{std::vector<Real>(kept), std::vector<Real>(kept), std::vector<DropStatus>(count),
                      std::vector<std::int32_t>(count), std::vector<DropMeasures>(count)};
  simulate_batch<Real>(starts, parameters, settings,
                       {arrays.q, arrays.v, arrays.status, arrays.columns, arrays.measures});
  return arrays;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

template <class Real>
void expect_same(const Arrays<Real>& a, const Arrays<Real>& b, const std::string& what) {
  EXPECT_TRUE(same_bits(a.q, b.q)) << what;
  EXPECT_TRUE(same_bits(a.v, b.v)) << what;
  EXPECT_EQ(a.status, b.status) << what;
  EXPECT_EQ(a.columns, b.columns) << what;
  EXPECT_TRUE(same_bits(a.measures, b.measures)) << what;
}

// Of drop i, the last good column of its own simulation, and its status.
void expect_as_alone(const Drops& drops, const Arrays<double>& batch, std::size_t i) {
  const drop::Parameters p = parameters_at(drops.parameters(), i);
  const auto alone = drop::simulate({drops.q0[3 * i], drops.q0[3 * i + 1], drops.q0[3 * i + 2]},
                                    {drops.v0[3 * i], drops.v0[3 * i + 1], drops.v0[3 * i + 2]}, p);
  const Vector3 q = alone.q_at(alone.columns - 1), v = alone.v_at(alone.columns - 1);
  ASSERT_EQ(batch.status[i], alone.status == LcpStatus::solved ? DropStatus::solved : DropStatus::numerical) << i;
  ASSERT_EQ(batch.columns[i], alone.columns) << i;
  for (std::size_t c = 0; c < 3; ++c) {
    ASSERT_TRUE(same_bits(batch.q[3 * i + c], q[c])) << i << " q" << c << " " << batch.q[3 * i + c] << " " << q[c];
    ASSERT_TRUE(same_bits(batch.v[3 * i + c], v[c])) << i << " v" << c << " " << batch.v[3 * i + c] << " " << v[c];
  }
}

TEST(SimulateBatch, GivesTheBitsOfOneByOneForAMillionRandomDrops) {
  Drops drops;
  Random random(11);
  for (int i = 0; i < 1000000; ++i) add_usual(drops, random);
  const Arrays<double> batch = run(drops.starts(), drops.parameters(), {});
  for (std::size_t i = 0; i < drops.size(); ++i) expect_as_alone(drops, batch, i);
}

TEST(SimulateBatch, GivesTheBitsOfOneByOneForWildDropsByEveryInstructionSet) {
  Drops drops;
  Random random(12);
  for (int i = 0; i < 60000; ++i) add_wild(drops, random);
  const Arrays<double> first = run(drops.starts(), drops.parameters(), {});
  std::size_t solved = 0;
  for (std::size_t i = 0; i < drops.size(); ++i) {
    if (first.status[i] == DropStatus::invalid) {
      EXPECT_NE(what_is_invalid(drops.starts(), drops.parameters(), i), "");
    } else {
      expect_as_alone(drops, first, i);
    }
    solved += first.status[i] == DropStatus::solved ? 1 : 0;
  }
  EXPECT_GT(solved, drops.size() / 4);  // or the test would say little
  EXPECT_LT(solved, drops.size());
  for (const InstructionSet set : instruction_sets()) {
    expect_same(run(drops.starts(), drops.parameters(), {.instruction_set = set}), first, std::string(to_string(set)));
  }
}

TEST(SimulateBatch, KeepsColumnsAsOneByOneAtEverySizeFrom1To70) {
  Random random(13);
  for (std::size_t count = 1; count <= 70; ++count) {
    for (const int every : {1, 2, 7, 40, 200}) {
      Drops drops;
      drops.columns = 41;
      for (std::size_t i = 0; i < count; ++i) i % 9 == 8 ? add_wild(drops, random) : add_usual(drops, random);
      const std::size_t kept = kept_columns(41, every);
      for (const InstructionSet set : instruction_sets()) {
        const Arrays<double> batch =
            run(drops.starts(), drops.parameters(), {.every = every, .threads = 2, .instruction_set = set});
        for (std::size_t i = 0; i < count; ++i) {
          if (batch.status[i] == DropStatus::invalid) continue;
          const auto alone = drop::simulate({drops.q0[3 * i], drops.q0[3 * i + 1], drops.q0[3 * i + 2]},
                                            {drops.v0[3 * i], drops.v0[3 * i + 1], drops.v0[3 * i + 2]},
                                            parameters_at(drops.parameters(), i));
          for (std::size_t k = 0; k < kept; ++k) {
            const int column = static_cast<int>(k) * every;
            for (std::size_t c = 0; c < 3; ++c) {
              const double q = batch.q[(3 * i + c) * kept + k], v = batch.v[(3 * i + c) * kept + k];
              if (column < alone.columns) {
                ASSERT_TRUE(same_bits(q, alone.q_at(column)[c])) << count << " " << every << " " << i << " " << column;
                ASSERT_TRUE(same_bits(v, alone.v_at(column)[c])) << count << " " << every << " " << i << " " << column;
              } else {
                ASSERT_TRUE(std::isnan(q) && std::isnan(v));
              }
            }
          }
        }
      }
    }
  }
}

TEST(SimulateBatch, KeepsColumnsOfLongRunsToo) {
  Drops drops;
  drops.columns = 1001;  // longer than what is put together in the cache
  Random random(14);
  for (int i = 0; i < 40; ++i) add_usual(drops, random);
  const Arrays<double> batch = run(drops.starts(), drops.parameters(), {.every = 1, .threads = 1});
  for (std::size_t i = 0; i < drops.size(); ++i) {
    const auto alone = drop::simulate({drops.q0[3 * i], drops.q0[3 * i + 1], drops.q0[3 * i + 2]},
                                      {drops.v0[3 * i], drops.v0[3 * i + 1], drops.v0[3 * i + 2]},
                                      parameters_at(drops.parameters(), i));
    ASSERT_EQ(std::memcmp(&batch.q[3 * 1001 * i], alone.q.data(), 3 * 1001 * sizeof(double)), 0) << i;
    ASSERT_EQ(std::memcmp(&batch.v[3 * 1001 * i], alone.v.data(), 3 * 1001 * sizeof(double)), 0) << i;
  }
}

TEST(SimulateBatch, DoesNotDependOnThreads) {
  Drops drops;
  Random random(15);
  for (int i = 0; i < 3000; ++i) i % 50 == 0 ? add_wild(drops, random) : add_usual(drops, random);
  for (const int every : {0, 3}) {
    const Arrays<double> first = run(drops.starts(), drops.parameters(), {.every = every, .threads = 1});
    for (int threads = 2; threads <= 16; ++threads) {
      expect_same(run(drops.starts(), drops.parameters(), {.every = every, .threads = threads}), first,
                  std::to_string(threads));
    }
  }
}

TEST(SimulateBatch, CommonParametersAreThoseOfEachDrop) {
  Drops drops;
  Random random(16);
  for (int i = 0; i < 200; ++i) add_usual(drops, random);
  const DropParameters document{.columns = 150};
  const Arrays<double> batch = run(drops.starts(), document, {});
  for (std::vector<double>& values : drops.values) values.clear();
  for (std::size_t i = 0; i < drops.size(); ++i) expect_as_alone(drops, batch, i);
  const double mu = 0.7;
  const Arrays<double> other = run(drops.starts(), {.mu = {&mu, 1}}, {});
  drops.values[2].assign(200, mu);
  for (std::size_t i = 0; i < drops.size(); ++i) expect_as_alone(drops, other, i);
}

TEST(SimulateBatch, OneBadDropTouchesNoOther) {
  Drops drops;
  Random random(17);
  for (int i = 0; i < 100; ++i) add_usual(drops, random);
  const Arrays<double> good = run(drops.starts(), drops.parameters(), {.every = 1});
  const std::size_t row = 3 * 150;
  for (const double bad : {k_nan, std::numeric_limits<double>::infinity(), -1.0}) {
    Drops spoilt = drops;
    if (bad == -1.0) {
      spoilt.values[2][41] = bad;  // friction
    } else {
      spoilt.v0[3 * 41 + 1] = bad;
    }
    for (const InstructionSet set : instruction_sets()) {
      const Arrays<double> batch = run(spoilt.starts(), spoilt.parameters(), {.every = 1, .instruction_set = set});
      EXPECT_EQ(batch.status[41], DropStatus::invalid);
      EXPECT_EQ(batch.columns[41], 0);
      EXPECT_EQ(batch.measures[41].face, -1);
      for (std::size_t k = 0; k < row; ++k) EXPECT_TRUE(std::isnan(batch.q[41 * row + k]));
      EXPECT_EQ(std::memcmp(batch.q.data(), good.q.data(), 41 * row * sizeof(double)), 0);
      EXPECT_EQ(std::memcmp(&batch.q[42 * row], &good.q[42 * row], 58 * row * sizeof(double)), 0);
      EXPECT_EQ(std::memcmp(&batch.v[42 * row], &good.v[42 * row], 58 * row * sizeof(double)), 0);
    }
    EXPECT_NE(what_is_invalid(spoilt.starts(), spoilt.parameters(), 41).find(bad == -1.0 ? "mu" : "v[1]"),
              std::string::npos);
    EXPECT_EQ(what_is_invalid(spoilt.starts(), spoilt.parameters(), 40), "");
  }
}

TEST(SimulateBatch, MeasuresAreThoseOfTheRecord) {
  Drops drops;
  Random random(18);
  for (int i = 0; i < 2000; ++i) add_usual(drops, random);
  const MeasureSettings settings{.rest_speed = 0.5, .x_min = -1.2, .x_max = 1.1};
  const Arrays<double> first = run(drops.starts(), drops.parameters(), {.measures = settings});
  for (std::size_t i = 0; i < drops.size(); ++i) {
    const drop::Parameters p = parameters_at(drops.parameters(), i);
    const auto record = drop::simulate_with_record({drops.q0[3 * i], drops.q0[3 * i + 1], drops.q0[3 * i + 2]},
                                                   {drops.v0[3 * i], drops.v0[3 * i + 1], drops.v0[3 * i + 2]}, p);
    double last_contact = k_nan, rest_time = 0.0, max_impulse = 0.0, escape_time = k_nan;
    std::int32_t impacts = 0;
    for (int k = 0; k < p.columns; ++k) {
      const Vector3 q = record.trajectory.q_at(k), v = record.trajectory.v_at(k);
      const double speed = std::sqrt(v[0] * v[0] + v[1] * v[1] + p.l * p.l / 6 * v[2] * v[2]);
      if (speed > settings.rest_speed) rest_time = k == p.columns - 1 ? k_nan : (k + 1) * p.dt;
      if (std::isnan(escape_time) && (q[0] < settings.x_min || q[0] > settings.x_max)) escape_time = k * p.dt;
      if (k == p.columns - 1) break;
      const double f_n = record.steps[static_cast<std::size_t>(k)].z[0];
      if (f_n > 0.0) last_contact = (k + 1) * p.dt;
      if (f_n > 0.0 && (k == 0 || record.steps[static_cast<std::size_t>(k - 1)].z[0] == 0.0)) ++impacts;
      max_impulse = std::max(max_impulse, f_n * p.dt);
    }
    const DropMeasures& m = first.measures[i];
    const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    EXPECT_TRUE(same(m.last_contact, last_contact)) << i;
    EXPECT_TRUE(same(m.rest_time, rest_time)) << i;
    EXPECT_TRUE(same(m.escape_time, escape_time)) << i;
    EXPECT_EQ(m.max_impulse, max_impulse) << i;
    EXPECT_EQ(m.impacts, impacts) << i;
    const auto energy = [&](int k) {
      return kinetic_energy(record.trajectory.v_at(k), p) + potential_energy(record.trajectory.q_at(k), p);
    };
    EXPECT_EQ(m.energy_lost, energy(0) - energy(p.columns - 1)) << i;
    const double quarters = std::nearbyint(record.trajectory.q_at(p.columns - 1)[2] / 1.5707963267948966);
    EXPECT_EQ(m.face, static_cast<int>(std::fmod(std::fmod(quarters, 4.0) + 4.0, 4.0))) << i;
  }
  for (const InstructionSet set : instruction_sets()) {
    expect_same(run(drops.starts(), drops.parameters(), {.measures = settings, .instruction_set = set}), first,
                std::string(to_string(set)));
  }
}

TEST(SimulateBatch, OfASquareThatIsSetDownOnEachSide) {
  for (int side = 0; side < 4; ++side) {
    const std::array<double, 3> q0 = {0.0, 0.11, side * 1.5707963267948966}, v0{};
    const Arrays<double> batch = run(DropStarts<double>{q0, v0}, {}, {});
    EXPECT_EQ(batch.measures[0].face, side);
  }
}

std::vector<float> as_float(const std::vector<double>& numbers) { return {numbers.begin(), numbers.end()}; }

TEST(SimulateBatch, InSinglePrecisionIsEqualByEveryInstructionSetAndNumberOfThreads) {
  Drops drops;
  Random random(19);
  for (int i = 0; i < 20000; ++i) i % 20 == 0 ? add_wild(drops, random) : add_usual(drops, random);
  const std::vector<float> q0 = as_float(drops.q0), v0 = as_float(drops.v0);
  for (const int every : {0, 4}) {
    const Arrays<float> first = run(DropStarts<float>{q0, v0}, drops.parameters(), {.every = every});
    for (const InstructionSet set : instruction_sets()) {
      for (const int threads : {1, 3}) {
        expect_same(run(DropStarts<float>{q0, v0}, drops.parameters(),
                        {.every = every, .threads = threads, .instruction_set = set}),
                    first, std::string(to_string(set)));
      }
    }
  }
}

// Until two drops part at an impact that one of them has a step later, single precision follows double.
TEST(SimulateBatch, InSinglePrecisionFollowsDouble) {
  Drops drops;
  Random random(20);
  for (int i = 0; i < 5000; ++i) add_usual(drops, random);
  drops.columns = 20;
  const std::vector<float> q0 = as_float(drops.q0), v0 = as_float(drops.v0);
  for (std::size_t k = 0; k < q0.size(); ++k) {
    drops.q0[k] = static_cast<double>(q0[k]);
    drops.v0[k] = static_cast<double>(v0[k]);
  }
  const Arrays<double> exact = run(drops.starts(), drops.parameters(), {});
  const Arrays<float> single = run(DropStarts<float>{q0, v0}, drops.parameters(), {});
  std::vector<double> errors;
  for (std::size_t k = 0; k < q0.size(); ++k) errors.push_back(std::abs(exact.q[k] - static_cast<double>(single.q[k])));
  std::ranges::sort(errors);
  EXPECT_LT(errors[errors.size() / 2], 1e-6);         // round-off of 20 steps at angles up to 10 rad
  EXPECT_LT(errors[errors.size() * 99 / 100], 1e-4);  // what impacts make of it
}

TEST(SimulateBatch, NothingIsNothing) {
  const Arrays<double> batch = run(DropStarts<double>{}, {}, {});
  EXPECT_TRUE(batch.q.empty());
}

TEST(SimulateBatch, RefusesWhatIsWrongForAll) {
  const std::vector<double> q0(6), v0(6), three(3), mu{-1.0};
  std::vector<double> q(6);
  const DropStarts<double> starts{q0, v0};
  const auto message = [&](const DropStarts<double>& s, const DropParameters& p, const BatchSettings& settings,
                           const DropResults<double>& results) -> std::string {
    try {
      simulate_batch<double>(s, p, settings, results);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message({q0, three}, {}, {}, {}), "q0, v0: must both be N x 3, got 6 and 3 numbers");
  EXPECT_EQ(message(starts, {.l = three}, {}, {}), "l: must have 1 or 2 values, got 3");
  EXPECT_EQ(message(starts, {.mu = mu}, {}, {}), "mu: must be finite and >= 0, got -1");
  EXPECT_EQ(message(starts, {.columns = 1}, {}, {}), "columns: must be in [2, 10000000], got 1");
  EXPECT_EQ(message(starts, {}, {.every = -1}, {}), "every: must be >= 0, got -1");
  EXPECT_EQ(message(starts, {}, {.threads = 2000}, {}),
            "threads: must be in [0, 1024], 0 for one for each core, got 2000");
  EXPECT_EQ(message(starts, {}, {.measures = {.rest_speed = k_nan}}, {}), "rest_speed: must be >= 0 m/s, got nan");
  EXPECT_EQ(message(starts, {}, {.measures = {.x_min = 1.0, .x_max = 0.0}}, {}),
            "x_min: must be <= x_max, which is 0 m, got 1 m");
  EXPECT_EQ(message(starts, {}, {.every = 1}, {.q = q}), "results.q: must have 900 numbers, got 6");
  EXPECT_EQ(message(starts, {}, {}, {.q = q}), "");
}

TEST(SimulateBatch, EndsWhenTheWatchThrows) {
  Drops drops;
  Random random(21);
  for (int i = 0; i < 20000; ++i) add_usual(drops, random);
  drops.columns = 3000;
  std::size_t seen = 0;
  const auto watch = [&](std::size_t done) {
    seen = done;
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(run(drops.starts(), drops.parameters(), {.watch = watch}), std::runtime_error);
  EXPECT_LT(seen, drops.size());
}

}  // namespace
}  // namespace tumble::batch
