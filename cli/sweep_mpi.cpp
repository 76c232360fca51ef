#include "sweep_mpi.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <thread>

#include "commands.hpp"
#include <mpi.h>

#include "tumble/sweep/plan.hpp"

namespace tumble::cli {
namespace {

constexpr int k_request = 1;  // from a helper: a chunk, please
constexpr int k_reply = 2;    // its number, or k_none
constexpr std::int64_t k_none = -1;
constexpr std::chrono::milliseconds k_pause{1};  // OpenMPI waits by spinning, which would cost a core

struct Ended {};

// Hands out the numbers of chunks, to threads of this process and to others.
class Queue {
 public:
  explicit Queue(std::vector<std::uint64_t> chunks) : chunks_(std::move(chunks)) {}

  std::int64_t next() {
    const std::size_t k = next_++;
    return k < chunks_.size() ? static_cast<std::int64_t>(chunks_[k]) : k_none;
  }
  void close() { next_ = chunks_.size(); }
  std::size_t num_given() const { return std::min<std::size_t>(next_, chunks_.size()); }

 private:
  std::vector<std::uint64_t> chunks_;
  std::atomic<std::size_t> next_ = 0;
};

}  // namespace

Processes::Processes() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (size == nullptr) return;  // without mpirun: MPI takes 0.4 s to start
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
}

Processes::~Processes() {
  int is_running = 0;
  MPI_Initialized(&is_running);
  if (!is_running) return;
  MPI_Finalize();
}

void Processes::help(const std::function<sweep::Folder()>& open) {
  MPI_Barrier(MPI_COMM_WORLD);
  const sweep::Folder folder = open();
  for (;;) {
    std::int64_t chunk = k_none;
    MPI_Send(nullptr, 0, MPI_BYTE, 0, k_request, MPI_COMM_WORLD);
    MPI_Recv(&chunk, 1, MPI_INT64_T, 0, k_reply, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (chunk == k_none) return;
    sweep::compute_chunk(folder, static_cast<std::uint64_t>(chunk), [] {});
  }
}

sweep::RunReport Processes::lead(const sweep::Folder& folder, const sweep::RunSettings& settings) {
  sweep::RunReport report;
  Queue queue(sweep::find_missing(folder, {settings.shard, settings.threads, {}, {}}, report));
  const std::uint64_t num_instances = sweep::num_instances(folder.spec(), settings.shard);
  MPI_Barrier(MPI_COMM_WORLD);
  std::atomic<bool> is_interrupted = false;
  std::atomic<bool> has_ended = false;
  std::exception_ptr failure;
  std::thread own([&] {
    try {
      for (std::int64_t chunk = queue.next(); chunk != k_none; chunk = queue.next()) {
        sweep::compute_chunk(folder, static_cast<std::uint64_t>(chunk), [&] {
          if (is_interrupted) throw Ended{};
        });
      }
    } catch (const Ended&) {
    } catch (...) {
      failure = std::current_exception();
      queue.close();
    }
    has_ended = true;
  });
  for (int helpers = count_ - 1; helpers > 0 || !has_ended;) {
    if (settings.is_interrupted() && !is_interrupted) {
      is_interrupted = true;
      queue.close();
    }
    MPI_Status status;
    int is_there = 0;
    MPI_Iprobe(MPI_ANY_SOURCE, k_request, MPI_COMM_WORLD, &is_there, &status);
    if (!is_there) {
      // The last chunk may be smaller.
      settings.progress(std::min((report.found + queue.num_given()) * folder.spec().chunk, num_instances));
      std::this_thread::sleep_for(k_pause);
      continue;
    }
    MPI_Recv(nullptr, 0, MPI_BYTE, status.MPI_SOURCE, k_request, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    const std::int64_t chunk = queue.next();
    MPI_Send(&chunk, 1, MPI_INT64_T, status.MPI_SOURCE, k_reply, MPI_COMM_WORLD);
    if (chunk == k_none) --helpers;
  }
  own.join();
  if (failure) std::rethrow_exception(failure);
  report.is_interrupted = is_interrupted;
  return report;
}

void Processes::abort(int exit_code) {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::exit(exit_code);
}

}  // namespace tumble::cli
