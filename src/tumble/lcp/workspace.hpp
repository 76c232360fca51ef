// Memory of the LCP solvers.
#pragma once

#include <memory>

#include "tumble/lcp/result.hpp"

namespace tumble {

// Scratch memory that solvers take from one solve to the next, so that problems of a size met before allocate nothing.
// It carries no state: a result does not depend on what was solved before. One per thread.
class LcpWorkspace {
 public:
  LcpWorkspace();
  ~LcpWorkspace();
  LcpWorkspace(LcpWorkspace&&) noexcept;
  LcpWorkspace& operator=(LcpWorkspace&&) noexcept;

  LcpResult result;  // of the last solve

  struct Buffers;  // private to the solvers: buffers.hpp
  Buffers& buffers() { return *buffers_; }

 private:
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace tumble
