#include "tumble/batch/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tumble/math/format.hpp"

namespace tumble::batch {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto k_watch_every = std::chrono::milliseconds(20);

// What the threads share.
class ChunkQueue {
 public:
  ChunkQueue(std::size_t num_chunks, const std::function<void(std::size_t, std::size_t)>& work)
      : num_chunks_(num_chunks), work_(work) {}

  // Takes one chunk and works on it; false if none is left.
  bool work_on_one(std::size_t worker) {
    const std::size_t chunk = next_.fetch_add(1);
    if (chunk >= num_chunks_) return false;
    try {
      work_(chunk, worker);
      num_done_.fetch_add(1);
    } catch (...) {
      fail(chunk);
    }
    return true;
  }

  // No further chunk is begun.
  void fail(std::size_t chunk) {
    next_.store(num_chunks_);
    const std::lock_guard lock(mutex_);
    if (error_ && chunk >= failed_chunk_) return;
    error_ = std::current_exception();
    failed_chunk_ = chunk;
  }

  std::size_t num_done() const { return num_done_.load(); }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::size_t num_chunks_;
  const std::function<void(std::size_t, std::size_t)>& work_;
  std::atomic<std::size_t> next_ = 0, num_done_ = 0;
  std::mutex mutex_;
  std::exception_ptr error_;
  std::size_t failed_chunk_ = std::numeric_limits<std::size_t>::max();
};

// Calls `watch` when it is due.
class Watch {
 public:
  Watch(ChunkQueue& queue, const std::function<void(std::size_t)>& watch) : queue_(queue), watch_(watch) {}

  void look() {
    if (!watch_ || Clock::now() < due_) return;
    due_ = Clock::now() + k_watch_every;
    try {
      watch_(queue_.num_done());
    } catch (...) {
      queue_.fail(std::numeric_limits<std::size_t>::max());
      is_over_ = true;
    }
    if (is_over_) due_ = Clock::time_point::max();
  }

 private:
  ChunkQueue& queue_;
  const std::function<void(std::size_t)>& watch_;
  Clock::time_point due_ = Clock::now() + k_watch_every;
  bool is_over_ = false;
};

}  // namespace

int num_cores() {
  static const int count = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));  // reads files
  return count;
}

void require_threads(int threads) {
  if (threads < 0 || threads > 1024) {
    throw std::invalid_argument(
        tumble::format("threads: must be in [0, 1024], 0 for one for each core, got {}", threads));
  }
}

void for_each_chunk(std::size_t num_chunks, int threads,
                    const std::function<void(std::size_t chunk, std::size_t worker)>& work,
                    const std::function<void(std::size_t num_done)>& watch) {
  require_threads(threads);
  ChunkQueue queue(num_chunks, work);
  Watch watcher(queue, watch);
  const auto work_and_watch = [&] {
    while (queue.work_on_one(0)) watcher.look();
  };
#ifdef __EMSCRIPTEN__  // has no threads
  work_and_watch();
#else
  const std::size_t wanted = threads == 0 ? static_cast<std::size_t>(num_cores()) : static_cast<std::size_t>(threads);
  const std::size_t num_helpers = std::min(wanted, std::max<std::size_t>(num_chunks, 1)) - 1;
  std::mutex mutex;
  std::condition_variable ended;
  std::size_t num_running = 0;
  std::vector<std::thread> helpers;
  helpers.reserve(num_helpers);
  for (std::size_t worker = 1; worker <= num_helpers; ++worker) {
    {
      const std::lock_guard lock(mutex);
      ++num_running;
    }
    try {
      helpers.emplace_back([&, worker] {
        while (queue.work_on_one(worker)) {
        }
        const std::lock_guard lock(mutex);
        --num_running;
        ended.notify_one();
      });
    } catch (const std::system_error&) {  // no more threads to be had: those there are do the work
      const std::lock_guard lock(mutex);
      --num_running;
      break;
    }
  }
  work_and_watch();
  {
    std::unique_lock lock(mutex);
    while (num_running != 0) {
      ended.wait_for(lock, k_watch_every);
      lock.unlock();
      watcher.look();
      lock.lock();
    }
  }
  for (std::thread& helper : helpers) helper.join();
#endif
  queue.rethrow();
}

}  // namespace tumble::batch
