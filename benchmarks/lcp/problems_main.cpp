// tumble-problems: makes contact problems from a seed, and converts between text and fclib's HDF5.
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tumble/math/format.hpp"

#ifdef TUMBLE_HAS_FCLIB
#include "fclib_file.hpp"
#endif
#include "known_problems.hpp"
#include "problems.hpp"

#include "tumble/lcp/problem_text.hpp"

namespace {

using namespace tumble;

bool is_text(const std::string& path) { return std::filesystem::path(path).extension() == ".txt"; }

[[noreturn]] void refuse_ending(const std::string& path) {
#ifdef TUMBLE_HAS_FCLIB
  throw std::invalid_argument(path + ": the name must end in .txt, .hdf5 or .h5");
#else
  throw std::invalid_argument(path + ": the name must end in .txt; this program was built without fclib");
#endif
}

bool is_hdf5(const std::string& path) {
#ifdef TUMBLE_HAS_FCLIB
  const std::filesystem::path ending = std::filesystem::path(path).extension();
  return ending == ".hdf5" || ending == ".h5";
#else
  return path.empty();
#endif
}

LcpProblem read(const std::string& path) {
  if (is_text(path)) return problems::read_known_problems(path).front().problem;
#ifdef TUMBLE_HAS_FCLIB
  if (is_hdf5(path)) return problems::read_fclib(path);
#endif
  refuse_ending(path);
}

// `comment` goes to the head of a text.
void write(const std::string& path, const LcpProblem& problem, const std::string& comment, bool may_replace) {
  if (!is_text(path) && !is_hdf5(path)) refuse_ending(path);
  if (!may_replace && std::filesystem::exists(path)) {
    throw std::invalid_argument(path + ": exists already; --force replaces it");
  }
#ifdef TUMBLE_HAS_FCLIB
  if (is_hdf5(path)) return problems::write_fclib(path, problem);
#endif
  const std::string part = path + ".part";
  std::ofstream file(part, std::ios::binary);
  file << tumble::format("# {}\n", comment) << to_text(problem);
  if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
  std::filesystem::rename(part, path);
}

struct Settings {
  std::string family = "wild";
  int num_contacts = 4;
  std::uint64_t seed = 1;
  std::string input;
  std::string output;
  bool may_replace = false;
};

void make(const Settings& settings) {
  for (const problems::Family& family : problems::families()) {
    if (family.name != settings.family) continue;
    problems::Random random(settings.seed);
    const ContactSystem system = family.make(random, static_cast<std::size_t>(settings.num_contacts));
    const std::string comment = tumble::format("{}, {} contacts, seed {}; z = (c, b+ and b-, s) by kind", family.name,
                                               settings.num_contacts, settings.seed);
    write(settings.output, as_lcp(system), comment, settings.may_replace);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  std::vector<std::string> names;
  for (const problems::Family& family : problems::families()) names.emplace_back(family.name);

  CLI::App app("Contact problems as LCPs: from a seed, as text (.txt) and as fclib's HDF5 (.hdf5, .h5).");
  app.require_subcommand(1);
  CLI::App* make_command = app.add_subcommand("make", "make a random contact problem");
  make_command->add_option("family", settings.family, "kind of scene")->required()->check(CLI::IsMember(names));
  make_command->add_option("output", settings.output, "file to write")->required();
  make_command->add_option("--contacts", settings.num_contacts, "number of contacts, n = 4 times this")
      ->check(CLI::Range(1, static_cast<int>(k_max_text_problem_size / 4)))
      ->capture_default_str();
  make_command->add_option("--seed", settings.seed)->capture_default_str();
  CLI::App* convert_command = app.add_subcommand("convert", "read one form and write the other");
  convert_command->add_option("input", settings.input, "file to read")->required();
  convert_command->add_option("output", settings.output, "file to write")->required();
  for (CLI::App* command : {make_command, convert_command}) {
    command->add_flag("--force", settings.may_replace, "replace an existing file");
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (*make_command) make(settings);
    if (*convert_command) {
      write(settings.output, read(settings.input), "from " + settings.input, settings.may_replace);
    }
  } catch (const std::exception& error) {
    tumble::print(stderr, "tumble-problems: {}\n", error.what());
    return 2;
  }
  return 0;
}
