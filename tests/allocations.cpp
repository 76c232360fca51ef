#include "allocations.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

// In a file of their own: where g++ inlines one of a pair of these it takes them for mismatched.

namespace {
std::atomic<long> count{0};
}

long tumble::test::num_allocations() { return count; }

void* operator new(std::size_t size) {
  ++count;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++count;
  return std::malloc(size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
