// Prints 64-bit hashes over the bits of reference runs: equal on every compiler, optimisation level and instruction
// set.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>

#include "../random_contact.hpp"

#include "tumble/drop/drop.hpp"
#include "tumble/lcp/lemke.hpp"

namespace {

using tumble::test::Random;

class Hash {  // FNV-1a over 64-bit words
 public:
  void add(std::span<const double> values) {
    for (const double value : values) {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      state_ = (state_ ^ bits) * 0x100000001b3u;
    }
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

// 2000 drops of 300 steps, over all the parameters; angles of many turns included.
std::uint64_t hash_of_drops() {
  Random random(1);
  Hash hash;
  for (int i = 0; i < 2000; ++i) {
    const tumble::drop::Parameters parameters{.l = random.uniform(0.05, 1.0),
                                              .m = random.uniform(0.1, 5.0),
                                              .mu = random.uniform(0.0, 1.5),
                                              .eps = random.uniform(0.0, 1.0),
                                              .dt = random.uniform(0.001, 0.02),
                                              .delta = random.uniform(0.0, 0.002),
                                              .g = random.uniform(1.0, 20.0),
                                              .columns = 301};
    const double turns = i % 10 == 0 ? 1e7 : 10.0;
    // Named one after the other: compilers differ in the order in which they evaluate arguments.
    const tumble::Vector3 q0 = {random.uniform(-1.0, 1.0), random.uniform(0.0, 2.0), random.uniform(-turns, turns)};
    const tumble::Vector3 v0 = {random.uniform(-3.0, 3.0), random.uniform(-3.0, 1.0), random.uniform(-20.0, 20.0)};
    const auto trajectory = tumble::drop::simulate(q0, v0, parameters);
    hash.add(trajectory.q);
    hash.add(trajectory.v);
  }
  return hash.value();
}

// Lemke on 2000 contact LCPs and 200 dense ones.
std::uint64_t hash_of_lcps() {
  Random random(2);
  Hash hash;
  for (int i = 0; i < 2000; ++i) hash.add(lemke(as_lcp(tumble::test::random_contact(random, 1.0))).z);
  for (std::size_t i = 0; i < 200; ++i) {
    const std::size_t n = 2 + i % 30;
    tumble::LcpProblem problem;
    for (std::size_t k = 0; k < n * n; ++k)
      problem.M.push_back(random.uniform(0.0, 1.0) + (k % (n + 1) == 0 ? 2.0 : 0.0));
    for (std::size_t k = 0; k < n; ++k) problem.q.push_back(random.uniform(-1.0, 1.0));
    hash.add(lemke(problem).z);
  }
  return hash.value();
}

}  // namespace

int main() {
  std::printf("drops %016llx\n", static_cast<unsigned long long>(hash_of_drops()));
  std::printf("lcps %016llx\n", static_cast<unsigned long long>(hash_of_lcps()));
}
