#include "allocations.hpp"

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define TUMBLE_HAS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TUMBLE_HAS_SANITIZER
#endif

namespace {
std::atomic<long> count{0};
}

long tumble::test::num_allocations() { return count; }

#if !defined(__GLIBC__) || defined(TUMBLE_HAS_SANITIZER)

bool tumble::test::counts_allocations() { return false; }

#else

bool tumble::test::counts_allocations() { return true; }

// The program's own functions of these names stand before those of glibc, in its libraries too. Memory comes from glibc
// all the same, under its second names, so that its `free` fits.
extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t num, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) noexcept {
  ++count;
  return __libc_malloc(size);
}

void* calloc(std::size_t num, std::size_t size) noexcept {
  ++count;
  return __libc_calloc(num, size);
}

void* realloc(void* memory, std::size_t size) noexcept {
  ++count;
  return __libc_realloc(memory, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++count;
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  ++count;
  if (alignment % sizeof(void*) != 0 || (alignment & (alignment - 1)) != 0 || alignment == 0) return EINVAL;
  void* aligned = __libc_memalign(alignment, size);
  if (aligned == nullptr) return ENOMEM;
  *memory = aligned;
  return 0;
}

}  // extern "C"

#endif
