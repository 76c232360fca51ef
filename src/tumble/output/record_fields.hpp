// A record as named arrays: the one layout behind .npz and .h5.
//   q, v 3 x T;  t, gap, corner, mode, status, residual, kinetic, potential T;  z 4 x T;  the parameters as
//   scalars.
// mode and status are codes: indices into mode_names and status_names.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tumble/drop/drop.hpp"
#include "tumble/output/field.hpp"

namespace tumble::output {

// Throws std::invalid_argument if the sizes within the record disagree or its parameters are not allowed.
void check_record(const drop::Record& record);

// Total energies per column [J], as drop::kinetic_energy and drop::potential_energy.
double kinetic_at(const drop::Record& record, int column);
double potential_at(const drop::Record& record, int column);

std::vector<Field> to_fields(const drop::Record& record);

// What a reader found under one name, integers turned into doubles.
struct NumberArray {
  std::vector<std::size_t> shape;
  std::vector<double> values;
};

// The names a reader has to look for; all others are of no concern to it.
std::vector<std::string> field_names_read();

// The most values that one of them can have.
std::size_t max_values_read();

// Needs q, v and the parameters. Where gap, corner, z, mode, status or residual are absent they are computed
// anew, by the step of each column. Throws std::invalid_argument "name: field: what, what is allowed".
drop::Record from_fields(const std::map<std::string, NumberArray>& fields, const std::string& name);

}  // namespace tumble::output
