#include "tumble/trajectory/scene_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "tumble/geometry/detect_contacts.hpp"
#include "tumble/geometry/placed_shape.hpp"
#include "tumble/math/format.hpp"
#include "tumble/trajectory/simulate.hpp"

namespace tumble {
namespace {

using Kind = SceneWarning::Kind;

constexpr double k_round_off = 1e-10;  // of a gap, in sizes of the bodies: what gaps of ellipses are exact to
constexpr double k_most_way = 0.5;     // in one step, in sizes of the body
constexpr double k_most_turn = 0.5;    // [rad]
constexpr double k_touch = 0.01;       // of its extent: how far a body must be above what carries it
constexpr double k_good_share = 0.2;   // of these by a step size that fits

Box box_of(const Shape& shape, const Frame& frame) {
  PlacedShape placed = placed_shape(shape);
  place(placed, frame);
  return bounding_box(placed, 0.0);
}

Box box_of(const Body& body, const Frame& frame) {
  Box box = box_of(body.parts[0].shape, frame);
  for (const Part& part : body.parts) box = united(box, box_of(part.shape, frame));
  return box;
}

double size_of(const Body& body) {
  const Box box = box_of(body, {});
  return 0.5 * length(box.high - box.low);
}

// ---- Overlaps ----

void warn_of_overlaps(const Scene& scene, std::vector<SceneWarning>& warnings) {
  std::vector<Pose> poses;
  for (const Body& body : scene.bodies) poses.push_back(body.pose);
  ContactFinder finder(scene);
  for (const Contact& contact : finder.find(poses, std::vector<double>(scene.bodies.size(), 0.0))) {
    if (contact.gap >= 0.0) continue;
    double size = std::max(std::abs(contact.point_a.x), std::abs(contact.point_a.y));
    for (const int index : {contact.body_a, contact.body_b}) {
      const double body_size = size_of(scene.bodies[static_cast<std::size_t>(index)]);
      if (std::isfinite(body_size)) size = std::max(size, body_size);
    }
    if (contact.gap >= -k_round_off * size) continue;
    // Contacts come pair by pair; one warning for each, of the deepest.
    const bool is_new = warnings.empty() || warnings.back().kind != Kind::overlap ||
                        warnings.back().body != contact.body_a || warnings.back().other != contact.body_b;
    if (is_new) warnings.push_back({Kind::overlap, contact.body_a, contact.body_b, 0.0, 0.0});
    warnings.back().value = std::max(warnings.back().value, -contact.gap);
  }
}

// ---- Support ----

// A union of intervals of the line.
class Intervals {
 public:
  bool meets(double low, double high) const {
    auto next = ends_.upper_bound(high);  // the first that begins behind `high`
    return next != ends_.begin() && std::prev(next)->second >= low;
  }

  void add(double low, double high) {
    for (auto at = ends_.upper_bound(high); at != ends_.begin() && std::prev(at)->second >= low;) {
      at = std::prev(at);
      low = std::min(low, at->first);
      high = std::max(high, at->second);
      at = ends_.erase(at);
    }
    ends_[low] = high;
  }

 private:
  std::map<double, double> ends_;  // low to high, apart from each other
};

// The frame of a body in a world that is turned until gravity points down.
Frame turned_down(const Frame& frame, Vector2 gravity) {
  const double g = length(gravity);
  const Frame turn = {{}, -gravity.x / g, -gravity.y / g};
  return {direction_to_world(turn, frame.position), turn.sin * frame.cos + turn.cos * frame.sin,
          turn.cos * frame.cos - turn.sin * frame.sin};
}

// What may carry, and what must be carried.
struct Item {
  Box box;
  int body;
  bool is_dynamic;

  // In this order all that may carry a body comes before it: what begins below its top.
  double height() const { return is_dynamic ? box.high.y - k_touch * (box.high.y - box.low.y) : box.low.y; }
};

void warn_of_missing_support(const Scene& scene, std::vector<SceneWarning>& warnings) {
  if (scene.gravity == Vector2{}) return;
  std::vector<Item> items;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const Frame frame = turned_down(frame_of(body.pose), scene.gravity);
    const auto index = static_cast<int>(i);
    if (body.kind == BodyKind::dynamic) {
      items.push_back({box_of(body, frame), index, true});
      continue;
    }
    for (const Part& part : body.parts) {
      const auto* plane = std::get_if<HalfPlane>(&part.shape);
      if (plane == nullptr) {
        items.push_back({box_of(part.shape, frame), index, false});
      } else if (direction_to_world(frame, plane->normal).y > k_round_off) {
        return;  // whatever falls falls on it
      }
    }
  }
  std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.height() < b.height(); });
  Intervals support;
  std::vector<int> unsupported;
  for (const auto& [box, body, is_dynamic] : items) {
    const double edge = k_touch * (box.high.x - box.low.x);
    if (!is_dynamic || support.meets(box.low.x + edge, box.high.x - edge)) {
      support.add(box.low.x, box.high.x);
    } else {
      unsupported.push_back(body);
    }
  }
  std::sort(unsupported.begin(), unsupported.end());
  for (const int body : unsupported) warnings.push_back({Kind::no_support, body, -1, 0.0, 0.0});
}

// ---- Speed ----

// The fastest speed and angular velocity known before a simulation.
std::pair<double, double> fastest(const Body& body) {
  double speed = length(Vector2{body.velocity[0], body.velocity[1]}), turn = std::abs(body.velocity[2]);
  if (!body.motion.empty()) speed = turn = 0.0;
  for (std::size_t k = 1; k < body.motion.size(); ++k) {
    const Knot& from = body.motion[k - 1];
    const Knot& to = body.motion[k];
    const double time = to.time - from.time;
    speed = std::max(speed, length(to.pose.position - from.pose.position) / time);
    turn = std::max(turn, std::abs(to.pose.angle - from.pose.angle) / time);
  }
  return {speed, turn};
}

void warn_of_speed(const Scene& scene, std::vector<SceneWarning>& warnings) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.kind == BodyKind::fixed) continue;
    const auto [speed, turn] = fastest(body);
    const double way = speed / size_of(body);  // per second, in sizes
    const double share = scene.step_size * std::max(way / k_most_way, turn / k_most_turn);
    if (!(share > 1.0)) continue;
    warnings.push_back({Kind::fast, static_cast<int>(i), -1, share, k_good_share * scene.step_size / share});
  }
}

}  // namespace

std::string_view to_string(SceneWarning::Kind kind) {
  switch (kind) {
    case Kind::overlap: return "overlap";
    case Kind::no_support: return "no_support";
    case Kind::fast: return "fast";
    case Kind::long_run: break;
  }
  return "long_run";
}

std::vector<SceneWarning> scene_warnings(const Scene& scene) {
  validate(scene);
  std::vector<SceneWarning> warnings;
  warn_of_overlaps(scene, warnings);
  warn_of_missing_support(scene, warnings);
  warn_of_speed(scene, warnings);
  const double steps = scene.duration / scene.step_size;
  if (steps > k_max_steps) warnings.push_back({Kind::long_run, -1, -1, steps, 0.0});
  return warnings;
}

std::string to_text(const SceneWarning& warning, const Scene& scene, const std::vector<std::string>& labels) {
  const auto label = [&](int body) { return labels[static_cast<std::size_t>(body)]; };
  switch (warning.kind) {
    case Kind::overlap:
      return tumble::format("{} and {} overlap by {:.3g} m at the start; they will be pushed apart",
                            label(warning.body), label(warning.other), warning.value);
    case Kind::no_support: return tumble::format("nothing is below {}: it falls for ever", label(warning.body));
    case Kind::fast:
      return tumble::format("{} goes far in one step of {} s; step_size = {:.1g} would follow it better",
                            label(warning.body), scene.step_size, warning.step_size);
    case Kind::long_run: break;
  }
  return tumble::format("the duration of {} s takes {:.4g} steps of {} s; at most {:g} are made", scene.duration,
                        warning.value, scene.step_size, k_max_steps);
}

}  // namespace tumble
