#include "results_table.hpp"

#include <algorithm>
#include <cmath>

#include "../lcp/median.hpp"

#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"

namespace tumble::bench {
namespace {

std::string time_text(double seconds) {
  if (seconds < 1e-6) return tumble::format("{:.0f} ns", 1e9 * seconds);
  if (seconds < 1e-3) return tumble::format("{:.3g} us", 1e6 * seconds);
  return tumble::format("{:.3g} ms", 1e3 * seconds);
}

std::string length_text(double metres) {
  if (metres == 0.0) return "0";
  if (metres < 1e-6) return tumble::format("{:.0e} m", metres);
  if (metres < 1e-4) return tumble::format("{:.2g} um", 1e6 * metres);
  if (metres < 0.1) return tumble::format("{:.2g} mm", 1e3 * metres);
  if (metres < 1.0) return tumble::format("{:.0f} mm", 1e3 * metres);
  return tumble::format("{:.2g} m", metres);
}

double ratio_of_times(const Measurement& m, const Measurement& reference) {
  std::vector<double> ratios;
  for (std::size_t round = 0; round < m.seconds_per_step.size(); ++round) {
    ratios.push_back(m.seconds_per_step[round] / reference.seconds_per_step[round]);
  }
  return median(ratios);
}

// What the question of the world asks for.
std::string answer_text(const World& world, const Quality& quality) {
  switch (world.question) {
    case Question::bounce: return quality.flight_error ? "off by " + length_text(*quality.flight_error) : "-";
    case Question::stand:
      return tumble::format("moved {} aside, {} up or down", length_text(quality.drift_x),
                            length_text(quality.drift_y));
    case Question::pile: return tumble::format("{:.0e} J per box", quality.kinetic_energy);
  }
  return "";
}

std::string row(const World& world, const Engine& engine, const Measurement& m, const Measurement& reference) {
  const Quality& q = m.quality;
  const std::string lost = q.num_lost > 0 ? tumble::format(", {} lost", q.num_lost) : "";
  return tumble::format("| {} | {}, {} | {} | {:.3g} | {} | {}{} | {} | {} |\n", world.name, engine.name,
                        engine.settings, time_text(median(m.seconds_per_step)), ratio_of_times(m, reference),
                        q.num_contacts, length_text(q.end_overlap), lost, length_text(q.deepest_overlap),
                        answer_text(world, q));
}

// The exponent of the time per step against the number of bodies, from one pile to the next.
std::string growth(const std::vector<World>& worlds, const std::vector<Engine>& engines,
                   const std::vector<Measurement>& measurements) {
  std::vector<std::size_t> piles;
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    if (worlds[w].question == Question::pile) piles.push_back(w);
  }
  if (piles.size() < 2) return "";
  std::string head = "| engine |", line = "|---|", text;
  for (std::size_t i = 1; i < piles.size(); ++i) {
    head += tumble::format(" {} to {} boxes |", worlds[piles[i - 1]].bodies.size(), worlds[piles[i]].bodies.size());
    line += "---|";
  }
  const auto seconds = [&](std::size_t w, std::size_t e) {
    return median(measurements[w * engines.size() + e].seconds_per_step);
  };
  for (std::size_t e = 0; e < engines.size(); ++e) {
    text += tumble::format("| {}, {} |", engines[e].name, engines[e].settings);
    for (std::size_t i = 1; i < piles.size(); ++i) {
      const double times = seconds(piles[i], e) / seconds(piles[i - 1], e);
      const auto count = [&](std::size_t w) { return static_cast<double>(worlds[w].bodies.size()); };
      text += tumble::format(" n^{:.2f} |", std::log(times) / std::log(count(piles[i]) / count(piles[i - 1])));
    }
    text += "\n";
  }
  return tumble::format("\nHow the time per step grows from pile to pile:\n\n{}\n{}\n{}", head, line, text);
}

}  // namespace

std::string tables(const std::vector<World>& worlds, const std::vector<Engine>& engines,
                   const std::vector<Measurement>& measurements, std::size_t reference) {
  std::string text = tumble::format(
      "| world | engine | time per step | times {} | contacts | overlap at the end | deepest overlap | result |\n"
      "|---|---|---|---|---|---|---|---|\n",
      engines[reference].name);
  for (const Measurement& m : measurements) {
    text += row(worlds[m.world_index], engines[m.engine_index], m,
                measurements[m.world_index * engines.size() + reference]);
  }
  text += "\nHere\n\n";
  for (std::size_t e = 0; e < engines.size(); ++e) {
    if (e > 0 && engines[e].name == engines[e - 1].name) continue;
    text += tumble::format("- {} {}.\n", engines[e].name, engines[e].remark);
  }
  return text + growth(worlds, engines, measurements);
}

std::string csv(const std::vector<World>& worlds, const std::vector<Engine>& engines,
                const std::vector<Measurement>& measurements, double step_size) {
  std::string text =
      "world,bodies,engine,settings,step_size,round,seconds_per_step,contacts,lost,end_overlap,deepest_overlap,"
      "kinetic_energy,drift_x,drift_y,flight_error\n";
  for (const Measurement& m : measurements) {
    const World& world = worlds[m.world_index];
    const Engine& engine = engines[m.engine_index];
    const Quality& q = m.quality;
    for (std::size_t round = 0; round < m.seconds_per_step.size(); ++round) {
      text += tumble::format("\"{}\",{},\"{}\",\"{}\",{},{},{},{},{},{},{},{},{},{},{}\n", world.name,
                             world.bodies.size(), engine.name, engine.settings, to_text(step_size), round,
                             to_text(m.seconds_per_step[round]), q.num_contacts, q.num_lost, to_text(q.end_overlap),
                             to_text(q.deepest_overlap), to_text(q.kinetic_energy), to_text(q.drift_x),
                             to_text(q.drift_y), q.flight_error ? to_text(*q.flight_error) : "");
    }
  }
  return text;
}

}  // namespace tumble::bench
