#include "tumble/sweep/spec.hpp"

#include <array>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "tumble/sweep/plan.hpp"
#include "tumble/sweep/run.hpp"

namespace {

using namespace tumble::sweep;

const std::string k_head = "sweep = 1\n";

std::string error_of(const std::string& text) {
  try {
    parse_spec(text, "s.toml");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::vector<double> values_of(const Spec& spec, const std::string& name, std::uint64_t first, std::size_t count) {
  for (std::size_t k = 0; k < spec.quantities.size(); ++k) {
    if (spec.quantities[k].name != name) continue;
    std::vector<double> values(count);
    fill_values(spec, k, first, values);
    return values;
  }
  return {};
}

TEST(SweepSpec, ErrorsNameFieldValueRangeAndPlace) {
  const std::array<std::array<std::string, 2>, 23> cases = {{
      {"start.x = 1", "s.toml:1:1: must have the key 'sweep'"},
      {k_head + "start.z = 1", "s.toml:2:7: start.'z': unknown key; did you mean 'x'?"},
      {k_head + "parameters.muu = 1", "s.toml:2:12: parameters.'muu': unknown key; did you mean 'mu'?"},
      {k_head + "sample = 3", "s.toml:2:1: 'sample': unknown key; did you mean 'samples'?"},
      {k_head + "[start]\nx = { unifrom = [0, 1] }",
       "s.toml:3:7: start.x.'unifrom': unknown key; did you mean "
       "'uniform'?"},
      {k_head + "parameters.eps = 1.5", "s.toml:2:18: parameters.eps: must be in [0, 1], got 1.5"},
      {k_head + "parameters.eps = { uniform = [0, 1.5] }",
       "s.toml:2:34: parameters.eps.uniform[1]: must be in [0, 1], got 1.5"},
      {k_head + "parameters.m = -1", "s.toml:2:16: parameters.m: must be in [1e-60, 1e+60] kg, got -1"},
      {k_head + "start.x = { uniform = [2, 1] }", "s.toml:2:23: start.x.uniform: must be [low, high], got [2, 1]"},
      {k_head + "start.x = { uniform = [2] }", "s.toml:2:23: start.x.uniform: must have 2 entries, got 1"},
      {k_head + "start.x = { uniform = [0, 1], list = [1] }",
       "s.toml:2:11: start.x: must be a number or one of range, list, uniform, normal and log_uniform, like { uniform "
       "= [0, 1] }"},
      {k_head + "start.x = { range = [0, 1, 1] }", "s.toml:2:28: start.x.range[2]: must be in [2, 1000000], got 1"},
      {k_head + "start.x = { range = [0, 1, 2.5] }",
       "s.toml:2:28: start.x.range[2]: must be a whole number, got a number"},
      {k_head + "start.x = { list = [] }", "s.toml:2:20: start.x.list: must have 1 to 1000000 entries, got 0"},
      {k_head + "start.x = { normal = [0, -1] }",
       "s.toml:2:26: start.x.normal[1]: a standard deviation must be >= 0, got -1"},
      {k_head + "start.x = { log_uniform = [0, 1] }",
       "s.toml:2:27: start.x.log_uniform: must have a low end > 0, got 0"},
      {k_head + "samples = 5",
       "s.toml:2:11: samples: must be 1 where nothing is drawn (uniform, normal, "
       "log_uniform), as all would be the same; got 5"},
      {k_head + "keep = 'all'", "s.toml:2:8: keep: must be 'columns' or 'statistics', got 'all'"},
      {k_head + "parameters.steps = 0", "s.toml:2:20: parameters.steps: must be in [1, 9999999], got 0"},
      {k_head + "chunk = 1\nsamples = 2000000\nstart.x = { uniform = [0, 1] }",
       "s.toml:2:9: chunk: must be at least 2 for 2000000 instances, got 1: a sweep has at most 1000000 chunks"},
      {k_head + "samples = 100000000000\nstart.x = { uniform = [0, 1] }",
       "s.toml:1:1: chunk: must be at least 100000 for 100000000000 instances, got 65536: a sweep has at most 1000000 "
       "chunks"},
      {k_head + "samples = 10000000000000\nstart.x = { uniform = [0, 1] }\nstart.y = { list = [1, 2] }",
       "s.toml:2:11: samples: must be at most 8388608000000 for 2 cells, as a sweep has at most 16777216000000 "
       "instances; got 10000000000000"},
      {k_head +
           "[start]\nx = { range = [0, 1, 1000000] }\ny = { range = [1, 2, 1000000] }\nvx = { range = [0, 1, 17] }",
       "s.toml:1:1: vx: the axes must have at most 16777216000000 cells, as a sweep has at most so many instances"},
  }};
  for (const auto& [text, error] : cases) EXPECT_EQ(error_of(text), error);
}

TEST(SweepSpec, AnglesMayBeInDegrees) {
  const Spec spec = parse_spec(k_head + "start.theta = { list = [1, '90 deg'] }");
  EXPECT_EQ(axes_of(spec)[0].values, (std::vector<double>{1.0, 1.5707963267948966}));
}

TEST(SweepPlan, TheFirstAxisIsTheSlowest) {
  const Spec spec = parse_spec(k_head +
                               "samples = 2\n[parameters]\nmu = { range = [0, 1, 3] }\n[start]\nx = { list = [5, 7] }\n"
                               "omega = { uniform = [0, 1] }\n");
  EXPECT_EQ(num_instances(spec), 12u);
  ASSERT_EQ(axes_of(spec).size(), 2u);
  EXPECT_EQ(axes_of(spec)[0].name, "mu");
  EXPECT_EQ(values_of(spec, "mu", 0, 12), (std::vector<double>{0, 0, 0, 0, 0.5, 0.5, 0.5, 0.5, 1, 1, 1, 1}));
  EXPECT_EQ(values_of(spec, "x", 0, 12), (std::vector<double>{5, 5, 7, 7, 5, 5, 7, 7, 5, 5, 7, 7}));
  EXPECT_EQ(values_of(spec, "y", 0, 2), (std::vector<double>{1.5, 1.5}));
}

TEST(SweepPlan, AnInstanceIsTheSameWhateverTheSlice) {
  const Spec spec = parse_spec(k_head +
                               "seed = 3\nsamples = 1000\nchunk = 300\n[start]\nx = { normal = [0, 1] }\n"
                               "theta = { uniform = [0, 1] }\n[parameters]\nm = { log_uniform = [1, 2] }\n");
  EXPECT_EQ(num_chunks(spec), 4u);
  EXPECT_EQ(slice_of_chunk(spec, 3).count, 100u);
  for (const char* name : {"x", "theta", "m"}) {
    const std::vector<double> all = values_of(spec, name, 0, 1000);
    EXPECT_EQ(values_of(spec, name, 617, 1)[0], all[617]);
    EXPECT_EQ(values_of(spec, name, 600, 300)[17], all[617]);
  }
}

TEST(SweepPlan, ShardsHaveTheInstancesOfTheirChunks) {
  const Spec spec = parse_spec(k_head + "samples = 1000\nchunk = 300\nstart.x = { uniform = [0, 1] }\n");
  EXPECT_EQ(num_instances(spec, {0, 3}), 400u);  // chunks 0 and 3, the last one, of 100
  EXPECT_EQ(num_instances(spec, {1, 3}), 300u);
  EXPECT_EQ(num_instances(spec, {4, 6}), 0u);
  EXPECT_EQ(num_instances(spec, {}), 1000u);
}

// A draw belongs to its quantity: another quantity that is drawn too does not change it.
TEST(SweepPlan, QuantitiesAreDrawnIndependently) {
  const std::string start = k_head + "samples = 2\nstart.omega = { uniform = [0, 1] }\n";
  EXPECT_EQ(values_of(parse_spec(start), "omega", 0, 2),
            values_of(parse_spec(start + "start.x = { uniform = [0, 1] }"), "omega", 0, 2));
}

TEST(SweepSpec, FingerprintsTellResultsApart) {
  const std::string start = k_head + "samples = 2\nstart.omega = { uniform = [0, 1] }\n";
  const std::uint64_t print = fingerprint(parse_spec(start));
  EXPECT_EQ(fingerprint(parse_spec("# A comment\n" + start + "title = 'T'\nparameters.mu = 0.3\n")), print);
  for (const char* line : {"seed = 1", "chunk = 1", "keep = 'statistics'", "start.x = 1", "parameters.steps = 3",
                           "measures.rest_speed = 1", "measures.region = [0, 1]"}) {
    EXPECT_NE(fingerprint(parse_spec(start + line)), print) << line;
  }
}

}  // namespace
