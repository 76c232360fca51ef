#include "problems.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tumble/lcp/residual.hpp"

namespace tumble::problems {
namespace {

using Index = std::size_t;

constexpr double k_gravity = 9.81;  // [m/s^2]

struct Vector2 {
  double x = 0.0;
  double y = 0.0;
};

// What a contact is made of: the points are seen from the centres of mass, the normal points from a to b.
struct Touch {
  int a = -1;
  int b = -1;
  Vector2 r_a{};
  Vector2 r_b{};
  Vector2 normal{0.0, 1.0};
  double friction = 0.5;
};

Vector3 row(Vector2 r, Vector2 direction, double sign) {
  return {sign * direction.x, sign * direction.y, sign * (r.x * direction.y - r.y * direction.x)};
}

BodyContact as_contact(const Touch& touch) {
  const Vector2 tangent{touch.normal.y, -touch.normal.x};
  return {touch.a,
          touch.b,
          row(touch.r_a, touch.normal, -1.0),
          row(touch.r_b, touch.normal, 1.0),
          row(touch.r_a, tangent, -1.0),
          row(touch.r_b, tangent, 1.0),
          touch.friction,
          0.0};
}

// 10^x, x uniform in [low, high): see `power_of_two`.
double decades(Random& random, double low, double high) {
  constexpr double log2_of_10 = 3.321928094887362;
  return random.log_uniform(low * log2_of_10, high * log2_of_10);
}

// x or -x; a function, as operands have no order in C++ and random numbers need one.
double either_sign(Random& random, double x) { return random.one_in(2) ? x : -x; }

// A point of the unit circle without sine and cosine: its upper half is (2 t, 1 - t^2) / (1 + t^2), |t| <= 1.
Vector2 upward(double t) {
  const double square = t * t;
  return {2.0 * t / (1.0 + square), (1.0 - square) / (1.0 + square)};
}

Vector2 direction(Random& random) {
  const Vector2 up = upward(random.uniform(-1.0, 1.0));
  return random.one_in(2) ? up : Vector2{-up.x, -up.y};
}

Vector2 point_in_square(Random& random, double half_side) {
  const double x = random.uniform(-half_side, half_side);
  return {x, random.uniform(-half_side, half_side)};
}

Vector2 moved(Vector2 p, Vector2 direction, double distance) {
  return {p.x + distance * direction.x, p.y + distance * direction.y};
}

// Adds a body of this mass; `size` is its radius of gyration.
int add_body(ContactSystem& system, double mass, double size, Vector3 velocity) {
  system.inverse_mass.push_back({1.0 / mass, 1.0 / mass, 1.0 / (mass * size * size)});
  system.velocity.push_back(velocity);
  return static_cast<int>(system.velocity.size()) - 1;
}

void add_contact(ContactSystem& system, const Touch& touch) { system.contacts.push_back(as_contact(touch)); }

double wild_friction(Random& random) { return random.one_in(4) ? 0.0 : decades(random, -6.0, 1.0); }

Vector2 wild_normal(Random& random) {
  switch (random.below(3)) {
    case 0: return {0.0, 1.0};
    case 1: return upward(either_sign(random, decades(random, -12.0, -2.0)));
    default: return direction(random);
  }
}

// A contact unlike the others.
Touch wild_touch(Random& random, const std::vector<double>& sizes) {
  const int num_bodies = static_cast<int>(sizes.size());
  Touch touch;
  touch.b = random.below(num_bodies);
  touch.a = random.below(num_bodies + 1) - 1;
  if (touch.a == touch.b) touch.a = -1;
  touch.normal = wild_normal(random);
  touch.r_b = point_in_square(random, sizes[static_cast<Index>(touch.b)]);
  if (touch.a >= 0) touch.r_a = point_in_square(random, sizes[static_cast<Index>(touch.a)]);
  touch.friction = wild_friction(random);
  return touch;
}

// The same contact, each number changed by a relative amount of this order.
Touch shaken(Random& random, Touch touch, double relative) {
  for (double* x : {&touch.r_a.x, &touch.r_a.y, &touch.r_b.x, &touch.r_b.y, &touch.normal.x, &touch.normal.y}) {
    *x *= 1.0 + relative * random.uniform(-1.0, 1.0);
  }
  const double length = std::sqrt(touch.normal.x * touch.normal.x + touch.normal.y * touch.normal.y);
  touch.normal = {touch.normal.x / length, touch.normal.y / length};
  return touch;
}

// Further along the face that `touch` lies on.
Touch on_the_same_face(Random& random, Touch touch, double size) {
  const Vector2 tangent{touch.normal.y, -touch.normal.x};
  const double distance = random.uniform(-size, size);
  touch.r_a = moved(touch.r_a, tangent, distance);
  touch.r_b = moved(touch.r_b, tangent, distance);
  return touch;
}

// Boxes, of towers and pyramids.
constexpr double k_half_width = 0.5;
constexpr double k_half_height = 0.25;

int add_box(ContactSystem& system, double mass, Random& random, bool is_moving, double step) {
  Vector3 v{0.0, -k_gravity * step, 0.0};
  if (is_moving) {
    v[0] += random.uniform(-1.0, 1.0);
    v[1] += random.uniform(-0.2, 0.1);
    v[2] += random.uniform(-0.3, 0.3);
  }
  const double gyration = std::sqrt((k_half_width * k_half_width + k_half_height * k_half_height) / 3.0);
  return add_body(system, mass, gyration, v);
}

// Box b, its centre `shift` to the right of a's, stands on a with a contact at x, seen from its own centre.
Touch box_on_box(int a, int b, double shift, double x, double friction) {
  return {a, b, {x + shift, k_half_height}, {x, -k_half_height}, {0.0, 1.0}, friction};
}

Tower random_tower(Random& random) {
  constexpr std::array exponents = {0.0, 9.966, -19.932};  // 1, 1e3, 1e-6
  Tower result;
  result.contacts_per_face = random.one_in(2) ? 2 : 4;
  result.mass_exponent = exponents[static_cast<Index>(random.below(3))];
  result.is_graded = random.one_in(2);
  result.is_moving = random.one_in(2);
  result.friction = random.uniform(0.1, 1.0);
  result.step = decades(random, -4.0, -1.0);
  return result;
}

}  // namespace

ContactSystem wild(Random& random, std::size_t num_contacts) {
  ContactSystem system;
  const int num_bodies = 1 + random.below(num_contacts <= 4 ? 3 : 8);
  const double step = decades(random, -6.0, -1.0);
  const double speed = random.one_in(4) ? 0.0 : decades(random, -8.0, 2.0);
  const double gravity = random.one_in(8) && speed > 0.0 ? 0.0 : k_gravity;
  std::vector<double> sizes;
  for (int k = 0; k < num_bodies; ++k) {
    sizes.push_back(decades(random, -2.0, 1.0));
    const double mass = decades(random, -3.0, 3.0);
    const double gyration = sizes.back() * random.uniform(0.3, 1.0);
    const double v_x = speed * random.uniform(-1.0, 1.0);
    const double v_y = speed * random.uniform(-1.0, 0.5) - gravity * step;
    const double spin = speed / sizes.back() * random.uniform(-1.0, 1.0);
    add_body(system, mass, gyration, {v_x, v_y, spin});
  }
  const double common_friction = wild_friction(random);
  const bool has_common_friction = random.one_in(2);
  std::vector<Touch> touches;
  while (touches.size() < num_contacts) {
    const int kind = touches.empty() ? 7 : random.below(8);
    if (kind >= 4) {
      touches.push_back(wild_touch(random, sizes));
      if (has_common_friction) touches.back().friction = common_friction;
      continue;
    }
    const Touch old = touches[static_cast<Index>(random.below(static_cast<int>(touches.size())))];
    if (kind == 0) {
      touches.push_back(old);
    } else if (kind == 1) {
      touches.push_back(shaken(random, old, decades(random, -14.0, -6.0)));
    } else {
      touches.push_back(on_the_same_face(random, old, sizes[static_cast<Index>(old.b)]));
    }
  }
  for (const Touch& touch : touches) add_contact(system, touch);
  return system;
}

ContactSystem tower(const Tower& tower, Random& random, std::size_t num_contacts) {
  ContactSystem system;
  const Index num_boxes = (num_contacts + tower.contacts_per_face - 1) / tower.contacts_per_face;
  for (Index k = 0; k < num_boxes; ++k) {
    double height = k + 1 == num_boxes ? 1.0 : 0.0;
    if (tower.is_graded && k > 0) height = static_cast<double>(k) / static_cast<double>(num_boxes - 1);
    const double mass = power_of_two(tower.mass_exponent * height);
    const int box = add_box(system, mass, random, tower.is_moving, tower.step);
    const Index count = std::min(tower.contacts_per_face, num_contacts - system.contacts.size());
    for (Index i = 0; i < count; ++i) {
      const double x =
          count == 1 ? 0.0 : k_half_width * (2.0 * static_cast<double>(i) / static_cast<double>(count - 1) - 1.0);
      add_contact(system, box_on_box(box - 1, box, 0.0, x, tower.friction));
    }
  }
  return system;
}

ContactSystem tower(Random& random, std::size_t num_contacts) {
  return tower(random_tower(random), random, num_contacts);
}

ContactSystem resting_tower(Random& random, std::size_t num_contacts) {
  Tower resting = random_tower(random);
  resting.is_moving = false;
  return tower(resting, random, num_contacts);
}

ContactSystem pyramid(Random& random, std::size_t num_contacts) {
  ContactSystem system;
  const bool is_moving = random.one_in(2);
  const double friction = random.uniform(0.1, 1.0);
  const double step = decades(random, -4.0, -1.0);
  const auto num_contacts_of = [](Index levels) { return 2 * levels + 2 * levels * (levels - 1); };
  Index levels = 1;
  while (num_contacts_of(levels) < num_contacts) ++levels;
  std::vector<int> below;
  for (Index level = 0; level < levels; ++level) {
    std::vector<int> boxes;
    for (Index k = 0; k + level < levels && system.contacts.size() < num_contacts; ++k) {
      const int box = add_box(system, 1.0, random, is_moving, step);
      boxes.push_back(box);
      std::vector<Touch> touches;
      if (level == 0) {
        for (const double x : {-k_half_width, k_half_width}) touches.push_back(box_on_box(-1, box, 0.0, x, friction));
      } else {
        for (const double x : {-k_half_width, 0.0}) {
          touches.push_back(box_on_box(below[k], box, k_half_width, x, friction));
        }
        for (const double x : {0.0, k_half_width}) {
          touches.push_back(box_on_box(below[k + 1], box, -k_half_width, x, friction));
        }
      }
      touches.resize(std::min(touches.size(), num_contacts - system.contacts.size()));
      for (const Touch& touch : touches) add_contact(system, touch);
    }
    below = boxes;
  }
  return system;
}

ContactSystem pile(Random& random, std::size_t num_contacts) {
  ContactSystem system;
  const double step = decades(random, -4.0, -1.0);
  const double speed = random.one_in(2) ? 0.0 : 1.0;
  std::vector<double> sizes;
  while (system.contacts.size() < num_contacts) {
    const double size = random.uniform(0.2, 1.0);
    const double v_x = speed * random.uniform(-1.0, 1.0);
    const double v_y = speed * random.uniform(-1.0, 0.5) - k_gravity * step;
    const double spin = speed * random.uniform(-1.0, 1.0);
    const double mass = decades(random, -3.0, 3.0);
    const int body = add_body(system, mass, size * random.uniform(0.4, 0.8), {v_x, v_y, spin});
    sizes.push_back(size);
    const Index count = std::min(1 + static_cast<Index>(random.below(3)), num_contacts - system.contacts.size());
    for (Index i = 0; i < count; ++i) {
      Touch touch;
      touch.b = body;
      // On the ground, or on one of the latest bodies: a pile is local.
      const int reach = std::min(body, 6);
      touch.a = random.one_in(4) || reach == 0 ? -1 : body - 1 - random.below(reach);
      touch.normal = touch.a < 0 ? Vector2{0.0, 1.0} : upward(random.uniform(-0.7, 0.7));
      const double offset = random.uniform(-0.5, 0.5) * size;
      const Vector2 tangent{touch.normal.y, -touch.normal.x};
      touch.r_b = moved(moved({}, touch.normal, -size), tangent, offset);
      if (touch.a >= 0) touch.r_a = moved({}, touch.normal, sizes[static_cast<Index>(touch.a)]);
      touch.friction = random.uniform(0.0, 1.0);
      add_contact(system, touch);
    }
  }
  return system;
}

ContactSystem wedge(Random& random, std::size_t num_contacts) {
  ContactSystem system;
  const double friction = decades(random, -2.0, 1.0);
  const double lean = random.one_in(2) ? 0.0 : decades(random, -8.0, -1.0);
  const double step = decades(random, -4.0, -1.0);
  while (system.contacts.size() < num_contacts) {
    const double push = random.one_in(2) ? 0.0 : random.uniform(-1.0, 1.0);
    const int body = add_body(system, decades(random, -1.0, 1.0), 0.5, {push, -k_gravity * step, 0.0});
    // Left and right; the walls lean outwards upwards, or stand upright. Between bodies a, the left one is the last.
    const Vector2 from_left = upward(1.0 - lean);
    for (const double side : {-1.0, 1.0}) {
      if (system.contacts.size() == num_contacts) break;
      Touch touch;
      touch.b = body;
      touch.a = side < 0.0 && random.one_in(2) ? body - 1 : -1;
      touch.normal = {-side * from_left.x, from_left.y};
      touch.r_b = {side * 0.5, random.uniform(-0.2, 0.2)};
      touch.r_a = {-side * 0.5, random.uniform(-0.2, 0.2)};
      touch.friction = friction;
      add_contact(system, touch);
    }
  }
  return system;
}

ContactSystem painleve(Random& random, std::size_t num_contacts) {
  ContactSystem system;
  const double plate_mass = decades(random, 0.0, 4.0);
  const bool has_plate = random.one_in(2);
  if (has_plate) add_body(system, plate_mass, 2.0, {0.0, 0.0, 0.0});
  const double step = decades(random, -6.0, -2.0);
  while (system.contacts.size() < num_contacts) {
    // The rod's half, from its foot to its centre, leans by 0.2 to 1.2 of its height.
    const Vector2 axis = upward(either_sign(random, random.uniform(0.1, 0.5)));
    const double half_length = random.uniform(0.2, 2.0);
    const double drive = random.uniform(-2.0, 2.0);
    const double fall = random.one_in(2) ? 0.0 : either_sign(random, decades(random, -6.0, 0.0));
    const double spin = random.one_in(2) ? 0.0 : random.uniform(-2.0, 2.0);
    const int rod = add_body(system, decades(random, -1.0, 1.0), half_length / std::sqrt(3.0),
                             {drive, fall - k_gravity * step, spin});
    Touch touch;
    touch.b = rod;
    touch.a = has_plate ? 0 : -1;
    touch.r_b = {-half_length * axis.x, -half_length * axis.y};
    if (has_plate) touch.r_a = {random.uniform(-2.0, 2.0), 0.1};
    // A_nn / |A_nt| of the rod alone, m (1 / A): (1 + 3 x^2) / (3 x y).
    const double critical = (1.0 + 3.0 * axis.x * axis.x) / (3.0 * std::abs(axis.x) * axis.y);
    touch.friction = critical * (random.one_in(2) ? random.uniform(0.9, 1.1) : random.uniform(0.5, 5.0));
    add_contact(system, touch);
  }
  return system;
}

ContactSystem next_step(const ContactSystem& resting, const std::vector<double>& z, Random& random) {
  ContactSystem next = resting;
  const std::vector<Vector3> after = velocities_after(resting, z);
  const LcpProblem problem = as_lcp(resting);
  const std::vector<double> w = complement(problem, z);
  for (Index k = 0; k < next.velocity.size(); ++k) {
    for (Index i = 0; i < 3; ++i) {
      next.velocity[k][i] = after[k][i] + resting.velocity[k][i] * (1.0 + 1e-6 * random.uniform(-1.0, 1.0));
    }
  }
  for (Index k = 0; k < next.contacts.size(); ++k) next.contacts[k].offset = w[k];
  return next;
}

Random random_of(std::uint64_t seed, std::uint64_t index) {
  // Starting points that no whole number of steps of SplitMix64 leads from one to the other, within any list.
  return Random((seed + 1) * 0xd1342543de82ef95u + index * 0xaf251af3b0f025b5u);
}

ContactSystem wild_of(std::uint64_t seed, std::uint64_t index, int max_contacts) {
  Random random = random_of(seed, index);
  const int num_contacts = 1 + random.below(max_contacts);
  return wild(random, static_cast<Index>(num_contacts));
}

std::span<const Family> families() {
  static constexpr std::array<Family, 6> all = {{{"wild", wild},
                                                 {"tower", tower},
                                                 {"pyramid", pyramid},
                                                 {"pile", pile},
                                                 {"wedge", wedge},
                                                 {"painleve", painleve}}};
  return all;
}

}  // namespace tumble::problems
