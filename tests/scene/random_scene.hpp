// Scenes at random, and all the bits of a scene, to compare two.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "tumble/scene/scene.hpp"

namespace tumble {

// The scene as numbers: doubles by their bits, texts by their bytes, each list after its size.
inline std::vector<std::uint64_t> bits_of(const Scene& scene) {
  std::vector<std::uint64_t> bits;
  const auto count = [&](std::size_t n) { bits.push_back(n); };
  const auto number = [&](double value) {
    std::uint64_t word;
    std::memcpy(&word, &value, sizeof word);
    bits.push_back(word);
  };
  const auto text = [&](const std::string& word) {
    count(word.size());
    for (const char c : word) bits.push_back(static_cast<unsigned char>(c));
  };
  const auto vector = [&](Vector2 v) { number(v.x), number(v.y); };
  const auto pose = [&](const Pose& p) { vector(p.position), number(p.angle); };
  const auto law = [&](const ContactLaw& l) { number(l.friction), number(l.static_friction), number(l.restitution); };
  text(scene.title);
  vector(scene.gravity);
  number(scene.step_size);
  number(scene.duration);
  count(scene.materials.size());
  for (const Material& material : scene.materials) text(material.name), law(material.law);
  count(scene.pairs.size());
  for (const MaterialPair& pair : scene.pairs) {
    count(static_cast<std::size_t>(pair.a));
    count(static_cast<std::size_t>(pair.b));
    law(pair.law);
  }
  count(scene.bodies.size());
  for (const Body& body : scene.bodies) {
    text(body.name);
    count(static_cast<std::size_t>(body.kind));
    count(body.parts.size());
    for (const Part& part : body.parts) {
      count(static_cast<std::size_t>(part.material));
      number(part.surface_speed);
      count(part.shape.index());
      if (const auto* polygon = std::get_if<RoundedPolygon>(&part.shape)) {
        count(polygon->vertices.size());
        for (const Vector2 v : polygon->vertices) vector(v);
        number(polygon->rounding);
      } else if (const auto* round = std::get_if<Ellipse>(&part.shape)) {
        number(round->semi_axis_x), number(round->semi_axis_y), pose(round->pose);
      } else if (const auto* plane = std::get_if<HalfPlane>(&part.shape)) {
        vector(plane->normal), number(plane->offset);
      } else if (const auto* terrain = std::get_if<Terrain>(&part.shape)) {
        count(terrain->points.size());
        for (const Vector2 p : terrain->points) vector(p);
      }
    }
    number(body.mass), number(body.moment_of_inertia), pose(body.pose);
    for (const double v : body.velocity) number(v);
    count(body.motion.size());
    for (const Knot& knot : body.motion) number(knot.time), pose(knot.pose);
    count(body.wrenches.size());
    for (const Wrench& w : body.wrenches) number(w.time), vector(w.force), number(w.torque);
    number(body.linear_damping), number(body.angular_damping);
  }
  return bits;
}

// A valid scene with all that a scene may hold: awkward names, zeros of both signs, numbers of many sizes.
inline Scene random_scene(std::mt19937_64& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto uniform = [&] { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); };
  const auto coordinate = [&] {
    constexpr double special[] = {0.0, -0.0, 0.1, 1.0, -1e12, 1e-300, 3.0, 1e10};
    return below(3) == 0 ? special[below(8)] : uniform() * (below(2) == 0 ? 1.0 : 1e6);
  };
  const auto vector = [&] { return Vector2{coordinate(), coordinate()}; };
  const auto pose = [&] { return Pose{vector(), below(2) == 0 ? 0.0 : 10.0 * uniform()}; };
  const auto size = [&] { return 0.01 + std::abs(uniform()); };
  const auto law = [&] {
    const double friction = std::abs(uniform());
    return ContactLaw{friction, friction + (below(2) == 0 ? 0.0 : 0.1), std::abs(uniform())};
  };
  const std::string names[] = {"wood", "a b", "quote\"d", "back\\slash", "b\xC3\xBCrste", "x.y", "[z]", "#", "'", "-"};

  Scene scene;
  scene.title = below(2) == 0 ? "" : "A \"title\" \\ # [x]";
  scene.gravity = {below(2) == 0 ? -0.0 : uniform(), 10.0 * uniform()};
  scene.step_size = size();
  scene.duration = size();
  const int materials = 1 + below(4);
  const int first_name = below(10);
  for (int i = 0; i < materials; ++i) scene.materials.push_back({names[(first_name + i) % 10], law()});
  if (materials > 2) scene.pairs = {{1, 0, law()}, {0, 2, law()}};

  const auto shape = [&](BodyKind kind) -> Shape {
    const int kinds = kind == BodyKind::fixed ? 9 : kind == BodyKind::kinematic ? 8 : 7;
    switch (below(kinds)) {
      case 0: return moved(rectangle(0.1 + size(), 0.1 + size(), 0.01), {{uniform(), uniform()}, uniform()});
      case 1: return rectangle(0.1 + size(), 0.1 + size(), below(2) == 0 ? 0.0 : 0.03);
      case 2: return disc(size(), vector());
      case 3: return moved(capsule(size(), size()), {{uniform(), uniform()}, uniform()});
      case 4: return Ellipse{size(), size(), pose()};
      case 5: return regular_polygon(3 + below(8), size());
      case 6: return segment({uniform(), uniform()}, {3.0, uniform()});
      case 7: return Terrain{{{-1.0, uniform()}, {0.0, -0.0}, {1.0, uniform()}, {2.5, uniform()}}};
      default: return moved(HalfPlane{{0.0, 1.0}, uniform()}, {{uniform(), uniform()}, below(2) * uniform()});
    }
  };
  const int bodies = below(5);
  for (int i = 0; i < bodies; ++i) {
    Body body;
    body.name = below(3) == 0 ? "" : names[i];
    body.kind = static_cast<BodyKind>(below(3));
    const int parts = 1 + below(3);
    for (int k = 0; k < parts; ++k) body.parts.push_back({shape(body.kind), below(materials), below(2) * uniform()});
    body.pose = pose();
    if (body.kind == BodyKind::dynamic) {
      body.mass = size();
      body.moment_of_inertia = size() * 1e-9;
      body.linear_damping = below(2) * size();
      body.angular_damping = below(2) * size();
      if (below(2) == 0) body.wrenches = {{0.0, vector(), uniform()}, {size(), {}, 0.0}};
    }
    if (body.kind == BodyKind::kinematic && below(2) == 0) {
      body.motion = {{size(), body.pose}, {2.0, pose()}, {2.5, pose()}};
    } else if (body.kind != BodyKind::fixed && below(2) == 0) {
      body.velocity = {uniform(), -0.0, uniform()};
    }
    scene.bodies.push_back(body);
  }
  return scene;
}

}  // namespace tumble
