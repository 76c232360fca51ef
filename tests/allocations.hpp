// Counts what the test program takes from the heap.
#pragma once

namespace tumble::test {

// Calls of operator new since the program began.
long num_allocations();

}  // namespace tumble::test
