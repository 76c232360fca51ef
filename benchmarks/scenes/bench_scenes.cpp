// Every engine in the same worlds in one run.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "../lcp/progress.hpp"
#include "engine.hpp"
#include "measure_engines.hpp"
#include "results_table.hpp"
#include "worlds.hpp"
#include <CLI/CLI.hpp>

#include "tumble/math/format.hpp"

namespace {

using namespace tumble::bench;

struct Settings {
  double step_size = 0.01;
  int rounds = 3;
  double at_least = 0.05;
  std::string only;
  std::string output = "out";
};

// All engines; the text says which are missing. The first one is what the others' times are compared with.
std::vector<Engine> all_engines(std::string& text) {
  std::vector<Engine> engines;
  const auto add = [&](const char* name, const char* package, const std::vector<Engine>& more) {
    if (more.empty()) text += tumble::format("{} was not found ({}) and is left out.\n\n", name, package);
    engines.insert(engines.end(), more.begin(), more.end());
  };
  add("Chipmunk", "libchipmunk-dev", chipmunk_engines());
  add("Tumble", "this project", tumble_engines());
  add("Box2D", "libbox2d-dev", box2d_engines());
  return engines;
}

std::vector<World> all_worlds() {
  return {dropped_square(), dropped_ball(), squares_side_by_side(500), tower(10), pile(10), pile(100), pile(1000)};
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

void run(const Settings& settings) {
  std::filesystem::create_directories(settings.output);
  const std::filesystem::path out = settings.output;
  std::string text =
      tumble::format("# Scenes\n\nStep size {} s; medians of {} rounds.\n\n", settings.step_size, settings.rounds);
  const std::vector<Engine> engines = all_engines(text);
  std::vector<World> worlds = all_worlds();
  if (!settings.only.empty()) std::erase_if(worlds, [&](const World& world) { return world.name != settings.only; });
  if (worlds.empty()) throw std::runtime_error(tumble::format("--only: no world is named '{}'", settings.only));
  std::vector<Measurement> measurements;
  {
    Progress progress("worlds", worlds.size());
    measurements = measure(worlds, engines, settings.step_size, settings.rounds, settings.at_least,
                           [&](std::size_t done) { progress.show(done); });
  }
  text += tables(worlds, engines, measurements, 0);
  write(out / "bench-scenes.csv", csv(worlds, engines, measurements, settings.step_size));
  write(out / "bench-scenes.md", text);
  tumble::print("{}", text);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs every engine in the same worlds; writes bench-scenes.md and bench-scenes.csv.");
  Settings settings;
  app.add_option("--step-size", settings.step_size, "of every engine, in s")
      ->check(CLI::Range(1e-5, 0.1))
      ->capture_default_str();
  app.add_option("--rounds", settings.rounds, "in each of them all engines run each world")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--at-least", settings.at_least, "seconds that an engine runs a world in a round")
      ->check(CLI::Range(0.0, 1e3))
      ->capture_default_str();
  app.add_option("--only", settings.only, "name of the one world to run");
  app.add_option("-o,--output", settings.output, "folder")->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    run(settings);
  } catch (const std::exception& error) {
    tumble::print(stderr, "tumble_bench_scenes: {}\n", error.what());
    return 2;
  }
  return 0;
}
