// Which bodies are joined by contacts.
#include <algorithm>

#include "tumble/step/step_parts.hpp"

namespace tumble {
namespace {

using Index = std::size_t;
using Parts = StepWorkspace::Parts;

int root_of(std::vector<int>& parent, int body) {
  while (parent[static_cast<Index>(body)] != body) {
    int& next = parent[static_cast<Index>(body)];
    next = parent[static_cast<Index>(next)];
    body = next;
  }
  return body;
}

// Bodies joined by contacts, contacts listed island by island, both in the order of the contacts.
void find_islands(Parts& parts) {
  const auto body_of = [](const StepContact& c) { return c.rows.body_a >= 0 ? c.rows.body_a : c.rows.body_b; };
  for (const StepContact& c : parts.contacts) {
    if (!c.is_listed) continue;
    for (const int body : {c.rows.body_a, c.rows.body_b}) {
      if (body >= 0) parts.parent[static_cast<Index>(body)] = body;
    }
  }
  for (const StepContact& c : parts.contacts) {
    if (!c.is_listed || c.rows.body_a < 0 || c.rows.body_b < 0) continue;
    const int a = root_of(parts.parent, c.rows.body_a), b = root_of(parts.parent, c.rows.body_b);
    parts.parent[static_cast<Index>(std::max(a, b))] = std::min(a, b);
  }
  const auto island_of = [&](const StepContact& c) -> int& {
    return parts.island_of[static_cast<Index>(root_of(parts.parent, body_of(c)))];
  };
  for (const StepContact& c : parts.contacts) {
    if (c.is_listed) island_of(c) = -1;
  }
  parts.island_begin.assign(1, 0);
  for (const StepContact& c : parts.contacts) {
    if (!c.is_listed) continue;
    int& island = island_of(c);
    if (island < 0) {
      island = static_cast<int>(parts.island_begin.size()) - 1;
      parts.island_begin.push_back(0);
    }
    ++parts.island_begin[static_cast<Index>(island) + 1];
  }
  for (Index i = 1; i < parts.island_begin.size(); ++i) parts.island_begin[i] += parts.island_begin[i - 1];
  const int num_listed = parts.island_begin.back();
  parts.island_contact.resize(static_cast<Index>(num_listed));
  for (Index i = parts.contacts.size(); i-- > 0;) {
    if (!parts.contacts[i].is_listed) continue;
    // Filled from the end, so that begin moves down to where the island begins.
    int& next = parts.island_begin[static_cast<Index>(island_of(parts.contacts[i])) + 1];
    parts.island_contact[static_cast<Index>(--next)] = static_cast<int>(i);
  }
  // Every begin has moved to the one before: move them back.
  parts.island_begin.erase(parts.island_begin.begin());
  parts.island_begin.push_back(num_listed);
}

// f(contacts, outcome) for each island.
template <typename F>
void for_islands(Parts& parts, const F& f) {
  for (Index i = 0; i + 1 < parts.island_begin.size(); ++i) {
    const auto begin = static_cast<Index>(parts.island_begin[i]), end = static_cast<Index>(parts.island_begin[i + 1]);
    const IslandContacts contacts = IslandContacts(parts.island_contact).subspan(begin, end - begin);
    f(contacts, parts.contacts[static_cast<Index>(contacts.front())].outcome);
  }
}

}  // namespace

void list_bodies(Parts& parts, IslandContacts contacts) {
  parts.island_body.clear();
  for (const int i : contacts) {
    const BodyContact& rows = parts.contacts[static_cast<Index>(i)].rows;
    for (const int body : {rows.body_a, rows.body_b}) {
      if (body < 0 || parts.local_body[static_cast<Index>(body)] >= 0) continue;
      parts.local_body[static_cast<Index>(body)] = static_cast<int>(parts.island_body.size());
      parts.island_body.push_back(body);
    }
  }
}

void forget_bodies(Parts& parts) {
  for (const int body : parts.island_body) parts.local_body[static_cast<Index>(body)] = -1;
}

void step_islands(double h, const StepSettings& settings, Parts& parts) {
  parts.island_begin.assign(1, 0);
  parts.island_contact.clear();
  if (parts.contacts.empty()) return;
  find_islands(parts);
  for_islands(parts, [&](IslandContacts contacts, IslandOutcome& outcome) {
    bool is_new = false;
    for (const int c : contacts) {
      is_new = is_new || parts.contacts[static_cast<Index>(c)].is_new;
      parts.contacts[static_cast<Index>(c)].is_new = false;
    }
    if (is_new) outcome = step_island(parts, contacts, h, settings);
  });
}

bool separate_islands(double h, const StepSettings& settings, Parts& parts) {
  bool has_shifted = false;
  for_islands(parts, [&](IslandContacts contacts, IslandOutcome& outcome) {
    if (outcome.has_moved && separate(parts, contacts, h, settings, outcome.lost)) has_shifted = true;
    outcome.has_moved = false;
  });
  return has_shifted;
}

}  // namespace tumble
