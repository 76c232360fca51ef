// tumble._core: systems of contacts as LCPs. Public face: tumble/lcp/.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "convert_lcp.hpp"

#include "tumble/lcp/contact_motions.hpp"
#include "tumble/lcp/contact_system.hpp"
#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/one_contact.hpp"
#include "tumble/lcp/solve_contacts.hpp"
#include "tumble/math/format.hpp"

namespace tumble::python {
namespace {

using namespace py::literals;
using Index = std::size_t;

constexpr Index k_max_contacts_of_motions = k_max_enumerate_size / 4;

// `as_array` without NaN and infinity; the core would name its own fields.
Array as_finite(const py::handle& object, const char* name, const std::vector<py::ssize_t>& shape,
                const std::string& shape_in_words = "") {
  Array array = as_array(object, name, shape, shape_in_words);
  const py::ssize_t columns = array.ndim() == 2 ? array.shape(1) : 0;
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    if (std::isfinite(array.data()[i])) continue;
    const std::string place =
        columns > 0 ? tumble::format("[{}][{}]", i / columns, i % columns) : tumble::format("[{}]", i);
    throw std::invalid_argument(tumble::format("{}{}: must be finite, got {}", name, place, array.data()[i]));
  }
  return array;
}

// Three numbers for each body.
std::vector<Vector3> per_body(const py::handle& object, const char* name, py::ssize_t length = -1) {
  const Array array = as_finite(object, name, {length}, length < 0 ? "(3 b,)" : "");
  if (array.size() % 3 != 0) {
    throw std::invalid_argument(tumble::format("{}: must have 3 entries for each body, got {}", name, array.size()));
  }
  std::vector<Vector3> values;
  for (const double* x = array.data(); x != array.data() + array.size(); x += 3) values.push_back({x[0], x[1], x[2]});
  return values;
}

// One number for each contact, or the same for all.
std::vector<double> per_contact(const py::handle& object, const char* name, py::ssize_t count) {
  if (num_dimensions(object, name) != 0) return as_vector(as_finite(object, name, {count}));
  const double value = as_number(object, name);
  if (!std::isfinite(value)) throw std::invalid_argument(tumble::format("{}: must be finite, got {}", name, value));
  return std::vector<double>(static_cast<Index>(count), value);
}

std::vector<double> frictions(const py::handle& object, py::ssize_t count) {
  std::vector<double> friction = per_contact(object, "friction", count);
  const auto negative = std::find_if(friction.begin(), friction.end(), [](double mu) { return mu < 0.0; });
  if (negative == friction.end()) return friction;
  throw std::invalid_argument(tumble::format("friction: must be finite and >= 0, got {} at contact {}", *negative,
                                             negative - friction.begin()));
}

Vector3 entries_of(const Array& J, py::ssize_t contact, int body) {
  if (body < 0) return {};
  return {J.at(contact, 3 * body), J.at(contact, 3 * body + 1), J.at(contact, 3 * body + 2)};
}

// The bodies that the rows of a contact touch: (-1, b) or (a, b), a < b.
std::array<int, 2> bodies_of(const Array& J_n, const Array& J_t, py::ssize_t contact) {
  std::array<int, 2> bodies = {-1, -1};
  for (py::ssize_t j = 0; j < J_n.shape(1); ++j) {
    const int body = static_cast<int>(j / 3);
    const bool is_touched = J_n.at(contact, j) != 0.0 || J_t.at(contact, j) != 0.0;
    if (!is_touched || body == bodies[1]) continue;
    if (bodies[0] >= 0) {
      throw std::invalid_argument(tumble::format("J_n[{0}], J_t[{0}]: must touch at most two bodies, got {1}, {2}, {3}",
                                                 contact, bodies[0], bodies[1], body));
    }
    bodies = {bodies[1], body};
  }
  if (bodies[1] < 0) throw std::invalid_argument(tumble::format("J_n[{0}], J_t[{0}]: must touch a body", contact));
  return bodies;
}

ContactSystem as_system(const py::handle& normal_rows, const py::handle& tangent_rows, const py::handle& inverse_mass,
                        const py::handle& velocity, const py::handle& friction, const py::handle& offset) {
  ContactSystem system;
  system.inverse_mass = per_body(inverse_mass, "inverse_mass");
  const auto columns = static_cast<py::ssize_t>(3 * system.inverse_mass.size());
  system.velocity = per_body(velocity, "velocity", columns);
  const Array J_n = as_finite(normal_rows, "J_n", {-1, columns}, tumble::format("(k, 3 b) = (k, {})", columns));
  const py::ssize_t count = J_n.shape(0);
  if (count == 0) throw std::invalid_argument("J_n: must have a row for each contact, at least 1, got 0");
  const Array J_t = as_finite(tangent_rows, "J_t", {count, columns});
  const std::vector<double> mu = frictions(friction, count);
  const std::vector<double> offsets = per_contact(offset, "offset", count);
  for (py::ssize_t i = 0; i < count; ++i) {
    const auto [a, b] = bodies_of(J_n, J_t, i);
    system.contacts.push_back({a, b, entries_of(J_n, i, a), entries_of(J_n, i, b), entries_of(J_t, i, a),
                               entries_of(J_t, i, b), mu[static_cast<Index>(i)], offsets[static_cast<Index>(i)]});
  }
  return system;
}

// (M, q, row_sizes)
py::tuple contact_problem(const py::handle& J_n, const py::handle& J_t, const py::handle& inverse_mass,
                          const py::handle& velocity, const py::handle& friction, const py::handle& offset) {
  const LcpProblem problem = as_lcp(as_system(J_n, J_t, inverse_mass, velocity, friction, offset));
  const auto n = static_cast<py::ssize_t>(problem.size());
  return py::make_tuple(to_numpy(problem.M, n, n), to_numpy(problem.q), to_numpy(problem.row_sizes));
}

py::list as_words(const std::vector<ContactMode>& modes) {
  py::list words;
  for (const ContactMode mode : modes) words.append(py::str(to_string(mode)));
  return words;
}

// The fields of tumble.lcp.Motions, each motion as (z, modes, velocities with a row for each contact).
py::dict motions_dict(const ContactMotions& found) {
  py::list motions;
  for (const ContactMotion& motion : found.motions) {
    const auto count = static_cast<py::ssize_t>(motion.modes.size());
    motions.append(py::make_tuple(to_numpy(motion.z), as_words(motion.modes), to_numpy(motion.velocities, count, 2)));
  }
  return py::dict("status"_a = py::str(to_string(found.status)), "motions"_a = motions,
                  "has_between"_a = found.has_between);
}

py::dict solve_contacts(const py::handle& J_n, const py::handle& J_t, const py::handle& inverse_mass,
                        const py::handle& velocity, const py::handle& friction, const py::handle& offset,
                        const py::handle& method, const py::handle& motions_wanted, const py::dict& settings) {
  const bool wants_motions = as_flag(motions_wanted, "motions");
  const ContactSystem system = as_system(J_n, J_t, inverse_mass, velocity, friction, offset);
  if (wants_motions && system.contacts.size() > k_max_contacts_of_motions) {
    throw std::invalid_argument(tumble::format("motions: must be False for more than {} contacts, got {}",
                                               k_max_contacts_of_motions, system.contacts.size()));
  }
  const LcpSettings chosen = as_settings(method, settings);
  ContactSolution solution;
  ContactMotions motions;
  {
    const py::gil_scoped_release without_gil;
    solution = tumble::solve_contacts(system, chosen);
    if (wants_motions) motions = tumble::contact_motions(system);
  }
  std::vector<double> velocities;
  for (const Vector3& v : solution.velocity) velocities.insert(velocities.end(), v.begin(), v.end());
  py::object of_motions = py::none();
  if (wants_motions) of_motions = motions_dict(motions);
  return py::dict("normal_impulse"_a = to_numpy(solution.normal_impulse),
                  "friction_impulse"_a = to_numpy(solution.friction_impulse),
                  "slip_speed"_a = to_numpy(solution.slip_speed), "mode"_a = as_words(solution.mode),
                  "velocity"_a = to_numpy(velocities), "result"_a = as_dict(solution.result), "motions"_a = of_motions);
}

py::dict contact_motions(const py::handle& M, const py::handle& q, const py::handle& row_sizes) {
  const LcpProblem problem = as_problem(M, q, row_sizes);
  ContactMotions motions;
  {
    const py::gil_scoped_release without_gil;
    motions = tumble::contact_motions(problem);
  }
  return motions_dict(motions);
}

// One array for each field of OneContactSolution.
py::dict solve_one_contacts(const py::handle& A_nn, const py::handle& A_nt, const py::handle& A_tt,
                            const py::handle& b_n, const py::handle& b_t, const py::handle& friction) {
  const Array nn = as_array(A_nn, "A_nn", {-1}, "(N,)");
  const py::ssize_t count = nn.size();
  const Array nt = as_array(A_nt, "A_nt", {count}), tt = as_array(A_tt, "A_tt", {count});
  const Array n = as_array(b_n, "b_n", {count}), t = as_array(b_t, "b_t", {count});
  const Array mu = as_array(friction, "friction", {count});
  py::array_t<double> f_n(count), f_t(count), slip_speed(count), residual(count);
  py::array_t<std::uint8_t> mode(count), status(count);
  const auto size = static_cast<Index>(count);
  const auto in = [&](const Array& array) { return std::span(array.data(), size); };
  const OneContactArrays contacts{in(nn), in(nt), in(tt), in(n), in(t), in(mu)};
  const auto out = [&](py::array_t<double>& array) { return std::span(array.mutable_data(), size); };
  const OneContactSolutionArrays solutions{out(f_n),
                                           out(f_t),
                                           out(slip_speed),
                                           out(residual),
                                           {reinterpret_cast<ContactMode*>(mode.mutable_data()), size},
                                           {reinterpret_cast<LcpStatus*>(status.mutable_data()), size}};
  {
    const py::gil_scoped_release without_gil;
    tumble::solve_one_contacts(contacts, solutions);
  }
  return py::dict("f_n"_a = f_n, "f_t"_a = f_t, "slip_speed"_a = slip_speed, "residual"_a = residual, "mode"_a = mode,
                  "status"_a = status);
}

}  // namespace

void bind_contacts(py::module_& module) {
  module.def("contact_problem", &contact_problem, "J_n"_a, "J_t"_a, "inverse_mass"_a, "velocity"_a, "friction"_a,
             "offset"_a);
  module.def("solve_contacts", &solve_contacts, "J_n"_a, "J_t"_a, "inverse_mass"_a, "velocity"_a, "friction"_a,
             "offset"_a, "method"_a, "motions"_a, "settings"_a);
  module.def("contact_motions", &contact_motions, "M"_a, "q"_a, "row_sizes"_a);
  module.def("solve_one_contacts", &solve_one_contacts, "A_nn"_a, "A_nt"_a, "A_tt"_a, "b_n"_a, "b_t"_a, "friction"_a);
  py::list modes;
  for (const ContactMode mode :
       {ContactMode::open, ContactMode::stick, ContactMode::slip_left, ContactMode::slip_right}) {
    modes.append(py::str(to_string(mode)));
  }
  module.attr("MODES") = py::tuple(modes);
}

}  // namespace tumble::python
