// The charts of a sweep, each drawn into an area of a picture.
#pragma once

#include <string>
#include <vector>

#include "tumble/output/canvas.hpp"
#include "tumble/sweep/summary.hpp"

namespace tumble::sweep {

// A quantity of some instances over time.
struct Fan {
  std::string name;
  std::string unit;
  std::vector<double> time;                // [s]
  std::vector<std::vector<double>> lines;  // of an instance, one value for each time; NaN where there is none
};

// How often each face is up, with 95 % intervals.
void draw_faces(output::Canvas& canvas, const output::Area& area, const Summary& summary);

// How the values of a measure are distributed, with mean, median and the middle 90 %.
void draw_histogram(output::Canvas& canvas, const output::Area& area, const Statistics& statistics,
                    const Summary& summary, std::size_t measure);

// The outcome that is most frequent in each cell, paler where it is rarer or, as instances are drawn at random, unsure.
// With one swept quantity the shares of all, on one another.
void draw_face_map(output::Canvas& canvas, const output::Area& area, const Statistics& statistics, bool is_drawn);

// The mean of a measure in each cell. With one swept quantity a line.
void draw_measure_map(output::Canvas& canvas, const output::Area& area, const Statistics& statistics,
                      std::size_t measure);

// Median, the middle 50 % and 90 % over time, and some single instances.
void draw_fan(output::Canvas& canvas, const output::Area& area, const Fan& fan);

}  // namespace tumble::sweep
