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

struct LcpWorkspace::Buffers {
  ScaledProblem scaled;
  bool has_contacts = false;
  ContactStructure contacts;  // filled if has_contacts
  ContactModes modes;
  std::vector<double> row_sizes, other_row_sizes;
  JudgeBuffers judge;
  Tableau tableau;
  DenseLu<double> lu;
  LuBasis<double> lu_basis;
  std::vector<std::size_t> basic_rows;
  std::vector<double> right, solution, z_scaled;
  std::vector<double> z, w;  // of the candidate being judged
};

}  // namespace tumble
