// Pictures of a sweep.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tumble/sweep/panels.hpp"
#include "tumble/sweep/summary.hpp"

namespace tumble::sweep {

struct PlotSettings {
  // "overview"; "faces" (shares of outcomes); the name of a measure (its histogram); "map" (the most frequent face over
  // the swept quantities); "map NAME" (the mean of a measure over them); "fan".
  std::string kind = "overview";
  int width = 0;   // [px]; 0: chosen, in the shape of the usual one if the other is given
  int height = 0;  // [px]
};

// What pictures show. Without `fan` there is no picture of it, and the overview has another in its place.
struct PlotSource {
  const Statistics& statistics;
  const Summary& summary;
  const Fan* fan = nullptr;
};

// Throws std::invalid_argument for an unknown kind, naming those there are, and for sizes out of range.
std::string to_plot_png(const PlotSource& source, const PlotSettings& settings);
std::string to_plot_svg(const PlotSource& source, const PlotSettings& settings);

// By the ending of the name, .png or .svg; all or nothing. Throws as the above and as output::write_file_atomically.
void write_plot(const PlotSource& source, const std::filesystem::path& path, const PlotSettings& settings,
                bool overwrite);

// True if it needs PlotSource::fan, or shows it if it is there.
bool shows_fan(const PlotSettings& settings);

}  // namespace tumble::sweep
