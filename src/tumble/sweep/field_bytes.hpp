// Named arrays of numbers as bytes of a chunk's file.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tumble/output/field.hpp"

namespace tumble::sweep {

// Names, shapes and numbers; no units and no texts.
std::string to_bytes(std::span<const output::Field> fields);

// Throws std::invalid_argument for bytes that are cut off or not of that kind.
std::vector<output::Field> fields_from_bytes(std::string_view bytes);

}  // namespace tumble::sweep
