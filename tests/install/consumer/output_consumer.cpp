#include <tumble/output/write.hpp>
#include <tumble/tumble.hpp>

// Writes the course's start to the files named on the command line.
int main(int argc, char** argv) {
  const auto record = tumble::drop::simulate_with_record({0.0, 1.5, 0.5235987755982988}, {0.0, -0.2, 0.0});
  for (int i = 1; i < argc; ++i) tumble::output::write_record(record, argv[i], {});
}
