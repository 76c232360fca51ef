#include "tumble/output/file.hpp"

#include <atomic>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tumble/math/format.hpp"

namespace tumble::output {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* action, const fs::path& path, int error) {
  throw std::system_error(error, std::generic_category(), tumble::format("cannot {} {}", action, path_text(path)));
}

[[noreturn]] void refuse(const fs::path& path, std::string_view why) {
  throw std::invalid_argument(tumble::format("{}: {}", path_text(path), why));
}

struct Target {
  fs::path path;  // links followed
  bool exists = false;
  bool is_direct = false;  // written to without a temporary file
  mode_t mode = 0;         // permissions, if it exists
};

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// A descriptor of a running process seen as a file, as behind /dev/stdout: renaming over it would miss its
// owner.
bool is_descriptor(const fs::path& path) {
  std::error_code error;
  const std::string folder = fs::canonical(folder_of(path), error).string();
  return !error && (folder == "/proc" || folder.starts_with("/proc/"));
}

Target find_target(const fs::path& path) {
  if (path.empty()) throw std::invalid_argument("the name of the file to write is empty");
  constexpr int k_max_links = 40;  // as the kernel's own limit
  Target target{path};
  struct stat info {};
  target.exists = ::stat(path.c_str(), &info) == 0;
  if (!target.exists && errno != ENOENT) fail("write", path, errno);
  if (target.exists) {
    if (S_ISDIR(info.st_mode)) refuse(path, "is a folder, expected the name of a file");
    target.is_direct = S_ISCHR(info.st_mode);
    target.mode = info.st_mode & 07777;
  }
  std::error_code error;
  for (int links = 0; !target.is_direct && fs::is_symlink(target.path, error); ++links) {
    if (links == k_max_links) fail("write", path, ELOOP);
    if (is_descriptor(target.path)) {
      target.is_direct = true;
      break;
    }
    const fs::path next = fs::read_symlink(target.path, error);
    if (error) fail("write", path, error.value());
    target.path = folder_of(target.path) / next;
  }
  if (target.is_direct) target.path = path;
  // A named pipe would keep the program waiting for a reader; the others are no place for a file.
  if (target.exists && !target.is_direct && !S_ISREG(info.st_mode)) {
    refuse(path, "is a named pipe, a socket or a block device, expected the name of a file");
  }
  return target;
}

void check(const fs::path& path, const Target& target, bool overwrite) {
  if (target.exists && !target.is_direct && !overwrite) refuse(path, "already exists");
  if (target.exists && ::access(path.c_str(), W_OK) != 0) refuse(path, "exists and is not writable");
  if (target.is_direct) return;
  const fs::path folder = folder_of(target.path);
  struct stat info {};
  if (::stat(folder.c_str(), &info) != 0) {
    refuse(path, tumble::format("the folder {} cannot be used: {}", path_text(folder),
                                std::generic_category().message(errno)));
  }
  if (!S_ISDIR(info.st_mode)) refuse(path, tumble::format("{} is not a folder", path_text(folder)));
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    refuse(path, tumble::format("the folder {} is not writable: {}", path_text(folder),
                                std::generic_category().message(errno)));
  }
}

// Process and counter make the name unique here; O_EXCL finds another one if a file of a foreign process has
// it. The name does not contain that of the target, which may already be as long as a name can be.
fs::path temporary_name(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  return folder_of(target) / tumble::format(".tumble-{}-{}.tmp", ::getpid(), counter++);
}

}  // namespace

std::string path_text(const fs::path& path) {
  std::string text = path.string();
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  }
  return text;
}

std::string ending_of(const fs::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

OutputFile::OutputFile(const fs::path& path, bool overwrite, bool has_temporary_name)
    : path_(path), overwrite_(overwrite), has_temporary_name_(has_temporary_name) {
  const Target target = find_target(path);
  check(path, target, overwrite);
  target_ = target.path;
  is_direct_ = target.is_direct;
  if (is_direct_) {
    working_path_ = target_;
    has_temporary_name_ = false;
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
    if (descriptor_ < 0) fail("write", path_, errno);
    return;
  }
  open_unfinished();
  // Some file systems know no permissions; the file is then as open as all others there.
  if (target.exists) static_cast<void>(::fchmod(descriptor_, target.mode));
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (has_temporary_name_) ::unlink(working_path_.c_str());
}

void OutputFile::open_unfinished() {
  // A file without a name is gone whatever ends the process. It is reached, and later named, by way of /proc.
  if (!has_temporary_name_ && ::access("/proc/self/fd", X_OK) == 0) {
    descriptor_ = ::open(folder_of(target_).c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
    working_path_ = tumble::format("/proc/{}/fd/{}", ::getpid(), descriptor_);
    if (descriptor_ >= 0) return;
  }
  do {  // a file system that does not know such files
    working_path_ = temporary_name(target_);
    descriptor_ = ::open(working_path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) fail("write", path_, errno);
  has_temporary_name_ = true;
}

// Fails if the name is in use.
bool OutputFile::link_as(const fs::path& name) const {
  return ::linkat(AT_FDCWD, working_path_.c_str(), AT_FDCWD, name.c_str(),
                  has_temporary_name_ ? 0 : AT_SYMLINK_FOLLOW) == 0;
}

void OutputFile::write(std::string_view bytes) {
  const SigpipeGuard guard;
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("write", path_, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void OutputFile::commit() {
  // Pipes and devices answer EINVAL or ENOTSUP: there is nothing to bring to a disk.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS) fail("write", path_, errno);
  if (is_direct_ || link_as(target_)) return;
  if (!overwrite_ && (errno == EEXIST || fs::exists(target_))) refuse(path_, "already exists");
  // Only a rename replaces a file in one step, and it needs a name to start from.
  while (!has_temporary_name_) {
    const fs::path name = temporary_name(target_);
    if (link_as(name)) {
      working_path_ = name;
      has_temporary_name_ = true;
    } else if (errno != EEXIST) {
      fail("write", path_, errno);
    }
  }
  if (::rename(working_path_.c_str(), target_.c_str()) != 0) fail("write", path_, errno);
  has_temporary_name_ = false;
}

void check_target(const fs::path& path, bool overwrite) {
  try {
    check(path, find_target(path), overwrite);
  } catch (const std::system_error& error) {
    throw std::invalid_argument(error.what());
  }
}

bool is_direct_target(const fs::path& path) { return find_target(path).is_direct; }

void write_file_atomically(const fs::path& path, std::string_view bytes, bool overwrite) {
  OutputFile file(path, overwrite);
  file.write(bytes);
  file.commit();
}

std::string read_file(const fs::path& path, std::size_t max_bytes) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail("read", path, errno);
  struct Closer {
    ~Closer() { ::close(descriptor); }
    int descriptor;
  } const closer{descriptor};

  const auto check_size = [&](std::size_t size) {
    if (size > max_bytes) refuse(path, tumble::format("has more than {} bytes, the most that is read", max_bytes));
  };
  struct stat info {};
  if (::fstat(descriptor, &info) != 0) fail("read", path, errno);
  std::string bytes;
  if (S_ISREG(info.st_mode)) {
    check_size(static_cast<std::size_t>(info.st_size));
    bytes.reserve(static_cast<std::size_t>(info.st_size));
  }
  std::string block(1 << 16, '\0');
  for (;;) {
    const ssize_t got = ::read(descriptor, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("read", path, errno);
    if (got == 0) return bytes;
    bytes.append(block, 0, static_cast<std::size_t>(got));
    check_size(bytes.size());
  }
}

SigpipeGuard::SigpipeGuard() {
  sigset_t pipe_only;
  sigset_t pending;
  sigset_t before;
  sigemptyset(&pipe_only);
  sigaddset(&pipe_only, SIGPIPE);
  sigpending(&pending);
  if (sigismember(&pending, SIGPIPE)) return;  // blocked by somebody else already: theirs to handle
  pthread_sigmask(SIG_BLOCK, &pipe_only, &before);
  must_unblock_ = !sigismember(&before, SIGPIPE);
}

SigpipeGuard::~SigpipeGuard() {
  if (!must_unblock_) return;
  sigset_t pipe_only;
  sigemptyset(&pipe_only);
  sigaddset(&pipe_only, SIGPIPE);
  const timespec at_once{};
  while (sigtimedwait(&pipe_only, nullptr, &at_once) == -1 && errno == EINTR) {
  }
  pthread_sigmask(SIG_UNBLOCK, &pipe_only, nullptr);
}

}  // namespace tumble::output
