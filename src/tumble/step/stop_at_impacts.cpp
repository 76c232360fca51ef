// What keeps bodies apart that the motion found would take through each other: they stop on their way, and go on in the
// next step. See docs/theory/step.md.
#include <algorithm>
#include <cmath>

#include "tumble/step/step_parts.hpp"

namespace tumble {
namespace {

using Index = std::size_t;
using Parts = StepWorkspace::Parts;

constexpr double k_deep = 0.01;        // [-] of the radius of the smaller part
constexpr double k_other_side = 0.25;  // [-] of the same: as deep, parts may come out on the other side of each other
constexpr double k_far_turn = 0.25;    // [rad]: they may do so without having been deep where the step ends
constexpr int k_max_rounds = 20;

// The part of their way that two parts can go before one is deeper inside the other than `depth` [m], and than at the
// start.
double share_before_depth(double h, Parts& parts, const Contact& pair, double depth) {
  constexpr double part = 0.25;  // [rad], and [-] of the radius: of the way between two looks
  constexpr double fewest_looks = 8.0, most_looks = 1000.0;
  double turn = 0.0, way = 0.0;
  for (const int body : {pair.body_a, pair.body_b}) {
    const Vector3& travel = parts.travel[static_cast<Index>(body)];
    turn = std::max(turn, std::abs(travel[2]));
    way += length(Vector2{travel[0], travel[1]});
  }
  const double radius = size_of_pair(parts, pair).radius;
  const double looks = std::clamp(std::ceil(std::max(turn / part, way / (part * radius))), fewest_looks, most_looks);
  set_way_velocity(h, parts, pair);
  const double deepest = std::min(least_gap_at(parts, pair, parts.way_velocity, 0.0), -depth);
  for (double look = 1.0; look <= looks; ++look) {
    if (least_gap_at(parts, pair, parts.way_velocity, look / looks * h) < deepest) return (look - 1.0) / looks;
  }
  return 1.0;
}

bool turns_far(const Parts& parts, const Contact& pair) {
  const auto turns = [&](int body) { return std::abs(parts.travel[static_cast<Index>(body)][2]) > k_far_turn; };
  return turns(pair.body_a) || turns(pair.body_b);
}

void shorten_way(Parts& parts, Index body, double share) {
  if (!(parts.inverse_mass[body][0] > 0.0) || !(share < 1.0)) return;
  for (double& way : parts.travel[body]) way *= share;
  parts.is_stopped[body] = parts.has_stopped = true;
}

void shorten_ways(Parts& parts, const Contact& pair, double share) {
  for (const int body : {pair.body_a, pair.body_b}) shorten_way(parts, static_cast<Index>(body), share);
}

// Bodies that were to touch first where they are held apart, and turn so fast that they run into each other elsewhere.
void stop_fast_turn(double h, Parts& parts, const Contact& pair) {
  const double depth = k_deep * size_of_pair(parts, pair).radius;
  set_way_velocity(h, parts, pair);
  if (turns_far(parts, pair) || least_gap_at(parts, pair, parts.way_velocity, h) < -depth)
    shorten_ways(parts, pair, share_before_depth(h, parts, pair, depth));
}

// Bodies that would come out on the other side of what they touch.
void stop_deep(double h, Parts& parts, const StepContact& c) {
  const Contact& pair = c.contact;
  const double depth = k_other_side * size_of_pair(parts, pair).radius;
  const auto way = [&](int body) {
    return parts.inverse_mass[static_cast<Index>(body)][0] > 0.0 ? way_of(parts, static_cast<Index>(body)) : 0.0;
  };
  if (c.gap_at_start >= -depth && way(pair.body_a) + way(pair.body_b) <= depth) return;
  set_way_velocity(h, parts, pair);
  if (turns_far(parts, pair) || least_gap_at(parts, pair, parts.way_velocity, h) < -depth)
    shorten_ways(parts, pair, share_before_depth(h, parts, pair, depth));
}

// Fast bodies that nothing holds apart. True if one had to stop.
bool stop_where_they_meet(double h, Parts& parts) {
  constexpr double late = 1.0 - 1e-6;  // [-] of the step: they have stopped there
  bool has_stopped = false;
  for (FastPair& pair : parts.fast_pairs) {
    if (has_listed(parts, pair.nearest)) continue;
    set_way_velocity(h, parts, pair.nearest);
    const auto impact = find_impact(h, parts, pair, parts.way_velocity);
    if (!impact) continue;
    shorten_ways(parts, pair.nearest, impact->time / h);
    has_stopped = has_stopped || impact->time < late * h;
  }
  return has_stopped;
}

// Bodies that go on towards one that has stopped. True if one had to stop.
bool stop_followers(double h, Parts& parts) {
  bool has_stopped = false;
  for (const StepContact& c : parts.contacts) {
    bool is_after_stop = false;
    double gap = c.gap_at_start + c.bend + h * c.rows.offset, approach = 0.0;
    for_bodies(c.rows, [&](Index b, const Vector3& normal, const Vector3&) {
      const double way = dot(normal, parts.travel[b]);
      (way < 0.0 ? approach : gap) += way;
      is_after_stop = is_after_stop || parts.is_stopped[b];
    });
    const double depth = k_deep * size_of_pair(parts, c.contact).radius, least = std::min(c.gap_at_start, -depth);
    if (!is_after_stop || gap + approach >= least - k_deep * depth || !(approach < 0.0)) continue;
    const double share = std::max(least - gap, approach) / approach;
    for_bodies(c.rows, [&](Index b, const Vector3& normal, const Vector3&) {
      if (dot(normal, parts.travel[b]) < 0.0) shorten_way(parts, b, std::max(share, 0.0));
    });
    has_stopped = true;
  }
  return has_stopped;
}

}  // namespace

void stop_at_impacts(double h, Parts& parts) {
  parts.has_stopped = false;
  if (parts.contacts.empty() && parts.fast_pairs.empty()) return;
  parts.is_stopped.assign(parts.travel.size(), false);
  // Further than contacts were looked for, nothing is known to be free.
  for (Index i = 0; i < parts.travel.size(); ++i) {
    if (parts.inverse_mass[i][0] > 0.0 && !is_within_reach(parts, i))
      shorten_way(parts, i, parts.reach[i] / way_of(parts, i));
  }
  for (const FastPair& pair : parts.fast_pairs) {
    if (has_listed(parts, pair.nearest)) stop_fast_turn(h, parts, pair.nearest);
  }
  for (const StepContact& c : parts.contacts) {
    if (c.is_listed && !c.is_ahead) stop_deep(h, parts, c);
  }
  for (int round = 0; round < k_max_rounds; ++round) {
    const bool has_met = stop_where_they_meet(h, parts), has_followed = stop_followers(h, parts);
    if (!has_met && !has_followed) break;
  }
}

}  // namespace tumble
