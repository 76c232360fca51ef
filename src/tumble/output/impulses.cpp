#include "tumble/output/impulses.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "tumble/contact/contact_rows.hpp"

namespace tumble::output {
namespace {

auto key_of(const Contact& contact) {
  return std::tuple(contact.body_a, contact.body_b, contact.part_a, contact.part_b, contact.feature);
}

bool is_earlier(const Impulse& a, const Impulse& b) {
  return a.step != b.step ? a.step < b.step : key_of(a.contact) < key_of(b.contact);
}

}  // namespace

Impulse impulse_of(const ContactRecord& record, const Scene& scene, std::int64_t step) {
  const Contact& contact = record.contact;
  // Contacts act on b, and by their opposites on a.
  const bool on_b = scene.bodies[static_cast<std::size_t>(contact.body_b)].kind == BodyKind::dynamic;
  Impulse impulse;
  impulse.step = step;
  const ContactPlaces places = contact_places(contact, contact.gap > 0.0);
  impulse.place = on_b ? places.on_b : places.on_a;
  impulse.normal = on_b ? contact.normal : -contact.normal;
  impulse.along_normal = record.normal_impulse;
  impulse.along_tangent = record.friction_impulse;  // both directions turn round with the normal
  impulse.size = std::hypot(record.normal_impulse, record.friction_impulse);
  if (!std::isfinite(impulse.size)) impulse.size = 0.0;
  impulse.friction = record.law.friction;
  impulse.mode = record.mode;
  impulse.contact = contact;
  return impulse;
}

std::vector<Impulse> largest_of_each_touch(const Trajectory& trajectory) {
  constexpr double k_about_equal = 0.9;
  std::vector<Impulse> impulses;
  struct Touch {
    Impulse shown;
    double largest;
    std::int64_t last_step;
  };
  std::map<decltype(key_of({})), Touch> touches;
  for (const StepContacts& step : trajectory.contacts) {
    for (const ContactRecord& record : step.contacts) {
      const Impulse impulse = impulse_of(record, trajectory.scene, step.step);
      if (impulse.size == 0.0) continue;
      const auto place = touches.try_emplace(key_of(record.contact), Touch{impulse, 0.0, step.step}).first;
      Touch& touch = place->second;
      if (touch.last_step + 1 < step.step) {
        impulses.push_back(touch.shown);
        touch.largest = 0.0;
      }
      if (impulse.size >= k_about_equal * touch.largest) touch.shown = impulse;
      touch.largest = std::max(touch.largest, impulse.size);
      touch.last_step = step.step;
    }
  }
  for (const auto& [key, touch] : touches) impulses.push_back(touch.shown);
  std::sort(impulses.begin(), impulses.end(), is_earlier);
  return impulses;
}

std::vector<Impulse> impulses_at_end(const Trajectory& trajectory) {
  std::vector<Impulse> impulses;
  if (trajectory.contacts.empty() || trajectory.contacts.back().step != trajectory.num_steps) return impulses;
  for (const ContactRecord& record : trajectory.contacts.back().contacts) {
    impulses.push_back(impulse_of(record, trajectory.scene, trajectory.num_steps));
  }
  return impulses;
}

std::vector<Impulse> largest_of_each_contact(std::vector<Impulse> impulses, std::size_t count, double smallest) {
  std::stable_sort(impulses.begin(), impulses.end(), [](const Impulse& a, const Impulse& b) {
    return key_of(a.contact) != key_of(b.contact) ? key_of(a.contact) < key_of(b.contact) : a.size > b.size;
  });
  const auto is_same = [](const Impulse& a, const Impulse& b) { return is_same_contact(a.contact, b.contact); };
  impulses.erase(std::unique(impulses.begin(), impulses.end(), is_same), impulses.end());
  return keep_largest(std::move(impulses), count, smallest);
}

std::vector<Impulse> keep_largest(std::vector<Impulse> impulses, std::size_t count, double smallest) {
  std::erase_if(impulses, [&](const Impulse& impulse) { return impulse.size < smallest; });
  std::stable_sort(impulses.begin(), impulses.end(),
                   [](const Impulse& a, const Impulse& b) { return a.size > b.size; });
  if (impulses.size() > count) impulses.resize(count);
  std::sort(impulses.begin(), impulses.end(), is_earlier);
  return impulses;
}

double largest_size(const std::vector<Impulse>& impulses) {
  double largest = 0.0;
  for (const Impulse& impulse : impulses) largest = std::max(largest, impulse.size);
  return largest;
}

bool is_same_contact(const Contact& a, const Contact& b) { return key_of(a) == key_of(b); }

}  // namespace tumble::output
