// libFuzzer: any two tables (with a zero between them) are a run of a scene or are refused with one line of
// std::invalid_argument; a run reads back from its own tables.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tumble/output/trajectory_csv.hpp"
#include "tumble/scene/scene_toml.hpp"

namespace {

using tumble::Trajectory;

struct Tables {
  std::string samples, contacts;
};

Tables tables_of(const Trajectory& run) {
  using namespace tumble::output;
  return {samples_csv_header(run) + samples_csv_rows(run, 0, run.time.size()),
          contacts_csv_header(run) + contacts_csv_rows(run, 0, run.contacts.size())};
}

// The bodies of tests/output/data/two_balls.toml, whose tables are the seed.
const tumble::Scene& scene() {
  static const tumble::Scene scene = tumble::parse_scene(R"(
    tumble = 1
    title = "Two balls"
    bodies = [
      { name = "floor", kind = "fixed", shape = { half_plane = [0, 1] } },
      { name = 'a "ball", red', shape = { disc = 0.25 }, mass = 1, position = [0, 0.25] },
      { name = "table", kind = "kinematic", parts = [{ shape = { disc = 1 } }, { shape = { disc = 2 } }] },
    ])");
  return scene;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t end = text.find('\0');
  const std::string_view contacts = end == std::string_view::npos ? "" : text.substr(end + 1);
  Trajectory run;
  try {
    run = tumble::output::parse_trajectory_csv(scene(), text.substr(0, end), "fuzz.csv", contacts, "fuzz.contacts.csv");
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    if (message.rfind("fuzz.", 0) != 0) std::abort();
    for (const char c : message) {
      if (c >= 0 && c < 32) std::abort();
    }
    return 0;
  }
  const Tables written = tables_of(run);
  const Trajectory again = tumble::output::parse_trajectory_csv(scene(), written.samples, "again.csv", written.contacts,
                                                                "again.contacts.csv");
  const Tables twice = tables_of(again);
  if (twice.samples != written.samples || twice.contacts != written.contacts) std::abort();
  return 0;
}
