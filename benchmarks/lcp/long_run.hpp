// Millions of problems for the default solver.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace tumble::bench {

struct LongRun {
  std::uint64_t seed = 1;
  std::uint64_t num_small = 10'000'000;  // wild, n = 4 .. 16
  std::uint64_t num_medium = 1'000'000;  // wild, n = 4 .. 48
  std::uint64_t num_stacks = 100;        // of each kind and size, to n = 400
  int num_threads = 2;
  std::filesystem::path failures;  // folder for the text of problems that failed, at most 100
};

// Solves them all by `robust`: a table of failures, residuals and rungs in markdown. The result does not depend on the
// number of threads.
std::string long_run(const LongRun& settings);

}  // namespace tumble::bench
