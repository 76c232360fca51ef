// JSON as the program prints it. Not for headers: nlohmann's is long to compile.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace tumble::cli {

using Json = nlohmann::ordered_json;  // names in the order in which they are written

// With the line end. Names of files may hold bytes that are not UTF-8; JSON may not, so each becomes U+FFFD.
inline std::string to_text(const Json& report) {
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tumble::cli
