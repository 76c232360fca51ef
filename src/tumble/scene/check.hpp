// Checks shared by the stage: one message for one mistake. Not a public header.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "tumble/math/format.hpp"
#include "tumble/scene/limits.hpp"
#include "tumble/scene/scene.hpp"

namespace tumble {

// Throws std::invalid_argument "field: must be in [low, high] unit, got value unit". NaN is outside every range.
inline void require_in(const Range& range, std::string_view field, double value) {
  if (value >= range.low && value <= range.high) return;
  throw std::invalid_argument(tumble::format("{}: must be in [{}, {}]{}{}, got {}", field, range.low, range.high,
                                             range.unit.empty() ? "" : " ", range.unit, value));
}

inline void require_count(std::string_view field, std::size_t count, std::size_t least, std::size_t most) {
  if (count >= least && count <= most) return;
  throw std::invalid_argument(tumble::format("{}: must have {} to {} entries, got {}", field, least, most, count));
}

// What one piece must hold by itself; messages name the field within it.
void check_law(const ContactLaw& law);
void check_body(const Body& body, std::size_t material_count);
void check_name(std::string_view field, std::string_view name, std::size_t max_bytes);

// Valid UTF-8 without control characters.
bool is_plain_text(std::string_view text);

}  // namespace tumble
