// One measurement of batches of drops per call, for benchmarks/batch/run.py, which takes rounds of them.
//   tumble_bench_batch rate SET STARTS KEEP THREADS REAL   steps per second and bytes per second of results
//   tumble_bench_batch stream THREADS                      bytes per second written past the caches to memory in use
// SET scalar, sse2, ...; STARTS course (all alike) or random; KEEP final, measures or all; REAL double or float.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "random.hpp"

#include "tumble/batch/column_writer.hpp"
#include "tumble/batch/parallel.hpp"
#include "tumble/batch/simulate_batch.hpp"
#include "tumble/math/format.hpp"

namespace {

using namespace tumble;
using Clock = std::chrono::steady_clock;

// Seconds of the fastest of some calls, which together take a third of a second.
template <class Function>
double fastest(Function function) {
  double best = 1e300;
  for (const auto start = Clock::now(); Clock::now() - start < std::chrono::milliseconds(330);) {
    const auto begin = Clock::now();
    function();
    best = std::min(best, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return best;
}

template <class Real>
void rate(const std::string& set, const std::string& starts, const std::string& keep, int threads) {
  // States alone stay in the second-level cache; trajectories go to memory.
  const std::size_t count = keep == "all" ? 200000 : 10000;
  problems::Random random(7);
  std::vector<Real> q0, v0;
  for (std::size_t i = 0; i < count; ++i) {
    const double course[6] = {0.0, 1.5, 0.52359877559829882, 0.0, -0.2, 0.0};
    const double low[6] = {-0.5, 0.5, 0.0, -1.0, -1.0, -5.0}, high[6] = {0.5, 1.5, 6.28, 1.0, 0.0, 5.0};
    for (std::size_t c = 0; c < 6; ++c) {
      const double number = random.uniform(low[c], high[c]);
      (c < 3 ? q0 : v0).push_back(static_cast<Real>(starts == "course" ? course[c] : number));
    }
  }
  batch::BatchSettings settings;
  settings.every = keep == "all" ? 1 : 0;
  settings.threads = threads;
  settings.instruction_set = instruction_set_named(set, "SET");
  const std::size_t kept = 3 * count * batch::kept_columns(150, settings.every);
  std::vector<Real> q(kept), v(kept);
  std::vector<batch::DropMeasures> measures(keep == "measures" ? count : 0);
  const double seconds = fastest([&] {
    batch::simulate_batch<Real>({q0, v0}, {}, settings, {.q = q, .v = v, .measures = measures});
  });
  const double steps = 149.0 * static_cast<double>(count);
  tumble::print("{} {}\n", steps / seconds, static_cast<double>(2 * kept * sizeof(Real)) / seconds);
}

void stream(int threads) {
  constexpr std::size_t size = std::size_t{1} << 26, piece = std::size_t{1} << 14;  // 512 MB, 128 kB
  std::vector<double> to(size + 8);
  const std::size_t first = (64 - reinterpret_cast<std::uintptr_t>(to.data()) % 64) / 8;  // a line begins here
  const std::vector<double> from(piece, 1.0);
  const double seconds = fastest([&] {
    batch::for_each_chunk(size / piece, threads, [&](std::size_t chunk, std::size_t) {
      batch::write_past_caches(to.data() + first + chunk * piece, from.data(), piece);
    });
  });
  tumble::print("{}\n", static_cast<double>(size * sizeof(double)) / seconds);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() == 2 && words[0] == "stream") {
      stream(std::atoi(words[1].c_str()));
    } else if (words.size() == 6 && words[0] == "rate") {
      (words[5] == "float" ? rate<float> : rate<double>)(words[1], words[2], words[3], std::atoi(words[4].c_str()));
    } else {
      throw std::invalid_argument("see the head of bench_batch.cpp");
    }
  } catch (const std::exception& error) {
    tumble::print(stderr, "tumble_bench_batch: {}\n", error.what());
    return 2;
  }
}
