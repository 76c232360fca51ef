#include "long_run.hpp"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <fstream>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "problems.hpp"
#include "progress.hpp"

#include "tumble/lcp/problem_text.hpp"
#include "tumble/lcp/residual.hpp"
#include "tumble/lcp/solve.hpp"
#include "tumble/math/format.hpp"

namespace tumble::bench {
namespace {

struct Group {
  std::string name;
  std::uint64_t count;
  std::function<ContactSystem(std::uint64_t index)> make;
};

struct Tally {
  std::map<LcpStatus, std::uint64_t> failures;
  std::map<LcpRung, std::uint64_t> rungs;
  double worst_residual = 0.0;  // of the solved
  std::vector<std::uint64_t> failed;

  void add(const Tally& other) {
    for (const auto& [status, count] : other.failures) failures[status] += count;
    for (const auto& [rung, count] : other.rungs) rungs[rung] += count;
    worst_residual = std::max(worst_residual, other.worst_residual);
    failed.insert(failed.end(), other.failed.begin(), other.failed.end());
  }
};

// `solved` counts only with a residual, computed anew, of at most this.
constexpr double k_accepted_residual = 1e-12;

void solve_one(const LcpProblem& problem, std::uint64_t index, LcpWorkspace& workspace, Tally& tally) {
  const LcpResult& result = solve_lcp(problem, RobustSettings{}, workspace);
  const double r = residual(problem, result.z).largest();
  if (result.status == LcpStatus::solved && r <= k_accepted_residual) {
    ++tally.rungs[result.rung];
    tally.worst_residual = std::max(tally.worst_residual, r);
  } else {
    ++tally.failures[result.status];
    tally.failed.push_back(index);
  }
}

Tally run(const Group& group, int num_threads) {
  const std::uint64_t block = std::clamp<std::uint64_t>(group.count / 1000, 1, 1000);
  std::atomic<std::uint64_t> next{0};
  std::mutex mutex;
  Tally total;
  std::uint64_t done = 0;
  Progress progress(group.name, group.count);
  const auto work = [&] {
    LcpWorkspace workspace;
    for (std::uint64_t first = next.fetch_add(block); first < group.count; first = next.fetch_add(block)) {
      const std::uint64_t end = std::min(first + block, group.count);
      Tally tally;
      for (std::uint64_t i = first; i < end; ++i) solve_one(as_lcp(group.make(i)), i, workspace, tally);
      const std::lock_guard lock(mutex);
      total.add(tally);
      done += end - first;
      progress.show(done);
    }
  };
  std::vector<std::thread> threads;
  for (int k = 0; k < num_threads; ++k) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  std::sort(total.failed.begin(), total.failed.end());
  return total;
}

std::string row(const Group& group, const Tally& tally) {
  std::string failures, rungs;
  for (const auto& [status, count] : tally.failures) failures += tumble::format(", {} {}", count, to_string(status));
  for (const auto& [rung, count] : tally.rungs)
    rungs += tumble::format("{}{} {}", rungs.empty() ? "" : ", ", count, to_string(rung));
  return tumble::format("| {} | {} | {}{} | {:.1e} | {} |\n", group.name, group.count, tally.failed.size(), failures,
                        tally.worst_residual, rungs);
}

}  // namespace

std::string long_run(const LongRun& settings) {
  std::vector<Group> groups;
  const std::uint64_t seed = settings.seed;
  groups.push_back({"wild, n = 4 .. 16", settings.num_small, [=](auto i) { return problems::wild_of(seed, i, 4); }});
  groups.push_back({"wild, n = 4 .. 48", settings.num_medium, [=](auto i) { return problems::wild_of(seed, i, 12); }});
  for (const problems::Family& family : problems::families()) {
    if (family.name == "wild") continue;
    for (const std::size_t n : {8u, 16u, 40u, 80u, 160u, 240u, 400u}) {
      groups.push_back({tumble::format("{}, n = {}", family.name, n), settings.num_stacks, [=](auto i) {
                          problems::Random random = problems::random_of(seed + n, i);
                          return family.make(random, n / 4);
                        }});
    }
  }
  std::string text = tumble::format(
      "## The default solver, seed {}\n\nA failure is anything but `solved` with a residual of at most {:.0e}, "
      "computed from the problem.\n\n| problems | count | failures | worst residual | rungs |\n|---|---|---|---|---|\n",
      seed, k_accepted_residual);
  std::size_t num_written = 0;
  for (const Group& group : groups) {
    const Tally tally = run(group, settings.num_threads);
    text += row(group, tally);
    for (const std::uint64_t index : tally.failed) {
      if (settings.failures.empty() || ++num_written > 100) break;
      std::filesystem::create_directories(settings.failures);
      std::string name;  // the letters and digits of the group, joined by '-'
      for (const char c : tumble::format("{} {}", group.name, index)) {
        if (std::isalnum(static_cast<unsigned char>(c)))
          name += c;
        else if (!name.ends_with('-'))
          name += '-';
      }
      std::ofstream file(settings.failures / (name + ".txt"));
      file << tumble::format("# {}, seed {}, index {}\n", group.name, seed, index)
           << to_text(as_lcp(group.make(index)));
    }
  }
  return text + '\n';
}

}  // namespace tumble::bench
