#include "tumble/lcp/contact_motions.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tumble/lcp/contact_structure.hpp"
#include "tumble/lcp/enumerate.hpp"

namespace tumble {
namespace {

using Index = std::size_t;

// Velocities that differ by less, relative to their scales, are equal. Vertices of the enumeration satisfy their
// equations to round-off, but bases are admitted up to a condition of 1e11: as A is semidefinite, an error e of f with
// A e = round-off moves velocities elsewhere by the square root of e . A e, some 1e-10 of the terms.
constexpr double k_same_velocity = 1e-8;

// The share of the largest row's terms that a row gets whose own terms vanish, as in `default_row_sizes`: with
// k_same_velocity it forgives 1e-14 of them, the round-off that a row gets from its neighbours.
constexpr double k_quiet_row = 1e-6;

// u = A f + b, and for each row the sum of the absolute terms.
struct Velocities {
  std::vector<double> u;
  std::vector<double> size;

  bool operator==(const Velocities& other) const {
    double largest = 0.0;
    for (Index i = 0; i < u.size(); ++i) largest = std::max({largest, size[i], other.size[i]});
    for (Index i = 0; i < u.size(); ++i) {
      const double scale = std::max(size[i], other.size[i]) + k_quiet_row * largest;
      if (std::abs(u[i] - other.u[i]) > k_same_velocity * scale) return false;
    }
    return true;
  }
};

class Contacts {
 public:
  Contacts(const LcpProblem& problem, std::vector<ContactPlace> places)
      : problem_(problem), places_(std::move(places)) {}

  Velocities velocities(const std::vector<double>& z) const {
    Velocities result;
    for (const ContactPlace& place : places_) {
      add_row(result, place.c, z, true);
      add_row(result, place.plus, z, true);
    }
    return result;
  }

  // A f for a direction of z. Not 0: the motion changes along the ray.
  bool moves_along(const std::vector<double>& ray) const {
    Velocities change;
    for (const ContactPlace& place : places_) {
      add_row(change, place.c, ray, false);
      add_row(change, place.plus, ray, false);
    }
    Velocities none = change;
    std::fill(none.u.begin(), none.u.end(), 0.0);
    return !(change == none);
  }

  std::vector<ContactMode> modes(const std::vector<double>& z, const std::vector<double>& u) const {
    std::vector<ContactMode> modes;
    for (Index i = 0; i < places_.size(); ++i) {
      const ContactPlace& place = places_[i];
      const double f_n = place.c >= 0 ? z[static_cast<Index>(place.c)] : 0.0;
      const double slip = place.s >= 0 ? z[static_cast<Index>(place.s)] : 0.0;
      modes.push_back(contact_mode(f_n, slip, u[2 * i + 1]));
    }
    return modes;
  }

 private:
  // One row of A f + b, or of A f. Friction counts as f_t = plus - minus: how it is split moves nothing.
  void add_row(Velocities& to, int row, const std::vector<double>& z, bool with_b) const {
    double sum = 0.0, size = 0.0;
    const auto add = [&](double term) {
      sum += term;
      size += std::abs(term);
    };
    if (row >= 0) {
      const auto i = static_cast<Index>(row);
      if (with_b) add(problem_.q[i]);
      for (const ContactPlace& place : places_) {
        if (place.c >= 0) add(problem_(i, static_cast<Index>(place.c)) * z[static_cast<Index>(place.c)]);
        if (place.plus < 0) continue;
        const auto plus = static_cast<Index>(place.plus), minus = static_cast<Index>(place.minus);
        add(problem_(i, plus) * (z[plus] - z[minus]));
      }
    }
    to.u.push_back(sum);
    to.size.push_back(size);
  }

  const LcpProblem& problem_;
  std::vector<ContactPlace> places_;
};

// Two solutions with impulses f_1, f_2 move all bodies alike if J^T f_1 and J^T f_2 do the same to each body that can
// move. That is so if and only if A f_1 = A f_2, A = J M^-1 J^T: with e = f_1 - f_2, e . A e is the kinetic energy of
// what J^T e does, and A e = 0 makes it 0. So it is enough to compare velocities at the contacts.
ContactMotions motions_of(const LcpProblem& problem, const Contacts& contacts) {
  const SolutionSet set = solution_set(problem);
  ContactMotions result;
  result.status = set.status;
  std::vector<Velocities> known;
  std::vector<Index> motion_of;  // per vertex
  for (const LcpResult& vertex : set.vertices) {
    Velocities velocities = contacts.velocities(vertex.z);
    const auto found = std::find(known.begin(), known.end(), velocities);
    motion_of.push_back(static_cast<Index>(found - known.begin()));
    if (found != known.end()) continue;
    result.motions.push_back({vertex.z, contacts.modes(vertex.z, velocities.u), velocities.u});
    known.push_back(std::move(velocities));
  }
  // All points of a face are solutions, and u is linear in f: between two motions lie all those between.
  for (const SolutionFace& face : set.faces) {
    for (const Index v : face.vertices) result.has_between |= motion_of[v] != motion_of[face.vertices.front()];
  }
  for (const std::vector<double>& ray : set.rays) result.has_between |= contacts.moves_along(ray);
  return result;
}

// Without friction a cone row names no normal, and the LCP does not tell which one is of the same contact. In `as_lcp`
// both follow the order of the contacts. Places of normals alone come last, see `find_contacts`.
void pair_without_friction(std::vector<ContactPlace>& places) {
  const auto first_normal = std::find_if(places.begin(), places.end(), [](const auto& p) { return p.plus < 0; });
  const auto has_no_normal = [](const ContactPlace& p) { return p.c < 0; };
  if (std::count_if(places.begin(), first_normal, has_no_normal) != places.end() - first_normal) return;
  auto normal = first_normal;
  for (auto place = places.begin(); place != first_normal; ++place) {
    if (has_no_normal(*place)) place->c = (normal++)->c;
  }
  places.erase(first_normal, places.end());
}

}  // namespace

ContactMotions contact_motions(const LcpProblem& problem) {
  validate(problem);
  ContactStructure structure;
  if (!find_contacts(problem, structure)) {
    throw std::invalid_argument("M: must be the matrix of planar contacts, one of them with a friction cone");
  }
  pair_without_friction(structure.places);
  return motions_of(problem, Contacts(problem, std::move(structure.places)));
}

ContactMotions contact_motions(const ContactSystem& system) {
  const LcpProblem problem = as_lcp(system);
  const int count = static_cast<int>(system.contacts.size());
  std::vector<ContactPlace> places;
  for (int i = 0; i < count; ++i) {
    const int plus = count + 2 * i;
    places.push_back({i, plus, plus + 1, 3 * count + i});
  }
  return motions_of(problem, Contacts(problem, std::move(places)));
}

}  // namespace tumble
