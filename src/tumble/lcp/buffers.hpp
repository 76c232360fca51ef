// What an LcpWorkspace holds. Not a public header.
#pragma once

#include "tumble/lcp/contact_modes.hpp"
#include "tumble/lcp/contact_structure.hpp"
#include "tumble/lcp/dense_lu.hpp"
#include "tumble/lcp/judge.hpp"
#include "tumble/lcp/lu_basis.hpp"
#include "tumble/lcp/scaled_problem.hpp"
#include "tumble/lcp/tableau.hpp"
#include "tumble/lcp/workspace.hpp"

namespace tumble {

struct NewtonBuffers {
  std::vector<double> z, w, phi;  // the iterate, in scaled numbers
  std::vector<double> jacobian, gradient, step;
  std::vector<double> next, next_w, next_phi;
};

struct LcpWorkspace::Buffers {
  ScaledProblem scaled;
  bool has_contacts = false;
  ContactStructure contacts;  // filled if has_contacts
  ContactModes modes;
  RowSizes row_sizes;
  std::vector<double> other_sizes;
  JudgeBuffers judge;
  Tableau tableau;
  DenseLu<double> lu;
  LuBasis<double> lu_basis;
  std::vector<std::size_t> basic_rows;
  std::vector<double> right, solution, z_scaled;
  std::vector<double> z, w;  // of the candidate being judged

  // What single methods need.
  std::vector<double> w_scaled, w_terms;
  std::vector<double> values, step;
  std::vector<std::uint8_t> basis;  // of the candidate
  NewtonBuffers newton;
  std::vector<double> impulses;
  std::vector<ContactMode> impulse_modes;
};

}  // namespace tumble
