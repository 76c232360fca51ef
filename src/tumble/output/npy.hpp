// Arrays as numpy stores them, the entries of .npz files. Not a public header.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tumble/output/field.hpp"

namespace tumble::output {

// What stands before the values: `descr` is numpy's name of the type, like <f8.
std::string npy_header(const std::string& descr, const std::vector<std::size_t>& shape);

std::string to_npy(const Field& field);

}  // namespace tumble::output
