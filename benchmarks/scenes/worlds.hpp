// The worlds that engines are compared in, in words that every engine knows. SI units, radians, y up.
#pragma once

#include <string>
#include <vector>

#include "tumble/math/pose.hpp"
#include "tumble/math/vector.hpp"

namespace tumble::bench {

// A convex polygon, or a disc: one vertex and a radius.
struct Outline {
  std::vector<Vector2> vertices;  // counter-clockwise, at most 8
  double radius = 0.0;            // [m] of a disc; 0 of a polygon
};

struct WorldBody {
  Outline outline;                 // in the frame of the body, whose origin is its centre of mass
  double mass = 0.0;               // [kg]
  double moment_of_inertia = 0.0;  // [kg m^2]
  Pose pose;
  Vector3 velocity{};  // v_x, v_y, omega
};

// What a world is there to show, beside the time.
enum class Question {
  bounce,  // where the bodies are just before they touch the ground y = 0 again, against the exact motion
  stand,   // whether the bodies stay where they start
  pile,    // whether they come to rest, and how deep they overlap
};

struct World {
  std::string name;
  Question question = Question::bounce;
  std::vector<WorldBody> bodies;
  std::vector<Outline> walls;  // fixed, in the world frame
  double friction = 0.0;       // of every contact, whatever an engine's mixing rule
  double restitution = 0.0;
  double gravity = 9.81;  // downwards
  double duration = 0.0;  // [s]
};

// The document's square from its start, and a ball.
World dropped_square();
World dropped_ball();

// Squares as the document's, 4 m apart on one ground, each dropped at its own angle: as many drops in one world.
World squares_side_by_side(int count);

// Boxes that touch, one on the other, from the ground up.
World tower(int count);

// Boxes of side 0.2 m poured into a closed funnel that grows with their number. The same bits on every machine.
World pile(int count);

}  // namespace tumble::bench
