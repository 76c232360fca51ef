#include <cstdio>

#include <tumble/tumble.hpp>

int main() {
  const auto trajectory = tumble::drop::simulate({0.0, 1.5, 0.5235987755982988}, {0.0, -0.2, 0.0});
  const auto q = trajectory.q_at(149);
  std::printf("%.17g %.17g %.17g\n", q[0], q[1], q[2]);
}
