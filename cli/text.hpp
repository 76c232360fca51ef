// Words of the command line as numbers, with errors that repeat what was typed.
#pragma once

#include <string>

#include "tumble/contact/island_solver.hpp"
#include "tumble/math/vector.hpp"

namespace tumble::cli {

// Each throws std::invalid_argument "<option>: <what is expected>, got '<text>'".
double number(const std::string& option, const std::string& text);
int whole_number(const std::string& option, const std::string& text);

// An angle in rad, or in degrees with the ending "deg": "0.5", "30deg".
double angle(const std::string& option, const std::string& text);

// "x,y,theta": two numbers and an angle (or an angular velocity).
Vector3 planar_triple(const std::string& option, const std::string& text);

// "exact" or "fast".
ContactSolver contact_solver(const std::string& option, const std::string& text);

}  // namespace tumble::cli
