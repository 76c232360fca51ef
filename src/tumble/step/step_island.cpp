// How the bodies of one island move in a step: freely, landing, or bouncing. See time_step.hpp and docs/theory/step.md.
#include <algorithm>
#include <cmath>

#include "tumble/contact/restitution.hpp"
#include "tumble/step/step_parts.hpp"

namespace tumble {
namespace {

using Index = std::size_t;
using Parts = StepWorkspace::Parts;
using Velocities = std::vector<Vector3>;

// [-] of what is summed: energy above is created, not rounded.
constexpr double k_energy_round_off = 1e-12;
// [-] of the same: bounces that share their energy aim at this.
constexpr double k_energy_aim = 1e-14;
// [-] of the way that a contact can go in a step: a gap below is closed.
constexpr double k_gap_round_off = 1e-12;
// [-] of the largest speed at the contacts of an island: what approaches or slips slower is at rest.
constexpr double k_speed_round_off = 1e-12;
// [-] of the same: impacts that follow from others in the same step, and approach slower, wait for the next one.
constexpr double k_impact_share = 1e-9;
constexpr int k_max_attempts = 6;       // at a bounce that makes no energy
constexpr int k_max_impact_rounds = 8;  // the last without restitution

struct Island {
  Parts& parts;
  IslandContacts contacts;
  double h;
  const StepSettings& settings;
  IslandOutcome outcome;
  double largest_speed = 0.0, rest_speed = 0.0;  // [m/s]

  StepContact& at(int i) const { return parts.contacts[static_cast<Index>(i)]; }

  // One contact in closed form.
  void solve_one(StepContact& c, const Velocities& from, Velocities& to) {
    const auto [u_n, u_t] = velocity_at(c.rows, from);
    OneContact problem{0.0, 0.0, 0.0, u_n + c.offset, u_t, c.friction};
    for_bodies(c.rows, [&](Index b, const Vector3& normal, const Vector3& tangent) {
      const Vector3& w = parts.inverse_mass[b];
      problem.A_nn += normal[0] * normal[0] * w[0] + normal[1] * normal[1] * w[1] + normal[2] * normal[2] * w[2];
      problem.A_nt += normal[0] * tangent[0] * w[0] + normal[1] * tangent[1] * w[1] + normal[2] * tangent[2] * w[2];
      problem.A_tt += tangent[0] * tangent[0] * w[0] + tangent[1] * tangent[1] * w[1] + tangent[2] * tangent[2] * w[2];
    });
    const OneContactSolution solution = solve_one_contact(problem);
    c.impulse = {solution.f_n, solution.f_t};
    c.mode = solution.mode;
    for_bodies(c.rows, [&](Index b, const Vector3& normal, const Vector3& tangent) {
      const Vector3& w = parts.inverse_mass[b];
      for (Index j = 0; j < 3; ++j) {
        to[b][j] = from[b][j] + w[j] * (normal[j] * solution.f_n + tangent[j] * solution.f_t);
      }
    });
    note(solution.status, solution.residual, 0);
  }

  void note(LcpStatus status, double residual, int factorisations) {
    if (status != LcpStatus::solved && outcome.status == LcpStatus::solved) outcome.status = status;
    outcome.residual = std::max(outcome.residual, residual);
    outcome.factorisations += factorisations;
  }

  // The LCP of the contacts included, from velocities `from` to velocities `to` of the island's bodies.
  void solve(const Velocities& from, Velocities& to) {
    if (contacts.size() == 1 && at(contacts[0]).is_included) return solve_one(at(contacts[0]), from, to);
    IslandSolver& solver = parts.solver;
    solver.system.inverse_mass.clear();
    solver.system.velocity.clear();
    solver.system.contacts.clear();
    solver.modes.clear();
    solver.impulses.clear();
    for (const int body : parts.island_body) {
      solver.system.inverse_mass.push_back(parts.inverse_mass[static_cast<Index>(body)]);
      solver.system.velocity.push_back(from[static_cast<Index>(body)]);
    }
    const auto local = [&](int body) { return body < 0 ? -1 : parts.local_body[static_cast<Index>(body)]; };
    for (const int i : contacts) {
      StepContact& c = at(i);
      if (!c.is_included) continue;
      BodyContact& rows = solver.system.contacts.emplace_back(c.rows);
      rows.body_a = local(rows.body_a);
      rows.body_b = local(rows.body_b);
      rows.offset += c.offset;
      rows.friction = c.friction;
      solver.modes.push_back(c.mode);
      solver.impulses.insert(solver.impulses.end(), {c.impulse[0], c.impulse[1]});
    }
    if (!solver.system.contacts.empty()) {
      const IslandSolution solution = solver.solve({settings.solver, settings.num_sweeps});
      note(solution.status, solution.residual, solution.factorisations);
    } else {
      solver.velocity = solver.system.velocity;
    }
    for (Index b = 0; b < parts.island_body.size(); ++b) {
      to[static_cast<Index>(parts.island_body[b])] = solver.velocity[b];
    }
    Index k = 0;
    for (const int i : contacts) {
      StepContact& c = at(i);
      c.mode = ContactMode::open;
      c.impulse = {};
      if (!c.is_included) continue;
      c.mode = solver.modes[k];
      c.impulse = {solver.impulses[2 * k], solver.impulses[2 * k + 1]};
      ++k;
    }
  }

  // Where contacts share a load, a force at the edge of its cone is no slip.
  bool slips(const StepContact& c, const Velocities& velocity) const {
    return c.mode != ContactMode::open && c.mode != ContactMode::stick &&
           std::abs(velocity_at(c.rows, velocity)[1]) > rest_speed;
  }

  // The same; contacts that static friction does not hold slip with the kinetic one.
  void solve_with_statics(const Velocities& from, Velocities& to) {
    for (;;) {
      solve(from, to);
      bool has_broken = false;
      for (const int i : contacts) {
        StepContact& c = at(i);
        if (!c.is_static || !slips(c, to)) continue;
        c.is_static = false;
        c.friction = c.law->friction;
        has_broken = true;
      }
      if (!has_broken) return;
    }
  }

  void set_friction() {
    for (const int i : contacts) {
      StepContact& c = at(i);
      c.is_static = c.has_stuck && c.law->static_friction > c.law->friction;
      c.friction = c.is_static ? c.law->static_friction : c.law->friction;
    }
  }

  // Turning alone, by which closed contacts start with a speed of their bend, is no approach. The way to the contact is
  // that of the LCP for the way: so an elastic bounce keeps the energy exactly.
  void set_bounce(StepContact& c, double end_speed) const {
    c.end_speed = end_speed;
    const double turning = c.was_closed ? c.bend / h : 0.0;
    c.bounce =
        bounce_speed({way_to(c), c.speed[0] - turning, end_speed - turning, h, 2.0 * c.bend / h}, c.law->restitution);
  }

  static double way_to(const StepContact& c) { return std::max(c.gap + c.bend, 0.0); }

  // The gap [m] after the step, up to third order, without impacts.
  double gap_without_impacts(const StepContact& c) const {
    return c.gap + 0.5 * h * (c.speed[0] + c.end_speed) + c.bend;
  }

  // Contacts that were closed are judged by the law that closed them, that of landing, under which they start the step
  // with the speed that takes the bend away.
  bool is_free() const {
    return std::none_of(contacts.begin(), contacts.end(), [&](int i) {
      const StepContact& c = at(i);
      return (c.was_closed && !may_bounce(c) ? c.gap + h * c.free_speed[0] + c.bend : gap_without_impacts(c)) < 0.0;
    });
  }

  bool may_bounce(const StepContact& c) const { return c.bounce > rest_speed; }
  bool is_bouncing(const StepContact& c) const { return may_bounce(c) && gap_without_impacts(c) < 0.0; }

  void set_travel(const Velocities& velocity) {
    for (const int body : parts.island_body) {
      const auto b = static_cast<Index>(body);
      for (Index j = 0; j < 3; ++j) parts.travel[b][j] = h * velocity[b][j];
    }
  }

  // The contacts that stand, by one LCP for the velocity at the end of the step. Those that may bounce are left out.
  void stand(Velocities& to) {
    set_friction();
    for (const int i : contacts) {
      StepContact& c = at(i);
      c.is_included = !may_bounce(c);
      c.offset = way_to(c) / h;
    }
    solve_with_statics(parts.free_velocity, to);
  }

  // With the velocity at the end of the step the bodies also move. False if this closes a contact that may bounce.
  bool land() {
    stand(parts.next_velocity);
    set_travel(parts.next_velocity);
    const bool closes = std::any_of(contacts.begin(), contacts.end(), [&](int i) {
      const StepContact& c = at(i);
      return may_bounce(c) && c.gap + c.bend + h * velocity_at(c.rows, parts.next_velocity)[0] < 0.0;
    });
    if (closes) return false;
    note_forces();
    add_work(parts.velocity, parts.next_velocity);
    return true;
  }

  // What bounces is approached under the forces and the contacts that stand. Those may be more than it seems at first:
  // bodies that fall together do not approach each other until the lower one stands.
  void find_approach() {
    const auto count = [&] {
      return std::count_if(contacts.begin(), contacts.end(), [&](int i) { return may_bounce(at(i)); });
    };
    for (auto before = count(); before > 0;) {
      stand(parts.way_velocity);
      for (const int i : contacts) {
        StepContact& c = at(i);
        if (may_bounce(c)) set_bounce(c, velocity_at(c.rows, parts.way_velocity)[0]);
      }
      const auto after = count();
      if (after == before) return;
      before = after;
    }
  }

  // The speed [m/s] that the forces of the step alone can bring about at a contact.
  double load_speed(const StepContact& c) const {
    double sum = 0.0;
    for_bodies(c.rows, [&](Index b, const Vector3& normal, const Vector3&) {
      for (Index j = 0; j < 3; ++j) sum += h * std::abs(normal[j] * parts.inverse_mass[b][j] * parts.force[b][j]);
    });
    return sum;
  }

  // One LCP for the way, until gaps close. What bounces meets its friction after the way.
  void find_way() {
    set_friction();
    for (const int i : contacts) {
      StepContact& c = at(i);
      c.is_included = true;
      c.offset = way_to(c) / h;
      if (is_bouncing(c)) c.friction = 0.0;
    }
    solve_with_statics(parts.middle_velocity, parts.way_velocity);
    set_travel(parts.way_velocity);
    for (const int i : contacts) {
      StepContact& c = at(i);
      const double way = h * velocity_at(c.rows, parts.way_velocity)[0];
      const double round_off = k_gap_round_off * (c.gap + h * (std::abs(c.speed[0]) + std::abs(c.free_speed[0])));
      c.is_touched = c.mode != ContactMode::open || c.gap + c.bend + way <= round_off;
    }
  }

  // The larger of the contact's A_nn and A_tt.
  double response_of(const StepContact& c) const {
    double nn = 0.0, tt = 0.0;
    for_bodies(c.rows, [&](Index b, const Vector3& normal, const Vector3& tangent) {
      const Vector3& w = parts.inverse_mass[b];
      for (Index j = 0; j < 3; ++j) {
        nn += normal[j] * normal[j] * w[j];
        tt += tangent[j] * tangent[j] * w[j];
      }
    });
    return std::max(nn, tt);
  }

  // What came from nothing: the work of contacts, of which none may be positive in sum, and what moving otherwise than
  // by (v + v') / 2 gained.
  struct Created {
    double energy = 0.0;
    double size = 0.0;
  };
  Created created() const {
    Created sum;
    const auto add = [&](double term) {
      sum.energy += term;
      sum.size += std::abs(term);
    };
    for (const int i : contacts) {
      const StepContact& c = at(i);
      add(c.work[0]);
      add(c.work[1]);
      const double push = c.total_impulse[0] * c.total_impulse[0] + c.total_impulse[1] * c.total_impulse[1];
      sum.size += push * response_of(c);  // what the impulse alone would do: velocities are rounded sums of it
    }
    for (const int body : parts.island_body) {
      const auto b = static_cast<Index>(body);
      for (Index j = 0; j < 3; ++j) {
        add(parts.force[b][j] * (0.5 * h * (parts.velocity[b][j] + parts.force_velocity[b][j]) - parts.travel[b][j]));
        sum.size += 0.5 * parts.mass[b][j] * parts.velocity[b][j] * parts.velocity[b][j];
      }
    }
    return sum;
  }

  // The velocities after the impacts at the end of the way, by one LCP for those that bounce by themselves and those
  // that stand, then by one for each round of impacts that follow from these. Contacts that are opening are not part of
  // an LCP: it would push bodies together that part. Where it drives them together, they bounce in the next round.
  void find_velocities(double share) {
    do {
      find_first_impacts(share);
    } while (add_loads());
    note_forces();
    add_work(parts.velocity, parts.next_velocity);
    for (int round = 1; round <= k_max_impact_rounds && list_next_impacts(round < k_max_impact_rounds, share);
         ++round) {
      parts.way_velocity = parts.next_velocity;
      solve_with_statics(parts.way_velocity, parts.next_velocity);
      add_work(parts.way_velocity, parts.next_velocity);
    }
  }

  void find_first_impacts(double share) {
    set_friction();
    for (const int i : contacts) {
      StepContact& c = at(i);
      const bool bounces = is_bouncing(c);
      const bool stands = c.is_load || (!may_bounce(c) && c.end_speed <= rest_speed);
      c.is_included = c.is_touched && (bounces || stands);
      c.offset = bounces ? -share * c.bounce : 0.0;
      c.restitution = c.is_included && bounces ? c.law->restitution : 0.0;
      c.work = c.total_impulse = {};
      c.impact_mode = ContactMode::open;
    }
    solve_with_statics(parts.free_velocity, parts.next_velocity);
  }

  // Contacts left out of the first LCP that the load of the step closes, at a speed whose rebounds end within the step:
  // that is no impact, they stand. False if there are none.
  bool add_loads() {
    bool has_more = false;
    for (const int i : contacts) {
      StepContact& c = at(i);
      if (!c.is_touched || c.is_included || c.is_load) continue;
      const double speed = velocity_at(c.rows, parts.next_velocity)[0], e = c.law->restitution;
      if (!(speed < -k_impact_share * largest_speed)) continue;
      c.is_load = -2.0 * e * speed <= std::min(c.speed[0] - speed, load_speed(c)) * (1.0 - e);
      has_more = has_more || c.is_load;
    }
    return has_more;
  }

  // Impacts without friction make no energy, and elastic ones lose none. Where several in one step would, by what their
  // ways and their speeds of approach do not know of each other, they all bounce a little less, or more.
  void bounce() {
    find_approach();
    find_way();
    double square = 1.0, last_square = 1.0, last_made = 0.0;  // of the share; the energy made is linear in it
    for (int attempt = 0;; ++attempt) {
      find_velocities(std::sqrt(square));
      double bounced = 0.0;
      bool rubs = false, is_elastic = true;
      for (const int i : contacts) {
        const StepContact& c = at(i);
        if (c.restitution > 0.0)
          bounced += 0.5 * c.total_impulse[0] * std::abs(velocity_at(c.rows, parts.next_velocity)[0]);
        rubs = rubs || c.total_impulse[1] != 0.0;
        is_elastic = is_elastic && (c.total_impulse[0] == 0.0 || c.restitution == 1.0);
      }
      const Created made = created();
      const double wrong = is_elastic ? std::abs(made.energy) : made.energy;
      if (rubs || wrong <= k_energy_aim * made.size || !(bounced > 0.0)) return;
      const bool is_last = attempt >= k_max_attempts;
      if (is_last && (made.energy <= 0.0 || attempt >= 2 * k_max_attempts)) return;
      double slope = 0.5 * bounced / square;
      if (attempt > 0 && (made.energy - last_made) * (square - last_square) > 0.0)
        slope = (made.energy - last_made) / (square - last_square);
      last_square = square;
      last_made = made.energy;
      square -= (is_last ? 2.0 : 1.0) * made.energy / slope;  // in the end, too little rather than too much
      if (!(square > 0.0)) square = 0.0;
    }
  }

  // Contacts that are touched and do not open now; false if none of them closes. Without restitution the round is the
  // last.
  bool list_next_impacts(bool with_restitution, double share) {
    bool has_impact = false;
    for (const int i : contacts) {
      StepContact& c = at(i);
      const double speed = velocity_at(c.rows, parts.next_velocity)[0];
      c.is_included = c.is_touched && (speed <= rest_speed || !with_restitution);
      const bool is_impact = c.is_touched && speed < -k_impact_share * largest_speed;
      const double restitution = is_impact && with_restitution ? c.law->restitution : 0.0;
      c.offset = share * restitution * speed;
      c.restitution = std::max(c.restitution, restitution);
      has_impact = has_impact || is_impact;
    }
    return has_impact;
  }

  // The velocities that the forces of the step have worked on.
  void note_forces() {
    for (const int body : parts.island_body) {
      const auto b = static_cast<Index>(body);
      parts.force_velocity[b] = parts.next_velocity[b];
    }
  }

  // Impulses of an LCP, and what they did.
  void add_work(const Velocities& from, const Velocities& to) {
    for (const int i : contacts) {
      StepContact& c = at(i);
      if (c.impulse[0] == 0.0 && c.impulse[1] == 0.0) continue;
      const auto u = velocity_at(c.rows, from), next = velocity_at(c.rows, to);
      for (Index j = 0; j < 2; ++j) {
        c.total_impulse[j] += c.impulse[j];
        c.work[j] += 0.5 * c.impulse[j] * (u[j] + next[j]);
      }
      c.impact_mode = c.mode;
    }
  }
};

}  // namespace

IslandOutcome step_island(Parts& parts, IslandContacts contacts, double h, const StepSettings& settings) {
  Island island{parts, contacts, h, settings, {}};
  for (const int i : contacts) {
    StepContact& c = island.at(i);
    c.restitution = 0.0;
    c.is_load = false;
    c.impact_mode = ContactMode::open;
    c.work = c.total_impulse = {};
    const double speed =
        std::max({std::abs(c.speed[0]), std::abs(c.free_speed[0]), std::abs(c.speed[1]), std::abs(c.free_speed[1])});
    island.largest_speed = std::max(island.largest_speed, speed);
    island.set_bounce(c, c.free_speed[0]);
  }
  island.rest_speed = k_speed_round_off * island.largest_speed;
  if (island.is_free()) {
    for (const int i : contacts) {
      StepContact& c = island.at(i);
      c.mode = ContactMode::open;
      c.sticks = false;
      c.impulse = {};
      c.speed_after = c.free_speed;
    }
    return island.outcome;
  }
  list_bodies(parts, contacts);
  const bool bounces =
      std::any_of(contacts.begin(), contacts.end(), [&](int i) { return island.is_bouncing(island.at(i)); });
  if (bounces || !island.land()) island.bounce();
  for (const int i : contacts) {
    StepContact& c = island.at(i);
    c.speed_after = velocity_at(c.rows, parts.next_velocity);
    c.mode = c.impact_mode;                                // open, where no round had an impulse
    if (c.friction == 0.0 && c.mode != ContactMode::open)  // no friction tells which way it slips
      c.mode = c.speed_after[1] < 0.0 ? ContactMode::slip_left : ContactMode::slip_right;
    c.sticks = c.mode != ContactMode::open && !island.slips(c, parts.next_velocity);
    island.outcome.is_at_work = island.outcome.is_at_work || c.mode != ContactMode::open;
  }
  const Island::Created created = island.created();
  if (created.energy > k_energy_round_off * created.size) island.outcome.created = created.energy;
  island.outcome.lost = -created.energy;
  island.outcome.has_moved = true;
  forget_bodies(parts);
  return island.outcome;
}

}  // namespace tumble
