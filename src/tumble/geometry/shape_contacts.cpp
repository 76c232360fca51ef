#include "tumble/geometry/shape_contacts.hpp"

#include <type_traits>

#include "tumble/geometry/pair_contacts.hpp"

namespace tumble {
namespace {

template <class A, class B>
concept HasContacts = requires(const A& a, const B& b, ContactPoints& contacts) {
  append_contacts(a, b, 0.0, contacts);
};

// Few contacts: by insertion.
void sort_by_feature(ContactPoints& contacts, std::size_t first) {
  for (std::size_t i = first + 1; i < contacts.size(); ++i) {
    for (std::size_t j = i; j > first && contacts[j].feature < contacts[j - 1].feature; --j) {
      std::swap(contacts[j], contacts[j - 1]);
    }
  }
}

}  // namespace

void append_sorted_contacts(const PlacedShape& a, const PlacedShape& b, double reach, ContactPoints& contacts) {
  const std::size_t first = contacts.size();
  const auto *polygon_a = std::get_if<PlacedPolygon>(&a), *polygon_b = std::get_if<PlacedPolygon>(&b);
  if (polygon_a && polygon_b) {  // nearly always: no look into a table of functions
    append_contacts(*polygon_a, *polygon_b, reach, contacts);
    if (contacts.size() > first + 1) sort_by_feature(contacts, first);
    return;
  }
  std::visit(
      [&](const auto& shape_a, const auto& shape_b) {
        using A = std::decay_t<decltype(shape_a)>;
        using B = std::decay_t<decltype(shape_b)>;
        if constexpr (HasContacts<A, B>) {
          append_contacts(shape_a, shape_b, reach, contacts);
        } else if constexpr (HasContacts<B, A>) {
          append_contacts(shape_b, shape_a, reach, contacts);
          for (std::size_t i = first; i < contacts.size(); ++i) contacts[i] = exchanged(contacts[i]);
        }
      },
      a, b);
  sort_by_feature(contacts, first);
}

void find_contacts(const Shape& a, const Frame& frame_a, const Shape& b, const Frame& frame_b, double reach,
                   std::vector<ContactPoint>& contacts) {
  PlacedShape placed_a = placed_shape(a), placed_b = placed_shape(b);
  place(placed_a, frame_a);
  place(placed_b, frame_b);
  append_sorted_contacts(placed_a, placed_b, reach, contacts);
}

}  // namespace tumble
