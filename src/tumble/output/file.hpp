// Files that appear under their name only when they are complete, and whole files read with a cap.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace tumble::output {

// The path for a message: one line, without bytes that a terminal would act on.
std::string path_text(const std::filesystem::path& path);

// The ending of a file's name in lower case, with its dot: ".npz" of "A.NPZ".
std::string ending_of(const std::filesystem::path& path);

// A file under construction. The bytes go to a file without a name on the disk of the target; `commit` gives it
// the name. Without `commit` nothing is left behind, even if the process is killed, and an older file stays as it
// was. (File systems without nameless files get a temporary name, .tumble-PID-N.tmp, which a kill leaves behind.)
// A symbolic link stays and its target is replaced. A character device and a descriptor of this process (/dev/null,
// /dev/stdout, /dev/fd/N) are written to directly.
// Throws std::invalid_argument if the target exists and may not be overwritten or is a folder, a named pipe, a socket
// or a block device, and std::system_error (a std::runtime_error) with path and reason for everything the system
// refuses.
class OutputFile {
 public:
  // `has_temporary_name` asks for such a name everywhere, for a library that cannot open files without one.
  OutputFile(const std::filesystem::path& path, bool overwrite, bool has_temporary_name = false);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  void commit();

  // The file that holds the bytes until `commit`, for a program that writes them itself.
  const std::filesystem::path& working_path() const { return working_path_; }

 private:
  void open_unfinished();
  bool link_as(const std::filesystem::path& name) const;

  std::filesystem::path path_;          // as given, for messages
  std::filesystem::path target_;        // links followed
  std::filesystem::path working_path_;  // equal to target_ if written to directly
  bool overwrite_;
  bool is_direct_ = false;
  bool has_temporary_name_ = false;
  int descriptor_ = -1;
};

// Everything about the target that can be known without touching it. Throws std::invalid_argument.
void check_target(const std::filesystem::path& path, bool overwrite);

// True if the path exists, links followed, and is a character device or a descriptor of this process.
bool is_direct_target(const std::filesystem::path& path);

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes, bool overwrite);

// The whole file. Throws std::invalid_argument if it has more than `max_bytes`, std::system_error if it
// cannot be read.
std::string read_file(const std::filesystem::path& path, std::size_t max_bytes);

// While it lives, a write of this thread to a closed pipe fails with EPIPE instead of ending the process.
class SigpipeGuard {
 public:
  SigpipeGuard();
  ~SigpipeGuard();
  SigpipeGuard(const SigpipeGuard&) = delete;
  SigpipeGuard& operator=(const SigpipeGuard&) = delete;

 private:
  bool must_unblock_ = false;
};

}  // namespace tumble::output
