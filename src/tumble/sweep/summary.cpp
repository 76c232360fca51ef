#include "tumble/sweep/summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tumble/math/format.hpp"

namespace tumble::sweep {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

MeasureSummary summarise(const Measure& measure, const Moments& moments, const Histogram& histogram) {
  const auto at = [&](double p) { return quantile(histogram, p, moments.min, moments.max, measure.is_whole); };
  const bool is_any = moments.count > 0;
  const double deviation =
      moments.count < 2 ? k_nan : std::sqrt(moments.squares / static_cast<double>(moments.count - 1));
  return {measure,
          moments.count,
          moments.missing,
          is_any ? moments.mean : k_nan,
          interval_of_mean(moments.count, moments.mean, moments.squares),
          deviation,
          is_any ? moments.min : k_nan,
          at(0.05),
          at(0.25),
          at(0.5),
          at(0.75),
          at(0.95),
          is_any ? moments.max : k_nan};
}

// 1234567 as "1 234 567".
std::string grouped(std::int64_t count) {
  std::string text = tumble::format("{}", count);
  for (std::ptrdiff_t k = static_cast<std::ptrdiff_t>(text.size()) - 3; k > 0; k -= 3) {
    text.insert(static_cast<std::size_t>(k), 1, ' ');
  }
  return text;
}

// Decimals of a percentage that show two figures of its interval.
int decimals_of(const Interval& share) {
  const double width = 100.0 * (share.high - share.low);
  return width > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(width))), 1, 8) : 1;
}

std::string name_with_unit(const Measure& measure) {
  return measure.unit.empty() ? measure.name : tumble::format("{} [{}]", measure.name, measure.unit);
}

std::string cell(double value) { return std::isnan(value) ? "-" : tumble::format("{:.4g}", value); }

std::string heading(const Summary& summary) {
  std::string text = summary.facts.title.empty() ? "" : summary.facts.title + "\n";
  for (const std::string& line : summary.facts.swept) text += line + "\n";
  text += tumble::format("{} instances, {} solved\n", grouped(summary.instances), grouped(summary.solved));
  if (summary.numerical > 0) {
    text += tumble::format("left out: {} numerical (a step left the range of double arithmetic)\n",
                           grouped(summary.numerical));
  }
  if (summary.invalid > 0) {
    text += tumble::format("left out: {} invalid (a start or a parameter out of range)\n", grouped(summary.invalid));
  }
  return text;
}

std::string table_of_shares(const Summary& summary) {
  std::string text = tumble::format("\n{:<16}{:>16}{:>12}   {}\n", "ends", "instances", "share", "95 % interval");
  for (const Share& share : summary.shares) {
    text += tumble::format("{:<16}{:>16}", name_of(share.outcome), grouped(share.count));
    if (std::isnan(share.share)) {
      text += tumble::format("{:>12}   -\n", "-");
      continue;
    }
    const int decimals = decimals_of(share.interval);
    text += tumble::format("{:>10.{}f} %   {:.{}f} to {:.{}f} %\n", 100.0 * share.share, decimals,
                           100.0 * share.interval.low, decimals, 100.0 * share.interval.high, decimals);
  }
  text += tumble::format("still moving: faster than {:.6g} m/s at the end\n", summary.facts.rest_speed);
  return text;
}

std::string table_of_measures(const Summary& summary) {
  std::string text =
      tumble::format("\n{:<20}{:>16}{:>11}   {:<24}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}\n", "measure", "instances",
                     "mean", "95 % interval", "deviation", "min", "5 %", "median", "95 %", "max");
  for (const MeasureSummary& m : summary.measures) {
    const std::string interval =
        std::isnan(m.interval.low) ? "-" : tumble::format("{:.5g} to {:.5g}", m.interval.low, m.interval.high);
    text += tumble::format("{:<20}{:>16}{:>11}   {:<24}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}\n",
                           name_with_unit(m.measure), grouped(m.count), cell(m.mean), interval, cell(m.deviation),
                           cell(m.min), cell(m.low), cell(m.median), cell(m.high), cell(m.max));
  }
  return text;
}

std::string number(double value, const char* otherwise) {
  return std::isfinite(value) ? tumble::format("{}", value) : otherwise;
}

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += tumble::format("\\{}", c);
    } else if (static_cast<unsigned char>(c) < 0x20) {
      result += tumble::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  result += '"';
  return result;
}

std::string json_of(const Interval& interval) {
  return tumble::format("[{}, {}]", number(interval.low, "null"), number(interval.high, "null"));
}

}  // namespace

const char* name_of(Outcome outcome) {
  static constexpr std::array<const char*, k_num_outcomes> k_names = {"+y up",        "+x up",     "-y up",  "-x up",
                                                                      "still moving", "numerical", "invalid"};
  return k_names[static_cast<std::size_t>(outcome)];
}

Summary summarise(const Statistics& statistics, const Facts& facts) {
  Summary summary{};
  summary.facts = facts;
  const OutcomeCounts& counts = statistics.outcomes();
  for (const std::int64_t count : counts) summary.instances += count;
  summary.numerical = counts[static_cast<std::size_t>(Outcome::numerical)];
  summary.invalid = counts[static_cast<std::size_t>(Outcome::invalid)];
  summary.solved = summary.instances - summary.numerical - summary.invalid;
  for (std::size_t k = 0; k < k_num_landed; ++k) {
    const double share =
        summary.solved == 0 ? k_nan : static_cast<double>(counts[k]) / static_cast<double>(summary.solved);
    summary.shares.push_back({static_cast<Outcome>(k), counts[k], share, interval_of_share(counts[k], summary.solved)});
  }
  const std::vector<Measure>& measures = statistics.layout().measures;
  for (std::size_t m = 0; m < measures.size(); ++m) {
    summary.measures.push_back(summarise(measures[m], statistics.moments(m), statistics.histogram(m)));
  }
  return summary;
}

std::string to_text(const Summary& summary) {
  std::string text = heading(summary) + table_of_shares(summary) + table_of_measures(summary);
  if (!summary.facts.is_drawn) {
    text +=
        "\nNothing was drawn at random: shares and means are those of the grid, and the intervals hold for instances "
        "drawn like it.\n";
  }
  return text;
}

std::string to_csv(const Summary& summary) {
  std::string text = "name,unit,count,of,value,low,high,deviation,min,q05,q25,q50,q75,q95,max\n";
  for (const Share& share : summary.shares) {
    text += tumble::format("{},,{},{},{},{},{},,,,,,,,\n", name_of(share.outcome), share.count, summary.solved,
                           number(share.share, ""), number(share.interval.low, ""), number(share.interval.high, ""));
  }
  for (const Outcome outcome : {Outcome::numerical, Outcome::invalid}) {
    const std::int64_t count = outcome == Outcome::numerical ? summary.numerical : summary.invalid;
    text += tumble::format("{},,{},{},,,,,,,,,,,\n", name_of(outcome), count, summary.instances);
  }
  for (const MeasureSummary& m : summary.measures) {
    text += tumble::format("{},{},{},{}", m.measure.name, m.measure.unit, m.count, m.count + m.missing);
    for (const double value : {m.mean, m.interval.low, m.interval.high, m.deviation, m.min, m.low, m.first_quartile,
                               m.median, m.third_quartile, m.high, m.max}) {
      text += tumble::format(",{}", number(value, ""));
    }
    text += "\n";
  }
  return text;
}

std::string to_json(const Summary& summary) {
  std::string text = tumble::format(
      "{{\n  \"title\": {},\n  \"instances\": {},\n  \"solved\": {},\n  \"numerical\": {},\n"
      "  \"invalid\": {},\n  \"rest_speed\": {},\n  \"drawn\": {},\n  \"outcomes\": [",
      quoted(summary.facts.title), summary.instances, summary.solved, summary.numerical, summary.invalid,
      number(summary.facts.rest_speed, "null"), summary.facts.is_drawn);
  const char* before = "\n";
  for (const Share& share : summary.shares) {
    text += tumble::format("{}    {{\"name\": {}, \"count\": {}, \"share\": {}, \"interval\": {}}}", before,
                           quoted(name_of(share.outcome)), share.count, number(share.share, "null"),
                           json_of(share.interval));
    before = ",\n";
  }
  text += "\n  ],\n  \"measures\": [";
  before = "\n";
  for (const MeasureSummary& m : summary.measures) {
    text += tumble::format(
        "{}    {{\"name\": {}, \"unit\": {}, \"count\": {}, \"missing\": {}, \"mean\": {}, "
        "\"interval\": {}, \"deviation\": {}",
        before, quoted(m.measure.name), quoted(m.measure.unit), m.count, m.missing, number(m.mean, "null"),
        json_of(m.interval), number(m.deviation, "null"));
    const std::array<std::pair<const char*, double>, 7> rest = {{{"min", m.min},
                                                                 {"q05", m.low},
                                                                 {"q25", m.first_quartile},
                                                                 {"q50", m.median},
                                                                 {"q75", m.third_quartile},
                                                                 {"q95", m.high},
                                                                 {"max", m.max}}};
    for (const auto& [name, value] : rest) text += tumble::format(", \"{}\": {}", name, number(value, "null"));
    text += "}";
    before = ",\n";
  }
  return text + (summary.measures.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

}  // namespace tumble::sweep
