// The scratch memory of a step, shared by its files. Not a public header.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "tumble/contact/contact_rows.hpp"
#include "tumble/contact/island_solver.hpp"
#include "tumble/geometry/detect_contacts.hpp"
#include "tumble/geometry/gap_rate.hpp"
#include "tumble/geometry/shape_size.hpp"
#include "tumble/geometry/time_of_impact.hpp"
#include "tumble/lcp/contact_system.hpp"
#include "tumble/step/step_report.hpp"
#include "tumble/step/time_step.hpp"

namespace tumble {

struct IslandOutcome {
  LcpStatus status = LcpStatus::solved;
  double residual = 0.0;
  int factorisations = 0;
  bool is_at_work = false;  // some contact was touched
  double created = 0.0;     // [J], above round-off
  double lost = 0.0;        // [J]
  bool has_moved = false;   // otherwise than freely, and was not yet separated
};

// One contact during a step. Velocities are (u_n, u_t).
struct StepContact {
  Contact contact;
  const ContactLaw* law = nullptr;
  Vector2 tangent;
  ContactPlaces places;                // of the impulse
  BodyContact rows;                    // bodies: index into the scene, -1 unless dynamic; offsets: of the motion of
                                       // kinematic bodies and conveyors
  std::array<double, 2> speed{};       // at the start of the step
  std::array<double, 2> free_speed{};  // at its end, were there no contacts
  double gap = 0.0;                    // [m] at the start of the step; 0 where the bodies overlap
  double bend = 0.0;                   // [m] what turning and curved surfaces add to it in the step: h^2 / 2 times
                                       // `gap_curvature`
  double gap_at_start = 0.0;           // [m] < 0: overlap
  bool is_ahead = false;               // of fast bodies: where they will meet, not where they are closest now
  bool was_closed = false;             // in the last step, and did not bounce
  bool has_stuck = false;              // in the last step: static friction may hold it
  bool is_listed = false;              // in an island: it may be touched in this step
  bool is_new = false;                 // there, since the islands were last solved
  // Of the island.
  double end_speed = 0.0;   // u_n at the end of the step, were there no impacts
  double bounce = 0.0;      // [m/s] speed of separation, if the gap closes
  bool is_touched = false;  // at the end of the way
  bool is_load = false;     // closed by the forces of the step alone, after impacts
  // Of the LCP being solved, and what came out.
  bool is_included = true;
  double friction = 0.0;                        // kinetic, or static
  bool is_static = false;                       // friction is the static one, and that is larger
  double offset = 0.0;                          // of u_n
  ContactMode mode = ContactMode::open;         // in: where to start
  std::array<double, 2> impulse{};              // in: where to start
  std::array<double, 2> total_impulse{};        // of all LCPs for velocities
  std::array<double, 2> work{};                 // [J] of these
  ContactMode impact_mode = ContactMode::open;  // in the last of these that had an impulse
  std::array<double, 2> speed_after{};
  bool sticks = false;       // closed, without slip
  double restitution = 0.0;  // that was at work
  double way_bend = 0.0;     // [m] of the way found
  IslandOutcome outcome;     // of the island whose first contact this is
};

// Two parts of which one may go far in the step, against their sizes: looked at along their way.
struct FastPair {
  Contact nearest;  // at the start of the step
  bool misses = false;
  std::array<Vector3, 2> missing_velocity{};  // of a and b, with which they are known not to meet
};

// [-] of the radius of the smaller part: parts that are nearer touch.
inline constexpr double k_touching = 1e-6;

struct StepWorkspace::Parts {
  explicit Parts(const Scene& scene);

  // What may differ between runs of one scene: laws of all materials, masses of a body.
  void take_laws(const Scene& scene);
  void take_mass(const Scene& scene, std::size_t body);

  // Of the scene.
  ContactFinder finder;
  std::vector<ContactLaw> laws;       // of materials a, b at a * materials + b
  std::vector<Vector3> inverse_mass;  // per body; 0 unless dynamic
  std::vector<Vector3> mass;          // (m, m, I)
  std::vector<double> radius;         // of the circle about the origin of the body's frame that holds it

  std::vector<std::vector<ShapeSize>> sizes;  // per body, per part

  // Of a step, per body.
  std::vector<Pose> poses;
  std::vector<double> reach;             // [m] how far it may go
  std::vector<double> reach_looked_at;   // the same when contacts were last looked for; < 0: never
  std::vector<bool> was_held;            // by contacts in the last step, or is not dynamic
  std::vector<Vector3> velocity;         // at the start; of kinematic bodies, their mean during the step
  std::vector<Vector3> force;            // F_x, F_y, torque: gravity and wrench [N, N m]
  std::vector<Vector3> wrench;           // the wrench alone
  std::vector<Vector3> free_velocity;    // v_f
  std::vector<Vector3> middle_velocity;  // (v + v_f) / 2
  std::vector<Vector3> next_velocity;
  std::vector<Vector3> force_velocity;  // after the forces and the first impacts: forces work along its mean with v
  std::vector<Vector3> travel;          // x, y, angle
  std::vector<bool> is_stopped;         // on its way; of use where any has
  std::vector<Vector3> shift;           // what `separate` adds to it
  bool has_stopped = false;             // any body, on its way

  // Contacts, island by island.
  std::vector<StepContact> contacts;
  std::vector<StepContact> last_contacts;  // of the look before
  std::vector<FastPair> fast_pairs;
  std::vector<StepContact> added;  // of fast pairs
  std::vector<ContactPoint> points;
  std::vector<int> parent;                   // union-find over bodies
  std::vector<int> island_of;                // root body -> island
  std::vector<int> island_begin;             // islands + 1
  std::vector<int> island_contact;           // indices into contacts
  IslandSolver solver;                       // of impulses
  IslandSolver separator;                    // of overlaps
  std::vector<int> local_body, island_body;  // scene -> island, -1 if not of it, and back
  std::vector<Vector3> way_velocity;         // of the LCP for the way
};

// Two parts on the ways of their bodies.

// The smaller sizes of the two.
ShapeSize size_of_pair(const StepWorkspace::Parts& parts, const Contact& pair);

// [m] How far the travel found takes any point of the body, at most.
double way_of(const StepWorkspace::Parts& parts, std::size_t body);

// Whether it goes no further than thought.
bool is_within_reach(const StepWorkspace::Parts& parts, std::size_t body);

// Sets parts.way_velocity of the two bodies to what takes them where they were found to go.
void set_way_velocity(double step_size, StepWorkspace::Parts& parts, const Contact& pair);

// Sets parts.points to the contacts that they have at a time of the step, moving with these velocities.
void find_contacts_at(StepWorkspace::Parts& parts, const Contact& pair, const std::vector<Vector3>& velocity,
                      double time, double reach);

// [m] There: below 0 where they overlap, else infinite.
double least_gap_at(StepWorkspace::Parts& parts, const Contact& pair, const std::vector<Vector3>& velocity,
                    double time);

// When they first meet while their bodies move with these velocities.
std::optional<Impact> find_impact(double step_size, StepWorkspace::Parts& parts, FastPair& pair,
                                  const std::vector<Vector3>& velocity);

// Contacts of a step.

// Whether contacts of the pair take part in the motion.
bool has_listed(const StepWorkspace::Parts& parts, const Contact& pair);

// The contacts in reach, with what is known of them before anything is solved, in the order of their ids.
void prepare_contacts(const Scene& scene, double step_size, const State& state, StepWorkspace::Parts& parts);

// The same once islands were stepped, where bodies may go further than thought at first. Pairs that take part in the
// motion found keep their contacts: from further away they may be seen otherwise.
void look_further(const Scene& scene, double step_size, const State& state, StepWorkspace::Parts& parts);

// [m] What turning and curved surfaces add to the gap in the step, to second order, where the two bodies move by the
// travel found, which impacts may have changed; 0 where that says little.
double bend_of_way(const StepWorkspace::Parts& parts, const Contact& contact, double step_size);

// Lists contacts that the motion found would overrun. False if there are none.
bool list_overrun(double step_size, StepWorkspace::Parts& parts);

// Adds the contacts of fast bodies that the motion found would run through. False if there are none.
bool add_contacts_on_way(const Scene& scene, double step_size, StepWorkspace::Parts& parts);

// Shortens the ways of bodies that would still run, or turn, through each other, so that they end before.
void stop_at_impacts(double step_size, StepWorkspace::Parts& parts);

// The motion of all islands. Those whose contacts are the same as before keep theirs.
void step_islands(double step_size, const StepSettings& settings, StepWorkspace::Parts& parts);

// Takes the bodies of islands that were stepped out of what they would overlap. False if there is no such.
bool separate_islands(double step_size, const StepSettings& settings, StepWorkspace::Parts& parts);

using IslandContacts = std::span<const int>;  // indices into Parts::contacts

// Numbers the dynamic bodies of one island, until the numbers are taken back.
void list_bodies(StepWorkspace::Parts& parts, IslandContacts island);
void forget_bodies(StepWorkspace::Parts& parts);

// Velocities and travel of the bodies of one island, impulses and modes of its contacts.
IslandOutcome step_island(StepWorkspace::Parts& parts, IslandContacts island, double step_size,
                          const StepSettings& settings);

// Adds to the travel of the bodies of one island what takes them out of what they would overlap after the step, the
// least in the metric of their masses. Velocities stay. Bodies are lifted against their forces by no more work than
// `lost` [J], what the step has lost: the sum creates no energy. False if they overlap nothing, or can do no such work.
bool separate(StepWorkspace::Parts& parts, IslandContacts island, double step_size, const StepSettings& settings,
              double lost);

}  // namespace tumble
