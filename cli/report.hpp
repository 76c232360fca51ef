// What `tumble drop` prints: tables for people, JSON for machines.
#pragma once

#include <string>
#include <vector>

#include "tumble/drop/drop.hpp"

namespace tumble::cli {

// A table of the impacts, the final state and the files written.
std::string drop_text(const drop::Record& record, const std::vector<std::string>& files);
std::string drop_json(const drop::Record& record, const std::vector<std::string>& files);

// "wrote a.csv, b.png", if there are any; the last line of a report.
std::string files_text(const std::vector<std::string>& files);

}  // namespace tumble::cli
