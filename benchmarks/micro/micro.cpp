// Times of single calls. Run by benchmarks/run.py, or alone: build/benchmarks/micro/tumble_micro.
#include <array>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include "tumble/tumble.hpp"

namespace {

using namespace tumble;

const Vector3 k_course_q0 = {0.0, 1.5, 0.5235987755982988};
const Vector3 k_course_v0 = {0.0, -0.2, 0.0};

// A contact of the document's square, approaching at 1.2 m/s; the slip decides the mode.
constexpr OneContact contact_with_slip(double slip) { return {0.083, -0.03, 0.06, -1.2, slip, 0.3}; }

void one_contact(benchmark::State& state, OneContact contact) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(contact);
    OneContactSolution solution = solve_one_contact(contact);
    benchmark::DoNotOptimize(solution);
  }
}
BENCHMARK_CAPTURE(one_contact, stick, contact_with_slip(0.5));
BENCHMARK_CAPTURE(one_contact, slip, contact_with_slip(3.0));
BENCHMARK_CAPTURE(one_contact, open, OneContact{0.083, -0.03, 0.06, 0.2, 0.5, 0.3});

// The time of one contact among many side by side; every other one sticks. Arrays begin `offset` doubles after a
// multiple of 64 bytes: what std::vector gives is two off, and registers of 64 bytes then cross lines of the cache.
void one_contacts(benchmark::State& state, std::size_t offset) {
  constexpr std::size_t count = 1024, num_arrays = 10;
  alignas(64) static std::array<double, num_arrays*(count + 8)> memory;
  std::array<std::span<double>, num_arrays> arrays;
  for (std::size_t k = 0; k < num_arrays; ++k) arrays[k] = {memory.data() + k * (count + 8) + offset, count};
  const auto& [A_nn, A_nt, A_tt, b_n, b_t, friction, f_n, f_t, slip_speed, residual] = arrays;
  for (std::size_t i = 0; i < count; ++i) {
    const OneContact contact = contact_with_slip(i % 2 == 0 ? 0.5 : 3.0);
    A_nn[i] = contact.A_nn, A_nt[i] = contact.A_nt, A_tt[i] = contact.A_tt;
    b_n[i] = contact.b_n, b_t[i] = contact.b_t, friction[i] = contact.friction;
  }
  std::vector<ContactMode> mode(count);
  std::vector<LcpStatus> status(count);
  while (state.KeepRunningBatch(count)) {
    solve_one_contacts({A_nn, A_nt, A_tt, b_n, b_t, friction}, {f_n, f_t, slip_speed, residual, mode, status});
    benchmark::ClobberMemory();
  }
}
BENCHMARK_CAPTURE(one_contacts, aligned, 0)->Name("one_contact/side by side");
BENCHMARK_CAPTURE(one_contacts, unaligned, 2)->Name("one_contact/side by side, not aligned");

template <class Settings>
void general_solver(benchmark::State& state) {
  LcpProblem problem = as_lcp(contact_with_slip(3.0));
  for (auto _ : state) {
    LcpResult result = solve_lcp(problem, Settings{});
    benchmark::DoNotOptimize(result);
  }
}
BENCHMARK(general_solver<LemkeSettings>)->Name("lemke, one contact");
BENCHMARK(general_solver<EnumerateSettings>)->Name("enumerate, one contact");

void step(benchmark::State& state, Vector3 q, Vector3 v) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(q);
    drop::State next = drop::step(q, v);
    benchmark::DoNotOptimize(next);
  }
}
BENCHMARK_CAPTURE(step, free, k_course_q0, k_course_v0);
BENCHMARK_CAPTURE(step, contact, Vector3{0.0, 0.09, 0.5}, Vector3{0.1, -2.0, 3.0});

void simulate_course_start(benchmark::State& state) {
  for (auto _ : state) {
    drop::Trajectory trajectory = drop::simulate(k_course_q0, k_course_v0);
    benchmark::DoNotOptimize(trajectory.q.data());
  }
}
BENCHMARK(simulate_course_start);

void record_course_start(benchmark::State& state) {
  for (auto _ : state) {
    drop::Record record = drop::simulate_with_record(k_course_q0, k_course_v0);
    benchmark::DoNotOptimize(record.steps.data());
  }
}
BENCHMARK(record_course_start);

void sine_and_cosine(benchmark::State& state) {
  double angle = 0.5;
  for (auto _ : state) {
    benchmark::DoNotOptimize(angle);
    SinCos result = sin_cos(angle);
    benchmark::DoNotOptimize(result);
  }
}
BENCHMARK(sine_and_cosine);

}  // namespace
