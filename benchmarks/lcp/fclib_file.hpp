// Contact problems in the HDF5 files of the Frictional Contact Library (fclib).
#pragma once

#include <filesystem>

#include "tumble/lcp/problem.hpp"

namespace tumble::problems {

// Writes the LCP of planar contacts, as `as_lcp` of contact_system.hpp orders it, as fclib's local problem with
// spacedim 2: u = W r + q, two rows per contact, normal before tangent, and the friction mu of each contact. A file of
// that name is replaced once the new one is complete. Throws std::invalid_argument if the problem is none of contacts
// in that order, std::runtime_error if the file cannot be written.
void write_fclib(const std::filesystem::path& path, const LcpProblem& problem);

// Reads such a file as the LCP of `as_lcp`, row sizes included. Throws std::runtime_error for a file that cannot be
// read or holds something else: spatial contacts, a global problem, equality constraints (V, R, s).
LcpProblem read_fclib(const std::filesystem::path& path);

}  // namespace tumble::problems
