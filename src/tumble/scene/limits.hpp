// What a scene may hold. The ranges keep squares and products of what is inside far from the ends of double; the counts
// keep a wrong or hostile file from taking the memory of the machine.
#pragma once

#include <cstddef>
#include <string_view>

namespace tumble {

struct Range {
  double low, high;  // both allowed
  std::string_view unit;
};

inline constexpr Range k_coordinate_range = {-1e12, 1e12, "m"};
inline constexpr Range k_size_range = {1e-12, 1e12, "m"};  // radii, semi-axes, sides
inline constexpr Range k_rounding_range = {0.0, 1e12, "m"};
inline constexpr Range k_angle_range = {-1e9, 1e9, "rad"};
inline constexpr Range k_speed_range = {-1e9, 1e9, "m/s"};
inline constexpr Range k_angular_velocity_range = {-1e9, 1e9, "rad/s"};
inline constexpr Range k_gravity_range = {-1e9, 1e9, "m/s^2"};
inline constexpr Range k_time_range = {0.0, 1e12, "s"};
inline constexpr Range k_step_size_range = {1e-12, 1e12, "s"};
inline constexpr Range k_duration_range = {1e-12, 1e12, "s"};
inline constexpr Range k_density_range = {1e-30, 1e30, "kg/m^2"};
inline constexpr Range k_mass_range = {1e-60, 1e60, "kg"};
inline constexpr Range k_inertia_range = {1e-60, 1e60, "kg m^2"};
inline constexpr Range k_force_range = {-1e60, 1e60, "N"};
inline constexpr Range k_torque_range = {-1e60, 1e60, "N m"};
inline constexpr Range k_damping_range = {0.0, 1e9, "1/s"};
inline constexpr Range k_friction_range = {0.0, 1e6, ""};
inline constexpr Range k_restitution_range = {0.0, 1.0, ""};

// Of the length of a half-plane's normal: the rounding of a length of 1, and some more for one that was turned.
inline constexpr double k_unit_length_tolerance = 1e-14;
inline constexpr double k_max_ellipse_ratio = 1e6;  // of the longer semi-axis to the shorter one

inline constexpr std::size_t k_max_vertices = 1000;  // of one polygon
inline constexpr std::size_t k_max_terrain_points = 100'000;
inline constexpr std::size_t k_max_parts = 1000;  // of one body
inline constexpr std::size_t k_max_bodies = 100'000;
inline constexpr std::size_t k_max_materials = 1000;
inline constexpr std::size_t k_max_pairs = 10'000;
inline constexpr std::size_t k_max_table_entries = 100'000;  // knots or wrenches of one body
inline constexpr std::size_t k_max_entries = 5'000'000;      // vertices, points, parts, knots, wrenches of all bodies
inline constexpr std::size_t k_max_name_bytes = 100;
inline constexpr std::size_t k_max_title_bytes = 1000;

inline constexpr std::size_t k_max_scene_bytes = std::size_t{64} << 20;  // of a file
inline constexpr std::size_t k_max_scene_values = 4'000'000;             // in a file

}  // namespace tumble
