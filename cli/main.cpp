// The program `tumble`. CLI11 is included here and nowhere else: it takes longer to compile than the rest
// together.
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <system_error>

#include "commands.hpp"
#include "input.hpp"
#include "text.hpp"
#include <CLI/CLI.hpp>

#include "tumble/lcp/methods.hpp"
#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"
#include "tumble/output/file.hpp"

namespace tumble::cli {
namespace {

// Parameters have the document's names in the library and words on the command line; errors show what was
// typed.
const std::map<std::string, std::string> k_option_of_field = {{"l", "--side"},
                                                              {"m", "--mass"},
                                                              {"mu", "--friction"},
                                                              {"eps", "--restitution"},
                                                              {"dt", "--step"},
                                                              {"delta", "--delta"},
                                                              {"g", "--gravity"},
                                                              {"columns", "--steps + 1"},
                                                              {"m, l", "--mass, --side"},
                                                              {"q0, v0", "--q0, --v0"},
                                                              {"width", "--width"},
                                                              {"height", "--height"},
                                                              {"speed", "--speed"},
                                                              {"format", "--format"},
                                                              {"step_size", "--step-size"},
                                                              {"duration", "--duration"},
                                                              {"sample_every", "--sample-every"},
                                                              {"method", "--method"},
                                                              {"threads", "--threads"}};

std::string with_option_name(const std::string& message) {
  for (const char* ending : {"already exists", "its spec.toml gives other results"}) {
    if (message.ends_with(ending)) return message + "; --force replaces it";
  }
  const std::size_t colon = message.find(':');
  const auto found = k_option_of_field.find(message.substr(0, colon));
  return found == k_option_of_field.end() ? message : found->second + message.substr(colon);
}

void add_report_options(CLI::App& app, ReportOptions& report) {
  app.add_flag("--json", report.json, "Print one JSON object instead of text");
  app.add_flag("--quiet", report.quiet, "Print nothing but errors");
}

// An option whose word goes through `parse`, so that every bad number gets the same kind of message.
template <class T>
void add_parsed(CLI::App& app, const std::string& name, T& target, T (*parse)(const std::string&, const std::string&),
                const std::string& description, const std::string& default_text, const std::string& type) {
  app.add_option_function<std::string>(
         name, [&target, parse, name](const std::string& word) { target = parse(name, word); }, description)
      ->default_str(default_text)
      ->type_name(type);
}

// Left out, it is chosen for the kind of picture: 0 in the library, which is no width to ask for.
int picture_side(const std::string& option, const std::string& text) {
  const int side = whole_number(option, text);
  if (side >= output::k_smallest_picture && side <= output::k_largest_picture) return side;
  throw std::invalid_argument(tumble::format("{}: must be in [{}, {}] px, got {}", option, output::k_smallest_picture,
                                             output::k_largest_picture, side));
}

// `data` are the endings of files that hold numbers.
void add_output_options(CLI::App& app, OutputOptions& output, const std::string& data) {
  output.pictures.page = page_path();
  app.add_option(
         "-o,--output", output.files,
         tumble::format(
             "File to write; its ending picks the kind: {}, .png .svg (many poses in one picture), .gif "
             ".mp4 (animation in real time), .html (page that plays it in a browser; needs `make viewer`). May be "
             "given several times",
             data))
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--format", output.pictures.format, "Kind of the files, whatever their endings, named like these")
      ->type_name("NAME");
  app.add_flag("--force", output.pictures.overwrite, "Replace files that exist");
  add_parsed(app, "--width", output.pictures.width, &picture_side, "Width of pictures [px], 160 to 4096", "by kind",
             "COUNT");
  add_parsed(app, "--height", output.pictures.height, &picture_side, "Height of pictures [px], 160 to 4096", "by kind",
             "COUNT");
  add_parsed(app, "--speed", output.pictures.speed, &number, "Pace of animations; 0.1 is slow motion, > 0", "1",
             "NUMBER");
}

void add_drop(CLI::App& program, DropOptions& options, std::function<int()>& command) {
  CLI::App& app = *program.add_subcommand("drop", "Drop a square on the ground and print its impacts");
  drop::Parameters& p = options.parameters;
  const auto add = [&](const std::string& name, double& target, const std::string& description) {
    add_parsed(app, name, target, &number, description, tumble::format("{}", target), "NUMBER");
  };
  add_parsed(app, "--q0", options.q0, &planar_triple, "Start: centre of mass [m] and angle [rad, or with ending deg]",
             "0,1.5,30deg", "X,Y,THETA");
  add_parsed(app, "--v0", options.v0, &planar_triple,
             "Start: velocity [m/s] and angular velocity [rad/s, or with ending deg]", "0,-0.2,0", "VX,VY,OMEGA");
  add("--side", p.l, "Side of the square [m], > 0");
  add("--mass", p.m, "Mass [kg], > 0");
  add("--friction", p.mu, "Coefficient of friction, >= 0");
  add("--restitution", p.eps, "Coefficient of restitution, 0 to 1");
  add("--step", p.dt, "Time step [s], > 0");
  add("--gravity", p.g, "Gravitational acceleration, downwards [m/s^2]");
  add("--delta", p.delta, "Contact threshold and lift [m], >= 0");
  app.add_option_function<std::string>(
         "--steps",
         [&p](const std::string& word) {
           const int steps = whole_number("--steps", word);
           if (steps < 1 || steps >= drop::k_max_columns) {
             throw std::invalid_argument(
                 tumble::format("--steps: must be in [1, {}], got {}", drop::k_max_columns - 1, steps));
           }
           p.columns = steps + 1;
         },
         "Number of steps; the trajectory has one column more")
      ->default_str("149")
      ->type_name("COUNT");
  add_output_options(app, options.output, ".csv .npz .h5 (data)");
  add_report_options(app, options.report);
  app.callback([&] { command = [&] { return run_drop(options); }; });
}

// 0 in the library stands for the scene's own value.
double positive_number(const std::string& option, const std::string& text) {
  const double value = number(option, text);
  if (value > 0.0) return value;
  throw std::invalid_argument(tumble::format("{}: must be > 0, got {}", option, value));
}

void add_scene_argument(CLI::App& app, std::string& input) {
  app.add_option("scene", input, "Scene file, see docs/scenes.md; '-' reads standard input")
      ->type_name("FILE")
      ->required();
}

void add_check(CLI::App& program, CheckOptions& options, std::function<int()>& command) {
  CLI::App& app = *program.add_subcommand("check", "Read a scene and say what is in it, and what is odd about it");
  add_scene_argument(app, options.input);
  add_report_options(app, options.report);
  app.footer("Exit codes: 0 nothing odd, 1 warnings, 2 bad input.");
  app.callback([&] { command = [&] { return check_scene(options); }; });
}

void add_run(CLI::App& program, RunOptions& options, std::function<int()>& command) {
  CLI::App& app = *program.add_subcommand("run", "Simulate a scene and print how it ends");
  add_scene_argument(app, options.input);
  SimulateSettings& settings = options.settings;
  add_parsed(app, "--step-size", settings.step_size, &positive_number, "Time step [s], > 0", "the scene's", "NUMBER");
  add_parsed(app, "--duration", settings.duration, &positive_number, "Simulated time [s], > 0", "the scene's",
             "NUMBER");
  add_parsed(app, "--sample-every", settings.sample_every, &whole_number,
             "Steps from one sample in the files to the next", "1", "COUNT");
  add_parsed(app, "--solver", settings.step.solver, &contact_solver,
             "Of contacts: exact, or fast for many bodies, which stops before the last digits", "exact", "NAME");
  app.add_flag("--no-contacts", options.no_contacts,
               "Leave contacts out of the files; saves memory in long runs of many bodies");
  add_output_options(app, options.output,
                     ".csv (bodies and energies over time), .contacts.csv (contacts), .npz .h5 (all of it)");
  add_report_options(app, options.report);
  app.callback([&] { command = [&] { return run_scene(options); }; });
}

void add_render(CLI::App& program, RenderOptions& options, std::function<int()>& command) {
  CLI::App& app = *program.add_subcommand("render", "Draw a record of a drop, or convert it");
  app.add_option("file", options.input, "Record written by `tumble drop -o`: .csv .npz .h5")
      ->type_name("FILE")
      ->required();
  add_output_options(app, options.output, ".csv .npz .h5 (data)");
  app.get_option("--output")->required();
  add_report_options(app, options.report);
  app.callback([&] { command = [&] { return run_render(options); }; });
}

std::string methods_text() {
  std::string text = "Methods, and what --set takes with its default:\n";
  for (const LcpMethod& method : lcp_methods()) {
    text += tumble::format("  {:<10} {}\n", method.name, method.summary);
    std::vector<std::string> settings;
    for (const auto& [name, value] : named_settings(method.defaults)) {
      settings.push_back(tumble::format("{}={}", name, to_text(value)));
    }
    text += tumble::format("  {:<10} {}\n", "", tumble::join(settings, " "));
  }
  return text;
}

void add_lcp(CLI::App& program, LcpOptions& options, std::function<int()>& command) {
  CLI::App& app =
      *program.add_subcommand("lcp", "Solve linear complementarity problems: w = M z + q >= 0, z >= 0, w.z = 0");
  app.add_option("files", options.files,
                 "Text: a line 'M', the rows of M, a line 'q', the entries of q; numbers as 1e-3 or 1/3, comments "
                 "behind '#'. '-' reads standard input. Several files give a table")
      ->type_name("FILE")
      ->required();
  app.add_option("--method", options.method, "One of those below")->type_name("NAME")->default_str("robust");
  app.add_option("--set", options.settings, "A setting of the method; may be given several times")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  CLI::Option* all = app.add_flag("--all", options.all, "Every vertex solution, by enumeration, n <= 12");
  CLI::Option* exact = app.add_flag(
      "--exact", options.exact,
      "Exact arithmetic, where 0.1 and 1/3 mean just that: fractions and proofs, n <= 40; with --all also rays and "
      "faces, n <= 12");
  exact->excludes("--method")->excludes("--set");
  CLI::Option* trace = app.add_flag("--trace", options.trace, "Show every pivot of Lemke's method, n <= 8");
  add_report_options(app, options.report);
  trace->excludes(all)->excludes(exact)->excludes(app.get_option("--json"));
  app.footer(methods_text());
  app.callback([&] { command = [&] { return run_lcp(options); }; });
}

// "2/8".
void parse_shard(const std::string& word, SweepOptions& options) {
  const std::size_t slash = word.find('/');
  if (slash != std::string::npos) {
    const auto index = parse_number(word.substr(0, slash));
    const auto count = parse_number(word.substr(slash + 1));
    const auto is_count = [](const auto& value) {
      return value && *value >= 1.0 && *value <= 1e6 && std::floor(*value) == *value;
    };
    if (is_count(index) && is_count(count) && *index <= *count) {
      options.shard = static_cast<std::uint64_t>(*index);
      options.shards = static_cast<std::uint64_t>(*count);
      return;
    }
  }
  throw std::invalid_argument(tumble::format("--shard: must be I/N, 1 <= I <= N, got '{}'", word));
}

void add_sweep_options(CLI::App& app, std::string& output, bool& overwrite, int& threads, const std::string& usual) {
  app.add_option("-o,--output", output,
                 "Folder that keeps the chunks and the results, or a file .npz or .h5 for the results alone")
      ->type_name("NAME")
      ->default_str(usual);
  app.add_flag("--force", overwrite, "Replace what is there, also another sweep in the folder");
  add_parsed(app, "--threads", threads, &whole_number, "Threads, 0 for one on each core", "0", "COUNT");
}

void add_merge(CLI::App& sweep, MergeOptions& options, std::function<int()>& command) {
  CLI::App& app = *sweep.add_subcommand("merge", "Make one result out of the chunks of all shards");
  app.add_option("folders", options.folders, "Folders that shards of one sweep have worked in")
      ->type_name("FOLDER")
      ->required();
  add_sweep_options(app, options.output, options.overwrite, options.threads, "the first folder");
  add_report_options(app, options.report);
  app.callback([&] { command = [&] { return merge_sweep(options); }; });
}

void add_sweep(CLI::App& program, SweepOptions& options, MergeOptions& merge, std::function<int()>& command) {
  CLI::App& app = *program.add_subcommand("sweep", "Drop many squares: ranges, grids and distributions of starts");
  CLI::Option* spec =
      app.add_option("spec", options.input, "What is swept, see docs/sweep.md; '-' reads standard input")
          ->type_name("FILE");
  add_sweep_options(app, options.output, options.overwrite, options.threads, "SPEC.sweep");
  app.add_option_function<std::string>(
         "--shard", [&options](const std::string& word) { parse_shard(word, options); },
         "Compute only part I of N, from 1/N to N/N; `tumble sweep merge` puts the parts together")
      ->type_name("I/N");
  add_report_options(app, options.report);
  app.require_subcommand(0, 1);
  app.footer("Killed or interrupted at any moment, the same call goes on where it was.");
  add_merge(app, merge, command);
  app.callback([&app, &options, &command, spec] {
    if (!app.get_subcommands().empty()) return;
    if (spec->empty()) throw CLI::RequiredError("spec");
    command = [&options] { return run_sweep(options); };
  });
}

void add_doctor(CLI::App& program, ReportOptions& options, std::function<int()>& command) {
  CLI::App& app = *program.add_subcommand(
      "doctor", "Print versions and instruction sets, and whether numbers come out as on other machines");
  add_report_options(app, options);
  app.footer("TUMBLE_INSTRUCTION_SET=NAME picks another instruction set. Exit code 3: the numbers are wrong.");
  app.callback([&] { command = [&] { return run_doctor(options); }; });
}

int fail(const std::string& message) { return report_failure(message, k_bad_input); }

// What was printed may still be on its way, to a disk that is full.
int after_printing(int exit_code) {
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) return fail("standard output could not be written");
  return exit_code;
}

// CLI11 would say that a command is missing and leave out that it does not know the word.
void require_command(const CLI::App& program, const std::string& word) {
  const auto commands = program.get_subcommands([&](const CLI::App* command) { return command->get_name() == word; });
  if (commands.empty() && !word.starts_with('-')) {
    throw std::invalid_argument(
        tumble::format("there is no command '{}'; there are drop, run, check, render, sweep, lcp and doctor", word));
  }
}

int run(int argc, char** argv) {
  CLI::App program("Tumble: rigid bodies in the plane under frictional contact.", "tumble");
  program.set_version_flag("--version", std::string("tumble ") + TUMBLE_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done, 1 warnings of check, 2 bad input, 3 numerical failure or no solution, 130 ended by Ctrl-C.\n"
      "`tumble COMMAND --help` tells more.");

  DropOptions drop_options;
  RunOptions run_options;
  CheckOptions check_options;
  RenderOptions render_options;
  SweepOptions sweep_options;
  MergeOptions merge_options;
  LcpOptions lcp_options;
  ReportOptions doctor_options;
  std::function<int()> command;
  add_drop(program, drop_options, command);
  add_run(program, run_options, command);
  add_check(program, check_options, command);
  add_render(program, render_options, command);
  add_sweep(program, sweep_options, merge_options, command);
  add_lcp(program, lcp_options, command);
  add_doctor(program, doctor_options, command);

  try {
    if (argc > 1) require_command(program, argv[1]);
    program.parse(argc, argv);
    return after_printing(command());
  } catch (const CLI::Success& request) {  // --help, --version
    return after_printing(program.exit(request));
  } catch (const CLI::ParseError& error) {
    return fail(error.what());
  } catch (const std::exception& error) {
    return report_error(error);
  }
}

}  // namespace

int report_error(const std::exception& error) { return fail(with_option_name(error.what())); }

int report_failure(const std::string& message, int exit_code) {
  std::fflush(stdout);
  tumble::print(stderr, "tumble: {}\n", output::path_text(message));  // words of the user may hold anything
  return exit_code;
}

void require_different(const std::vector<std::string>& files) {
  std::set<std::filesystem::path> seen;
  for (const std::string& file : files) {
    std::error_code ignored;  // a path that cannot be resolved is refused with a reason when it is opened
    const std::filesystem::path target =
        std::filesystem::weakly_canonical(std::filesystem::absolute(file, ignored), ignored);
    if (!seen.insert(target.empty() ? std::filesystem::path(file) : target).second) {
      throw std::invalid_argument(tumble::format("--output: {} is named twice", file));
    }
  }
}

}  // namespace tumble::cli

int main(int argc, char** argv) { return tumble::cli::run(argc, argv); }
