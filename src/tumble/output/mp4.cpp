#include "tumble/output/mp4.hpp"

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tumble/math/format.hpp"
#include "tumble/output/animation.hpp"
#include "tumble/output/file.hpp"

extern char** environ;

namespace tumble::output {
namespace {

constexpr const char* k_program = "ffmpeg";
constexpr std::size_t k_kept_words = 4096;  // [bytes] of what ffmpeg says

[[noreturn]] void fail(const char* action, int error) {
  throw std::system_error(error, std::generic_category(), tumble::format("cannot {} {}", action, k_program));
}

// The full name of the program, "" if it is not on the PATH.
std::string find_program() {
  const char* path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    const std::string candidate = tumble::format("{}/{}", rest.substr(0, colon), k_program);
    if (colon > 0 && ::access(candidate.c_str(), X_OK) == 0 && std::filesystem::is_regular_file(candidate)) {
      return candidate;
    }
    rest.remove_prefix(std::min(colon + 1, rest.size()));
  }
  return "";
}

class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  void close() {
    if (value_ >= 0) ::close(value_);
    value_ = -1;
  }
  int get() const { return value_; }

 private:
  int value_;
};

struct Pipe {
  Descriptor read;
  Descriptor write;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  // Closed in other children that another thread may start: they would keep the pipe open.
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("make a pipe to", errno);
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

// A running ffmpeg that takes pictures. Its end without `finish` is a kill.
class Encoder {
 public:
  Encoder(const std::vector<std::string>& arguments) : pictures_(make_pipe()), words_(make_pipe()) {
    start(arguments);
    pictures_.read.close();
    words_.write.close();
    set_nonblocking(pictures_.write.get());
    set_nonblocking(words_.read.get());
  }

  ~Encoder() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    wait();
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  void add(std::string_view bytes) {
    const SigpipeGuard guard;
    while (!bytes.empty()) {
      // Words are taken while waiting: a full pipe of words would stop ffmpeg, and so this.
      std::array<pollfd, 2> waiting{{{pictures_.write.get(), POLLOUT, 0}, {words_.read.get(), POLLIN, 0}}};
      if (::poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) fail("wait for", errno);
      if (waiting[1].revents != 0 && !take_words()) waiting[1].revents = 0;
      if (waiting[0].revents == 0) continue;
      const ssize_t written = ::write(pictures_.write.get(), bytes.data(), bytes.size());
      if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
      if (written < 0 && errno == EPIPE) finish();  // it has ended before its time: say why
      if (written < 0 && errno == EPIPE) fail("write to", EPIPE);
      if (written < 0 && errno != EAGAIN && errno != EINTR) fail("write to", errno);
    }
  }

  // Waits for the end. Throws with the last words if it was no good one.
  void finish() {
    pictures_.write.close();
    pollfd waiting{words_.read.get(), POLLIN, 0};
    while (take_words()) {
      if (::poll(&waiting, 1, -1) < 0 && errno != EINTR) break;
    }
    const int status = wait();
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    const std::string reason = WIFSIGNALED(status) ? tumble::format("ended by signal {}", WTERMSIG(status))
                                                   : tumble::format("exit status {}", WEXITSTATUS(status));
    throw std::runtime_error(tumble::format("ffmpeg failed ({}): {}", reason, last_line()));
  }

 private:
  void start(const std::vector<std::string>& arguments) {
    const std::string program = find_program();
    if (program.empty()) check_ffmpeg();
    std::vector<char*> argv = {const_cast<char*>(k_program)};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pictures_.read.get(), STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, words_.write.get(), STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes, &signals);
    sigaddset(&signals, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    const int error = ::posix_spawn(&process_, program.c_str(), &actions, &attributes, argv.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
      process_ = 0;
      fail("start", error);
    }
  }

  static void set_nonblocking(int descriptor) {
    if (::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) | O_NONBLOCK) < 0) fail("talk to", errno);
  }

  // Takes what ffmpeg has said so far. False after its end.
  bool take_words() {
    std::array<char, 1024> block{};
    for (;;) {
      const ssize_t got = ::read(words_.read.get(), block.data(), block.size());
      if (got > 0) {
        said_.append(block.data(), static_cast<std::size_t>(got));
        if (said_.size() > 2 * k_kept_words) said_.erase(0, said_.size() - k_kept_words);
      } else if (got == 0) {
        return false;
      } else if (errno != EINTR) {
        return errno == EAGAIN;
      }
    }
  }

  // The exit status; that of a child that somebody else has waited for already counts as good.
  int wait() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0) {
      if (errno == EINTR) continue;
      status = 0;
      break;
    }
    process_ = 0;
    return status;
  }

  std::string last_line() const {
    const std::size_t end = said_.find_last_not_of("\r\n ");
    if (end == std::string::npos) return "it gave no reason";
    const std::size_t start = said_.find_last_of("\r\n", end);
    const std::string line = said_.substr(start == std::string::npos ? 0 : start + 1, end - start);
    return path_text(line);
  }

  Pipe pictures_;  // to its standard input
  Pipe words_;     // from its standard error
  std::string said_;
  pid_t process_ = 0;
};

// Blue, green, red, unused per pixel, whatever the byte order of the machine.
void append_bytes(const std::vector<std::uint32_t>& pixels, std::string& bytes) {
  bytes.resize(4 * pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (std::size_t b = 0; b < 4; ++b) bytes[4 * i + b] = static_cast<char>(pixels[i] >> (8 * b) & 0xffu);
  }
}

}  // namespace

void check_ffmpeg() {
  if (!find_program().empty()) return;
  throw std::runtime_error(
      "an .mp4 needs the program ffmpeg, which is not on the PATH: install Debian's package ffmpeg");
}

void write_mp4(const Trajectory& trajectory, const std::filesystem::path& path, int width, int height, double speed) {
  check_ffmpeg();
  Animation animation(trajectory, width, height, speed, k_max_mp4_frames);
  const std::string rate = tumble::format("{}", std::lround(1.0 / k_frame_time));
  // "file:" keeps ffmpeg from reading a name such as "pipe:1" or "-y" as something else.
  Encoder encoder({"-nostdin",
                   "-hide_banner",
                   "-loglevel",
                   "error",
                   "-y",
                   "-f",
                   "rawvideo",
                   "-pixel_format",
                   "bgr0",
                   "-video_size",
                   tumble::format("{}x{}", width, height),
                   "-framerate",
                   rate,
                   "-i",
                   "pipe:0",
                   "-an",
                   "-c:v",
                   "libx264",
                   "-preset",
                   "medium",
                   "-crf",
                   "18",
                   "-tune",
                   "animation",
                   "-pix_fmt",
                   "yuv420p",
                   "-fflags",
                   "+bitexact",
                   "-movflags",
                   "+faststart",
                   "-f",
                   "mp4",
                   "file:" + std::filesystem::absolute(path).string()});
  std::string bytes;
  for (int i = 0; i < animation.frames(); ++i) {
    append_bytes(animation.draw(i), bytes);
    encoder.add(bytes);
  }
  const long held = std::lround(k_hold_time / k_frame_time) - 1;
  for (long i = 0; i < held; ++i) encoder.add(bytes);
  encoder.finish();
}

}  // namespace tumble::output
