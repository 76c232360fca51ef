// The contacts of a step. See docs/theory/step.md.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>

#include "tumble/contact/contact_rows.hpp"
#include "tumble/geometry/gap_rate.hpp"
#include "tumble/geometry/pair_contacts.hpp"
#include "tumble/geometry/passing_contact.hpp"
#include "tumble/step/step_parts.hpp"

namespace tumble {
namespace {

using Index = std::size_t;
using Parts = StepWorkspace::Parts;

constexpr double k_fast = 0.25;  // [-] of the radius of the smaller part: longer ways are long

bool is_dynamic(const Scene& scene, int body) {
  return scene.bodies[static_cast<Index>(body)].kind == BodyKind::dynamic;
}

void add_offsets(const Scene& scene, const Parts& parts, StepContact& c) {
  const Contact& contact = c.contact;
  const auto a = static_cast<Index>(contact.body_a), b = static_cast<Index>(contact.body_b);
  if (!is_dynamic(scene, contact.body_a)) {
    c.rows.offset += dot(c.rows.normal_a, parts.velocity[a]);
    c.rows.tangent_offset += dot(c.rows.tangent_a, parts.velocity[a]);
    c.rows.body_a = -1;
  }
  if (!is_dynamic(scene, contact.body_b)) {
    c.rows.offset += dot(c.rows.normal_b, parts.velocity[b]);
    c.rows.tangent_offset += dot(c.rows.tangent_b, parts.velocity[b]);
    c.rows.body_b = -1;
  }
  const Part& part_a = scene.bodies[a].parts[static_cast<Index>(contact.part_a)];
  const Part& part_b = scene.bodies[b].parts[static_cast<Index>(contact.part_b)];
  // Each runs along its own outward normal turned right: t for a, -t for b.
  c.rows.tangent_offset -= part_a.surface_speed + part_b.surface_speed;
}

const ContactLaw& law_of(const Scene& scene, const Parts& parts, const Contact& contact) {
  const auto material = [&](int body, int part) {
    return static_cast<Index>(scene.bodies[static_cast<Index>(body)].parts[static_cast<Index>(part)].material);
  };
  return parts.laws[material(contact.body_a, contact.part_a) * scene.materials.size() +
                    material(contact.body_b, contact.part_b)];
}

auto key_of(const auto& c) { return std::tie(c.body_a, c.body_b, c.part_a, c.part_b, c.feature); }

auto pair_of(const Contact& c) { return std::tie(c.body_a, c.body_b, c.part_a, c.part_b); }

bool is_of_pair(const Contact& c, const Contact& d) { return pair_of(c) == pair_of(d); }

const Contact& nearest_of(std::span<const Contact> pair) {
  return *std::min_element(pair.begin(), pair.end(), [](auto& c, auto& d) { return c.gap < d.gap; });
}

// Contacts of one pair of sides share one line of friction: their tangents are those of the one that is nearer, whose
// place is on a flat side if there is one. With lines that differ by the tilt of two sides, however small, rigid bodies
// could jam on them with forces as large as the tilt is small; on one line they cannot, and where both contacts are
// closed there is no tilt.
void share_friction_line(StepContact& first, StepContact& second) {
  constexpr double nearly_parallel = 0.99;  // cosine
  const Contact &c = first.contact, &d = second.contact;
  if (dot(c.normal, d.normal) < nearly_parallel) return;
  const StepContact& nearer = c.gap <= d.gap ? first : second;
  StepContact& other = c.gap <= d.gap ? second : first;
  other.tangent = nearer.tangent;
  other.rows.tangent_a = nearer.rows.tangent_a;
  other.rows.tangent_b = nearer.rows.tangent_b;
  // Where the line of its own normal meets that of the friction.
  const Vector2 n = other.contact.normal, t = other.tangent;
  const auto move = [&](Vector2& place, Vector2 on_line) {
    place = place + cross(on_line - place, t) / cross(n, t) * n;
  };
  move(other.places.on_a, nearer.places.on_a);
  move(other.places.on_b, nearer.places.on_b);
}

// [m] Gaps of the two bodies below are closed.
double position_round_off(const Parts& parts, const Contact& contact) {
  constexpr double round_off = 1e-13;  // [-] some hundred times that of one number: positions are sums over many steps
  const auto size = [&](int body) {
    const Vector2 p = parts.poses[static_cast<Index>(body)].position;
    const double radius = parts.radius[static_cast<Index>(body)];
    return std::max(std::abs(p.x), std::abs(p.y)) + (std::isfinite(radius) ? radius : 0.0);
  };
  return round_off * std::max(size(contact.body_a), size(contact.body_b));
}

// All contacts in reach of the two bodies are known.
bool is_looked_at(const Parts& parts, const Contact& pair) {
  const auto a = static_cast<Index>(pair.body_a), b = static_cast<Index>(pair.body_b);
  return parts.reach[a] <= parts.reach_looked_at[a] && parts.reach[b] <= parts.reach_looked_at[b];
}

// Bodies apart that may go so far in the step, against their sizes, that where they are closest at its start tells
// little about where, and whether, they meet.
bool is_fast(const Parts& parts, std::span<const Contact> pair) {
  const Contact& first = pair.front();
  const double way = parts.reach[static_cast<Index>(first.body_a)] + parts.reach[static_cast<Index>(first.body_b)];
  const ShapeSize size = size_of_pair(parts, first);
  if (way <= k_fast * size.radius && way <= size.thickness) return false;
  return std::all_of(pair.begin(), pair.end(), [&](const Contact& c) { return c.gap > k_touching * size.radius; });
}

// Law, places and rows of the contact, of bodies whose frames are at these positions; a gap within the round-off [m] is
// none.
void set_geometry(const Scene& scene, const Parts& parts, StepContact& c, double round_off, Vector2 centre_a,
                  Vector2 centre_b) {
  c.law = &law_of(scene, parts, c.contact);
  c.gap = c.contact.gap > round_off ? c.contact.gap : 0.0;
  c.tangent = turned_right(c.contact.normal);
  c.places = contact_places(c.contact, c.gap > 0.0);
  c.rows = contact_rows(c.contact, c.places, centre_a, centre_b);
}

// Two round surfaces, the more so two corners, turn their normal as they pass: past half their distance from centre to
// centre the first two derivatives of the gap no longer tell what it will be.
double bend_of(const Contact& contact, const Motion& a, const Motion& b, double h) {
  const double distance = contact.gap + contact.radius_a + contact.radius_b;
  if (std::isfinite(distance)) {
    const auto velocity_at = [](const Motion& body, Vector2 point) {
      return Vector2{body.velocity[0], body.velocity[1]} + body.velocity[2] * turned_left(point - body.position);
    };
    const double slip = cross(contact.normal, velocity_at(b, contact.point_b) - velocity_at(a, contact.point_a));
    if (!(h * std::abs(slip) < 0.5 * distance)) return 0.0;
  }
  return 0.5 * h * h * gap_curvature(contact, a, b);
}

// How the gap changes in the step.
void set_motion(const Parts& parts, double h, StepContact& c) {
  const auto motion_of = [&](int body) {
    const auto b = static_cast<Index>(body);
    return Motion{parts.poses[b].position, parts.middle_velocity[b]};
  };
  c.speed = velocity_at(c.rows, parts.velocity);
  c.free_speed = velocity_at(c.rows, parts.free_velocity);
  if (c.is_ahead) return;
  c.gap_at_start = c.contact.gap;
  c.bend = bend_of(c.contact, motion_of(c.contact.body_a), motion_of(c.contact.body_b), h);
}

// Of bodies that both were held in the last step.
bool is_near_in_crowd(const Parts& parts, const StepContact& c) {
  constexpr double near = 0.5;  // [-] of how far they may go
  const auto a = static_cast<Index>(c.contact.body_a), b = static_cast<Index>(c.contact.body_b);
  return parts.was_held[a] && parts.was_held[b] && c.gap < near * (parts.reach[a] + parts.reach[b]);
}

// What the contact did in the last step, if there is memory of it.
void recall(const ContactMemory* memory, double h, const Parts& parts, StepContact& c) {
  if (memory) {
    c.mode = memory->mode;
    c.was_closed = c.mode != ContactMode::open && !memory->has_bounced;
    c.impulse = {memory->normal_impulse, memory->friction_impulse};
    c.has_stuck = memory->has_stuck;
  } else {
    c.mode = h * c.free_speed[0] + c.gap + c.bend < 0.0 ? ContactMode::stick : ContactMode::open;
    c.has_stuck = c.speed[1] == 0.0;
  }
  // Other contacts may push bodies together: those that they reach are listed then, or at once in a crowd.
  const double slower = std::min(c.free_speed[0], 0.5 * (c.speed[0] + c.free_speed[0]));
  c.is_listed = c.is_new = memory || c.gap + c.bend + h * slower < 0.0 || is_near_in_crowd(parts, c);
}

// Of point_b seen from point_a.
Vector2 relative_velocity(const Parts& parts, const Contact& contact, const std::vector<Vector3>& velocity) {
  const auto velocity_at = [&](int body, Vector2 point) {
    const Vector3& v = velocity[static_cast<Index>(body)];
    return Vector2{v[0], v[1]} + v[2] * turned_left(point - parts.poses[static_cast<Index>(body)].position);
  };
  return velocity_at(contact.body_b, contact.point_b) - velocity_at(contact.body_a, contact.point_a);
}

// The contact in place of those of two polygons that would close in the step, where by their own motion, forces apart,
// they pass each other.
std::optional<Contact> find_passing(double h, const Parts& parts, std::span<const Contact> pair, double round_off) {
  constexpr double early = 1.25;        // [-] of a step: forces may speed them up
  constexpr double step_height = 1e-3;  // [-] of the way, and of the size: lower steps are none
  constexpr double tilt = 0.01;         // [-] of the way: they are on it along the side
  constexpr double same_side = 0.99;    // cosine
  const Contact& nearest = nearest_of(pair);
  if (!(nearest.gap > round_off)) return std::nullopt;
  const Vector2 velocity = relative_velocity(parts, nearest, parts.velocity), way = early * h * velocity;
  if (!(nearest.gap + dot(nearest.normal, way) < 0.0)) return std::nullopt;
  const double tolerance = step_height * std::min(length(way), size_of_pair(parts, nearest).radius);
  const auto better = passing_contact(parts.finder.shape(nearest.body_a, nearest.part_a),
                                      parts.finder.shape(nearest.body_b, nearest.part_b), way, tolerance);
  if (!better || better->gap + dot(better->normal, way) < -tilt * length(way)) return std::nullopt;
  if (dot(better->normal, nearest.normal) > same_side) return std::nullopt;  // and it may have both ends of the side
  // Where they meet corner on corner, which side they pass on is not decided; forces that press on one decide it.
  const Vector2 pressed = relative_velocity(parts, nearest, parts.free_velocity) - velocity;
  if (better->gap <= tolerance && !(dot(better->normal, pressed) < 0.0)) return std::nullopt;
  return Contact{*better, nearest.body_a, nearest.body_b, nearest.part_a, nearest.part_b};
}

// Appends the contacts that two parts have where they first meet when their bodies move with these velocities. The gap
// is the way that is left to there, along the normal that they will have.
void append_contacts_ahead(const Scene& scene, double h, Parts& parts, FastPair& fast,
                           const std::vector<Vector3>& velocity, std::vector<StepContact>& contacts) {
  const auto impact = find_impact(h, parts, fast, velocity);
  if (!impact) return;
  const Contact& pair = fast.nearest;
  const auto a = static_cast<Index>(pair.body_a), b = static_cast<Index>(pair.body_b);
  find_contacts_at(parts, pair, velocity, impact->time, parts.reach[a] + parts.reach[b]);
  const auto way_of = [&](Index body) { return impact->time * Vector2{velocity[body][0], velocity[body][1]}; };
  const Index first = contacts.size();
  for (const ContactPoint& point : parts.points) {
    StepContact& c = contacts.emplace_back();
    c.contact = {point, pair.body_a, pair.body_b, pair.part_a, pair.part_b};
    c.is_ahead = true;
    set_geometry(scene, parts, c, position_round_off(parts, pair), parts.poses[a].position + way_of(a),
                 parts.poses[b].position + way_of(b));
    if (contacts.size() > first + 1) share_friction_line(contacts.end()[-2], c);
  }
  for (Index i = first; i < contacts.size(); ++i) {
    StepContact& c = contacts[i];
    add_offsets(scene, parts, c);
    c.gap_at_start = c.contact.gap - impact->time * velocity_at(c.rows, velocity)[0];
    c.gap = std::max(c.gap_at_start, 0.0);
    // Reported where the bodies are at the start of the step, turned as they will be.
    c.contact.gap = c.gap;
    for (Vector2* place : {&c.places.on_a, &c.contact.point_a}) *place = *place - way_of(a);
    for (Vector2* place : {&c.places.on_b, &c.contact.point_b}) *place = *place - way_of(b);
  }
}

// Those of one pair, of contacts in the order of their ids.
std::span<const StepContact> contacts_of_pair(const std::vector<StepContact>& contacts, const Contact& pair) {
  const auto is_before = [](const StepContact& c, const Contact& p) { return pair_of(c.contact) < pair_of(p); };
  const StepContact* const end = contacts.data() + contacts.size();
  const StepContact* const first = std::lower_bound(contacts.data(), end, pair, is_before);
  const StepContact* last = first;
  while (last != end && is_of_pair(last->contact, pair)) ++last;
  return {first, static_cast<std::size_t>(last - first)};
}

// Both in the order of their ids.
void merge_into(std::vector<StepContact>& contacts, const std::vector<StepContact>& more,
                std::vector<StepContact>& scratch) {
  scratch.clear();
  std::merge(contacts.begin(), contacts.end(), more.begin(), more.end(), std::back_inserter(scratch),
             [](const StepContact& c, const StepContact& d) { return key_of(c.contact) < key_of(d.contact); });
  contacts.swap(scratch);
}

// Sets parts.contacts to those in reach, of pairs of which one body may go further than when they were last looked for.
void find_contacts(const Scene& scene, double h, const State& state, Parts& parts) {
  const std::vector<Contact>& found = parts.finder.find(parts.poses, parts.reach);
  parts.contacts.clear();
  for (Index begin = 0, end = 0; begin < found.size(); begin = end) {
    while (end < found.size() && is_of_pair(found[end], found[begin])) ++end;
    const std::span<const Contact> pair = std::span(found).subspan(begin, end - begin);
    if (is_looked_at(parts, pair.front())) continue;
    const double round_off = position_round_off(parts, pair.front());
    const auto passing = find_passing(h, parts, pair, round_off);
    if (!passing && is_fast(parts, pair)) {
      parts.fast_pairs.push_back({nearest_of(pair)});
      append_contacts_ahead(scene, h, parts, parts.fast_pairs.back(), parts.middle_velocity, parts.contacts);
      continue;
    }
    for (const Contact& contact : passing ? std::span(&*passing, 1) : pair) {
      StepContact& c = parts.contacts.emplace_back();
      c.contact = contact;
      set_geometry(scene, parts, c, round_off, parts.poses[static_cast<Index>(contact.body_a)].position,
                   parts.poses[static_cast<Index>(contact.body_b)].position);
      if (!passing && &contact != &pair.front()) share_friction_line(parts.contacts.end()[-2], c);
    }
  }
  Index next = 0;
  for (StepContact& c : parts.contacts) {
    if (!c.is_ahead) add_offsets(scene, parts, c);
    set_motion(parts, h, c);
    while (next < state.contacts.size() && key_of(state.contacts[next]) < key_of(c.contact)) ++next;
    const bool is_known = next < state.contacts.size() && key_of(state.contacts[next]) == key_of(c.contact);
    recall(is_known ? &state.contacts[next] : nullptr, h, parts, c);
  }
  parts.reach_looked_at = parts.reach;
}

}  // namespace

bool has_listed(const Parts& parts, const Contact& pair) {
  const auto contacts = contacts_of_pair(parts.contacts, pair);
  return std::any_of(contacts.begin(), contacts.end(), [](const StepContact& c) { return c.is_listed; });
}

void prepare_contacts(const Scene& scene, double h, const State& state, Parts& parts) {
  parts.fast_pairs.clear();
  parts.reach_looked_at.assign(scene.bodies.size(), -1.0);
  for (Index i = 0; i < scene.bodies.size(); ++i) parts.was_held[i] = scene.bodies[i].kind != BodyKind::dynamic;
  for (const ContactMemory& c : state.contacts) {
    parts.was_held[static_cast<Index>(c.body_a)] = parts.was_held[static_cast<Index>(c.body_b)] = true;
  }
  find_contacts(scene, h, state, parts);
}

bool add_contacts_on_way(const Scene& scene, double h, Parts& parts) {
  std::vector<StepContact>& added = parts.added;
  added.clear();
  for (FastPair& pair : parts.fast_pairs) {
    if (has_listed(parts, pair.nearest)) continue;
    set_way_velocity(h, parts, pair.nearest);
    append_contacts_ahead(scene, h, parts, pair, parts.way_velocity, added);
  }
  if (added.empty()) return false;
  for (StepContact& c : added) {
    set_motion(parts, h, c);
    recall(nullptr, h, parts, c);
    c.is_listed = c.is_new = true;
  }
  // They take the place of those of the same pairs; all are in the order of their ids.
  Index next = 0;
  std::erase_if(parts.contacts, [&](const StepContact& c) {
    while (next < added.size() && pair_of(added[next].contact) < pair_of(c.contact)) ++next;
    return next < added.size() && is_of_pair(added[next].contact, c.contact);
  });
  merge_into(parts.contacts, added, parts.last_contacts);
  return true;
}

void look_further(const Scene& scene, double h, const State& state, Parts& parts) {
  constexpr double same_side = 0.99;  // cosine
  std::vector<StepContact>& kept = parts.last_contacts;
  kept.clear();
  for (const StepContact& c : parts.contacts) {
    if (is_looked_at(parts, c.contact) || has_listed(parts, c.contact)) kept.push_back(c);
  }
  std::erase_if(parts.fast_pairs, [&](const FastPair& pair) { return !is_looked_at(parts, pair.nearest); });
  find_contacts(scene, h, state, parts);
  std::sort(parts.fast_pairs.begin(), parts.fast_pairs.end(),
            [](const FastPair& p, const FastPair& q) { return pair_of(p.nearest) < pair_of(q.nearest); });
  std::erase_if(parts.contacts, [&](const StepContact& c) {
    const auto pair = contacts_of_pair(kept, c.contact);
    return std::any_of(pair.begin(), pair.end(), [&](const StepContact& d) {
      return c.is_ahead || d.is_ahead || key_of(c.contact) == key_of(d.contact) ||
             dot(c.contact.normal, d.contact.normal) < same_side;
    });
  });
  merge_into(parts.contacts, kept, parts.added);
}

double bend_of_way(const Parts& parts, const Contact& contact, double h) {
  const auto motion_of = [&](int body) {
    const auto b = static_cast<Index>(body);
    Motion motion{parts.poses[b].position, parts.velocity[b]};
    if (parts.inverse_mass[b][0] > 0.0) {
      for (Index j = 0; j < 3; ++j) motion.velocity[j] = parts.travel[b][j] / h;
    }
    return motion;
  };
  return bend_of(contact, motion_of(contact.body_a), motion_of(contact.body_b), h);
}

bool list_overrun(double h, Parts& parts) {
  constexpr double round_off = 1e-12;  // [-] of the way
  bool has_new = false;
  for (StepContact& c : parts.contacts) {
    if (c.is_listed) continue;
    double gap = c.gap + h * c.rows.offset;
    for_bodies(c.rows, [&](Index b, const Vector3& normal, const Vector3&) { gap += dot(normal, parts.travel[b]); });
    gap += c.is_ahead ? c.bend : std::min(c.bend, bend_of_way(parts, c.contact, h));
    if (gap >= -round_off * (c.gap + h * (std::abs(c.speed[0]) + std::abs(c.free_speed[0])))) continue;
    c.is_listed = c.is_new = has_new = true;
  }
  return has_new;
}

}  // namespace tumble
