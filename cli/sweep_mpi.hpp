// Sweeps whose chunks are handed out to the processes of `mpirun`.
#pragma once

#include <functional>

#include "tumble/sweep/run.hpp"

namespace tumble::cli {

// This process among those that mpirun has started. Throws std::runtime_error if there are several and this build has
// no MPI.
class Processes {
 public:
  Processes();
  ~Processes();
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;

  bool are_many() const { return count_ > 1; }
  bool is_first() const { return rank_ == 0; }

  // The work of all but the first process: computes chunks as long as it is given some. Waits for the first one before,
  // which has then made the folder.
  void help(const std::function<sweep::Folder()>& open);

  // That of the first one: hands the missing chunks out, one at a time, to the others and to a thread of its own.
  sweep::RunReport lead(const sweep::Folder& folder, const sweep::RunSettings& settings);

  // Ends all of them, however far they are.
  [[noreturn]] void abort(int exit_code);

 private:
  int rank_ = 0;
  int count_ = 1;
};

}  // namespace tumble::cli
