// Counts what the test program takes from the heap.
#pragma once

namespace tumble::test {

// False under sanitizers, which have a malloc of their own, and without glibc.
bool counts_allocations();

// Calls of malloc, calloc, realloc and their aligned kin since the program began, those of operator new included.
long num_allocations();

}  // namespace tumble::test
