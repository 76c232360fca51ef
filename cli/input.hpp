// Files that the program reads, "-" being standard input.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "tumble/scene/scene.hpp"

namespace tumble::cli {

// For messages: "standard input", or the name without bytes that a terminal would act on.
std::string input_name(const std::string& file);

// Throws std::invalid_argument if it has more than `max_bytes`, std::system_error if it cannot be read.
std::string read_input(const std::string& file, std::size_t max_bytes);

// Throws as read_input, and std::invalid_argument "file:line:column: field: ..." as parse_scene.
Scene read_scene(const std::string& file);

// Where the page for .html files is looked for: $TUMBLE_PAGE, else share/tumble/tumble.html beside the folder of this
// program.
std::filesystem::path page_path();

}  // namespace tumble::cli
