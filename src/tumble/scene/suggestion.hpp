// What messages say about a word that is none of those allowed. Not a public header.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "tumble/math/format.hpp"
#include "tumble/scene/check.hpp"

namespace tumble {

// A word of the user for a message: short, and without bytes that a terminal would act on.
inline std::string shown(std::string_view word) {
  if (word.size() <= 40 && is_plain_text(word)) return tumble::format("'{}'", word);
  std::string text;
  for (const char c : word.substr(0, 40)) text += (c > 31 && c < 127) ? c : '?';
  return tumble::format("'{}{}'", text, word.size() > 40 ? "..." : "");
}

// Insertions, deletions and exchanges that make one word the other.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row[b.size()];
}

// "; did you mean 'friction'?" if one of the words is near, else "; allowed are a, b, c".
template <class Words>
std::string suggestion(std::string_view word, const Words& words) {
  std::string_view nearest;
  std::size_t least = 1 + std::max(std::size_t{2}, word.size() / 3);
  for (const std::string_view known : words) {
    if (word.size() > k_max_name_bytes) break;
    const std::size_t distance = edit_distance(word, known);
    if (distance < least) {
      least = distance;
      nearest = known;
    }
  }
  if (!nearest.empty()) return tumble::format("; did you mean '{}'?", nearest);
  std::string list;
  for (const std::string_view known : words) {
    if (list.size() > 300) return "; allowed are " + list + ", ...";
    list += (list.empty() ? "" : ", ") + std::string(known);
  }
  return list.empty() ? "" : "; allowed are " + list;
}

}  // namespace tumble
