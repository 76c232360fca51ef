// Work in chunks, shared over the cores. Results belong to chunks, never to threads, so that they do not depend on how
// many threads there were or on which was first.
#pragma once

#include <cstddef>
#include <functional>

namespace tumble::batch {

// As many as the machine has cores.
int num_cores();

// Throws std::invalid_argument: threads must be in [0, 1024], 0 meaning num_cores().
void require_threads(int threads);

// Calls work(chunk, worker) once for each chunk in [0, num_chunks), from `threads` threads (0: one for each core), the
// calling one being worker 0; worker < max(1, threads) tells them apart, for scratch memory. `watch(chunks done)` is
// called from the calling thread alone, about every 20 ms. If `work` or `watch` throws, chunks that were begun are
// finished, no others are begun, and the exception is thrown here once all threads have ended: of several, that of the
// lowest chunk. Nothing else is called after that.
void for_each_chunk(std::size_t num_chunks, int threads,
                    const std::function<void(std::size_t chunk, std::size_t worker)>& work,
                    const std::function<void(std::size_t num_done)>& watch = {});

}  // namespace tumble::batch
