// The subcommands: each takes its parsed options, calls the library, writes and returns the exit code.
#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include "tumble/drop/drop.hpp"
#include "tumble/output/write.hpp"
#include "tumble/trajectory/simulate.hpp"

namespace tumble::cli {

// Exit codes. Bad input is whatever the library throws as std::invalid_argument.
inline constexpr int k_done = 0;
inline constexpr int k_warnings = 1;   // of check
inline constexpr int k_bad_input = 2;  // also: a file that cannot be read or written
inline constexpr int k_numerical_failure = 3;
inline constexpr int k_interrupted = 130;  // by Ctrl-C: 128 + SIGINT, as shells have it

// "tumble: <message>" on standard error; returns `exit_code`.
int report_failure(const std::string& message, int exit_code);

// The same of an exception, in the words of the command line: options for fields, and which one helps.
int report_error(const std::exception& error);

struct ReportOptions {
  bool json = false;   // one JSON object on standard output instead of text
  bool quiet = false;  // nothing on standard output
};

// Where the results go. `pictures` holds width, height and speed, shared by all files of a run.
struct OutputOptions {
  std::vector<std::string> files;
  output::WriteOptions pictures;
};

// Throws std::invalid_argument if two of the names mean the same file.
void require_different(const std::vector<std::string>& files);

struct DropOptions {
  Vector3 q0 = {0.0, 1.5, 0.52359877559829887};  // the course's start: 30 degrees
  Vector3 v0 = {0.0, -0.2, 0.0};
  drop::Parameters parameters;
  OutputOptions output;
  ReportOptions report;
};
int run_drop(const DropOptions& options);

struct RunOptions {
  std::string input;  // "-" is standard input
  SimulateSettings settings;
  bool no_contacts = false;  // leave contacts out of the files
  OutputOptions output;
  ReportOptions report;
};
int run_scene(const RunOptions& options);

// Prints what the program was built with and the hash of the reference run; a numerical failure if that is not what it
// is everywhere.
int run_doctor(const ReportOptions& options);

struct CheckOptions {
  std::string input;  // "-" is standard input
  ReportOptions report;
};
int check_scene(const CheckOptions& options);

struct RenderOptions {
  std::string input;
  OutputOptions output;
  ReportOptions report;
};
int run_render(const RenderOptions& options);

struct SweepOptions {
  std::string input;   // "-" is standard input
  std::string output;  // folder, or file .npz or .h5; empty: a folder named like the input
  bool overwrite = false;
  std::uint64_t shard = 1;  // of `shards`, from 1 on
  std::uint64_t shards = 1;
  int threads = 0;
  ReportOptions report;
};
int run_sweep(const SweepOptions& options);

struct MergeOptions {
  std::vector<std::string> folders;
  std::string output;  // folder, or file .npz or .h5; empty: the first of the folders
  bool overwrite = false;
  int threads = 0;
  ReportOptions report;
};
int merge_sweep(const MergeOptions& options);

struct LcpOptions {
  std::vector<std::string> files;     // "-" is standard input
  std::string method;                 // empty: the one that fits the other options
  std::vector<std::string> settings;  // NAME=VALUE
  bool all = false;                   // every solution
  bool exact = false;                 // fractions
  bool trace = false;                 // every pivot
  ReportOptions report;
};
int run_lcp(const LcpOptions& options);

// The same for options.exact; `text` has been read from `name`.
int run_lcp_exact(const std::string& text, const std::string& name, const LcpOptions& options);

}  // namespace tumble::cli
