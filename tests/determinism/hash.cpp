// Prints 64-bit hashes over the bits of reference runs: equal on every compiler, optimisation level and instruction
// set.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <span>
#include <sstream>
#include <string>

#include "../random_contact.hpp"
#include "problems.hpp"

#include "tumble/batch/reference_run.hpp"
#include "tumble/drop/drop.hpp"
#include "tumble/lcp/lemke.hpp"
#include "tumble/lcp/lemke_lu.hpp"
#include "tumble/lcp/one_contact_lanes.hpp"
#include "tumble/lcp/robust.hpp"
#include "tumble/math/bit_hash.hpp"
#include "tumble/math/distributions.hpp"
#include "tumble/scene/scene_toml.hpp"
#include "tumble/trajectory/simulate.hpp"

namespace {

using tumble::test::Random;

using Hash = tumble::BitHash;

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

// Batches of drops, by every instruction set that this processor has.
std::uint64_t hash_of_batches() {
  std::uint64_t common = tumble::batch::reference_hash(tumble::InstructionSet::scalar);
  for (const tumble::InstructionSet set : tumble::instruction_sets()) {
    if (tumble::batch::reference_hash(set) != common) return 0;
  }
  return common;
}

// 10000 draws of each distribution, from the tails too.
std::uint64_t hash_of_draws() {
  Hash hash;
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const std::uint64_t word = tumble::draw_word(7, i, i % 5);
    hash.add(std::array{tumble::uniform(word, -1.0, 3.0), tumble::normal(word, 0.5, 2.0),
                        tumble::log_uniform(word, 1e-9, 1e12), tumble::normal(i, 0.0, 1.0)});
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

// The default solver on contact problems, n = 4 .. 64, and on the next steps of resting towers from the last basis;
// then Lemke's method with sparse factors, n = 240.
std::uint64_t hash_of_robust() {
  namespace problems = tumble::problems;
  Hash hash;
  for (const problems::Family& family : problems::families()) {
    for (std::uint64_t i = 0; i < 64; ++i) {
      Random random = problems::random_of(3, i);
      hash.add(robust(as_lcp(family.make(random, 1 + i % 16))).z);
    }
  }
  Random random(4);
  for (std::size_t i = 0; i < 16; ++i) {
    const tumble::ContactSystem tower = problems::resting_tower(random, 1 + i);
    const tumble::LcpResult first = robust(as_lcp(tower));
    hash.add(robust(as_lcp(problems::next_step(tower, first.z, random)), {.start_basis = first.basis}).z);
  }
  const tumble::LcpProblem pile = as_lcp(problems::pile(random, 60));
  hash.add(robust(pile).z);
  hash.add(lemke_lu(pile).z);
  return hash.value();
}

// 6400 contacts side by side, by every instruction set that this processor has: all give this hash.
std::uint64_t hash_of_contacts() {
  constexpr std::size_t count = 6400;
  Random random(5);
  std::vector<double> in[6];
  for (std::size_t i = 0; i < count; ++i) {
    const tumble::OneContact c = tumble::test::random_contact(random, i % 4 == 0 ? 5.0 : 1.0);
    const double numbers[6] = {c.A_nn, c.A_nt, c.A_tt, c.b_n, c.b_t, c.friction};
    for (std::size_t k = 0; k < 6; ++k) in[k].push_back(numbers[k]);
  }
  const tumble::OneContactArrays contacts{in[0], in[1], in[2], in[3], in[4], in[5]};
  std::uint64_t common = 0;
  for (const auto set :
       {tumble::InstructionSet::baseline, tumble::InstructionSet::avx2, tumble::InstructionSet::avx512}) {
    if (!tumble::has_instruction_set(set)) continue;
    std::vector<double> out[4];
    for (std::vector<double>& numbers : out) numbers.resize(count);
    const tumble::OneContactSolutionArrays solutions{out[0], out[1], out[2], out[3], {}, {}};
    Hash hash;
    for (std::size_t first = 0; first < count; first += 64) {
      std::array<std::uint8_t, 64> is_done{};
      tumble::one_contact::block_solver(set)(contacts, solutions, first, is_done.data());
      for (const std::uint8_t byte : is_done) hash.add(std::array<double, 1>{static_cast<double>(byte)});
    }
    for (const std::vector<double>& numbers : out) hash.add(numbers);
    if (set == tumble::InstructionSet::baseline) common = hash.value();
    if (hash.value() != common) return 0;
  }
  return common;
}

// 1000 steps of scenes with all shapes and kinds of contact: states, impulses and energies.
std::uint64_t hash_of_scenes() {
  Hash hash;
  for (const char* name :
       {"drop", "billiard", "bouncing_balls", "capsule_and_rounded", "compound", "conveyor", "dominoes", "ellipse_drop",
        "funnel", "galton_board", "pusher", "pyramid", "stack_heavy_top", "terrain", "wedge"}) {
    std::ifstream file(std::string(TUMBLE_SOURCE "/scenes/") + name + ".toml", std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    const tumble::Scene scene = tumble::parse_scene(text.str(), name);
    tumble::Simulation simulation(scene, {.duration = 1000.0 * scene.step_size, .keeps_contacts = false});
    while (!simulation.is_done()) {
      simulation.advance();
      for (const tumble::BodyState& body : simulation.state().bodies) {
        hash.add(std::array{body.pose.position.x, body.pose.position.y, body.pose.angle});
        hash.add(body.velocity);
      }
      for (const tumble::ContactRecord& contact : simulation.report().contacts) {
        hash.add(std::array{contact.contact.gap, contact.normal_impulse, contact.friction_impulse});
      }
      const tumble::EnergyLedger& energy = simulation.report().energy;
      hash.add(std::array{energy.kinetic, energy.potential, energy.friction_loss, energy.impact_loss});
    }
  }
  return hash.value();
}

}  // namespace

int main() {
  std::printf("drops %016llx\n", static_cast<unsigned long long>(hash_of_drops()));
  std::printf("batches %016llx\n", static_cast<unsigned long long>(hash_of_batches()));
  std::printf("draws %016llx\n", static_cast<unsigned long long>(hash_of_draws()));
  std::printf("lcps %016llx\n", static_cast<unsigned long long>(hash_of_lcps()));
  std::printf("robust %016llx\n", static_cast<unsigned long long>(hash_of_robust()));
  std::printf("contacts %016llx\n", static_cast<unsigned long long>(hash_of_contacts()));
  std::printf("scenes %016llx\n", static_cast<unsigned long long>(hash_of_scenes()));
}
