#include "tumble/step/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>

#include <fmt/format.h>

#include "tumble/contact/contact_rows.hpp"
#include "tumble/geometry/gap_rate.hpp"
#include "tumble/math/numeric.hpp"
#include "tumble/step/step_parts.hpp"

namespace tumble {
namespace {

using Index = std::size_t;
using Parts = StepWorkspace::Parts;

// The body may be pushed a little within a step without a second look for contacts: [-] of its size.
constexpr double k_slack = 0.005;
constexpr int k_max_looks = 8;

double radius_of(const Shape& shape) {
  if (const auto* polygon = std::get_if<RoundedPolygon>(&shape)) {
    double largest = 0.0;
    for (const Vector2 vertex : polygon->vertices) largest = std::max(largest, length(vertex));
    return largest + polygon->rounding;
  }
  if (const auto* ellipse = std::get_if<Ellipse>(&shape)) {
    return length(ellipse->pose.position) + std::max(ellipse->semi_axis_x, ellipse->semi_axis_y);
  }
  if (const auto* terrain = std::get_if<Terrain>(&shape)) {
    double largest = 0.0;
    for (const Vector2 point : terrain->points) largest = std::max(largest, length(point));
    return largest;
  }
  return HUGE_VAL;  // a half-plane
}

bool is_dynamic(const Scene& scene, int body) {
  return scene.bodies[static_cast<Index>(body)].kind == BodyKind::dynamic;
}

void check(const Scene& scene, double step_size, const State& state) {
  if (!(std::isfinite(step_size) && step_size > 0.0)) {
    throw std::invalid_argument(fmt::format("step_size: must be > 0 s, got {}", step_size));
  }
  if (state.bodies.size() != scene.bodies.size()) {
    throw std::invalid_argument(fmt::format("state.bodies: must have one entry per body of the scene ({}), got {}",
                                            scene.bodies.size(), state.bodies.size()));
  }
  for (Index i = 0; i < state.bodies.size(); ++i) {
    const BodyState& b = state.bodies[i];
    const std::array<double, 6> values = {b.pose.position.x, b.pose.position.y, b.pose.angle,
                                          b.velocity[0],     b.velocity[1],     b.velocity[2]};
    if (!all_finite(values)) {
      throw std::invalid_argument(fmt::format("state.bodies[{}] ({}): must be finite", i, scene.bodies[i].name));
    }
  }
}

// The motion of all bodies as if there were no contacts, and how far each can get.
void predict(const Scene& scene, double h, const State& state, Parts& parts) {
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const BodyState& now = state.bodies[i];
    parts.frames[i] = frame_of(now.pose);
    if (body.kind == BodyKind::fixed) continue;
    if (body.kind == BodyKind::kinematic) {
      const Pose next = prescribed_pose(body, state.time + h);
      const Vector2 way = next.position - now.pose.position;
      parts.travel[i] = {way.x, way.y, next.angle - now.pose.angle};
      for (Index j = 0; j < 3; ++j) parts.velocity[i][j] = parts.travel[i][j] / h;
      parts.free_velocity[i] = parts.middle_velocity[i] = parts.next_velocity[i] = parts.velocity[i];
      const double turn = std::abs(parts.travel[i][2]);
      parts.reach[i] = length(way) + (turn > 0.0 ? turn * parts.radius[i] : 0.0);
      continue;
    }
    const Vector3& v = now.velocity;
    Vector3& force = parts.force[i];
    parts.wrench[i] = body.wrenches.empty() ? Vector3{} : mean_wrench(body, state.time, state.time + h);
    force = {body.mass * scene.gravity.x + parts.wrench[i][0], body.mass * scene.gravity.y + parts.wrench[i][1],
             parts.wrench[i][2]};
    Vector3 free;
    for (Index j = 0; j < 3; ++j) free[j] = v[j] + h * (parts.inverse_mass[i][j] * force[j]);
    if (body.linear_damping > 0.0) {
      free[0] /= 1.0 + h * body.linear_damping;
      free[1] /= 1.0 + h * body.linear_damping;
    }
    if (body.angular_damping > 0.0) free[2] /= 1.0 + h * body.angular_damping;
    parts.velocity[i] = v;
    parts.free_velocity[i] = parts.next_velocity[i] = parts.force_velocity[i] = free;
    for (Index j = 0; j < 3; ++j) {
      parts.middle_velocity[i][j] = 0.5 * (v[j] + free[j]);
      parts.travel[i][j] = h * parts.middle_velocity[i][j];
    }
    const double radius = parts.radius[i];
    const double speed =
        std::max(std::sqrt(v[0] * v[0] + v[1] * v[1]), std::sqrt(free[0] * free[0] + free[1] * free[1]));
    const double spin = std::max(std::abs(v[2]), std::abs(free[2]));
    parts.reach[i] = h * (speed + spin * radius) + k_slack * radius;
  }
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

bool is_before(const ContactMemory& memory, const Contact& contact) {
  const auto key = [](const auto& c) { return std::tie(c.body_a, c.body_b, c.part_a, c.part_b, c.feature); };
  return key(memory) < key(contact);
}

// Contacts of one pair of sides share one line of friction: their tangents are those of the one that is nearer, whose
// place is on a flat side if there is one. With lines that differ by the tilt of two sides, however small, rigid bodies
// could jam on them with forces as large as the tilt is small; on one line they cannot, and where both contacts are
// closed there is no tilt.
void share_friction_line(StepContact& first, StepContact& second) {
  constexpr double nearly_parallel = 0.99;  // cosine
  const Contact &c = first.contact, &d = second.contact;
  const bool is_same_pair =
      c.body_a == d.body_a && c.body_b == d.body_b && c.part_a == d.part_a && c.part_b == d.part_b;
  if (!is_same_pair || dot(c.normal, d.normal) < nearly_parallel) return;
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

// [m] Gaps below are closed.
double position_round_off(const Parts& parts, const Contact& contact) {
  constexpr double round_off = 1e-13;  // [-] some hundred times that of one number: positions are sums over many steps
  const auto size = [&](int body) {
    const Vector2 p = parts.frames[static_cast<Index>(body)].position;
    const double radius = parts.radius[static_cast<Index>(body)];
    return std::max(std::abs(p.x), std::abs(p.y)) + (std::isfinite(radius) ? radius : 0.0);
  };
  return round_off * std::max(size(contact.body_a), size(contact.body_b));
}

// Two round surfaces, the more so two corners, turn their normal as they pass: past half their distance from centre to
// centre the first two derivatives of the gap no longer tell what it will be.
bool is_curvature_known(const StepContact& c, double h) {
  const double distance = c.contact.gap + c.contact.radius_a + c.contact.radius_b;
  return std::isinf(distance) || h * 0.5 * std::abs(c.speed[1] + c.free_speed[1]) < 0.5 * distance;
}

// The contacts in reach, with what is known of them before anything is solved.
void prepare_contacts(const Scene& scene, double h, const State& state, Parts& parts) {
  const std::vector<Contact>& found = parts.finder.find(parts.frames, parts.reach);
  parts.contacts.resize(found.size());
  const auto motion_of = [&](Index body) { return Motion{parts.frames[body].position, parts.middle_velocity[body]}; };
  for (Index i = 0; i < found.size(); ++i) {
    StepContact& c = parts.contacts[i];
    c = {};
    c.contact = found[i];
    c.law = &law_of(scene, parts, c.contact);
    c.gap = c.contact.gap > position_round_off(parts, c.contact) ? c.contact.gap : 0.0;
    const auto a = static_cast<Index>(c.contact.body_a), b = static_cast<Index>(c.contact.body_b);
    c.tangent = turned_right(c.contact.normal);
    c.places = contact_places(c.contact, c.gap > 0.0);
    c.rows = contact_rows(c.contact, c.places, parts.frames[a].position, parts.frames[b].position);
    if (i > 0) share_friction_line(parts.contacts[i - 1], c);
  }
  Index memory = 0;
  for (StepContact& c : parts.contacts) {
    const auto a = static_cast<Index>(c.contact.body_a), b = static_cast<Index>(c.contact.body_b);
    add_offsets(scene, parts, c);
    c.speed = contact_velocity(c.rows, parts.velocity);
    c.free_speed = contact_velocity(c.rows, parts.free_velocity);
    const double curvature = is_curvature_known(c, h) ? gap_curvature(c.contact, motion_of(a), motion_of(b)) : 0.0;
    c.bend = 0.5 * h * h * curvature;
    while (memory < state.contacts.size() && is_before(state.contacts[memory], c.contact)) ++memory;
    const bool is_known =
        memory < state.contacts.size() && state.contacts[memory].body_a == c.contact.body_a &&
        state.contacts[memory].body_b == c.contact.body_b && state.contacts[memory].part_a == c.contact.part_a &&
        state.contacts[memory].part_b == c.contact.part_b && state.contacts[memory].feature == c.contact.feature;
    if (is_known) {
      const ContactMemory& last = state.contacts[memory];
      c.mode = last.mode;
      c.was_closed = c.mode != ContactMode::open;
      c.impulse = {last.normal_impulse, last.friction_impulse};
    } else if (h * c.free_speed[0] + c.gap + c.bend < 0.0) {
      c.mode = ContactMode::stick;
    }
    c.has_stuck = is_known ? state.contacts[memory].has_stuck : c.speed[1] == 0.0;
    // Other contacts may push bodies together: those that they reach are listed then.
    c.is_listed = c.is_new =
        is_known || c.gap + c.bend + h * std::min(c.free_speed[0], 0.5 * (c.speed[0] + c.free_speed[0])) < 0.0;
  }
  parts.outcome.assign(found.size(), {});
}

int root_of(std::vector<int>& parent, int body) {
  while (parent[static_cast<Index>(body)] != body) {
    int& next = parent[static_cast<Index>(body)];
    next = parent[static_cast<Index>(next)];
    body = next;
  }
  return body;
}

// Bodies joined by contacts, contacts listed island by island, both in the order of the contacts.
void find_islands(Parts& parts) {
  const auto body_of = [](const StepContact& c) { return c.rows.body_a >= 0 ? c.rows.body_a : c.rows.body_b; };
  for (const StepContact& c : parts.contacts) {
    if (!c.is_listed) continue;
    for (const int body : {c.rows.body_a, c.rows.body_b}) {
      if (body >= 0) parts.parent[static_cast<Index>(body)] = body;
    }
  }
  for (const StepContact& c : parts.contacts) {
    if (!c.is_listed || c.rows.body_a < 0 || c.rows.body_b < 0) continue;
    const int a = root_of(parts.parent, c.rows.body_a), b = root_of(parts.parent, c.rows.body_b);
    parts.parent[static_cast<Index>(std::max(a, b))] = std::min(a, b);
  }
  const auto island_of = [&](const StepContact& c) -> int& {
    return parts.island_of[static_cast<Index>(root_of(parts.parent, body_of(c)))];
  };
  for (const StepContact& c : parts.contacts) {
    if (c.is_listed) island_of(c) = -1;
  }
  parts.island_begin.assign(1, 0);
  for (const StepContact& c : parts.contacts) {
    if (!c.is_listed) continue;
    int& island = island_of(c);
    if (island < 0) {
      island = static_cast<int>(parts.island_begin.size()) - 1;
      parts.island_begin.push_back(0);
    }
    ++parts.island_begin[static_cast<Index>(island) + 1];
  }
  for (Index i = 1; i < parts.island_begin.size(); ++i) parts.island_begin[i] += parts.island_begin[i - 1];
  const int num_listed = parts.island_begin.back();
  parts.island_contact.resize(static_cast<Index>(num_listed));
  for (Index i = parts.contacts.size(); i-- > 0;) {
    if (!parts.contacts[i].is_listed) continue;
    // Filled from the end, so that begin moves down to where the island begins.
    int& next = parts.island_begin[static_cast<Index>(island_of(parts.contacts[i])) + 1];
    parts.island_contact[static_cast<Index>(--next)] = static_cast<int>(i);
  }
  // Every begin has moved to the one before: move them back.
  parts.island_begin.erase(parts.island_begin.begin());
  parts.island_begin.push_back(num_listed);
}

// Lists contacts that the motion found would overrun. False if there are none.
bool list_overrun(double h, Parts& parts) {
  constexpr double round_off = 1e-12;  // [-] of the way
  bool has_new = false;
  for (StepContact& c : parts.contacts) {
    if (c.is_listed) continue;
    double gap = c.gap + c.bend + h * c.rows.offset;
    if (c.rows.body_a >= 0) gap += dot(c.rows.normal_a, parts.travel[static_cast<Index>(c.rows.body_a)]);
    if (c.rows.body_b >= 0) gap += dot(c.rows.normal_b, parts.travel[static_cast<Index>(c.rows.body_b)]);
    if (gap >= -round_off * (c.gap + h * (std::abs(c.speed[0]) + std::abs(c.free_speed[0])))) continue;
    c.is_listed = c.is_new = has_new = true;
  }
  return has_new;
}

// The motion of all islands. Those whose contacts stay the same keep theirs.
void step_islands(double h, const StepSettings& settings, Parts& parts) {
  do {
    find_islands(parts);
    for (Index i = 0; i + 1 < parts.island_begin.size(); ++i) {
      const auto begin = static_cast<Index>(parts.island_begin[i]), end = static_cast<Index>(parts.island_begin[i + 1]);
      const IslandContacts contacts = IslandContacts(parts.island_contact).subspan(begin, end - begin);
      bool is_new = false;
      for (const int c : contacts) {
        is_new = is_new || parts.contacts[static_cast<Index>(c)].is_new;
        parts.contacts[static_cast<Index>(c)].is_new = false;
      }
      if (is_new) parts.outcome[static_cast<Index>(contacts.front())] = step_island(parts, contacts, h, settings);
    }
  } while (list_overrun(h, parts));
}

// True if no body went further than its contacts were looked for; else they are looked for further away.
bool is_within_reach(const Scene& scene, Parts& parts) {
  bool is_within = true;
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].kind != BodyKind::dynamic) continue;
    const Vector3& d = parts.travel[i];
    const double way = std::sqrt(d[0] * d[0] + d[1] * d[1]) + std::abs(d[2]) * parts.radius[i];
    if (!(way > parts.reach[i])) continue;
    parts.reach[i] = 2.0 * way;
    is_within = false;
  }
  return is_within;
}

void fill_report(const Scene& scene, double h, const State& state, Parts& parts, StepReport& report) {
  EnergyLedger& energy = report.energy;
  report.contacts.clear();
  for (StepContact& c : parts.contacts) {
    if (!c.is_listed) {
      c.speed_after = contact_velocity(c.rows, parts.next_velocity);
      c.mode = ContactMode::open;
      c.sticks = false;
      c.impulse = c.total_impulse = c.work = {};
    }
    report.contacts.push_back({c.contact, c.tangent, c.places.on_a, c.places.on_b, *c.law, c.speed[0], c.speed[1],
                               c.speed_after[0], c.speed_after[1], c.impulse[0], c.impulse[1], c.restitution,
                               c.sticks ? ContactMode::stick : c.mode});
    energy.impact_loss -= c.work[0];
    energy.friction_loss -= c.work[1];
    energy.external_work -= c.total_impulse[0] * c.rows.offset + c.total_impulse[1] * c.rows.tangent_offset;
  }
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.kind != BodyKind::dynamic) continue;
    const Vector3 &v = parts.velocity[i], &next = parts.next_velocity[i], &travel = parts.travel[i];
    const Vector2 x = state.bodies[i].pose.position;
    energy.potential -= body.mass * (scene.gravity.x * x.x + scene.gravity.y * x.y);
    for (Index j = 0; j < 3; ++j) {
      const double middle = 0.5 * h * (v[j] + parts.force_velocity[i][j]);
      energy.kinetic += 0.5 * parts.mass[i][j] * next[j] * next[j];
      energy.external_work += parts.wrench[i][j] * travel[j];
      energy.stabilisation_work += parts.force[i][j] * (middle - travel[j]);
      const double damping = j < 2 ? body.linear_damping : body.angular_damping;
      if (damping > 0.0) energy.damping_loss += damping * parts.mass[i][j] * parts.free_velocity[i][j] * middle;
    }
  }
}

}  // namespace

StepWorkspace::Parts::Parts(const Scene& scene) : finder(scene) {
  const Index n = scene.bodies.size();
  for (Index a = 0; a < scene.materials.size(); ++a) {
    for (Index b = 0; b < scene.materials.size(); ++b) {
      laws.push_back(contact_law(scene, static_cast<int>(a), static_cast<int>(b)));
    }
  }
  for (const Body& body : scene.bodies) {
    const bool moves = body.kind == BodyKind::dynamic;
    const Vector3 m = {body.mass, body.mass, body.moment_of_inertia};
    mass.push_back(moves ? m : Vector3{});
    inverse_mass.push_back(moves ? Vector3{1.0 / m[0], 1.0 / m[1], 1.0 / m[2]} : Vector3{});
    double largest = 0.0;
    for (const Part& part : body.parts) largest = std::max(largest, radius_of(part.shape));
    radius.push_back(largest);
  }
  frames.resize(n);
  reach.assign(n, 0.0);
  for (std::vector<Vector3>* values : {&velocity, &force, &wrench, &free_velocity, &middle_velocity, &next_velocity,
                                       &travel, &shift, &way_velocity, &force_velocity}) {
    values->assign(n, Vector3{});
  }
  parent.resize(n);
  island_of.resize(n);
  local_body.assign(n, -1);
}

StepWorkspace::StepWorkspace(const Scene& scene) {
  validate(scene);
  parts_ = std::make_unique<Parts>(scene);
}
StepWorkspace::~StepWorkspace() = default;
StepWorkspace::StepWorkspace(StepWorkspace&&) noexcept = default;
StepWorkspace& StepWorkspace::operator=(StepWorkspace&&) noexcept = default;

void validate(const StepSettings& settings) {
  if (settings.num_sweeps < 1) {
    throw std::invalid_argument(fmt::format("num_sweeps: must be >= 1, got {}", settings.num_sweeps));
  }
}

LcpStatus time_step(const Scene& scene, double h, const StepSettings& settings, State& state, StepWorkspace& workspace,
                    StepReport* report) {
  check(scene, h, state);
  validate(settings);
  Parts& parts = workspace.parts();
  predict(scene, h, state, parts);
  for (int look = 1;; ++look) {
    prepare_contacts(scene, h, state, parts);
    step_islands(h, settings, parts);
    if (is_within_reach(scene, parts) || look == k_max_looks) break;
    for (Index i = 0; i < scene.bodies.size(); ++i) {
      if (scene.bodies[i].kind != BodyKind::dynamic) continue;
      parts.next_velocity[i] = parts.force_velocity[i] = parts.free_velocity[i];
      for (Index j = 0; j < 3; ++j) parts.travel[i][j] = h * parts.middle_velocity[i][j];
    }
  }
  IslandOutcome worst;
  int num_islands = 0;
  for (Index i = 0; i + 1 < parts.island_begin.size(); ++i) {
    const int first = parts.island_contact[static_cast<Index>(parts.island_begin[i])];
    const IslandOutcome& outcome = parts.outcome[static_cast<Index>(first)];
    if (outcome.status != LcpStatus::solved) worst.status = outcome.status;
    worst.residual = std::max(worst.residual, outcome.residual);
    worst.factorisations += outcome.factorisations;
    worst.created += outcome.created;
    num_islands += outcome.is_at_work ? 1 : 0;
  }

  state.time += h;
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    BodyState& body = state.bodies[i];
    const Vector3& travel = parts.travel[i];
    if (scene.bodies[i].kind == BodyKind::fixed) continue;
    if (scene.bodies[i].kind == BodyKind::kinematic) {
      body.pose = prescribed_pose(scene.bodies[i], state.time);
    } else {
      body.pose.position = body.pose.position + Vector2{travel[0], travel[1]};
      body.pose.angle += travel[2];
    }
    body.velocity = parts.next_velocity[i];
  }
  state.contacts.clear();
  for (const StepContact& c : parts.contacts) {
    if (!c.is_listed || c.mode == ContactMode::open) continue;
    const Contact& k = c.contact;
    state.contacts.push_back(
        {k.body_a, k.body_b, k.part_a, k.part_b, k.feature, c.mode, c.sticks, c.impulse[0], c.impulse[1]});
  }
  if (report) {
    *report = {worst.status, worst.residual, num_islands, worst.factorisations, {}, std::move(report->contacts)};
    fill_report(scene, h, state, parts, *report);
    report->energy.created = worst.created;
  }
  return worst.status;
}

}  // namespace tumble
