// The contacts of each pair of kinds of shapes, see find_contacts. The functions append contacts in no certain order.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "tumble/geometry/contact_point.hpp"
#include "tumble/geometry/placed_shape.hpp"

namespace tumble {

using ContactPoints = std::vector<ContactPoint>;

void append_contacts(const PlacedPolygon& a, const PlacedPolygon& b, double reach, ContactPoints& contacts);
void append_contacts(const PlacedPolygon& a, const PlacedHalfPlane& b, double reach, ContactPoints& contacts);
void append_contacts(const PlacedEllipse& a, const PlacedEllipse& b, double reach, ContactPoints& contacts);
void append_contacts(const PlacedEllipse& a, const PlacedPolygon& b, double reach, ContactPoints& contacts);
void append_contacts(const PlacedEllipse& a, const PlacedHalfPlane& b, double reach, ContactPoints& contacts);
void append_contacts(const PlacedPolygon& a, const PlacedTerrain& b, double reach, ContactPoints& contacts);
void append_contacts(const PlacedEllipse& a, const PlacedTerrain& b, double reach, ContactPoints& contacts);

// Of any two shapes, sorted by feature.
void append_sorted_contacts(const PlacedShape& a, const PlacedShape& b, double reach, ContactPoints& contacts);

// Features of one shape: 16 bits each of a contact's feature, those of a above those of b.
inline std::uint32_t corner_feature(int i) { return (2U * static_cast<std::uint32_t>(i)) & 0xffffU; }
inline std::uint32_t side_feature(int i) { return corner_feature(i) | 1U; }
inline std::uint32_t pair_feature(std::uint32_t a, std::uint32_t b) { return a << 16U | b; }

// The contact with a and b exchanged.
inline ContactPoint exchanged(const ContactPoint& c) {
  return {-c.normal, c.point_b, c.point_a, c.gap, c.radius_b, c.radius_a, c.feature << 16U | c.feature >> 16U};
}

}  // namespace tumble
