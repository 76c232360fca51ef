// Vectors in the plane.
#pragma once

#include <cmath>

namespace tumble {

struct Vector2 {
  double x = 0.0;
  double y = 0.0;

  friend bool operator==(const Vector2&, const Vector2&) = default;
};

inline Vector2 operator+(Vector2 a, Vector2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vector2 operator-(Vector2 a, Vector2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vector2 operator-(Vector2 a) { return {-a.x, -a.y}; }
inline Vector2 operator*(double s, Vector2 a) { return {s * a.x, s * a.y}; }

inline double dot(Vector2 a, Vector2 b) { return a.x * b.x + a.y * b.y; }
inline double cross(Vector2 a, Vector2 b) { return a.x * b.y - a.y * b.x; }
inline double length(Vector2 a) { return std::sqrt(dot(a, a)); }

// Turned by +90 and by -90 degrees. The tangent of a contact is its normal turned right: +x for the normal +y.
inline Vector2 turned_left(Vector2 a) { return {-a.y, a.x}; }
inline Vector2 turned_right(Vector2 a) { return {a.y, -a.x}; }

}  // namespace tumble
