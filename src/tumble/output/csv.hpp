// A record as text: a header of comment lines with the parameters, a line of column names, one row per column
// of the trajectory. Numbers are the shortest decimals that read back to the same bits.
#pragma once

#include <string>
#include <string_view>

#include "tumble/drop/drop.hpp"

namespace tumble::output {

// The comment lines and the line of column names. Throws std::invalid_argument if the record is inconsistent.
std::string csv_header(const drop::Record& record);

// The rows of the columns [first, last): a long record need not be in memory as text.
std::string csv_rows(const drop::Record& record, int first, int last);

std::string to_csv(const drop::Record& record);

// Reads what `to_csv` wrote, to the same bits. Throws std::invalid_argument "name:line:column: what, what is
// allowed" for anything else, a file that was cut off included.
drop::Record parse_record_csv(std::string_view text, const std::string& name);

}  // namespace tumble::output
