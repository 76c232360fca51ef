// Every LCP solver on the same problems in one run.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases.hpp"
#include "long_run.hpp"
#include "measure.hpp"
#include "progress.hpp"
#include "solver.hpp"
#include "table.hpp"
#include <CLI/CLI.hpp>

#include "tumble/math/format.hpp"

namespace {

using namespace tumble::bench;

struct Settings {
  std::uint64_t seed = 1;
  double scale = 1.0;
  double time_limit = 10.0;
  std::vector<std::string> problems;
  std::string output = "out";
  bool is_long = false;
  LongRun long_run;
};

template <class T>
void append(std::vector<T>& all, std::vector<T> more) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

// All solvers; the text says which peers are missing.
std::vector<Solver> all_solvers(std::string& text) {
  std::vector<Solver> solvers = our_solvers();
  const auto add = [&](const char* project, const char* package, std::vector<Solver> peers) {
    if (peers.empty()) text += tumble::format("{} was not found ({}) and is left out.\n\n", project, package);
    append(solvers, std::move(peers));
  };
  add("Siconos", "libsiconos-numerics-dev", siconos_solvers());
  add("Bullet", "libbullet-dev", bullet_solvers());
  add("DART", "libdart-dev", dart_solvers());
  return solvers;
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

void run(const Settings& settings) {
  std::filesystem::create_directories(settings.output);
  const std::filesystem::path out = settings.output;
  std::string text = "# LCP solvers\n\n";
  const std::vector<Solver> solvers = all_solvers(text);
  std::vector<Case> cases;
  for (const std::string& path : settings.problems) append(cases, cases_from_files(path, path));
  append(cases, cases_from_files(TUMBLE_LCP_DATA, "data/lcp"));
  append(cases, generated_cases(settings.seed, settings.scale));
  append(cases, warm_cases(settings.seed, settings.scale));
  std::vector<Measurement> measurements;
  {
    Progress progress("problems", cases.size());
    measurements = measure(cases, solvers, settings.time_limit, [&](std::size_t done) { progress.show(done); });
  }
  text += tables(cases, solvers, measurements);
  write(out / "bench-lcp.csv", csv(cases, solvers, measurements));
  write(out / "bench-lcp.md", text);
  if (settings.is_long) {
    LongRun settings_long = settings.long_run;
    settings_long.seed = settings.seed;
    settings_long.failures = out / "bench-lcp-failures";
    text += long_run(settings_long);
    write(out / "bench-lcp.md", text);
  }
  tumble::print("{}", text);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs every LCP solver on the same problems; writes bench-lcp.md and bench-lcp.csv.");
  Settings settings;
  app.add_option("--problems", settings.problems, "files, or folders of *.txt, with problems of your own");
  app.add_option("--seed", settings.seed, "of the random problems")->capture_default_str();
  app.add_option("--scale", settings.scale, "times the usual number of random problems")
      ->check(CLI::Range(1e-3, 1e3))
      ->capture_default_str();
  app.add_option("--time-limit", settings.time_limit,
                 "seconds that a solver may take for one problem, repeats included")
      ->check(CLI::Range(0.1, 1e5))
      ->capture_default_str();
  app.add_option("-o,--output", settings.output, "folder")->capture_default_str();
  app.add_flag("--long", settings.is_long, "also millions of problems for the default solver");
  app.add_option("--small", settings.long_run.num_small, "how many with n = 4 .. 16 then")->capture_default_str();
  app.add_option("--medium", settings.long_run.num_medium, "with n = 4 .. 48")->capture_default_str();
  app.add_option("--stacks", settings.long_run.num_stacks, "of each kind and size")->capture_default_str();
  app.add_option("--threads", settings.long_run.num_threads)->check(CLI::Range(1, 256))->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    run(settings);
  } catch (const std::exception& error) {
    tumble::print(stderr, "tumble_bench_lcp: {}\n", error.what());
    return 2;
  }
  return 0;
}
