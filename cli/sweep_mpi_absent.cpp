// Stands in for sweep_mpi.cpp where TUMBLE_MPI is off.
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "sweep_mpi.hpp"

namespace tumble::cli {

Processes::Processes() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (size == nullptr || std::string(size) == "1") return;
  throw std::runtime_error("this build has no MPI: build with -DTUMBLE_MPI=ON, or give each process its --shard");
}

Processes::~Processes() = default;

void Processes::help(const std::function<sweep::Folder()>&) {}

sweep::RunReport Processes::lead(const sweep::Folder& folder, const sweep::RunSettings& settings) {
  return sweep::run_sweep(folder, settings);
}

void Processes::abort(int exit_code) { std::exit(exit_code); }

}  // namespace tumble::cli
