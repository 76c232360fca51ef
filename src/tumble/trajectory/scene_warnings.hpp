// What in a scene is allowed and yet probably not meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tumble/scene/scene.hpp"

namespace tumble {

struct SceneWarning {
  enum class Kind {
    overlap,     // two bodies overlap at the start, by more than round-off
    no_support,  // nothing is below a body that gravity pulls down
    fast,        // a body moves or turns far in one step
    long_run,    // more steps than a simulation takes
  };
  Kind kind = Kind::overlap;
  int body = -1;           // index into Scene::bodies; -1: about the scene
  int other = -1;          // overlap: the other one
  double value = 0.0;      // overlap: depth [m]; fast: way in one step over the most that is good; long_run: steps
  double step_size = 0.0;  // fast: one that fits [s]
};

// "overlap", "no_support", "fast", "long_run".
std::string_view to_string(SceneWarning::Kind kind);

// In the order of their kinds, then of bodies. Throws std::invalid_argument as `validate(scene)`.
//   - overlap: of pairs of which at least one is dynamic, by more than 1e-10 of their size;
//   - no_support: neither a fixed or kinematic body nor one that has support lies below any point of the body, at the
//     start. What flies to a place where there is something is warned of, too;
//   - fast: at the start, or between two knots, a body moves by more than half of its size in a step, or turns by more
//     than 0.5 rad. Its size is half the diagonal of its box.
std::vector<SceneWarning> scene_warnings(const Scene& scene);

// One line without an end, that names the bodies by `body_labels`.
std::string to_text(const SceneWarning& warning, const Scene& scene, const std::vector<std::string>& labels);

}  // namespace tumble
