#include "measure.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <limits>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tumble/lcp/residual.hpp"

namespace tumble::bench {
namespace {

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Seconds of one run: the fastest mean of three loops, each long enough for the clock. A run that takes longer than
// 50 ms is not repeated.
double seconds_per_run(const std::function<void()>& run) {
  constexpr double loop = 20e-6, too_long = 50e-3;
  const double first_start = seconds_now();
  run();
  double best = seconds_now() - first_start;
  if (best > too_long) return best;
  for (int i = 0; i < 3; ++i) {
    const int count = static_cast<int>(std::clamp(loop / best, 1.0, 1000.0));
    const double start = seconds_now();
    for (int k = 0; k < count; ++k) run();
    best = std::min(best, (seconds_now() - start) / count);
  }
  return best;
}

Verdict judge(const Case& c, const Answer& answer, double residual) {
  if (c.has_no_solution) return answer.is_solved ? Verdict::wrong : Verdict::good;
  if (!answer.is_solved) return Verdict::said_no;
  return residual <= k_good_residual ? Verdict::good : Verdict::wrong;
}

// What the child tells: first that it begins a pair, then the result.
struct Message {
  bool is_result = false;
  bool is_skipped = false;
  Measurement measurement;
};

void send(int pipe, const Message& message) {
  if (write(pipe, &message, sizeof message) != sizeof message) _exit(1);  // shorter than PIPE_BUF: whole or not at all
}

struct Pairs {
  const std::vector<Case>& cases;
  const std::vector<Solver>& solvers;
  std::size_t count() const { return cases.size() * solvers.size(); }
};

// The child: all pairs from `first` on. noexcept: a solver that throws ends the child here, and nothing of the caller
// runs a second time.
[[noreturn]] void run_pairs(const Pairs& pairs, std::size_t first, int pipe) noexcept {
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  for (std::size_t pair = first; pair < pairs.count(); ++pair) {
    Message message;
    Measurement& m = message.measurement;
    m.case_index = pair / pairs.solvers.size();
    m.solver_index = pair % pairs.solvers.size();
    const Case& c = pairs.cases[m.case_index];
    send(pipe, message);
    const std::optional<Attempt> attempt = pairs.solvers[m.solver_index].prepare(c);
    message.is_result = true;
    message.is_skipped = !attempt;
    if (attempt) {
      m.seconds = seconds_per_run(attempt->run);
      const Answer answer = attempt->answer();
      const bool has_z = answer.z.size() == c.problem.size();
      m.residual = has_z ? residual(c.problem, answer.z).largest() : std::numeric_limits<double>::infinity();
      m.pivots = answer.pivots;
      m.verdict = judge(c, answer, m.residual);
    }
    send(pipe, message);
  }
  _exit(0);
}

// Waits for one message; nothing if the child is gone or silent for too long.
std::optional<Message> receive(int pipe, double time_limit, bool& is_timed_out) {
  pollfd waiting{pipe, POLLIN, 0};
  int ready = 0;
  do ready = poll(&waiting, 1, static_cast<int>(1000.0 * time_limit));
  while (ready < 0 && errno == EINTR);
  is_timed_out = ready == 0;
  if (ready <= 0) return std::nullopt;
  Message message;
  if (read(pipe, &message, sizeof message) != sizeof message) return std::nullopt;
  return message;
}

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::good: return "good";
    case Verdict::said_no: return "said no";
    case Verdict::wrong: return "wrong";
    case Verdict::crashed: return "crashed";
    case Verdict::timed_out: return "timed out";
  }
  return "";
}

std::vector<Measurement> measure(const std::vector<Case>& cases, const std::vector<Solver>& solvers, double time_limit,
                                 const std::function<void(std::size_t)>& progress) {
  const Pairs pairs{cases, solvers};
  std::vector<Measurement> measurements;
  std::size_t next = 0;
  while (next < pairs.count()) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("cannot make a pipe");
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot start a process");
    if (child == 0) {
      close(ends[0]);
      run_pairs(pairs, next, ends[1]);
    }
    close(ends[1]);
    Measurement current;
    bool is_timed_out = false;
    while (next < pairs.count()) {
      const std::optional<Message> message = receive(ends[0], time_limit, is_timed_out);
      if (!message) break;
      current = message->measurement;
      if (!message->is_result) continue;
      if (!message->is_skipped) measurements.push_back(current);
      if (++next % solvers.size() == 0) progress(next / solvers.size());
    }
    close(ends[0]);
    if (next < pairs.count()) {
      kill(child, SIGKILL);
      current.case_index = next / solvers.size();
      current.solver_index = next % solvers.size();
      current.verdict = is_timed_out ? Verdict::timed_out : Verdict::crashed;
      current.seconds = time_limit;
      measurements.push_back(current);
      ++next;
    }
    waitpid(child, nullptr, 0);
  }
  return measurements;
}

}  // namespace tumble::bench
